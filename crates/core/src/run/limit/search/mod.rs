//! The search for the limits on one grid, load by load.
//!
//! Every load that is solved counts for all criteria. First the loads of the `scan`, a factor of two apart, then those between which the
//! utilisation of a criterion reaches 1: the `root`.

mod root;
mod scan;

use super::band::UtilisationBand;
use super::windows::Windows;
use super::{At, Limit, LimitStep, Limits, SearchEnd};
use crate::load::LoadQuantity;
use crate::problem::Problem;
use crate::reading::{Criterion, Utilisation};
use crate::run::{GridStart, Loading, NoSteadyState, Recorder, Run, RunError, StepRecord};
use crate::spectral::{AdhesiveSolver, SlipSolver, Solver, Step};
use crate::stress::Tables;
use std::error::Error;
use std::sync::Arc;

/// Largest number of limits that are shown with their fields.
pub const EVENTS: usize = 4;
/// Largest number of loads for one limit; bisection alone takes ten from a factor of two on.
const TRIALS: usize = 40;
/// Largest number of rounds over all criteria: loads that were solved for one may show an earlier crossing of another.
const ROUNDS: usize = 4;
/// Relative difference below which two loads are one.
const SAME_LOAD: f64 = 1e-12;

/// Solver of the loads of a search.
enum Loaded {
    /// A counterbody that slides or is still.
    Sliding(Box<Solver>),
    /// A counterbody that sticks and slips, with its history.
    Sticking(Box<SlipSolver>),
    /// Surfaces that adhere, and the solver of the same contact without tension.
    Adhering(Box<AdhesiveSolver>, Box<Solver>),
}

impl Loaded {
    fn new<E: Error + 'static>(run: &Run, problem: &Arc<Problem>, points: [usize; 2]) -> Result<Self, RunError<E>> {
        let normal = || Ok::<_, RunError<E>>(Box::new(Solver::new(Arc::clone(problem), points, run.settings)?));
        Ok(if run.motions.is_some() {
            Self::Sticking(Box::new(run.slip_solver(problem, points)?))
        } else if problem.adhesion().is_some() {
            Self::Adhering(Box::new(AdhesiveSolver::new(Arc::clone(problem), points, run.settings)?), normal()?)
        } else {
            Self::Sliding(normal()?)
        })
    }

    fn full_contact_pressure(&mut self) -> f64 {
        match self {
            Self::Sliding(solver) | Self::Adhering(_, solver) => solver.full_contact_pressure(),
            Self::Sticking(solver) => solver.full_contact_pressure(),
        }
    }

    /// The solver of the normal contact.
    fn normal(&self) -> &Solver {
        match self {
            Self::Sliding(solver) | Self::Adhering(_, solver) => solver,
            Self::Sticking(solver) => solver.normal(),
        }
    }
}

/// A search on one grid.
pub(super) struct LimitSearch<'a, R: Recorder> {
    run: &'a Run,
    windows: Windows,
    /// The window of the solver.
    window: usize,
    solver: Loaded,
    /// Tables that the stresses of all loads share.
    tables: Arc<Tables>,
    /// The quantity of all loads.
    quantity: LoadQuantity,
    /// Load at which contact becomes complete; infinite for a flat surface, for an isolated contact, and from [`Self::hardness_load`] on.
    complete: f64,
    /// Load that is [`SearchEnd::OF_HARDNESS`] of the most that the hardness bears; infinite without hardness, and for an isolated
    /// contact, whose window grows.
    hardness_load: f64,
    /// Largest load that is solved, whatever fails there; infinite where none is prescribed.
    most: f64,
    /// A load of the order at which contact fills the cell or the window; infinite for a flat surface.
    filling: f64,
    /// The solved loads, by ascending load.
    steps: Vec<StepRecord>,
    /// The step of the load that was solved last.
    last: Option<Step>,
    recorder: &'a mut R,
}

