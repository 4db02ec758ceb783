//! A run whose contact sticks and slips: loads, with a tangential force or shift at the end of each, or rolled at each.

use super::{EarlierRun, Loading, Recorder, Run, RunError, Solved, StepRecord};
use crate::friction::Friction;
use crate::load::Load;
use crate::problem::Problem;
use crate::reading::{Criterion, SlipReading, Utilisation, cycle_length};
use crate::spectral::{
    Drive, OtherGrids, RollError, Rolling, RollingDrive, SlipError, SlipSettings, SlipSolver, SlipStep, Step,
};
use crate::stress::Tables;
use std::error::Error;
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
    /// Force over μP, shift (a length) or creepage.
    pub(crate) fn vector(&self) -> [f64; 2] {
        match *self {
            Self::Shear(Drive::Part(vector) | Drive::Shift(vector))
            | Self::Roll(RollingDrive::Part(vector) | RollingDrive::Creepage(vector), _) => vector,
        }
    }

    /// The step of a solver to a load.
    pub(crate) fn step(self, solver: &mut SlipSolver, load: Load) -> Result<SlipStep, RollError> {
        match self {
            Self::Shear(drive) => Ok(solver.advance(load, drive)?),
            Self::Roll(drive, rolling) => solver.roll(load, drive, rolling),
        }
    }
}

/// Purpose for which the steps of a history are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sought {
    /// All readings of every step.
    Steps,
    /// Utilisations alone.
    Utilisations,
    /// All stresses of every step, and no lives.
    Stresses,
}

/// Records and steps of a history so far, and where the next one stands in it.
struct Past<'a> {
    records: &'a [StepRecord],
    /// The last steps; empty unless something tires in place.
    steps: &'a [Step],
    is_last: bool,
}

impl Run {
    /// Whether stresses are sought in points that stay in place, and something tires under them or has endurance limits.
    fn tires_in_place(&self) -> bool {
        let bodies = self.problem.bodies();
        let stays = self.motions.iter().flatten().any(|motion| matches!(motion, Motion::Shear(_)));
        stays && self.mean_stress().is_some() && (bodies.tire() || bodies.have_endurance())
    }

