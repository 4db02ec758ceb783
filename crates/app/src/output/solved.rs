//! Files of a solved case, without its pictures.

use super::histograms::histograms;
use super::plan::Plan;
use super::recording::files;
use super::summary::{Summary, curve};
use super::writer::Writer;
use super::{OutputError, Timing, write_text};
use percoat_case::case::Case;
use percoat_core::run::Outcome;
use std::path::Path;

/// A file of the scalars of a solved case.
struct Scalars {
    name: &'static str,
    /// Whether a case has it.
    of: fn(&Case) -> bool,
    content: fn(&Summary) -> Option<String>,
}

const SCALARS: [Scalars; 3] = [
    Scalars { name: "histograms.csv", of: |case| case.surface.is_some(), content: |run| histograms(&run.steps) },
    Scalars { name: "curve.csv", of: |_| true, content: |run| Some(curve(&run.steps)) },
    Scalars { name: "summary.json", of: |_| true, content: |run| Some(run.to_json()) },
];

/// The plan of a solved case with `steps` load steps; `fields`: whether fields are kept. Pictures are not included.
pub fn solved_plan(case: &Case, steps: usize, fields: bool) -> Plan {
    let scalars = SCALARS.iter().filter(|scalars| (scalars.of)(case)).map(|scalars| scalars.name.to_owned());
    let names = files(case, steps, fields).into_iter().chain(scalars).collect();
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
    let written = SCALARS.iter().filter_map(|scalars| Some((scalars.name, (scalars.content)(&summary)?)));
    written.into_iter().try_for_each(|(name, text)| write_text(&folder.join(name), &text))
}
