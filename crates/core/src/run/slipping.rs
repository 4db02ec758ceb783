//! A run whose contact sticks and slips: loads, with a tangential force or shift at the end of each, or rolled at each.

use super::{EarlierRun, GridStart, Loading, Recorder, Run, RunError, Solved, StepRecord};
use crate::friction::Friction;
use crate::load::Load;
use crate::problem::Problem;
use crate::reading::{Criterion, SlipReading, Utilisation, closed_cycle};
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
    /// The step of a solver to a load.
    pub(crate) fn step(self, solver: &mut SlipSolver, load: Load) -> Result<SlipStep, RollError> {
        match self {
            Self::Shear(drive) => Ok(solver.advance(load, drive)?),
            Self::Roll(drive, rolling) => solver.roll(load, drive, rolling),
        }
    }
}

/// Difference of two motions, or of two loads, over the largest of the history, up to which they are taken for one.
const SAME: f64 = 1e-9;

/// Number of the steps of the closed cycle with which a history of forces, or of shifts, ends; `None` without one. Without `loads` these are alike.
pub(crate) fn cycle_of(motions: &[Motion], loads: &[Load]) -> Option<usize> {
    let by_shift = |motion: &Motion| matches!(motion, Motion::Shear(Drive::Shift(_)));
    let vectors: Vec<[f64; 2]> = motions
        .iter()
        .map(|motion| match *motion {
            Motion::Shear(Drive::Part(vector) | Drive::Shift(vector)) => Some(vector),
            Motion::Roll(..) => None,
        })
        .collect::<Option<_>>()?;
    if motions.iter().any(by_shift) && !motions.iter().all(by_shift) {
        return None;
    }
    let farthest = vectors.iter().map(|[x, y]| x.hypot(*y)).fold(f64::MIN_POSITIVE, f64::max);
    let highest = loads.iter().map(|load| load.value().abs()).fold(f64::MIN_POSITIVE, f64::max);
    let load = |k: usize| loads.get(k).map_or(0.0, |load| load.value() / highest);
    let states = vectors.iter().enumerate().map(|(k, [x, y])| [load(k), x / farthest, y / farthest]);
    closed_cycle(&states.collect::<Vec<_>>(), SAME)
}