impl<'a, R: Recorder> LimitSearch<'a, R> {
    /// A search for the limits of a run up to the load `most` on a grid of `points`, before its first load.
    fn new(run: &'a Run, (points, most): ([usize; 2], f64), recorder: &'a mut R) -> Result<Self, RunError<R::Error>> {
        let mut solver = Loaded::new(run, &run.problem, points)?;
        NoSteadyState::of(solver.normal()).map_or(Ok(()), Err)?;
        recorder.begin(&GridStart::from(solver.normal())).map_err(RunError::Recorder)?;
        // A flat surface is in complete contact at zero pressure, which does not end the search: its stresses grow with the load.
        let complete = Some(solver.full_contact_pressure()).filter(|pressure| *pressure > 0.0);
        let (quantity, area) = (run.quantity(), run.problem.cell().area());
        let per_pressure = if quantity == LoadQuantity::Force { area } else { 1.0 };
        let borne = SearchEnd::OF_HARDNESS * largest_borne(&run.problem) * per_pressure;
        let filling = complete.map_or(f64::INFINITY, |pressure| (pressure * per_pressure).min(borne));
        // An isolated contact is never complete, but fills its window under a load of this order.
        let kind = run.problem.kind();
        let complete = if kind.may_be_complete() && filling < borne { filling } else { f64::INFINITY };
        let hardness_load = if kind.is_indentation() { f64::INFINITY } else { borne };
        let windows = Windows::new(Arc::clone(&run.problem), complete.min(hardness_load).min(most), points);
        let (tables, steps) = (Arc::default(), Vec::new());
        Ok(Self {
            run,
            windows,
            window: 0,
            solver,
            tables,
            quantity,
            complete,
            hardness_load,
            most,
            filling,
            steps,
            last: None,
            recorder,
        })
    }

    /// Searches the limits of a run up to the load `most` on a grid of `points`.
    pub fn on_grid(
        run: &'a Run,
        (points, most): ([usize; 2], f64),
        recorder: &'a mut R,
    ) -> Result<Limits, RunError<R::Error>> {
        let mut search = Self::new(run, (points, most), recorder)?;
        let Self { quantity, complete, hardness_load, .. } = search;
        let bodies = run.problem.bodies();
        let (at_rest, sought): (Vec<Criterion>, Vec<Criterion>) =
            Criterion::all(bodies).into_iter().partition(|criterion| criterion.at_rest(bodies) >= 1.0);
        if !sought.is_empty() {
            search.scan(&sought)?;
            search.divide_touches(&sought)?;
        }
        for _ in 0..ROUNDS {
            let known = search.steps.len();
            for &criterion in &sought {
                search.find(criterion)?;
            }
            if search.steps.len() == known {
                break;
            }
        }
        let limit = |criterion: Criterion| {
            let at = if at_rest.contains(&criterion) { At::Rest } else { search.found(criterion) };
            Limit { criterion, quantity, at }
        };
        let limits = Criterion::all(bodies).into_iter().map(limit).collect();
        let mut limits = Limits {
            limits,
            steps: Vec::new(),
            shown: Vec::new(),
            quantity,
            complete,
            hardness_load,
            window: search.largest_window(),
            ends_at_border: search.windows.largest() < complete.min(hardness_load).min(most),
            change: None,
            end: None,
            warnings: Vec::new(),
        };
        let is_load = |limit: &&&Limit| limit.load() > 0.0 && limit.load().is_finite();
        let events: Vec<Limit> = limits.ordered().iter().filter(is_load).take(EVENTS).map(|limit| **limit).collect();
        for limit in events {
            let record = search.solve_for(limit.load(), Some(limit.criterion))?.clone();
            // Rounding decides between places that are equal by symmetry: the place is that of the step that is shown.
            let limit = limit.moved_to(search.utilisation(&record, limit.criterion).position);
            limits
                .limits
                .iter_mut()
                .filter(|before| before.criterion == limit.criterion)
                .for_each(|before| *before = limit);
            limits.shown.extend(search.last.take().map(|step| LimitStep { limit, record, step }));
        }
        Ok(Limits { steps: search.steps, ..limits })
    }

