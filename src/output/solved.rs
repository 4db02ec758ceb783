//! What a solved case leaves beside its pictures.

use super::histograms::histograms;
use super::plan::Plan;
use super::summary::{Summary, curve};
use super::writer::Writer;
use super::{OutputError, Timing, write_text};
use crate::case::Case;
use crate::run::Outcome;
use std::path::Path;

/// The files of a case with so many load steps, with their fields or without; pictures come besides.
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
                names.extend((1..=steps).map(|step| format!("stress.{step:04}.vts")));
            }
        }
    }
    names.extend(["curve.csv", "summary.json"].map(str::to_owned));
    Plan { names, case: Some(case.to_toml()), ..Plan::new(Writer::Solve) }
}

/// Writes every scalar of a solved case into the folder where its result is gathered.
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
