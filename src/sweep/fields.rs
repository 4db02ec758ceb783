//! Recorders of a combination: one that keeps no fields, and one that keeps them as a solved case in a folder of its own.

use super::row::Ended;
use crate::case::resources::{Job, needs};
use crate::case::{Case, plausibility};
use crate::load::Load;
use crate::machine::Capacity;
use crate::output::{Clock, FolderError, OutputError, Recording, RunFolder, release, solved_plan, write_scalars};
use crate::run::{Recorder, RunError, StepRecord};
use crate::spectral::{Progress, Solver, Step};
use crate::stress::StressField;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// A recorder without fields, which checks memory and disk and ends the combination when the sweep is stopped.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fits<'a> {
    pub(super) case: &'a Case,
    pub(super) job: Job,
    pub(super) room: Capacity,
    pub(super) stop: &'a AtomicBool,
}

/// The sweep was stopped.
#[derive(Debug, thiserror::Error)]
#[error("stopped before its end")]
pub(super) struct Stopped;

impl Recorder for Fits<'_> {
    type Error = Stopped;

    fn fits(&self, points: [usize; 2]) -> bool {
        needs(self.case, points, self.job).fit(self.room)
    }

    fn iteration(&mut self, _progress: Progress) -> Result<(), Stopped> {
        self.searching()
    }

    fn searching(&self) -> Result<(), Stopped> {
        if self.stop.load(Ordering::Relaxed) { Err(Stopped) } else { Ok(()) }
    }
}

/// Why the fields of a combination cannot be kept.
#[derive(Debug, thiserror::Error)]
pub(super) enum KeepError {
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error("{}", .0.told())]
    Run(#[from] RunError<OutputError>),
}

/// A recorder of fields, which checks memory and disk.
struct Keeping<'a> {
    recording: Recording<'a>,
    fits: Fits<'a>,
}

impl Recorder for Keeping<'_> {
    type Error = OutputError;

    fn fits(&self, points: [usize; 2]) -> bool {
        self.fits.fits(points)
    }

    fn begin(&mut self, solver: &Solver) -> Result<(), OutputError> {
        self.recording.begin(solver)
    }

    fn load(&mut self, load: Load) {
        self.recording.load(load);
    }

    fn clock(&self) -> Option<f64> {
        self.recording.clock()
    }

    fn stresses(&mut self) {
        self.recording.stresses();
    }

    fn step(&mut self, step: &Step, record: &StepRecord, field: Option<&StressField>) -> Result<(), OutputError> {
        self.recording.step(step, record, field)
    }
}

/// Solves a case into `folder`, as `percoat solve --no-pictures` does.
pub(super) fn keep(case: &Case, folder: &Path, fits: Fits<'_>) -> Result<Ended, KeepError> {
    let (clock, run) = (Clock::start(), case.run());
    let claim = RunFolder::claim(folder, solved_plan(case, run.loads.len(), true))?;
    let recording = Recording::new(&claim, &run, case.to_toml(), clock);
    let mut keeping = Keeping { recording, fits };
    let outcome = run.solve(&mut keeping)?;
    let (_, mut clock) = keeping.recording.finish()?;
    let warnings = [outcome.warnings.clone(), plausibility::of_case(case)].concat();
    write_scalars(&claim.staging(), case, &outcome, &warnings, clock.timing())?;
    claim.publish()?;
    // Its files are part of the sweep's result.
    let files = release(folder)?;
    Ok(Ended::solved(&outcome, case).leaving(files))
}
