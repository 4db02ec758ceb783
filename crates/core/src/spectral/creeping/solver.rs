//! Contact of bodies that creep along a path of times and loads.
//!
//! Loads are linear in time from one point of the path to the next; two loads of one time, and the first one, are a jump, under which the
//! bodies are glassy. Over a step of length Δt the pressure of each sample is linear in time:
//!
//! g(t) = A p(t) + u + f − δ(t),  p ≥ 0, g ≥ 0, gp = 0
//!
//! with the operator A of the [compliances](crate::creep::History::compliances) of the interval, symmetric and positive, and the displacement u
//! that earlier pressures leave. Each step is solved on all nested grids, each with its own history.
//!
//! A step is taken once whole and once by two halves, of which the result counts; the difference is stated for its error. Where
//! that is above the tolerance the step is divided.

use super::CreepError;
use super::pace::Pace;
use super::surface_history::SurfaceHistory;
use crate::creep::{Retardation, times};
use crate::lattice::Grid;
use crate::load::Load;
use crate::numeric::sums;
use crate::problem::Problem;
use crate::spectral::iteration::{Progress, Settings, Stop, Unknowns};
use crate::spectral::{Solver, Step};
use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Least relative error of the penetration in a step over that of the pressure: twice the largest that chance hides in the study `creep`.
const BY_PRESSURE: f64 = 0.04;
/// Largest error of one step in time that is used where none is prescribed.
pub const TIME_TOLERANCE: f64 = 1e-3;
/// Length of a step, over the shortest retardation time, below which it is not divided.
const LEAST_STEP: f64 = 1e-4;

/// Called after each iteration; `Break` ends the step.
type Watch<'a> = dyn FnMut(Progress) -> ControlFlow<()> + Send + 'a;

/// Bodies that creep in a contact, time after time.
#[derive(Debug)]
pub struct CreepSolver {
    solver: Solver,
    /// Histories of the grids, the finest first.
    histories: Vec<SurfaceHistory>,
    /// Present time and load; `None` before the first one.
    present: Option<(f64, Load)>,
    tolerance: f64,
    /// Length below which steps are not divided, a time.
    least: f64,
    /// Largest penetration and sum of the pressures of the path so far.
    largest: [f64; 2],
    error: TimeError,
    /// First failure on the path: what follows from it is no solution either.
    failed: Option<Stop>,
}

/// Error of the steps in time, added up over the path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TimeError {
    /// Error of the penetration, a length.
    pub penetration: f64,
    /// Error of the pressure: the sum of its magnitudes over that of the largest pressures of the path.
    pub pressure: f64,
}

/// State of a path at one time.
#[derive(Debug, Clone)]
pub struct CreepStep {
    /// The contact.
    pub contact: Step,
    /// Time.
    pub time: f64,
    /// Steps in time since the point of the path before.
    pub steps: usize,
    /// Error of all steps in time so far; `None` where steps are not divided.
    pub error: Option<TimeError>,
}

/// State of all grids: pressures and histories, the finest first.
#[derive(Clone)]
struct State {
    unknowns: Vec<Unknowns>,
    histories: Vec<SurfaceHistory>,
}

/// Work on the way to a state.
#[derive(Debug, Clone, Copy, Default)]
struct Effort {
    steps: usize,
    iterations: usize,
    convolutions: f64,
}

