//! `steps.jsonl`: every step of an unfinished run, one line each, appended as it is done.
//!
//! A line is the step as it will stand in `summary.json`, with what a run that goes on needs besides: its number and load, which
//! run it is of, the files that it has left with their checksums, and a [checksum](super::trailer) of the line itself. Whatever ends
//! the run, the lines that end are whole steps: a step is finished where its line ends.

use super::error::At;
use super::json::read_back;
use super::log::{LineLog, whole_lines};
use super::trailer::{with_checksum, without_checksum};
use super::{Files, OutputError};
use crate::load::Load;
use crate::reading::Histogram;
use crate::run::StepRecord;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// Name of the file.
pub(super) const NAME: &str = "steps.jsonl";

/// The steps of an unfinished run.
#[derive(Debug)]
pub(super) struct StepsLog {
    log: LineLog,
    /// [Fingerprint](super::fingerprint) of the run; none where no later one goes on from it.
    run: Option<String>,
    /// Number of steps that it has.
    steps: usize,
}

/// A line.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Logged {
    #[serde(flatten)]
    pub(super) place: Place,
    #[serde(flatten)]
    pub(super) record: StepRecord,
    /// The histograms of a topography, which the record of a step leaves out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    histograms: Vec<Histogram>,
    pub(super) files: Files,
}

/// Which step of which run a line is of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Place {
    /// Its number, from 1.
    pub(super) step: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) run: Option<String>,
    pub(super) load: Prescribed,
}

/// A load as it was given.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Prescribed {
    MeanPressure(f64),
    Penetration(f64),
}

impl From<Load> for Prescribed {
    fn from(load: Load) -> Self {
        match load {
            Load::MeanPressure(value) => Self::MeanPressure(value),
            Load::Penetration(value) => Self::Penetration(value),
        }
    }
}

impl StepsLog {
    /// No steps yet; `folder` is the staging folder.
    pub(super) fn new(folder: &Path, run: Option<String>) -> Self {
        Self { log: LineLog::new(folder.join(NAME)), run, steps: 0 }
    }

    /// The log of an interrupted run, of whose steps the first so many stay when the next is added.
    pub(super) fn go_on(folder: &Path, run: Option<String>, steps: usize) -> Result<Self, OutputError> {
        let path = folder.join(NAME);
        let lines = if steps > 0 { whole_lines(&path).at(&path)? } else { Vec::new() };
        let known = lines.into_iter().take(steps).map(|line| line + "\n").collect();
        Ok(Self { log: LineLog::after(path, known), run, steps })
    }

    /// Appends a step with the files that it has left. Refused when the first one finds steps there already, unless it goes on
    /// after them.
    pub(super) fn add(&mut self, load: Load, record: &StepRecord, files: Files) -> Result<(), OutputError> {
        let histograms = record.rough.as_ref().map_or(Vec::new(), |rough| rough.histograms.clone());
        self.steps += 1;
        let place = Place { step: self.steps, run: self.run.clone(), load: load.into() };
        let line = serde_json::to_string(&Logged { place, record: record.clone(), histograms, files });
        let line = with_checksum(&line.expect("a step is numbers and texts under names")) + "\n";
        self.log.add(&line)
    }
}

/// A line of a log, if it is as it was written.
pub(super) fn logged(line: &str) -> Result<Logged, String> {
    let object = without_checksum(line).map_err(|error| error.to_string())?;
    let value: Value = serde_json::from_str(&object).map_err(|error| error.to_string())?;
    let mut line: Logged = read_back(&value).map_err(|error| error.to_string())?;
    if let Some(rough) = &mut line.record.rough {
        rough.histograms = std::mem::take(&mut line.histograms);
    }
    line.record.check().map_err(|reason| format!("step {}: {reason}", line.place.step))?;
    Ok(line)
}
