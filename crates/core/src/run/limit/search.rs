//! The search for the limits on one grid, load by load.

use super::band::{Crossing, UtilisationBand};
use super::windows::Windows;
use super::{At, Limit, LimitStep, Limits, SearchEnd};
use crate::body::{HalfSpace, Layer};
use crate::load::LoadQuantity;
use crate::problem::Problem;
use crate::reading::{Criterion, Reading, Utilisation};
use crate::run::{Loading, Recorder, Run, RunError, StepRecord};
use crate::spectral::{Solver, Step, Stop};
use crate::stress::Tables;
use std::f64::consts::PI;
use std::sync::Arc;

/// Largest number of doublings and of halvings of the first load.
const DOUBLINGS: usize = 40;
/// Largest number of limits that are shown with their fields.
pub const EVENTS: usize = 4;
/// Largest number of times that a first load is halved whose contact has no room in its window.
const HALVINGS: usize = 8;
/// Largest number of loads for one limit; bisection alone takes ten from a factor of two on.
const TRIALS: usize = 40;
/// Least number of samples along the radius of a contact for its stresses to be read.
const LEAST_SAMPLES: f64 = 3.0;
/// Largest number of rounds over all criteria: loads that were solved for one may show an earlier crossing of another.
const ROUNDS: usize = 4;
/// Relative difference below which two loads are one.
const SAME_LOAD: f64 = 1e-12;
/// The first load over that of complete contact.
const START: f64 = 1.0 / 1024.0;
/// Largest ratio of the load on an indenter with a shape of its own between neighbouring loads.
const GROWTH: f64 = 4.0;
/// Relative difference of loads below which they are not divided where a level begins to touch.
const TOUCHING: f64 = 1e-3;

/// A search on one grid.
pub(super) struct LimitSearch<'a, R: Recorder> {
    run: &'a Run,
    windows: Windows,
    /// The window of the solver.
    window: usize,
    solver: Solver,
    /// Tables that the stresses of all loads share.
    tables: Arc<Tables>,
    /// The quantity of all loads.
    quantity: LoadQuantity,
    /// Load at which contact becomes complete; infinite for a flat surface, for an isolated contact, and from [`Self::hardness_load`] on.
    complete: f64,
    /// Load that is [`SearchEnd::OF_HARDNESS`] of the most that the hardness bears; infinite without hardness, and for an isolated
    /// contact, whose window grows.
    hardness_load: f64,
    /// A load of the order at which contact fills the cell or the window; infinite for a flat surface.
    filling: f64,
    /// The solved loads, by ascending load.
    steps: Vec<StepRecord>,
    /// The step of the load that was solved last.
    last: Option<Step>,
    recorder: &'a mut R,
}

