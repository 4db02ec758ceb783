//! Wear from one state of a life to the next, step by step.

use super::beginning::Beginning;
use super::groove::Groove;
use super::task::{LifeError, LifeTask};
use super::way_back::WayBack;
use crate::run::{WearPath, WornPath, WornStep};
use crate::spectral::{Solver, Step, Stop, Wear};
use std::ops::ControlFlow;

/// Relative change of the largest pressure by wear after which damage is computed anew.
const REREAD: f64 = 0.02;
/// Accepted steps of wear from one state to the next, at most.
const WEAR_STEPS: usize = 8;
/// Accepted steps of wear over a groove, from one row of samples to the next, at most.
const GROOVE_STEPS: usize = 60;
/// Relative change of the largest pressure over a groove, beyond that of a row, at which it is read anew at the latest.
const IN_GROOVE: f64 = 0.3;

/// Steps of wear after a contact.
#[derive(Debug)]
pub(super) struct WornSince {
    /// Largest pressure of the contact before the steps.
    begun: f64,
    /// Whether damage is done.
    tires: bool,
    /// The groove of a body that tires.
    pub groove: Option<Groove>,
    back: WayBack,
    steps: usize,
    /// Distance of the last path, a length.
    pub slid: f64,
    /// Why a way back was not solved, where one was not.
    pub stop: Option<Stop>,
}

impl WornSince {
    /// No steps yet after a contact, of bodies that tire or not.
    pub fn new(task: &LifeTask, contact: &Beginning, wear: &Wear, tires: bool) -> Result<Self, LifeError> {
        Ok(Self {
            begun: contact.record.reading.grid_peak(),
            tires,
            groove: if tires { Groove::new(contact, wear) } else { None },
            back: task.way_back(contact.step.problem(), contact.step.grid().points())?,
            steps: 0,
            slid: 0.0,
            stop: None,
        })
    }

    /// Slides along a path until a contact has changed so much that it is to be read anew.
    pub fn slide(
        &mut self,
        path: &WearPath,
        solver: &mut Solver,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<WornPath, LifeError> {
        let mut failed = None;
        let followed = path.slide(solver, &mut |step, end| match self.add(step, end) {
            Ok(false) if goes_on() => ControlFlow::Continue(()),
            Ok(_) => ControlFlow::Break(()),
            Err(error) => {
                failed = Some(error);
                ControlFlow::Break(())
            }
        })?;
        match failed {
            Some(error) => Err(error),
            None if goes_on() => Ok(followed),
            None => Err(LifeError::Interrupted),
        }
    }

    /// Whether a groove has not taken in a row since its beginning, over which it has its mean.
    pub fn is_between_rows(&self) -> bool {
        self.stop.is_none() && self.groove.as_ref().is_some_and(|groove| groove.has_begun() && !groove.has_widened())
    }

    /// Adds a step: whether the contact at its `end` is to be read anew.
    fn add(&mut self, step: &WornStep, end: &Step) -> Result<bool, LifeError> {
        self.steps += 1;
        self.slid = step.distance;
        let change = (step.max_pressure / self.begun - 1.0).abs();
        let Some(groove) = &mut self.groove else {
            return Ok(self.steps >= WEAR_STEPS || (self.tires && change > REREAD));
        };
        let back = self.back.over(end.surface())?;
        self.stop = back.as_ref().map(|back| back.report.stop).filter(|stop| !stop.solved());
        if self.stop.is_some() {
            return Ok(true);
        }
        groove.add(step, end, back.as_ref());
        Ok(groove.has_widened() || self.steps >= GROOVE_STEPS || change > IN_GROOVE)
    }
}