    /// Solves a load of the search and keeps its record.
    fn solve(&mut self, load: f64) -> Result<&StepRecord, RunError<R::Error>> {
        self.solve_for(load, None)
    }

    /// Solves a load and keeps its record; with all stresses where it is the limit of a criterion.
    fn solve_for(&mut self, load: f64, limit: Option<Criterion>) -> Result<&StepRecord, RunError<R::Error>> {
        // The memory of a step is freed before the next one needs as much.
        self.last = None;
        self.enter(self.windows.of(load))?;
        let prescribed = self.quantity.load(load);
        let loading = if limit.is_some() { Loading::Limit } else { Loading::Search };
        let (run, tables) = (self.run, &self.tables);
        let (record, step) = match &mut self.solver {
            Loaded::Sliding(solver) => run.solve_load(solver, tables, prescribed, (loading, None), self.recorder)?,
            Loaded::Adhering(solver, _) => run.adhering_at(solver, prescribed, (loading, tables), self.recorder)?,
            Loaded::Sticking(solver) => run.worst_of_history(solver, prescribed, (limit, tables), self.recorder)?,
        };
        self.last = Some(step);
        // The load of a reading is the prescribed one to rounding.
        let quantity = self.quantity;
        let before = |other: &StepRecord| other.reading.load(quantity) < load * (1.0 - SAME_LOAD);
        let place = self.steps.partition_point(before);
        match self.steps.get_mut(place) {
            Some(same) if same.reading.load(quantity) <= load * (1.0 + SAME_LOAD) => *same = record,
            _ => self.steps.insert(place, record),
        }
        Ok(&self.steps[place])
    }

    /// Sides of the largest window in which loads were solved, where that is not the window of the problem.
    fn largest_window(&self) -> Option<[f64; 2]> {
        let last = self.windows.of(self.load_of(self.steps.len().checked_sub(1)?));
        let [[width, _], [_, height]] = self.windows.problem(last).cell().vectors();
        (last > 0).then_some([width, height])
    }

    /// Sets the solver up for a window, unless it is there.
    fn enter(&mut self, window: usize) -> Result<(), RunError<R::Error>> {
        if window != self.window {
            let (problem, points) = (Arc::clone(self.windows.problem(window)), self.solver.normal().grid().points());
            // The tables of one window are kept at a time.
            self.tables = Arc::default();
            self.solver = Loaded::new(self.run, &problem, points)?;
            self.window = window;
            self.recorder.begin(&GridStart::from(self.solver.normal())).map_err(RunError::Recorder)?;
        }
        Ok(())
    }

    /// The load of a solved step by its index.
    fn load_of(&self, index: usize) -> f64 {
        self.steps[index].reading.load(self.quantity)
    }

    /// Utilisation of a criterion under the loads that were solved.
    fn band(&self, criterion: Criterion) -> UtilisationBand {
        UtilisationBand::new(self.steps.iter().map(|record| {
            let Utilisation { value, error, .. } = self.utilisation(record, criterion);
            [record.reading.load(self.quantity), value, error.unwrap_or(0.0)]
        }))
    }

    /// Utilisation of a criterion in a step; without contact that by residual stress.
    fn utilisation(&self, record: &StepRecord, criterion: Criterion) -> Utilisation {
        let value = criterion.at_rest(self.run.problem.bodies());
        let at_rest = Utilisation::new(criterion, value, None, [0.0; 3]);
        record.utilisation(criterion).copied().unwrap_or(at_rest)
    }
}

/// Largest mean pressure that the hardness bears, which contact does not reach; that under which the highest value of a given pressure is
/// the hardness. Infinite without hardness.
fn largest_borne(problem: &Problem) -> f64 {
    let hardness = problem.largest_hardness().map_or(f64::INFINITY, |(hardness, _)| hardness);
    let over_highest =
        problem.given_pressure().map_or(1.0, |given| given.force() / problem.cell().area() / given.highest());
    hardness * over_highest
}
