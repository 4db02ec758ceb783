//! The recorder of a run, which is called during the run and may end it.

use super::{EarlierRun, GridStart, StepRecord};
use crate::load::Load;
use crate::spectral::{Checkpoint, Progress, Step};
use crate::stress::StressFields;
use std::convert::Infallible;
use std::error::Error;

/// A recorder of a run. Its methods are called from the threads that solve.
pub trait Recorder: Send {
    /// Reason for which the run ends early.
    type Error: Error + Send + Sync + 'static;

    /// The earlier run to resume, if any. Called once, before the first load.
    fn finished(&mut self) -> Option<EarlierRun> {
        None
    }

    /// Whether memory and disk suffice for a finer grid of `points`; if not, a refinement ends.
    fn fits(&self, _points: [usize; 2]) -> bool {
        true
    }

    /// Called when the run begins on a grid; the steps so far are those of a coarser grid.
    ///
    /// # Errors
    /// Ends the run.
    fn begin(&mut self, _start: &GridStart) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Called when a load step begins.
    fn load(&mut self, _load: Load) {}

    /// Seconds since any fixed moment, from which the wall time of each step is taken; a run itself reads no clock.
    fn clock(&self) -> Option<f64> {
        None
    }

    /// Called after each iteration on the finest grid.
    ///
    /// # Errors
    /// Ends the run.
    fn iteration(&mut self, _progress: Progress) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Called when a load is solved, before its readings; not for a load that an earlier run has solved.
    ///
    /// # Errors
    /// Ends the run.
    fn solved(&mut self, _checkpoint: &Checkpoint) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Called when the contact of a step is read and its stresses begin; the record has none of them yet.
    fn stresses(&mut self, _step: &Step, _record: &StepRecord) {}

    /// Called many times a second while the largest stresses are searched.
    ///
    /// # Errors
    /// Ends the run.
    fn searching(&self) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Called when a step is done, with its stress `fields` where stresses are computed.
    ///
    /// # Errors
    /// Ends the run.
    fn step(&mut self, _step: &Step, _record: &StepRecord, _fields: Option<&StressFields>) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Called when all steps on a grid of `points` are done, with their change from the next coarser grid.
    fn refined(&mut self, _points: [usize; 2], _change: f64) {}
}

impl Recorder for () {
    type Error = Infallible;
}
