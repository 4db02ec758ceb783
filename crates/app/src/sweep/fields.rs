//! How a combination is recorded: its scalars alone, or its fields too, as a solved case in a folder of its own.

use super::row::Ended;
use crate::output::{Clock, FolderError, OutputError, Recording, RunFolder, release, solved_plan, write_scalars};
use crate::task::{Solve, Solved};
use percoat_case::case::Case;
use percoat_core::run::{Recorder, RunError};
use percoat_core::spectral::Progress;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Writes nothing, and ends the run of a combination when `stop` is true.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scalars<'a> {
    pub(super) stop: &'a AtomicBool,
}

/// The sweep was stopped.
#[derive(Debug, thiserror::Error)]
#[error("stopped before its end")]
pub(super) struct Stopped;

impl Recorder for Scalars<'_> {
    type Error = Stopped;

    fn iteration(&mut self, _progress: Progress) -> Result<(), Stopped> {
        self.searching()
    }

    fn searching(&self) -> Result<(), Stopped> {
        if self.stop.load(Ordering::Relaxed) { Err(Stopped) } else { Ok(()) }
    }
}

/// Solves a case into `folder`, as `percoat solve --no-pictures` does. What cannot be solved is a failed combination, what cannot be written
/// ends the sweep.
pub(super) fn keep(case: &Case, task: &Solve, folder: &Path) -> Result<Ended, OutputError> {
    let clock = Clock::start();
    let claim = match RunFolder::claim(folder, solved_plan(case, task.run.loads.len(), true)) {
        Ok(claim) => claim,
        Err(FolderError::Output(error)) => return Err(error),
        Err(refused) => return Ok(Ended::failed(refused.to_string())),
    };
    let mut recording = Recording::new(&claim, &task.run, case.to_toml(), clock);
    let Solved { outcome, warnings } = match task.solve(&mut recording) {
        Ok(solved) => solved,
        Err(RunError::Recorder(error)) => return Err(error),
        Err(error) => return Ok(Ended::failed(error.told())),
    };
    let (_, mut clock) = recording.finish()?;
    write_scalars(&claim.staging(), case, &outcome, &warnings, clock.timing())?;
    claim.publish()?;
    // The files of the combination are part of the sweep's result.
    let files = release(folder)?;
    Ok(Ended::solved(Solved { outcome, warnings }).leaving(files))
}
