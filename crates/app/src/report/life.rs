//! Part of a report: how long a body lasts.

use super::ReportError;
use super::answer::doubts;
use super::certificate::certificate;
use super::figures::{PictureText, figures};
use super::markup::{Markup, numbers, tag, with};
use super::part::{Part, assumed, by, case_text, case_to_copy, section, warnings};
use super::problem::problem;
use super::resolution::{resolution, upper};
use super::results::Results;
use super::table::table;
use super::units::{case_of, measured_in, units_of};
use crate::output::{LifeFile, table as tables};

const PICTURES: [PictureText; 2] = [
    (
        "damage",
        "Map of the damage in a pass below the surface, with the interfaces",
        "Damage in a pass across the path and below the surface; lines: interfaces; cross: where it is largest.",
    ),
    (
        "life",
        "Curves of the layers that are left, of what is removed and of the peak pressure over the passes",
        "What is left of the layers, what is removed and worn off, and the peak pressure, over the passes.",
    ),
];

/// The part of the page for a life, from `life.json`.
pub(super) fn part(results: &Results, file: &LifeFile) -> Result<Part, ReportError> {
    let path = results.folder.join("life.json");
    let case = &file.case;
    let text = case_text(case).map_err(|reason| ReportError::version(&path, &file.percoat, reason))?;
    let units = units_of(&file.units, case_of(&text, &results.folder).as_ref(), case);
    let lives = tables::lives(&file.steps, &units);
    let answer = |words: &str| with("p", &[("class", "answer")], numbers(&upper(words)));
    let mut found = vec![doubts(&file.steps)];
    found.push(answer(&tables::headline(file, &units)));
    if let Some(lives) = &lives {
        found.push(table("Passes until damage 1; ± is the estimated error of the grid", &lives.table));
    }
    found.push(assumed(case, false));
    let left = tables::left(file, &units).map_or(Markup::default(), |words| tag("p", numbers(&upper(&words))));
    found.push(left);
    let mut sections = vec![
        section("answer", "Answer", found),
        section("problem", "Problem", vec![problem(case), tag("p", measured_in(&units))]),
        section("pictures", "Pictures", vec![figures(results, "life.json", &PICTURES)?]),
    ];
    if let Some(events) = tables::events(&file.events, &units).filter(|_| file.end.is_some()) {
        sections.push(section("events", "Events", vec![table("What fails and comes off, pass after pass", &events)]));
    }
    let first = "The contact before the first pass";
    sections.push(section("contact", "Contact", vec![table(first, &tables::steps(&file.steps, &units))]));
    sections.push(warnings());
    sections.push(section("resolution", "Resolution", vec![resolution(&file.steps, None)]));
    let tolerance = case["solver"]["tolerance"].as_f64();
    sections.push(section("certificate", "Certificate", vec![certificate(&file.steps, tolerance)]));
    sections.push(section("time", "Version", vec![by(&file.percoat)]));
    sections.push(section("case", "Case", vec![case_to_copy(&text, "life")]));
    Ok(Part { name: "life", kind: "Life", title: file.title.clone(), sections, warnings: file.warnings.clone() })
}