    /// The solver of a contact that sticks and slips.
    pub(super) fn slip_solver(&self, problem: &Arc<Problem>, points: [usize; 2]) -> Result<SlipSolver, SlipError> {
        SlipSolver::new(Arc::clone(problem), points, self.settings, SlipSettings::default())
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
        let mut solver = self.slip_solver(&self.problem, points)?;
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
                let past = Past { records: &records[..number], steps: &steps, is_last: number + 1 == self.loads.len() };
                let record = self.slip_record(&step, motion, past, (Sought::Steps, &tables, began), recorder)?;
                records.push(record);
            }
            steps.push(step.contact);
        }
        Ok((records, steps.pop()))
    }

    /// The record of a step of a history, passed to the recorder. The last one of a closed cycle has the lives and endurance of the cycle, one
    /// that rolls those of a pass.
    fn slip_record<R: Recorder>(
        &self,
        step: &SlipStep,
        motion: Motion,
        past: Past<'_>,
        (sought, tables, began): (Sought, &Arc<Tables>, Option<f64>),
        recorder: &mut R,
    ) -> Result<StepRecord, RunError<R::Error>> {
        let direction = self.problem.friction().map_or([1.0, 0.0], Friction::direction);
        let (reading, slip) = (step.contact.reading(), SlipReading::of(step, direction));
        let before = past.records.iter().filter_map(|step| Some((&step.reading, step.tangential.as_ref()?)));
        let cycle = cycle_length(before.chain([(&reading, &slip)]));
        // The steps between those that begin and end the cycle.
        let moments = cycle.filter(|_| past.is_last && !past.steps.is_empty()).map_or(0, |length| length - 1);
        let moments = &past.steps[past.steps.len() - moments..];
        let loading = match (motion, sought) {
            (Motion::Roll(..), Sought::Steps) => Loading::Path,
            (Motion::Roll(..), Sought::Utilisations) => Loading::Search,
            (Motion::Roll(..), Sought::Stresses) => Loading::Limit,
            (Motion::Shear(_), Sought::Utilisations) => Loading::SearchInPlace(moments),
            (Motion::Shear(_), _) => Loading::InPlace(moments),
        };
        let record = StepRecord::new(&step.contact, reading).with_slip(slip);
        self.with_stresses(&step.contact, record, tables, loading, (began, 0.0), recorder)
    }

    /// Motions of a history that is followed at any load. A contact that rolls has one.
    ///
    /// # Errors
    /// [`RunError::SeveralLoads`] of motions at loads that differ.
    pub(super) fn history<E: Error + 'static>(&self) -> Result<&[Motion], RunError<E>> {
        match self.motions.as_deref().unwrap_or_default() {
            [roll @ Motion::Roll(..), ..] => Ok(std::slice::from_ref(roll)),
            motions if self.loads.iter().all(|load| *load == self.loads[0]) => Ok(motions),
            _ => Err(RunError::SeveralLoads),
        }
    }

    /// Follows the history of the run anew at a load. Returns the step at which a criterion, or any without one, is nearest to failure, with its
    /// record, in which each utilisation is the largest of all steps.
    pub(super) fn worst_of_history<R: Recorder>(
        &self,
        solver: &mut SlipSolver,
        load: Load,
        (sought, of, tables): (Sought, Option<Criterion>, &Arc<Tables>),
        recorder: &mut R,
    ) -> Result<(StepRecord, Step), RunError<R::Error>> {
        solver.begin_anew();
        recorder.load(load);
        let (motions, keeps_steps) = (self.history()?, self.tires_in_place());
        let (mut records, mut steps, mut worst) = (Vec::<StepRecord>::new(), Vec::<Step>::new(), [0; 2]);
        for (number, &motion) in motions.iter().enumerate() {
            recorder.searching().map_err(RunError::Recorder)?;
            let began = recorder.clock();
            let step = motion.step(solver, load)?;
            let past = Past {
                records: &records,
                steps: if keeps_steps { &steps } else { &[] },
                is_last: number + 1 == motions.len(),
            };
            let record = self.slip_record(&step, motion, past, (sought, tables, began), recorder)?;
            let taken = |record: &StepRecord| nearness(record, of);
            if number == 0 || taken(&record) > taken(&records[worst[0]]) {
                worst = [number, steps.len()];
            }
            records.push(record);
            steps.push(step.contact);
            // Of the steps that nothing needs any more the worst one is kept.
            if !keeps_steps && steps.len() > 1 {
                steps.swap_remove(1 - worst[1]);
                worst[1] = 0;
            }
        }
        let (strength, stop) = (largest_of_all(&records), records.iter().find(|record| !record.converged()));
        let stop = stop.map(|record| record.stop);
        let record = records.swap_remove(worst[0]);
        let record = StepRecord { stop: stop.unwrap_or(record.stop), ..record.with_utilisations(strength) };
        Ok((record, steps.swap_remove(worst[1])))
    }
}

/// Utilisation of a criterion in a step, or the largest of all.
fn nearness(record: &StepRecord, of: Option<Criterion>) -> f64 {
    let all = record.strength.iter().filter(|utilisation| of.is_none_or(|of| utilisation.criterion == of));
    all.map(|utilisation| utilisation.value).fold(f64::NEG_INFINITY, f64::max)
}

/// The largest utilisation of each criterion in some steps, with an error that reaches to the largest value and error of all.
fn largest_of_all(records: &[StepRecord]) -> Vec<Utilisation> {
    let mut all: Vec<Utilisation> = Vec::new();
    for taken in records.iter().flat_map(|record| &record.strength) {
        let Some(most) = all.iter_mut().find(|most| most.criterion == taken.criterion) else {
            all.push(*taken);
            continue;
        };
        let upper = [*most, *taken].map(|taken| taken.error.map(|error| taken.value + error));
        let larger = if taken.value > most.value { taken } else { &*most };
        let error = match upper {
            [Some(a), Some(b)] => Some(a.max(b) - larger.value),
            _ => larger.error,
        };
        let rival = larger.rival;
        *most = Utilisation { rival, ..Utilisation::new(larger.criterion, larger.value, error, larger.position) };
    }
    all
}
