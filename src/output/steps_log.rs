//! `steps.jsonl`: every step of an unfinished run, one line each, appended as it is done.
//!
//! A line is the step as it will stand in `summary.json`, with what a run that goes on needs besides: its number and load, which
//! run it is of, the files that it has left with their checksums, and a [checksum](super::trailer) of the line itself. Whatever ends
//! the run, the lines that end are whole steps: a step is finished where its line ends.

use super::disk::{self, Appended};
use super::trailer::{with_checksum, without_checksum};
use super::{Files, OutputError, recorded, write_file, write_text};
use crate::load::Load;
use crate::reading::Histogram;
use crate::run::StepRecord;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

/// Name of the file.
pub(super) const NAME: &str = "steps.jsonl";

/// The steps of an unfinished run.
#[derive(Debug)]
pub(super) struct StepsLog {
    path: PathBuf,
    /// [Fingerprint](super::fingerprint) of the run; none where no later one goes on from it.
    run: Option<String>,
    /// Number of steps that it has.
    steps: usize,
    /// Open from the first step on.
    file: Option<Appended>,
    /// Lines of an earlier run with which it begins.
    known: Option<String>,
}

#[derive(Serialize)]
struct Line<'a> {
    #[serde(flatten)]
    place: Place,
    #[serde(flatten)]
    record: &'a StepRecord,
    /// Largest pressures on the grid, of all and of each level, also where they are infinite under a tip.
    peaks: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    histograms: Option<&'a Vec<Histogram>>,
    files: Files,
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

/// A line that is as it was written.
#[derive(Debug)]
pub(super) struct Logged {
    pub(super) place: Place,
    pub(super) record: StepRecord,
    pub(super) files: Files,
}

impl StepsLog {
    /// No steps yet; `folder` is where the result is gathered.
    pub(super) fn new(folder: &Path, run: Option<String>) -> Self {
        Self { path: folder.join(NAME), run, steps: 0, file: None, known: None }
    }

    /// After an earlier run; of its steps the first so many stay when the next is added.
    pub(super) fn go_on(folder: &Path, run: Option<String>, steps: usize) -> Result<Self, OutputError> {
        let path = folder.join(NAME);
        let lines =
            if steps > 0 { whole_lines(&path).map_err(|error| OutputError::new(&path, error))? } else { Vec::new() };
        let known = lines.into_iter().take(steps).map(|line| line + "\n").collect();
        Ok(Self { path, run, steps, file: None, known: Some(known) })
    }

    /// Appends a step with the files that it has left. Refused when the first one finds steps there already, unless it goes on
    /// after them.
    pub(super) fn add(&mut self, load: Load, record: &StepRecord, files: Files) -> Result<(), OutputError> {
        let histograms = record.rough.as_ref().map(|rough| &rough.histograms);
        let levels = record.reading.levels.iter().map(|level| level.max_pressure);
        let peaks = std::iter::once(record.reading.max_pressure).chain(levels).collect();
        self.steps += 1;
        let place = Place { step: self.steps, run: self.run.clone(), load: load.into() };
        let line = serde_json::to_string(&Line { place, record, peaks, histograms, files });
        let line = with_checksum(&line.expect("a step is numbers and texts under names")) + "\n";
        let failed = |error| OutputError::new(&self.path, error);
        match &mut self.file {
            Some(file) => file.add(line.as_bytes()).map_err(failed),
            None if self.known.is_none() && disk::found(&self.path).map_err(failed)?.is_some() => {
                Err(failed(io::ErrorKind::AlreadyExists.into()))
            }
            None => {
                // The first line and the file come at once.
                write_text(&self.path, &(self.known.take().unwrap_or_default() + &line))?;
                self.file = Some(Appended::open(&self.path).map_err(failed)?);
                self.path.parent().map_or(Ok(()), disk::sync_folder).map_err(failed)
            }
        }
    }
}

/// A line of a log, if it is as it was written.
pub(super) fn logged(line: &str) -> Result<Logged, String> {
    let object = without_checksum(line).map_err(|error| error.to_string())?;
    let value: Value = serde_json::from_str(&object).map_err(|error| error.to_string())?;
    let place = Place::deserialize(&value).map_err(|error| error.to_string())?;
    let files = Files::deserialize(&value["files"]).map_err(|error| error.to_string())?;
    let record = recorded::step(&value).map_err(|error| error.to_string())?;
    Ok(Logged { place, record, files })
}

/// Whether a log is there and has a whole line.
pub(super) fn has_whole_line(path: &Path) -> bool {
    let line = disk::open(path).and_then(|file| {
        let mut line = Vec::new();
        BufReader::new(file).read_until(b'\n', &mut line)?;
        Ok(line)
    });
    line.is_ok_and(|line| line.ends_with(b"\n"))
}

/// Cuts off what a kill or a full disk has left of one more line than are whole; a log without a whole line goes.
pub(super) fn cut(path: &Path) -> Result<(), OutputError> {
    let failed = |error| OutputError::new(path, error);
    if !disk::is_file(path) {
        return Ok(());
    }
    let bytes = disk::read(path).map_err(failed)?;
    match bytes.iter().rposition(|byte| *byte == b'\n') {
        None => disk::remove(path).map_err(failed),
        // The file may have another name elsewhere, whose content is not percoat's to cut.
        Some(end) if end + 1 < bytes.len() => write_file(path, |writer| writer.write_all(&bytes[..=end])),
        Some(_) => Ok(()),
    }
}

/// The whole lines of a log: whatever a kill or a full disk left of one more is none. Bytes that are not
/// UTF-8 become U+FFFD, so that the checksum of their line no longer fits.
///
/// # Errors
/// When it cannot be read.
pub fn whole_lines(path: &Path) -> io::Result<Vec<String>> {
    let mut bytes = disk::read(path)?;
    bytes.truncate(bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1));
    Ok(String::from_utf8_lossy(&bytes).lines().map(str::to_owned).collect())
}
