//! The search on one grid, load by load.

use super::curve::Curve;
use super::{At, Limit, Limits, Shown};
use crate::load::Load;
use crate::reading::{Criterion, Utilisation};
use crate::run::{Recorder, Run, RunError, StepRecord};
use crate::spectral::{Solver, Step};
use std::sync::Arc;

/// Doublings and halvings of the first load at most.
const DOUBLINGS: usize = 40;
/// Loads to find one limit at most; bisection alone takes ten from a factor of two on.
const TRIALS: usize = 40;
/// Samples that the radius of a contact needs to be worth halving its load further.
const LEAST_SAMPLES: f64 = 2.0;
/// Rounds over all criteria: loads that were solved for one may be an earlier crossing of another.
const ROUNDS: usize = 4;
/// Loads that differ by less are one.
const SAME: f64 = 1e-12;
/// Part of the pressure of complete contact to begin with where the run's first load is none.
const START: f64 = 1e-3;

/// A search that goes on.
pub(super) struct Search<'a, R: Recorder> {
    run: &'a Run,
    solver: Solver,
    complete: f64,
    /// By ascending mean pressure.
    steps: Vec<StepRecord>,
    /// The last one that was solved.
    last: Option<Step>,
    recorder: &'a mut R,
}

impl<'a, R: Recorder> Search<'a, R> {
    /// The limits of a run on a grid of `points`.
    pub fn on_grid(run: &'a Run, points: [usize; 2], recorder: &'a mut R) -> Result<Limits, RunError<R::Error>> {
        let mut solver = Solver::new(Arc::clone(&run.problem), points, run.settings)?;
        recorder.begin(&solver).map_err(RunError::Recorder)?;
        // A flat surface is in complete contact under any load, and more of it changes what fails all the same.
        let complete = Some(solver.full_contact_pressure()).filter(|pressure| *pressure > 0.0);
        let complete = complete.unwrap_or(f64::INFINITY);
        let mut search = Self { run, solver, complete, steps: Vec::new(), last: None, recorder };
        let half_space = run.problem.half_space();
        let (at_rest, sought): (Vec<Criterion>, Vec<Criterion>) =
            Criterion::all(half_space).into_iter().partition(|criterion| criterion.at_rest(half_space) >= 1.0);
        if !sought.is_empty() {
            search.enclose(&sought)?;
        }
        let mut limits = Vec::new();
        for _ in 0..ROUNDS {
            let known = search.steps.len();
            limits.clear();
            for criterion in Criterion::all(half_space) {
                let at = if at_rest.contains(&criterion) { At::Rest } else { search.find(criterion)? };
                limits.push(Limit { criterion, at });
            }
            if search.steps.len() == known {
                break;
            }
        }
        let mut limits =
            Limits { limits, steps: Vec::new(), shown: None, complete, change: None, end: None, warnings: Vec::new() };
        let is_load = |limit: &&&Limit| limit.mean_pressure() > 0.0 && limit.mean_pressure().is_finite();
        let first = limits.ordered().iter().find(is_load).map(|limit| **limit);
        let shown = match first {
            Some(limit) => {
                let record = search.solve(limit.mean_pressure())?.clone();
                // Of places alike by symmetry rounding takes one or the other: told is the one of the step that is shown.
                let limit = limit.moved_to(search.utilisation(&record, limit.criterion).position);
                limits.limits.iter_mut().filter(|own| own.criterion == limit.criterion).for_each(|own| *own = limit);
                search.last.take().map(|step| Shown { limit, record, step })
            }
            None => None,
        };
        Ok(Limits { shown, steps: search.steps, ..limits })
    }

    /// Solves a load and keeps what it says.
    fn solve(&mut self, mean_pressure: f64) -> Result<&StepRecord, RunError<R::Error>> {
        // Its memory goes before the next one takes as much.
        self.last = None;
        let load = Load::MeanPressure(mean_pressure);
        let (record, step) = self.run.solve_load(&mut self.solver, load, None, self.recorder)?;
        self.last = Some(step);
        // What is read off a step has the load to rounding.
        let before = |other: &StepRecord| other.reading.mean_pressure < mean_pressure * (1.0 - SAME);
        let place = self.steps.partition_point(before);
        match self.steps.get_mut(place) {
            Some(same) if same.reading.mean_pressure <= mean_pressure * (1.0 + SAME) => *same = record,
            _ => self.steps.insert(place, record),
        }
        Ok(&self.steps[place])
    }

    /// The first load: the run's, or a little where it prescribes a penetration that hardly touches. That penetration is only
    /// where the search begins, and no load of it.
    fn start(&mut self) -> f64 {
        let pressure = match self.run.loads.iter().find(|load| load.value() > 0.0) {
            Some(&Load::MeanPressure(pressure)) => pressure,
            Some(&penetration) => self.solver.solve(penetration).reading().mean_pressure,
            None => 0.0,
        };
        let pressure = if pressure > 0.0 && pressure.is_finite() { pressure } else { START * self.complete };
        pressure.min(self.complete)
    }