impl CreepSolver {
    /// Bodies at rest without a load, on a grid of `points` = [N₁, N₂] and its coarser companions. The `tolerance` is the largest error of one
    /// step in time, of the penetration and of the pressure over the largest ones of the path so far; infinite, no step is divided.
    ///
    /// # Errors
    /// [`CreepError`].
    pub fn new(
        problem: impl Into<Arc<Problem>>,
        points: [usize; 2],
        settings: Settings,
        tolerance: f64,
    ) -> Result<Self, CreepError> {
        let problem = problem.into();
        CreepError::of_problem(&problem)?;
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(CreepError::Tolerance(tolerance));
        }
        let solver = Solver::new(Arc::clone(&problem), points, settings)?;
        let retardation = Retardation::new(problem.bodies());
        let grids = solver.levels.iter().map(|level| level.surface().grid());
        let histories = grids.map(|grid| SurfaceHistory::new(grid, &retardation)).collect();
        let least = times(problem.bodies()).map_or(0.0, |[shortest, _]| LEAST_STEP * shortest);
        let (present, failed, error) = (None, None, TimeError::default());
        Ok(Self { solver, histories, present, tolerance, least, largest: [0.0; 2], error, failed })
    }

    /// The problem.
    pub fn problem(&self) -> &Arc<Problem> {
        self.solver.problem()
    }

    /// The finest grid.
    pub fn grid(&self) -> &Arc<Grid> {
        self.solver.grid()
    }

    /// The solver of the loads on all grids.
    pub(crate) fn elastic(&self) -> &Solver {
        &self.solver
    }

    /// Goes on to a load at a time.
    ///
    /// # Errors
    /// [`CreepError::Time`] for a time before the present one, [`CreepError::Loads`] for a load of another kind.
    pub fn advance(&mut self, time: f64, load: Load) -> Result<CreepStep, CreepError> {
        self.advance_with_progress(time, load, &mut |_| ControlFlow::Continue(()))
    }

    /// Goes on to a load at a time. Calls `progress` after each iteration on the finest grid; `Break` ends the step as interrupted.
    ///
    /// # Errors
    /// [`CreepError`] as for [`Self::advance`].
    pub fn advance_with_progress(
        &mut self,
        time: f64,
        load: Load,
        progress: &mut Watch<'_>,
    ) -> Result<CreepStep, CreepError> {
        let (before, from) = self.present.unwrap_or((time, load));
        CreepError::of_path(self.problem(), &[before, time], &[from, load])?;
        let mut effort = Effort::default();
        let mut contact = None;
        let mut pace = Pace::new(time - before, self.tolerance, self.least);
        while let Some(length) = pace.next() {
            // The load at the end is met without rounding.
            let at = |left: f64| load.with_value(load.value() + left / (time - before) * (from.value() - load.value()));
            let ends = [0.5 * length, length].map(|passed| at(pace.left() - passed));
            contact = self.step(length, ends, &mut pace, &mut effort, progress).or(contact);
            if self.failed.is_some() {
                break;
            }
        }
        let contact = match contact {
            Some(contact) => contact,
            None => self.jump(0.0, load, &mut effort, progress),
        };
        self.present = Some((time, load));
        Ok(self.state(contact, time, load, effort))
    }

    /// One step in time, whole and by two halves under the loads at the ends of these; `None` where it is refused, or halves are not needed.
    fn step(
        &mut self,
        length: f64,
        [middle, end]: [Load; 2],
        pace: &mut Pace,
        effort: &mut Effort,
        progress: &mut Watch<'_>,
    ) -> Option<Step> {
        if self.tolerance.is_infinite() {
            pace.accepts(length, 0.0);
            return Some(self.jump(length, end, effort, progress));
        }
        let start = self.save();
        let whole = self.jump(length, end, effort, progress);
        if self.failed.is_some() {
            return Some(whole);
        }
        self.restore(start.clone());
        self.jump(0.5 * length, middle, effort, progress);
        let halves = self.jump(0.5 * length, end, effort, progress);
        if self.failed.is_some() {
            return Some(halves);
        }
        let error = self.difference(&whole, &halves);
        if pace.accepts(length, (error.penetration / self.largest[0].max(f64::MIN_POSITIVE)).max(error.pressure)) {
            // A step and its halves agree about the penetration by chance now and then, though not about the pressure.
            self.error.penetration += error.penetration.max(BY_PRESSURE * error.pressure * self.largest[0]);
            self.error.pressure += error.pressure;
            effort.steps += 2;
            return Some(halves);
        }
        self.restore(start);
        None
    }

    /// Solves one interval of a length ≥ 0, at the end of which there is a load.
    fn jump(&mut self, length: f64, load: Load, effort: &mut Effort, progress: &mut Watch<'_>) -> Step {
        let intervals: Vec<_> = self.histories.iter().map(|history| history.interval(length)).collect();
        for ((level, history), interval) in self.solver.levels.iter_mut().zip(&self.histories).zip(&intervals) {
            level.open(&history.known(interval), history.operator(interval));
        }
        let step = self.solver.solve_with_progress(load, progress);
        for ((level, history), interval) in self.solver.levels.iter().zip(&mut self.histories).zip(&intervals) {
            history.advance(interval, &level.unknowns().pressure);
        }
        effort.iterations += step.report.iterations;
        effort.convolutions += step.convolutions;
        if !step.report.stop.solved() {
            self.failed = Some(step.report.stop);
        }
        let pressure = step.finest().pressures();
        let [sum] = sums::of(pressure.len(), |i| [pressure[i]]);
        self.largest = [self.largest[0].max(step.penetration().abs()), self.largest[1].max(sum)];
        step
    }

    /// Error of a step by two halves, by that of the whole step.
    fn difference(&self, whole: &Step, halves: &Step) -> TimeError {
        let [one, two] = [whole, halves].map(|step| step.finest().pressures());
        let [change] = sums::of(one.len(), |i| [(one[i] - two[i]).abs()]);
        TimeError {
            penetration: (whole.penetration() - halves.penetration()).abs(),
            pressure: change / self.largest[1].max(f64::MIN_POSITIVE),
        }
    }

    fn save(&self) -> State {
        State { unknowns: self.solver.unknowns().cloned().collect(), histories: self.histories.clone() }
    }

    fn restore(&mut self, State { unknowns, histories }: State) {
        self.solver.set_unknowns(unknowns);
        self.histories = histories;
    }

    /// The state at a time, whose contact is that of the last interval.
    fn state(&self, contact: Step, time: f64, load: Load, effort: Effort) -> CreepStep {
        let stored: Vec<f64> = self.histories.iter().map(SurfaceHistory::stored).collect();
        let mut contact = contact.creeping(&stored);
        contact.load = load;
        contact.report.iterations = effort.iterations;
        contact.report.stop = self.failed.unwrap_or(contact.report.stop);
        contact.convolutions = effort.convolutions;
        let error = self.tolerance.is_finite().then_some(self.error);
        CreepStep { contact, time, steps: effort.steps.max(1), error }
    }
}

impl fmt::Display for CreepSolver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.solver)
    }
}
