//! What hears of a run while it goes on, and says whether it may. It hears from the threads that solve.

use super::{Finished, StepRecord};
use crate::load::Load;
use crate::spectral::{Checkpoint, Progress, Solver, Step};
use crate::stress::StressField;
use std::convert::Infallible;
use std::error::Error;

/// What hears of a run while it goes on.
pub trait Recorder: Send {
    /// Why it cannot go on.
    type Error: Error + Send + Sync + 'static;

    /// What an earlier run of the same kind has finished, to go on from there. Asked once, before anything is solved.
    fn finished(&mut self) -> Option<Finished> {
        None
    }

    /// Whether there is room for a finer grid of `points`; without it a refinement ends.
    fn fits(&self, _points: [usize; 2]) -> bool {
        true
    }

    /// A grid begins. What was solved before is a coarser solution of the same steps.
    ///
    /// # Errors
    /// Ends the run.
    fn begin(&mut self, _solver: &Solver) -> Result<(), Self::Error> {
        Ok(())
    }

    /// A load step begins.
    fn load(&mut self, _load: Load) {}

    /// The time, seconds since any moment, for who wants to know how long a step takes: a run itself reads no clock.
    fn clock(&self) -> Option<f64> {
        None
    }

    /// An iteration on the finest grid is done.
    ///
    /// # Errors
    /// Ends the run.
    fn iteration(&mut self, _progress: Progress) -> Result<(), Self::Error> {
        Ok(())
    }

    /// A load is solved; nothing is read off it yet. Not told of a load that an earlier run has solved.
    ///
    /// # Errors
    /// Ends the run.
    fn solved(&mut self, _checkpoint: &Checkpoint) -> Result<(), Self::Error> {
        Ok(())
    }

    /// The stresses of a step begin.
    fn stresses(&mut self) {}

    /// The search for the largest stresses goes on; called many times a second.
    ///
    /// # Errors
    /// Ends the run.
    fn searching(&self) -> Result<(), Self::Error> {
        Ok(())
    }

    /// A step is done; `field` where stresses are wanted.
    ///
    /// # Errors
    /// Ends the run.
    fn step(&mut self, _step: &Step, _record: &StepRecord, _field: Option<&StressField>) -> Result<(), Self::Error> {
        Ok(())
    }

    /// All steps on a grid of `points` are done, with this change from the next coarser one.
    fn refined(&mut self, _points: [usize; 2], _change: f64) {}
}

impl Recorder for () {
    type Error = Infallible;
}
