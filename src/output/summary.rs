//! `summary.json` and `curve.csv`: every scalar of a run.

use super::Timing;
use super::columns::{csv, scalars};
use super::fingerprint::fingerprint;
use crate::case::Case;
use crate::run::StepRecord;
use serde_json::{Value, json};

/// A whole run as indented JSON; `accuracy`: the change between the two finest grids, where an accuracy was asked for.
/// Two runs of one case differ in `timing` and in the `seconds` of the steps alone.
pub fn summary(
    case: &Case,
    warnings: &[String],
    accuracy: Option<f64>,
    steps: &[StepRecord],
    timing: Timing,
) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let mut summary =
        json!({ "percoat": version, "title": case.title, "case": case, "units": units(case), "warnings": warnings });
    // With it a run knows that it is finished.
    summary["fingerprint"] = fingerprint(case, "").into();
    if let Some(accuracy) = accuracy {
        summary["accuracy"] = accuracy.into();
    }
    summary["steps"] = json!(steps);
    summary["timing"] = json!(timing);
    format!("{summary:#}\n")
}

/// The names of the units of all numbers, null where they have none.
pub(super) fn units(case: &Case) -> Value {
    let units = case.units();
    json!({ "length": units.length().name(), "pressure": units.pressure().name() })
}

/// The steps as a CSV table: one row a step, one column a scalar, nested names joined by underscores (`levels_1_load`).
/// What a step does not have stays empty.
pub fn curve(steps: &[StepRecord]) -> String {
    csv(|| steps.iter().map(|step| scalars(&json!(step))))
}
