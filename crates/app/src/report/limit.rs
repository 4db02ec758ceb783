//! Part of a report: a search for limit loads.

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
use crate::output::{LimitFile, table as tables, with_unit};
use percoat_case::units::Units;
use percoat_core::measured::Measured;
use percoat_core::run::{At, EVENTS, Limits};

const PICTURES: [PictureText; 1 + EVENTS] = [
    (
        "limit",
        "Curves of the utilisation of each criterion over the load",
        "Utilisation of each criterion over the load; it fails where it reaches 1.",
    ),
    (
        "limit-section",
        "Maps of stresses in a vertical cut under the place that fails first",
        "Stresses in a vertical cut through the place that fails first, at its limit load; numbers: what is at or beyond its \
         strength.",
    ),
    ("limit-section-2", SECTION_TEXT[0], SECTION_TEXT[1]),
    ("limit-section-3", SECTION_TEXT[0], SECTION_TEXT[1]),
    ("limit-section-4", SECTION_TEXT[0], SECTION_TEXT[1]),
];

/// Texts of the sections through places that fail later.
const SECTION_TEXT: [&str; 2] = [
    "Maps of stresses in a vertical cut through a place that fails at a higher load",
    "Stresses in a vertical cut through the place that fails next, at its limit load.",
];

/// The part of the page for a search for limit loads, from `limit.json`.
pub(super) fn part(results: &Results, file: &LimitFile) -> Result<Part, ReportError> {
    let path = results.folder.join("limit.json");
    let (case, limits) = (&file.case, file.limits());
    let text = case_text(case).map_err(|reason| ReportError::version(&path, &file.percoat, reason))?;
    let units = units_of(&file.units, case_of(&text, &results.folder).as_ref(), case);
    let found = tables::limits(&limits, &units);
    let mut sections = vec![
        section(
            "answer",
            "Answer",
            vec![
                doubts(&limits.steps),
                with(
                    "p",
                    &[("class", "answer")],
                    numbers(&first(&limits, &units).unwrap_or_else(|| upper(&found.words))),
                ),
                table("Limit loads; ± is the estimated error of the grid", &found.table),
                assumed(case, true),
                tables::wider_windows(&limits, &units)
                    .map_or(Markup::default(), |words| tag("p", numbers(&upper(&words)))),
            ],
        ),
        section("problem", "Problem", vec![problem(case), tag("p", measured_in(&units))]),
        section("pictures", "Pictures", vec![figures(results, "limit.json", &PICTURES)?]),
    ];
    if !limits.steps.is_empty() {
        let caption = "Loads that were solved in the search, by ascending load";
        sections.push(section("loads", "Loads solved", vec![table(caption, &tables::steps(&limits.steps, &units))]));
    }
    sections.push(warnings());
    if !limits.steps.is_empty() {
        sections.push(section("resolution", "Resolution", vec![resolution(&limits.steps, limits.change)]));
        let tolerance = case["solver"]["tolerance"].as_f64();
        sections.push(section("certificate", "Certificate", vec![certificate(&limits.steps, tolerance)]));
    }
    sections.push(section("time", "Version", vec![by(&file.percoat)]));
    sections.push(section("case", "Case", vec![case_to_copy(&text, "limit")]));
    Ok(Part {
        name: "limit",
        kind: "Limit loads",
        title: file.title.clone(),
        sections,
        warnings: file.warnings.clone(),
    })
}

/// The criterion that fails first with its load, where no other one may be first within the errors.
fn first(limits: &Limits, units: &Units) -> Option<String> {
    let first = limits.first()?;
    let At::Load { load, error, .. } = first.at else { return None };
    if !first.is_sharp() || !limits.contenders().is_empty() {
        return None;
    }
    let load = with_unit(&units.load(), Measured::new(load, error));
    Some(format!("First: {} at the {} {load}.", first.criterion, limits.quantity.name()))
}
