//! Part of a report: a load by the spectral and by the localized method.

use super::ReportError;
use super::answer::doubts;
use super::certificate::certificate;
use super::figures::{PictureText, figures};
use super::markup::{numbers, tag};
use super::part::{Part, assumed, by, case_text, case_to_copy, section};
use super::problem::problem;
use super::resolution::upper;
use super::results::Results;
use super::table::table;
use super::units::{case_of, measured_in, units_of};
use crate::output::{ComparisonFile, table as tables};

const PICTURES: [PictureText; 1] = [(
    "comparison",
    "Curves of the differences between the methods over the number of indenters that act",
    "How far the localized method is from the spectral one, over the number of indenters inside the circle.",
)];

/// The part of the page for a comparison, from `compare.json`.
pub(super) fn part(results: &Results, file: &ComparisonFile) -> Result<Part, ReportError> {
    let path = results.folder.join("compare.json");
    let case = &file.case;
    let text = case_text(case).map_err(|reason| ReportError::version(&path, &file.percoat, reason))?;
    let read = case_of(&text, &results.folder);
    let units = units_of(&file.units, read.as_ref(), case);
    let steps = std::slice::from_ref(&file.spectral);
    let stresses = read.as_ref().and_then(|case| tables::stresses(file, case));
    let stresses = stresses.map(|words| vec![tag("p", numbers(&upper(&words))), assumed(case, false)]);
    let differences =
        "Largest relative differences from the spectral solution, and those of half the elements and half the grid";
    let sections = vec![
        section("answer", "Answer", vec![doubts(steps), table(differences, &tables::differences(file))]),
        section(
            "methods",
            "Both methods",
            vec![table("Both methods, level by level", &tables::readings(file, &units))],
        ),
        section("stresses", "Stresses", stresses.unwrap_or_default()),
        section("pictures", "Pictures", vec![figures(results, "compare.json", &PICTURES)?]),
        section("problem", "Problem", vec![problem(case), tag("p", measured_in(&units))]),
        section("certificate", "Certificate", vec![certificate(steps, case["solver"]["tolerance"].as_f64())]),
        section("time", "Version", vec![by(&file.percoat)]),
        section("case", "Case", vec![case_to_copy(&text, "compare")]),
    ];
    Ok(Part { name: "comparison", kind: "Comparison", title: file.title.clone(), sections, warnings: Vec::new() })
}