    /// Solves loads until each criterion has one load below and one above, or none is left; downwards until it holds and
    /// falls with the load, as the tension at an edge and the opening of an interface fall towards complete contact too.
    fn enclose(&mut self, sought: &[Criterion]) -> Result<(), RunError<R::Error>> {
        let mut lowest = self.start();
        let mut highest = lowest;
        self.solve(lowest)?;
        for _ in 0..DOUBLINGS {
            let holds = |&criterion: &Criterion| self.curve(criterion).first_failure().is_none();
            if highest >= self.complete || !sought.iter().any(holds) {
                break;
            }
            highest = (2.0 * highest).min(self.complete);
            self.solve(highest)?;
        }
        let is_tip = self.first_is_tip();
        for _ in 0..DOUBLINGS {
            // Under a tip of the highest level it fails however small the load.
            let asks_for_less = |&criterion: &Criterion| {
                let curve = self.curve(criterion);
                match curve.first_failure() {
                    Some(0) => !(is_tip && curve.0[0][1].is_infinite()),
                    _ => !curve.falls_with_the_load(),
                }
            };
            if self.steps[0].reading.spot_resolution < LEAST_SAMPLES || !sought.iter().any(asks_for_less) {
                break;
            }
            lowest *= 0.5;
            self.solve(lowest)?;
        }
        Ok(())
    }

    /// What the loads that were solved take up of a criterion.
    fn curve(&self, criterion: Criterion) -> Curve {
        let value = |record: &StepRecord| [record.reading.mean_pressure, self.utilisation(record, criterion).value];
        Curve(self.steps.iter().map(value).collect())
    }

    /// Whether the highest level, which touches under any load, has tips whose pressure is infinite.
    fn first_is_tip(&self) -> bool {
        let indenters = self.run.problem.counterbody().indenters();
        let levels = indenters.into_iter().flat_map(|all| all.levels().iter().zip(all.drops()));
        levels.into_iter().any(|(level, drop)| drop == 0.0 && level.shape().singular_peak())
    }

    /// What a step takes up of a criterion; without contact what residual stress does.
    fn utilisation(&self, record: &StepRecord, criterion: Criterion) -> Utilisation {
        let value = criterion.at_rest(self.run.problem.half_space());
        record.utilisation(criterion).copied().unwrap_or(Utilisation {
            criterion,
            value,
            error: None,
            position: [0.0; 3],
            rival: None,
        })
    }

    /// Where a criterion is reached.
    fn find(&mut self, criterion: Criterion) -> Result<At, RunError<R::Error>> {
        for trial in 0..TRIALS {
            let curve = self.curve(criterion);
            let next = match curve.first_failure() {
                None => curve.towards_largest(),
                Some(0) => None,
                // Every third load halves what is enclosed.
                Some(above) => curve.enclosure(above).next(trial % 3 == 2),
            };
            let Some(next) = next else { break };
            self.solve(next)?;
        }
        Ok(self.found(criterion))
    }

    /// Where a criterion is reached, by the loads that were solved.
    fn found(&self, criterion: Criterion) -> At {
        let curve = self.curve(criterion);
        let taken = |index: usize| self.utilisation(&self.steps[index], criterion);
        let load = |index: usize| self.steps[index].reading.mean_pressure;
        let Some(above) = curve.first_failure() else {
            let at = curve.largest();
            return At::Never { up_to: load(self.steps.len() - 1), utilisation: taken(at).value, at: load(at) };
        };
        let Utilisation { value, position, .. } = taken(above);
        if above == 0 {
            let is_tip = value.is_infinite() && self.first_is_tip();
            let below = At::Below { mean_pressure: load(above), utilisation: value, position };
            return if is_tip { At::Tip { position } } else { below };
        }
        let enclosure = curve.enclosure(above);
        let mean_pressure = enclosure.root();
        if enclosure.slope().is_none() {
            // Of what jumps nothing tells how far the grid moves it, and its place is where it has failed.
            return At::Load { mean_pressure, error: None, position };
        }
        let nearest = taken(if enclosure.first_is_nearer() { above - 1 } else { above });
        let by_grid = curve.slope_around(mean_pressure).zip(nearest.error);
        let by_grid = by_grid.map(|(slope, error)| error / (nearest.value * slope));
        // What the search leaves open is an error too.
        let error = by_grid.map(|by_grid| mean_pressure * by_grid.hypot(enclosure.open()));
        At::Load { mean_pressure, error, position: nearest.position }
    }
}
