//! Files of a solved case, without its pictures.

use super::histograms::histograms;
use super::plan::Plan;
use super::stress::volume_name;
use super::summary::{Summary, curve};
use super::writer::Writer;
use super::{OutputError, Timing, write_text};
use percoat_case::case::Case;
use percoat_core::body::HalfSpace;
use percoat_core::run::Outcome;
use std::path::Path;

/// The plan of a solved case with `steps` load steps; `fields`: whether fields are kept. Pictures are not included.
pub fn solved_plan(case: &Case, steps: usize, fields: bool) -> Plan {
    let mut names = vec!["case.toml".to_owned()];
    if case.surface.is_some() {
        names.push("histograms.csv".to_owned());
    }
    if fields {
        names.push("contact.npz".to_owned());
        if let Some(stress) = &case.stress {
            names.push("stress.npz".to_owned());
            if stress.volume.is_some() {
                let sides = case.problem().bodies().each().map(HalfSpace::side);
                names.extend(sides.flat_map(|side| (1..=steps).map(move |step| volume_name(side, step))));
            }
        }
    }
    names.extend(["curve.csv", "summary.json"].map(str::to_owned));
    Plan { names, case: Some(case.to_toml()), ..Plan::new(Writer::Solve) }
}

/// Writes every scalar of a solved case into its staging folder.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn write_scalars(
    folder: &Path,
    case: &Case,
    outcome: &Outcome,
    warnings: &[String],
    timing: Timing,
) -> Result<(), OutputError> {
    let summary = Summary::new(case, warnings, outcome.change, &outcome.steps, timing);
    write_text(&folder.join("summary.json"), &summary.to_json())?;
    write_text(&folder.join("curve.csv"), &curve(&outcome.steps))?;
    match histograms(&outcome.steps) {
        Some(histograms) => write_text(&folder.join("histograms.csv"), &histograms),
        None => Ok(()),
    }
}
