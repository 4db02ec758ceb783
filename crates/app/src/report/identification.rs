//! Part of a report: parameters found from measured indentation curves.

use super::ReportError;
use super::figures::{PictureText, figures};
use super::markup::{Markup, numbers, tag};
use super::part::{Part, by, case_text, case_to_copy, section, warnings};
use super::problem::problem;
use super::resolution::upper;
use super::results::Results;
use super::table::table;
use super::units::{case_of, measured_in, units_of};
use crate::output::IdentificationFile;

const PICTURES: [PictureText; 1] = [(
    "identification",
    "Measured points with the fit, and their difference",
    "The measured points, the fit, and their difference over the force.",
)];

const OF_UNLOADING: [PictureText; 1] = [(
    "identification",
    "Stiffness of unloading over the contact radius, measured and of the layered body",
    "The stiffness of unloading over the contact radius: measured, and that of the layered body found, of its surface and of its substrate alone.",
)];

/// The part of the page for an identification, from `identification.json`.
pub(super) fn part(results: &Results, file: &IdentificationFile) -> Result<Part, ReportError> {
    let path = results.folder.join("identification.json");
    let case = &file.case;
    let text = case_text(case).map_err(|reason| ReportError::version(&path, &file.percoat, reason))?;
    let units = units_of(&file.units, case_of(&text, &results.folder).as_ref(), case);
    let lines = |lines: Vec<String>| lines.iter().map(|line| tag("p", numbers(&upper(line)))).collect::<Markup>();
    let caption = "What was found; ± is one standard error by the scatter of the points, left out where it is more than three tenths";
    let known = file.by_known().map(|known| table("Change of what was found by what was taken as known", &known));
    let of_curves = if file.is_of_unloading() {
        "Unloadings: what was measured, and the contact at the largest force with hardness and the formula for bare bodies"
    } else {
        "Residuals of the curves"
    };
    let curves: Markup = file.of_curves(&units).iter().map(|curves| table(of_curves, curves)).collect();
    let pictures = if file.is_of_unloading() { &OF_UNLOADING } else { &PICTURES };
    let sections = vec![
        section("answer", "Answer", vec![table(caption, &file.found()), lines(file.correlations())]),
        section("fit", "Fit", vec![lines(file.fit(&units)), curves, known.unwrap_or_default()]),
        section("pictures", "Pictures", vec![figures(results, "identification.json", pictures)?]),
        section("problem", "Problem with what was found", vec![problem(case), tag("p", measured_in(&units))]),
        warnings(),
        section("time", "Version", vec![by(&file.percoat)]),
        section("case", "Case with what was found", vec![case_to_copy(&text, "solve")]),
    ];
    Ok(Part {
        name: "identification",
        kind: "Identification",
        title: file.title.clone(),
        sections,
        warnings: file.warnings.clone(),
    })
}
