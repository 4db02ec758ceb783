//! What is known of a combination when it is done.

use crate::case::{Case, plausibility};
use crate::output::columns::{Cells, plain, scalars};
use crate::run::{Limits, Outcome, StepRecord};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::combinations::column;

/// How a combination ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// As it should.
    Done,
    /// Something did not converge; all numbers are there.
    NotConverged,
    /// There are no numbers.
    Failed,
}

impl Status {
    /// As the table has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::NotConverged => "not_converged",
            Self::Failed => "failed",
        }
    }
}

/// A combination that is done: a line of `sweep.jsonl`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its place in the sweep, from 1.
    pub combination: usize,
    /// What it sets, each key with its value as typed.
    pub settings: Vec<(String, String)>,
    /// Of the whole case that was solved, and how: equal only where the results are.
    pub fingerprint: String,
    /// How it ended.
    pub status: Status,
    /// Why, where it did not end as it should.
    pub reason: Option<String>,
    /// What a reader should know before trusting the numbers.
    pub warnings: Vec<String>,
    /// Its results: one object a load step, as in `summary.json`, or one with the limits.
    pub results: Vec<Value>,
    /// Wall time, seconds.
    pub seconds: f64,
}

/// How a combination ended, and with what.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ended {
    pub(super) status: Status,
    pub(super) reason: Option<String>,
    pub(super) warnings: Vec<String>,
    pub(super) results: Vec<Value>,
}

impl Ended {
    /// Without results.
    pub(super) fn failed(reason: impl Into<String>) -> Self {
        Self { status: Status::Failed, reason: Some(reason.into()), warnings: Vec::new(), results: Vec::new() }
    }

    pub(super) fn solved(outcome: &Outcome, case: &Case) -> Self {
        let stopped = outcome.steps.iter().find(|step| !step.converged()).map(StepRecord::stop_reason);
        let inaccurate =
            || outcome.end.filter(|_| !outcome.is_accurate()).map(|end| format!("accuracy not reached: {end}"));
        let reason = stopped.or_else(inaccurate);
        let results = outcome.steps.iter().map(|step| {
            let mut step = json!(step);
            // No two runs share it.
            step.as_object_mut().and_then(|step| step.shift_remove("seconds"));
            step
        });
        Self::with(reason, [&outcome.warnings[..], &plausibility::of_case(case)].concat(), results.collect())
    }

    pub(super) fn limited(limits: &Limits, results: Value, case: &Case) -> Self {
        let reason = (!limits.converged()).then(|| "a load or the accuracy did not converge".to_owned());
        Self::with(reason, [&limits.warnings[..], &plausibility::of_case(case)].concat(), vec![results])
    }

    fn with(reason: Option<String>, warnings: Vec<String>, results: Vec<Value>) -> Self {
        let status = if reason.is_some() { Status::NotConverged } else { Status::Done };
        Self { status, reason, warnings, results }
    }
}

impl Row {
    /// Its number and what it sets.
    pub fn named(&self) -> String {
        let settings: Vec<String> = self.settings.iter().map(|(key, value)| format!("{key}={value}")).collect();
        format!("combination {} ({})", self.combination, settings.join(", "))
    }

    /// Its lines in `sweep.csv`: one a load step, or one alone.
    pub fn cells(&self) -> Vec<Cells> {
        let cell = |name: &str, value: String| (name.to_owned(), value);
        let line = |(step, results): (Option<usize>, &Value)| {
            let mut cells = vec![cell("combination", self.combination.to_string())];
            cells.extend(self.settings.iter().map(|(key, value)| cell(&column(key), plain(value))));
            cells.push(cell("status", self.status.name().to_owned()));
            cells.push(cell("step", step.map_or(String::new(), |step| step.to_string())));
            cells.extend(scalars(results));
            cells.push(cell("warnings", plain(&self.warnings.join("; "))));
            cells.push(cell("reason", plain(self.reason.as_deref().unwrap_or(""))));
            cells
        };
        if self.results.is_empty() {
            return vec![line((None, &json!({})))];
        }
        (1..).map(Some).zip(&self.results).map(line).collect()
    }
}
