//! A run whose contact sticks and slips: loads, with a tangential force or shift at the end of each, or rolled at each.

use super::{EarlierRun, Loading, Recorder, Run, RunError, Solved, StepRecord};
use crate::load::Load;
use crate::reading::SlipReading;
use crate::spectral::{Drive, OtherGrids, RollError, Rolling, RollingDrive, SlipSettings, SlipSolver, SlipStep};
use std::sync::Arc;

/// Motion of the counterbody along the surface at a load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// A tangential force or shift at the end of the step.
    Shear(Drive),
    /// Rolling under a tangential force or a creepage.
    Roll(RollingDrive, Rolling),
}

impl Motion {
    fn step(self, solver: &mut SlipSolver, load: Load) -> Result<SlipStep, RollError> {
        match self {
            Self::Shear(drive) => Ok(solver.advance(load, drive)?),
            Self::Roll(drive, rolling) => solver.roll(load, drive, rolling),
        }
    }
}

impl Run {
    /// Solves all loads on one grid with partial slip. The steps of the earlier run `finished` are solved once more, since those after them
    /// follow from their tractions; they are not recorded again.
    pub(super) fn slip_on_grid<R: Recorder>(
        &self,
        motions: &[Motion],
        points: [usize; 2],
        finished: Option<EarlierRun>,
        recorder: &mut R,
    ) -> Result<Solved, RunError<R::Error>> {
        let friction = self.problem.friction().copied();
        let mut solver = SlipSolver::new(Arc::clone(&self.problem), points, self.settings, SlipSettings::default())?;
        recorder.begin(solver.normal()).map_err(RunError::Recorder)?;
        let mut records = finished.map_or_else(Vec::new, |earlier| earlier.steps);
        let known = records.len();
        if known >= self.loads.len() {
            return Err(OtherGrids.into());
        }
        let (mut last, tables) = (None, Arc::default());
        for (number, (&load, &motion)) in self.loads.iter().zip(motions).enumerate() {
            drop(last.take());
            if number >= known {
                recorder.load(load);
            }
            recorder.searching().map_err(RunError::Recorder)?;
            let began = recorder.clock();
            let step = motion.step(&mut solver, load)?;
            if number < known {
                continue;
            }
            let mut record = StepRecord::new(&step.contact, step.contact.reading());
            if let Some(friction) = friction {
                record = record.with_slip(SlipReading::of(&step, friction.direction()));
            }
            let record = self.with_stresses(&step.contact, record, &tables, Loading::Path, (began, 0.0), recorder)?;
            records.push(record);
            last = Some(step.contact);
        }
        Ok((records, last))
    }
}
