//! A run whose contact sticks and slips: loads, with a tangential force or shift at the end of each.

use super::{EarlierRun, Loading, Recorder, Run, RunError, Solved, StepRecord};
use crate::reading::SlipReading;
use crate::spectral::{Drive, OtherGrids, SlipSettings, SlipSolver};
use std::sync::Arc;

impl Run {
    /// Solves all loads on one grid with partial slip. The steps of the earlier run `finished` are solved once more, since those after them
    /// follow from their tractions; they are not recorded again.
    pub(super) fn slip_on_grid<R: Recorder>(
        &self,
        drives: &[Drive],
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
        for (number, (&load, &drive)) in self.loads.iter().zip(drives).enumerate() {
            drop(last.take());
            if number >= known {
                recorder.load(load);
            }
            let began = recorder.clock();
            let step = solver.advance(load, drive)?;
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
