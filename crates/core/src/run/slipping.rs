//! A run whose contact sticks and slips: loads, with a tangential force or shift at the end of each, or rolled at each.

use super::{EarlierRun, Loading, Recorder, Run, RunError, Solved, StepRecord};
use crate::friction::Friction;
use crate::load::Load;
use crate::reading::{SlipReading, cycle_length};
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
    /// Whether stresses are sought, and something tires under them or has endurance limits.
    fn tires_in_place(&self) -> bool {
        let bodies = self.problem.bodies();
        self.mean_stress().is_some() && (bodies.tire() || bodies.have_endurance())
    }

    /// Solves all loads on one grid with partial slip. The steps of the earlier run `finished` are solved once more, since those after them
    /// follow from their tractions; they are not recorded again.
    pub(super) fn slip_on_grid<R: Recorder>(
        &self,
        motions: &[Motion],
        points: [usize; 2],
        finished: Option<EarlierRun>,
        recorder: &mut R,
    ) -> Result<Solved, RunError<R::Error>> {
        let direction = self.problem.friction().map_or([1.0, 0.0], Friction::direction);
        let mut solver = SlipSolver::new(Arc::clone(&self.problem), points, self.settings, SlipSettings::default())?;
        recorder.begin(solver.normal()).map_err(RunError::Recorder)?;
        let mut records = finished.map_or_else(Vec::new, |earlier| earlier.steps);
        let known = records.len();
        if known >= self.loads.len() {
            return Err(OtherGrids.into());
        }
        let (mut steps, tables, keeps_steps) = (Vec::new(), Arc::default(), self.tires_in_place());
        for (number, (&load, &motion)) in self.loads.iter().zip(motions).enumerate() {
            if !keeps_steps {
                steps.clear();
            }
            if number >= known {
                recorder.load(load);
            }
            recorder.searching().map_err(RunError::Recorder)?;
            let began = recorder.clock();
            let step = motion.step(&mut solver, load)?;
            if number >= known {
                let (reading, slip) = (step.contact.reading(), SlipReading::of(&step, direction));
                let before =
                    records[..number].iter().filter_map(|step| Some((&step.reading, step.tangential.as_ref()?)));
                let cycle = cycle_length(before.chain([(&reading, &slip)]));
                let is_last = number + 1 == self.loads.len();
                // The steps between those that begin and end the cycle.
                let moments = cycle.filter(|_| is_last && keeps_steps).map_or(0, |length| length - 1);
                let loading = Loading::InPlace(&steps[steps.len() - moments..]);
                let record = StepRecord::new(&step.contact, reading).with_slip(slip);
                let record = self.with_stresses(&step.contact, record, &tables, loading, (began, 0.0), recorder)?;
                records.push(record);
            }
            steps.push(step.contact);
        }
        Ok((records, steps.pop()))
    }
}
