//! A run of bodies that creep: loads at times, linear in time from one to the next.

use super::{EarlierRun, GridStart, Loading, Recorder, Run, RunError, Solved};
use crate::reading::CreepReading;
use crate::run::StepRecord;
use crate::spectral::{CreepError, CreepSolver, OtherGrids, TIME_TOLERANCE};
use std::error::Error;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Times of the loads of a run. Between two times the load is linear; two loads of one time, and the first one, are a jump.
#[derive(Debug, Clone, PartialEq)]
pub struct Times {
    /// Time of each load, none before the one in front of it.
    pub times: Vec<f64>,
    /// Largest error of one step in time, over the largest penetration and pressure so far, above which it is divided.
    pub tolerance: f64,
}

impl Times {
    /// Times with the tolerance that is used where none is prescribed.
    pub fn new(times: Vec<f64>) -> Self {
        Self { times, tolerance: TIME_TOLERANCE }
    }
}

impl Run {
    /// Checks that loads that change in time can be followed.
    pub(super) fn check_times<E: Error + 'static>(&self) -> Result<(), RunError<E>> {
        let Some(Times { times, tolerance }) = &self.times else { return Ok(()) };
        CreepError::of_problem(&self.problem)?;
        CreepError::of_path(&self.problem, times, &self.loads)?;
        if tolerance.is_nan() || *tolerance <= 0.0 {
            return Err(CreepError::Tolerance(*tolerance).into());
        }
        if self.mean_stress().is_some() {
            return Err(CreepError::Stresses.into());
        }
        Ok(())
    }

    /// Solves all loads on one grid at their times. The steps of the earlier run `finished` are solved once more, since those after them begin
    /// from their states; they are not recorded again.
    pub(super) fn creep_on_grid<R: Recorder>(
        &self,
        Times { times, tolerance }: &Times,
        points: [usize; 2],
        finished: Option<EarlierRun>,
        recorder: &mut R,
    ) -> Result<Solved, RunError<R::Error>> {
        let mut solver = CreepSolver::new(Arc::clone(&self.problem), points, self.settings, *tolerance)?;
        recorder.begin(&GridStart::from(solver.elastic())).map_err(RunError::Recorder)?;
        let mut records = finished.map_or_else(Vec::new, |earlier| earlier.steps);
        let known = records.len();
        if known >= self.loads.len() {
            return Err(OtherGrids.into());
        }
        let (mut last, tables) = (None, Arc::default());
        for (number, (&load, &time)) in self.loads.iter().zip(times).enumerate() {
            // The memory of a step is freed before the next one needs as much.
            drop(last.take());
            if number >= known {
                recorder.load(load);
            }
            let (began, mut iterated) = (recorder.clock(), Ok(()));
            let step = solver.advance_with_progress(time, load, &mut |progress| {
                if iterated.is_ok() {
                    iterated = recorder.iteration(progress);
                }
                if iterated.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            })?;
            iterated.map_err(RunError::Recorder)?;
            if number >= known {
                // The checkpoint tells that the load is solved: a run that goes on solves all loads again.
                recorder.solved(&solver.elastic().checkpoint(&step.contact)).map_err(RunError::Recorder)?;
                let reading = step.contact.reading().with_time_error(step.error, load.is_load_control());
                let record = StepRecord::new(&step.contact, reading).with_creep(CreepReading::of(&step));
                let record =
                    self.with_stresses(&step.contact, record, &tables, Loading::Path, (began, 0.0), recorder)?;
                records.push(record);
            }
            last = Some(step.contact);
        }
        Ok((records, last))
    }
}