impl<'a, R: Recorder> LimitSearch<'a, R> {
    /// A search for the limits of a run on a grid of `points`, before its first load.
    fn new(run: &'a Run, points: [usize; 2], recorder: &'a mut R) -> Result<Self, RunError<R::Error>> {
        let mut solver = Solver::new(Arc::clone(&run.problem), points, run.settings)?;
        recorder.begin(&solver).map_err(RunError::Recorder)?;
        // A flat surface is in complete contact under any load, but its stresses grow with the load all the same.
        let complete = Some(solver.full_contact_pressure()).filter(|pressure| *pressure > 0.0);
        let (quantity, area) = (run.quantity(), run.problem.cell().area());
        let per_pressure = if quantity == LoadQuantity::Force { area } else { 1.0 };
        let borne = SearchEnd::OF_HARDNESS * largest_borne(&run.problem) * per_pressure;
        let filling = complete.map_or(f64::INFINITY, |pressure| (pressure * per_pressure).min(borne));
        // An isolated contact is never complete, but fills its window under a load of this order.
        let kind = run.problem.kind();
        let complete = if kind.may_be_complete() && filling < borne { filling } else { f64::INFINITY };
        let hardness_load = if kind.is_indentation() { f64::INFINITY } else { borne };
        let windows = Windows::new(Arc::clone(&run.problem), complete.min(hardness_load));
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
            filling,
            steps,
            last: None,
            recorder,
        })
    }

    /// Searches the limits of a run on a grid of `points`.
    pub fn on_grid(run: &'a Run, points: [usize; 2], recorder: &'a mut R) -> Result<Limits, RunError<R::Error>> {
        let mut search = Self::new(run, points, recorder)?;
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
            ends_at_border: search.windows.largest() < complete.min(hardness_load),
            change: None,
            end: None,
            warnings: Vec::new(),
        };
        let is_load = |limit: &&&Limit| limit.load() > 0.0 && limit.load().is_finite();
        let events: Vec<Limit> = limits.ordered().iter().filter(is_load).take(EVENTS).map(|limit| **limit).collect();
        for limit in events {
            let record = search.solve_for(limit.load(), Loading::Limit)?.clone();
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
        self.solve_for(load, Loading::Search)
    }

    /// Solves a load and keeps its record.
    fn solve_for(&mut self, load: f64, loading: Loading) -> Result<&StepRecord, RunError<R::Error>> {
        // The memory of a step is freed before the next one needs as much.
        self.last = None;
        self.enter(self.windows.of(load))?;
        let prescribed = self.quantity.load(load);
        let (record, step) =
            self.run.solve_load(&mut self.solver, &self.tables, prescribed, (loading, None), self.recorder)?;
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
            let (problem, points) = (Arc::clone(self.windows.problem(window)), self.solver.grid().points());
            // The tables of one window are kept at a time.
            self.tables = Arc::default();
            self.solver = Solver::new(problem, points, self.run.settings)?;
            self.window = window;
            self.recorder.begin(&self.solver).map_err(RunError::Recorder)?;
        }
        Ok(())
    }

    /// The first load: a part of that of complete contact, or the least strength where contact is complete under any
    /// load and stresses are proportional to it.
    fn start(&self) -> f64 {
        if self.filling.is_finite() {
            return START * self.filling;
        }
        let bodies = || self.run.problem.bodies().each();
        let of_materials = bodies().flat_map(HalfSpace::strengths);
        let of_materials = of_materials.flat_map(|strength| [strength.yielding, strength.tensile]);
        let of_interfaces = bodies().flat_map(HalfSpace::layers).map(Layer::interface_strength);
        let of_interfaces = of_interfaces.flat_map(|strength| [strength.normal, strength.shear]);
        let least = of_materials.chain(of_interfaces).flatten().fold(f64::INFINITY, f64::min);
        let least = match self.quantity {
            LoadQuantity::MeanPressure => least,
            LoadQuantity::Force => least * self.run.problem.cell().area(),
        };
        least.min(self.hardness_load)
    }

    /// Solves loads a factor of two apart, from the least whose contact has samples enough on, until every criterion has
    /// failed by more than its error or contact is complete. They do not depend on the loads of the run.
    fn scan(&mut self, sought: &[Criterion]) -> Result<(), RunError<R::Error>> {
        let mut lowest = self.start();
        let mut at_border = has_no_room(self.solve(lowest)?);
        for _ in 0..HALVINGS {
            if !at_border {
                break;
            }
            // Contact has no room in its window: a lower load may have.
            lowest *= 0.5;
            at_border = has_no_room(self.solve(lowest)?);
            self.steps.truncate(1);
        }
        while at_border && self.windows.end_at(0.0) {
            self.steps.clear();
            at_border = has_no_room(self.solve(lowest)?);
        }
        let mut highest = lowest;
        for _ in 0..DOUBLINGS {
            // Loads are halved until everything holds where contact is complete under any load.
            let holds = |search: &Self| {
                let failed = |&criterion: &Criterion| search.band(criterion).upper.first_failure() == Some(0);
                search.filling.is_infinite() && !sought.iter().any(failed)
            };
            if !self.is_readable(&self.steps[0].reading) || holds(self) {
                break;
            }
            lowest *= 0.5;
            self.solve(lowest)?;
        }
        for _ in 0..DOUBLINGS {
            let has_samples = self.steps.iter().any(|step| self.is_readable(&step.reading));
            let holds = |&criterion: &Criterion| !self.band(criterion).fails();
            if at_border || highest >= self.windows.largest() || has_samples && !sought.iter().any(holds) {
                break;
            }
            let before = highest;
            highest = (2.0 * highest).min(self.windows.largest());
            if has_no_room(self.solve(highest)?) {
                // Contact has no room in its window: the load says nothing.
                self.steps.pop();
                highest = before;
                if !self.windows.end_at(before) {
                    break;
                }
            }
        }
        let readable = self.steps.iter().position(|step| self.is_readable(&step.reading));
        let least = readable.unwrap_or(self.steps.len() - 1);
        self.steps.drain(..least);
        Ok(())
    }

    /// Whether the contact of the best resolved level, or that of a topography, has enough samples for its stresses.
    fn is_readable(&self, reading: &Reading) -> bool {
        // A given contact does not grow with the load.
        if self.run.problem.kind().is_given {
            return true;
        }
        let samples = reading.contact_area / self.solver.grid().sample_area();
        let whole = (samples / PI).sqrt();
        let of_levels = reading.levels.iter().map(|level| level.resolution).reduce(f64::max);
        of_levels.unwrap_or(whole) >= LEAST_SAMPLES
    }

    /// Solves loads between those where a level of a shape of its own begins to touch: its small contacts may fail at loads
    /// of theirs that no doubling of the whole load meets. Levels of one shape fail at the highest of them first.
    fn divide_touches(&mut self, sought: &[Criterion]) -> Result<(), RunError<R::Error>> {
        for _ in 0..TRIALS {
            let holds = |index: usize| {
                let holds =
                    |&criterion: &Criterion| self.band(criterion).lower.samples[..=index].iter().all(|[_, u]| *u < 1.0);
                sought.iter().any(holds)
            };
            let rough = (1..self.steps.len()).find(|&above| holds(above - 1) && self.grows_apart(above));
            let Some(above) = rough else { break };
            let [low, high] = [above - 1, above].map(|index| self.load_of(index));
            self.solve((low * high).sqrt())?;
        }
        Ok(())
    }

    /// Whether the load on one indenter of some level grows by more than [`GROWTH`] from the load before to load `above`, and
    /// the level has a shape that no higher one has.
    fn grows_apart(&self, above: usize) -> bool {
        let [before, after] = [above - 1, above].map(|index| &self.steps[index].reading);
        if after.load(self.quantity) <= before.load(self.quantity) * (1.0 + TOUCHING) {
            return false;
        }
        let Some(indenters) = self.run.problem.indenters() else { return false };
        let (levels, drops) = (indenters.levels(), indenters.drops());
        let is_new = |level: usize| {
            (0..levels.len()).all(|other| {
                let is_higher = drops[other] < drops[level] || drops[other] == drops[level] && other < level;
                !is_higher || levels[other].shape() != levels[level].shape()
            })
        };
        let grows = |level: usize| {
            let [low, high] = [before, after].map(|reading| &reading.levels[level]);
            high.resolution >= 2.0 * LEAST_SAMPLES && high.load > GROWTH * low.load
        };
        (0..levels.len()).any(|level| drops[level] > 0.0 && is_new(level) && grows(level))
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

    /// Whether the highest level, which touches under any load, has tips whose pressure is infinite.
    fn first_is_tip(&self) -> bool {
        let indenters = self.run.problem.indenters();
        let levels = indenters.into_iter().flat_map(|all| all.levels().iter().zip(all.drops()));
        levels.into_iter().any(|(level, drop)| drop == 0.0 && level.shape().singular_peak())
    }

    /// Utilisation of a criterion in a step; without contact that by residual stress.
    fn utilisation(&self, record: &StepRecord, criterion: Criterion) -> Utilisation {
        let value = criterion.at_rest(self.run.problem.bodies());
        let at_rest = Utilisation::new(criterion, value, None, [0.0; 3]);
        record.utilisation(criterion).copied().unwrap_or(at_rest)
    }

    /// Solves loads until the limit of a criterion is known.
    fn find(&mut self, criterion: Criterion) -> Result<(), RunError<R::Error>> {
        for trial in 0..TRIALS {
            // Every third load bisects the interval around the root.
            let Some(next) = self.band(criterion).next(trial % 3 == 2) else { break };
            self.solve(next)?;
        }
        Ok(())
    }

    /// Limit of a criterion, by the loads that were solved.
    fn found(&self, criterion: Criterion) -> At {
        let band = self.band(criterion);
        let taken = |index: usize| self.utilisation(&self.steps[index], criterion);
        let load = |index: usize| self.load_of(index);
        let up_to = load(self.steps.len() - 1);
        let Crossing { from, at: crossing, to } = band.crossing();
        let undecided = |at: usize| {
            let Utilisation { value: utilisation, error, position, .. } = taken(at);
            // At another load it may be larger still.
            let most = band.upper.samples.iter().map(|[_, u]| *u).fold(f64::NEG_INFINITY, f64::max);
            let error = error.map(|error| error.max(most - utilisation));
            let at = load(at);
            if from.is_infinite() {
                let end = SearchEnd::of(up_to, self.complete, self.hardness_load);
                At::Never { up_to, end, utilisation, error, at }
            } else {
                At::Undecided { from, up_to, utilisation, error, at, position }
            }
        };
        match band.value.first_failure() {
            None => undecided(band.value.largest()),
            Some(0) => match band.lower.first_failure() {
                // Under no load is u − e ≥ 1: the utilisation there may be an error.
                None => undecided(0),
                Some(sure) => {
                    let Utilisation { value, position, .. } = taken(sure);
                    if sure == 0 && value.is_infinite() && self.first_is_tip() {
                        return At::Tip { position };
                    }
                    At::Below { load: load(sure), utilisation: value, position }
                }
            },
            Some(above) => {
                let enclosure = band.value.enclosure(above);
                let nearest = taken(if enclosure.first_is_nearer() { above - 1 } else { above });
                // The error of a jump by the grid is not known; its place is that of the load that fails.
                let jumps = enclosure.slope().is_none();
                let position = if jumps { taken(above).position } else { nearest.position };
                let error = (crossing - from).max(to - crossing);
                let error = Some(error).filter(|error| error.is_finite() && !jumps && nearest.error.is_some());
                At::Load { load: crossing, error, interval: [from, to], position }
            }
        }
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

/// Whether a contact has no room in its window: it reaches the border, or would at the hardness everywhere.
fn has_no_room(step: &StepRecord) -> bool {
    matches!(step.stop, Stop::AtBorder | Stop::BeyondHardness)
}
