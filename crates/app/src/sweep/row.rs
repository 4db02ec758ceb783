//! A combination that is done: its settings, results and ending.

use super::combinations::column;
use super::result::SweepResult;
use crate::output::Files;
use crate::output::columns::Cells;
use crate::task::{Limited, Solved};
use percoat_core::run::StepRecord;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// How a combination ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Everything converged.
    Done,
    /// Something did not converge; the results are there.
    NotConverged,
    /// No results: the solution failed.
    Failed,
}

impl Status {
    /// Code of the status in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::NotConverged => "not_converged",
            Self::Failed => "failed",
        }
    }
}

/// A finished combination: a line of `sweep.jsonl`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Number of the combination in the sweep, from 1.
    pub combination: usize,
    /// Each key of the sweep with its value as typed.
    pub settings: Vec<(String, String)>,
    /// Fingerprint of the whole case and the task: equal only where the results are.
    pub fingerprint: String,
    /// How it ended.
    pub status: Status,
    /// Why it failed or did not converge; `None` where it is done.
    pub reason: Option<String>,
    /// Doubts about the results.
    pub warnings: Vec<String>,
    /// A result for each load step, or one with the limits; none where the combination failed.
    pub results: Vec<SweepResult>,
    /// Wall time, seconds.
    pub seconds: f64,
    /// Files of the combination by their names in its folder, where fields are kept.
    #[serde(default, skip_serializing_if = "Files::is_empty")]
    pub files: Files,
}

/// How a combination ended, with its results and files.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ended {
    pub(super) status: Status,
    pub(super) reason: Option<String>,
    pub(super) warnings: Vec<String>,
    pub(super) results: Vec<SweepResult>,
    pub(super) files: Files,
}

impl Ended {
    /// A failed combination.
    pub(super) fn failed(reason: impl Into<String>) -> Self {
        let (reason, files) = (Some(reason.into()), Files::default());
        Self { status: Status::Failed, reason, warnings: Vec::new(), results: Vec::new(), files }
    }

    pub(super) fn solved(Solved { outcome, warnings }: Solved) -> Self {
        let stopped = outcome.steps.iter().find(|step| !step.converged()).map(|step| step.stop.to_string());
        let inaccurate =
            || outcome.end.filter(|_| !outcome.is_accurate()).map(|end| format!("accuracy not reached: {end}"));
        let reason = stopped.or_else(inaccurate);
        // The time differs from run to run.
        let results = outcome.steps.into_iter().map(|step| StepRecord { seconds: None, ..step });
        let results = results.map(|step| SweepResult::Step(Box::new(step)));
        Self::with(reason, warnings, results.collect())
    }

    pub(super) fn limited(Limited { limits, warnings, .. }: Limited) -> Self {
        let reason = (!limits.converged()).then(|| "a load or the accuracy did not converge".to_owned());
        let results = vec![SweepResult::Limits(limits.limits)];
        Self::with(reason, warnings, results)
    }

    fn with(reason: Option<String>, warnings: Vec<String>, results: Vec<SweepResult>) -> Self {
        let status = if reason.is_some() { Status::NotConverged } else { Status::Done };
        Self { status, reason, warnings, results, files: Files::default() }
    }

    /// The ending with the files of its fields.
    pub(super) fn leaving(self, files: Files) -> Self {
        Self { files, ..self }
    }
}

impl Row {
    /// The row of a combination without results, for a `reason`; `settings` are its keys with their values.
    pub fn failed(number: usize, settings: Vec<(String, String)>, fingerprint: String, reason: String) -> Self {
        let Ended { status, reason, warnings, results, files } = Ended::failed(reason);
        Self { combination: number, settings, fingerprint, status, reason, warnings, results, seconds: 0.0, files }
    }

    /// Refuses a row that no sweep writes.
    pub(super) fn checked(&self) -> Result<(), String> {
        let has_failed = self.status == Status::Failed;
        if self.combination == 0 {
            return Err("there is no combination 0".to_owned());
        }
        if has_failed != self.results.is_empty() {
            let has = if has_failed { "has results" } else { "has no results" };
            return Err(format!("combination {} {has} and is marked {}", self.combination, self.status.name()));
        }
        for step in self.results.iter().filter_map(SweepResult::step) {
            step.check().map_err(|reason| format!("combination {}: {reason}", self.combination))?;
        }
        if !(self.seconds >= 0.0 && self.seconds.is_finite()) {
            return Err(format!("combination {} took {} seconds", self.combination, self.seconds));
        }
        Ok(())
    }

    /// Number and settings of the combination in words.
    pub fn named(&self) -> String {
        let settings: Vec<String> = self.settings.iter().map(|(key, value)| format!("{key}={value}")).collect();
        format!("combination {} ({})", self.combination, settings.join(", "))
    }

    /// Lines of the combination in `sweep.csv`: one for each load step, or a single one.
    pub fn cells(&self) -> Vec<Cells> {
        let cell = |name: &str, value: Value| (name.to_owned(), value);
        let line = |(step, results): (Option<usize>, Cells)| {
            let mut cells = vec![cell("combination", self.combination.into())];
            cells.extend(self.settings.iter().map(|(key, value)| cell(&column(key), value.as_str().into())));
            cells.push(cell("status", self.status.name().into()));
            cells.push(cell("step", json!(step)));
            cells.extend(results);
            cells.push(cell("warnings", self.warnings.join("; ").into()));
            cells.push(cell("reason", self.reason.as_deref().unwrap_or("").into()));
            cells
        };
        if self.results.is_empty() {
            return vec![line((None, Cells::new()))];
        }
        (1..).map(Some).zip(self.results.iter().map(SweepResult::cells)).map(line).collect()
    }
}
