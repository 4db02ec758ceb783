//! `summary.json` and `curve.csv`: every scalar of a run.

use super::columns::{csv, scalars};
use super::fingerprint::fingerprint;
use super::read_back::{Unreadable, read_back};
use super::{Timing, indented};
use crate::case::Case;
use crate::run::StepRecord;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// A whole run, as `summary.json` has it. Two runs of one case differ in `timing` and in the `seconds` of the steps alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The version that wrote it.
    pub percoat: String,
    /// Title of the case.
    pub title: String,
    /// The whole case, with its defaults.
    pub case: Value,
    /// Names of the units of all numbers.
    #[serde(default)]
    pub units: UnitNames,
    /// What a reader should know before trusting the numbers.
    pub warnings: Vec<String>,
    /// Of the case and the version: with it a run recognises its own finished result.
    #[serde(default)]
    pub fingerprint: String,
    /// Change between the two finest grids, where an accuracy was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<f64>,
    /// The load steps.
    pub steps: Vec<StepRecord>,
    /// Where the time went.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing: Option<Timing>,
}

/// Names of units, `None` where they have none.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct UnitNames {
    /// Of lengths.
    pub length: Option<String>,
    /// Of pressures.
    pub pressure: Option<String>,
}

impl UnitNames {
    /// Those of a case.
    pub(super) fn of(case: &Case) -> Self {
        let units = case.units();
        Self { length: units.length().name(), pressure: units.pressure().name() }
    }
}

impl Summary {
    /// Of a run of a case; `accuracy`: the change between the two finest grids, where an accuracy was asked for.
    pub fn new(case: &Case, warnings: &[String], accuracy: Option<f64>, steps: &[StepRecord], timing: Timing) -> Self {
        Self {
            percoat: env!("CARGO_PKG_VERSION").to_owned(),
            title: case.title.clone(),
            case: json!(case),
            units: UnitNames::of(case),
            warnings: warnings.to_vec(),
            fingerprint: fingerprint(case, ""),
            accuracy,
            steps: steps.to_vec(),
            timing: Some(timing),
        }
    }

    /// Reads the run back that a file holds.
    ///
    /// # Errors
    /// [`Unreadable`] with the key that is not as this version writes it.
    pub fn read(file: &Value) -> Result<Self, Unreadable> {
        let summary: Self = read_back(file)?;
        check(&summary.steps)?;
        Ok(summary)
    }

    /// The file.
    pub fn to_json(&self) -> String {
        indented(self)
    }
}

/// Refuses steps of which one is not as a run leaves it.
pub(super) fn check(steps: &[StepRecord]) -> Result<(), Unreadable> {
    let refused = |number: usize, reason| Unreadable { place: format!("step {number}"), reason };
    (1..).zip(steps).try_for_each(|(number, step)| step.check().map_err(|reason| refused(number, reason)))
}

/// The steps as a CSV table: one row a step, one column a scalar, nested names joined by underscores (`levels_1_load`).
/// A cell stays empty where a step does not have the scalar.
pub fn curve(steps: &[StepRecord]) -> String {
    csv(|| steps.iter().map(|step| scalars(&json!(step))))
}