/// The other steps of a cycle of some length that ends with the next step, of the steps so far; none where these are not kept.
fn moments(steps: &[Step], cycle: Option<usize>) -> &[Step] {
    let count = cycle.filter(|_| !steps.is_empty()).map_or(0, |length| length - 1);
    &steps[steps.len() - count..]
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
        let cycle = cycle_of(motions, &self.loads);
        recorder.begin(&GridStart::from(solver.normal())).map_err(RunError::Recorder)?;
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
                let moments = moments(&steps, cycle.filter(|_| number + 1 == self.loads.len()));
                let record = self.slip_record(&step, motion, moments, (true, &tables, began), recorder)?;
                records.push(record);
            }
            steps.push(step.contact);
        }
        Ok((records, steps.pop()))
    }

    /// The record of a step of a history, passed to the recorder: with all readings, or the utilisations alone. One that closes a cycle has the
    /// lives and endurance of the cycle by its `moments`, one that rolls those of a pass.
    fn slip_record<R: Recorder>(
        &self,
        step: &SlipStep,
        motion: Motion,
        moments: &[Step],
        (all, tables, began): (bool, &Arc<Tables>, Option<f64>),
        recorder: &mut R,
    ) -> Result<StepRecord, RunError<R::Error>> {
        let direction = self.problem.friction().map_or([1.0, 0.0], Friction::direction);
        let (reading, slip) = (step.contact.reading(), SlipReading::of(step, direction));
        let loading = match (motion, all) {
            (Motion::Roll(..), true) => Loading::Path,
            (Motion::Roll(..), false) => Loading::Search,
            (Motion::Shear(_), true) => Loading::InPlace(moments),
            (Motion::Shear(_), false) => Loading::SearchInPlace(moments),
        };
        let record = StepRecord::new(&step.contact, reading).with_slip(slip);
        self.with_stresses(&step.contact, record, tables, loading, (began, 0.0), recorder)
    }

    /// Motions of a history that is followed at any load. A contact that rolls has one.
    ///
    /// # Errors
    /// [`RunError::SeveralLoads`] of motions at loads that differ, [`RunError::NoCycle`] of endurance limits without a closed cycle.
    pub(super) fn history<E: Error + 'static>(&self) -> Result<&[Motion], RunError<E>> {
        let motions = self.motions.as_deref().unwrap_or_default();
        let first = motions.first().ok_or(RunError::NoLoads)?;
        if let Motion::Roll(..) = first {
            let is_one = motions.iter().all(|motion| motion == first);
            return if is_one { Ok(std::slice::from_ref(first)) } else { Err(RunError::SeveralLoads) };
        }
        if self.loads.iter().any(|load| *load != self.loads[0]) {
            return Err(RunError::SeveralLoads);
        }
        if self.problem.bodies().have_endurance() && cycle_of(motions, &[]).is_none() {
            return Err(RunError::NoCycle);
        }
        Ok(motions)
    }

    /// Follows the history of the run anew at a load. Returns the step at which a criterion, or any without one, is nearest to failure, with its
    /// record, in which each utilisation is the largest of all steps; with all stresses where there is a criterion.
    pub(super) fn worst_of_history<R: Recorder>(
        &self,
        solver: &mut SlipSolver,
        load: Load,
        (of, tables): (Option<Criterion>, &Arc<Tables>),
        recorder: &mut R,
    ) -> Result<(StepRecord, Step), RunError<R::Error>> {
        solver.begin_anew();
        recorder.load(load);
        let (motions, keeps_steps) = (self.history()?, self.tires_in_place());
        let cycle = cycle_of(motions, &[]);
        let (mut records, mut steps, mut worst) = (Vec::<StepRecord>::new(), Vec::<Step>::new(), [0; 2]);
        for (number, &motion) in motions.iter().enumerate() {
            recorder.searching().map_err(RunError::Recorder)?;
            let began = recorder.clock();
            let step = motion.step(solver, load)?;
            let is_last = number + 1 == motions.len();
            let moments = moments(if keeps_steps { &steps } else { &[] }, cycle.filter(|_| is_last));
            let record = self.slip_record(&step, motion, moments, (of.is_some(), tables, began), recorder)?;
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
        let seconds = records.iter().map(|record| record.seconds).sum();
        let record = records.swap_remove(worst[0]);
        let record = StepRecord { stop: stop.unwrap_or(record.stop), seconds, ..record.with_utilisations(strength) };
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

#[cfg(test)]
mod tests {
    use super::*;

    fn length(parts: &[f64], loads: &[f64]) -> Option<usize> {
        let motions: Vec<Motion> = parts.iter().map(|part| Motion::Shear(Drive::Part([*part, 0.0]))).collect();
        let loads: Vec<Load> = loads.iter().map(|load| Load::Force(*load)).collect();
        cycle_of(&motions, &loads)
    }

    #[test]
    fn a_cycle_ends_where_it_began_from_the_same_side() {
        for (parts, expected) in [
            (&[0.6, -0.6, 0.6][..], Some(2)),
            (&[0.3, 0.6, 0.3, 0.0, -0.3, -0.6, -0.3, 0.0, 0.3, 0.6], Some(8)),
            (&[0.6, 0.0, -0.6, 0.0, 0.6, 0.0], Some(4)),
            // A loading that never comes back.
            (&[0.1, 0.5, 0.1], None),
            (&[0.5, -0.3], None),
            (&[0.5], None),
            (&[], None),
        ] {
            assert_eq!(length(parts, &[]), expected, "{parts:?}");
        }
        let parts = [0.5, 0.3, 0.5, 0.3, 0.5];
        assert_eq!(length(&parts, &[1.0; 5]), Some(2));
        assert_eq!(length(&parts, &[1.0, 2.0, 3.0, 2.0, 1.0]), Some(4));
        assert_eq!(length(&parts, &[1.0, 2.0, 3.0, 2.0, 2.0]), None);
        let shift = Motion::Shear(Drive::Shift([0.5, 0.0]));
        let part = |part: f64| Motion::Shear(Drive::Part([part, 0.0]));
        assert_eq!(cycle_of(&[part(0.5), part(-0.5), shift], &[]), None);
    }
}
