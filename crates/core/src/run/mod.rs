//! The engine of a run: load path, refinement to an accuracy, stresses, warnings.
//!
//! A [`Run`] is solved with a [`Recorder`], which is called with every finished step: that of the command line writes files, that
//! of a study reads numbers, `()` records nothing. The result is an [`Outcome`]. A recorder may give an [`EarlierRun`] to resume.
//!
//! ```
//! use percoat_core::run::{Run, Sampling};
//! # use percoat_core::*;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let levels = vec![Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0)?];
//! # let indenters = Indenters::new(Lattice::hexagonal(1.0, 1)?, levels)?;
//! # let problem = Problem::new(indenters, HalfSpace::new(vec![], Material::from_young(1.0, 0.3)?));
//! let loads = [0.01, 0.02].map(Load::MeanPressure).to_vec();
//! let outcome = Run::new(problem, loads, Sampling::Accuracy(0.01)).solve(&mut ())?;
//! assert!(outcome.is_accurate() && outcome.steps.iter().all(|step| step.converged()));
//! # Ok(())
//! # }
//! ```

mod accuracy;
mod adhering;
mod alone;
mod checked;
mod creeping;
mod earlier_run;
mod ended;
mod grid_start;
mod limit;
mod outcome;
pub mod places;
mod quantities;
mod record;
mod recorder;
mod sampling;
mod slipping;
mod tapered;
pub mod tip;
pub mod touches;
pub mod warnings;
mod wear;
pub mod words;

pub use accuracy::{Refinement, RefinementEnd, TooOblong, balanced_points, change};
pub use alone::alone;
pub use creeping::Times;
pub use earlier_run::{EarlierRun, LastLoad};
pub use grid_start::GridStart;
pub use limit::{At, EVENTS, Limit, LimitStep, Limits, SearchEnd, first, rivals};
pub use outcome::{AllAtHardness, BeyondFullContact, BeyondHardness, NoSteadyState, Outcome, RunError};
pub use places::{Cut, StressRequest, Volume};
pub use quantities::{OfStep, Part, declared, of_step};
pub use record::{STEP, Sliding, StepQuantities, StepRecord};
pub use recorder::Recorder;
pub use sampling::Sampling;
pub use slipping::Motion;
pub(crate) use slipping::cycle_of;
pub use tapered::Tapered;
pub(crate) use wear::next_length;
pub use wear::{PathEnd, WearPath, WornPath, WornStep, WornSurface};

use crate::body::MeanStress;
use crate::lattice::Grid;
use crate::load::{Control, Load, LoadQuantity};
use crate::problem::Problem;
use crate::reading::{self, Criterion, Pass, PathReading, StressReading};
use crate::spectral::{AdhesiveError, OtherGrids, Settings, Solver, Step, check_adhesive_grid};
use crate::stress::{PathSought, StressFields, Tables};
use std::cell::Cell;
use std::convert::Infallible;
use std::error::Error;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Index of the grid of a refinement, if it has as many, on which the penetration of complete contact is checked: 768 points are
/// enough.
const CHECKED_GRID: usize = 3;

/// Purpose for which a load is solved.
#[derive(Debug, Clone, Copy)]
enum Loading<'a> {
    /// A step of a load path: the contact stiffness is read too.
    Path,
    /// A load of a search for limits: of stresses those by which strengths are judged.
    Search,
    /// A limit that is shown, with all stresses.
    Limit,
    /// A step in which points stay in place, with the other steps of the cycle that ends with it; empty where none does.
    InPlace(&'a [Step]),
    /// A step in place, as before, of a search for limits.
    SearchInPlace(&'a [Step]),
}

/// A run: loads solved one after another, on one grid or on finer and finer ones.
#[derive(Debug, Clone)]
pub struct Run {
    /// The bodies in contact.
    pub problem: Arc<Problem>,
    /// The prescribed loads, in their order.
    pub loads: Vec<Load>,
    /// The grid, or the accuracy of a refinement.
    pub sampling: Sampling,
    /// Tolerance and limits of the solver.
    pub settings: Settings,
    /// The stresses to be computed, if any.
    pub stress: Option<StressRequest>,
    /// Motion at each load, where friction sticks and slips; `None` where the counterbody slides or is still.
    pub motions: Option<Vec<Motion>>,
    /// Times of the loads, of bodies that creep; `None` where nothing depends on time.
    pub times: Option<Times>,
}

/// Records of all loads on one grid, and the last step.
type Solved = (Vec<StepRecord>, Option<Step>);

impl Run {
    /// A run without stresses, with the solver's defaults.
    pub fn new(problem: impl Into<Arc<Problem>>, loads: Vec<Load>, sampling: Sampling) -> Self {
        let (problem, settings, stress, motions, times) = (problem.into(), Settings::default(), None, None, None);
        Self { problem, loads, sampling, settings, stress, motions, times }
    }

    /// The quantity in which its loads are stated: forces where one is prescribed, and for an isolated contact.
    pub fn quantity(&self) -> LoadQuantity {
        let by_force = self.loads.iter().any(|load| matches!(load, Load::Force(_)));
        if by_force { LoadQuantity::Force } else { self.problem.kind().load_quantity() }
    }

    /// Checks that there are loads and a grid, and that every prescribed penetration can be reached: on the grid, or on a fine one of
    /// a refinement.
    ///
    /// # Errors
    /// [`RunError::NoLoads`], [`TooOblong`], [`BeyondHardness`] for the first load that the hardness does not bear, [`AllAtHardness`]
    /// for the first penetration that takes all of the surface to it, [`BeyondFullContact`] for the first one out of reach,
    /// [`LatticeError`] when there is no such grid.
    ///
    /// [`LatticeError`]: crate::lattice::LatticeError
    pub fn check(&self) -> Result<(), RunError<Infallible>> {
        self.checked()
    }

    /// [`check`](Self::check) with the error type of a recorder.
    fn checked<E: Error + 'static>(&self) -> Result<(), RunError<E>> {
        if self.loads.is_empty() {
            return Err(RunError::NoLoads);
        }
        let points = self.checked_sampling()?;
        self.check_adhesion()?;
        self.check_times()?;
        let kind = self.problem.kind();
        let hardness = self.problem.largest_hardness().filter(|_| !kind.is_given).map(|(hardness, _)| hardness);
        for load in &self.loads {
            if let (Control::MeanPressure(mean), Some(hardness)) = (load.on(self.problem.cell()), hardness)
                && mean >= hardness
            {
                return Err(BeyondHardness { load: *load, hardness, area: self.problem.cell().area() }.into());
            }
        }
        let by_load = self.loads.iter().all(|load| load.is_load_control());
        if by_load || !kind.may_be_complete() {
            return Ok(());
        }
        let surface = self.problem.loaded_by().surface(points)?;
        let deepest = self.loads.iter().filter_map(|load| match *load {
            Load::Penetration(penetration) => Some(penetration),
            Load::Grip { position, stiffness } if stiffness.is_infinite() => Some(position),
            _ => None,
        });
        let beyond = |limit: f64| deepest.clone().find(|penetration| *penetration >= limit);
        let compliance = self.problem.bodies().mean_compliance();
        if let Some(hardness) = hardness {
            // A uniform pressure displaces nothing but the layers on a rigid base.
            let complete = surface.largest() + compliance * hardness;
            return beyond(complete)
                .map_or(Ok(()), |penetration| Err(AllAtHardness { penetration, complete, hardness }.into()));
        }
        // Complete contact of compressible layers on a rigid base bears any penetration.
        let complete = surface.mean();
        match beyond(complete).filter(|_| compliance == 0.0) {
            Some(penetration) => Err(BeyondFullContact { penetration, complete }.into()),
            None => Ok(()),
        }
    }

    /// Refinement to an accuracy, from the first grid on that resolves the zone in which surfaces that adhere pull beside contact.
    fn refinement<E: Error + 'static>(&self, accuracy: f64) -> Result<Refinement, RunError<E>> {
        let cell = self.problem.cell();
        let resolves =
            |points| Grid::new(cell, points).is_ok_and(|grid| check_adhesive_grid(&self.problem, &grid).is_ok());
        Ok(Refinement::new(&cell, accuracy)?.without(|points| !resolves(points)))
    }

    /// Checks that surfaces adhere where loads or motions need or exclude that, and that the finest grid resolves the zone that pulls.
    fn check_adhesion<E: Error + 'static>(&self) -> Result<(), RunError<E>> {
        let (cell, adheres) = (self.problem.cell(), self.problem.adhesion().is_some());
        if adheres && self.motions.is_some() {
            return Err(AdhesiveError::Sticks.into());
        }
        for load in &self.loads {
            match *load {
                Load::Grip { .. } if !adheres => return Err(AdhesiveError::Grip.into()),
                Load::Grip { stiffness, .. } if stiffness.is_nan() || stiffness <= 0.0 => {
                    return Err(AdhesiveError::Stiffness(stiffness).into());
                }
                _ => {}
            }
        }
        match self.sampling.grids(&cell)?.last() {
            Some(finest) if adheres => Ok(check_adhesive_grid(&self.problem, &Grid::new(cell, *finest)?)?),
            _ => Ok(()),
        }
    }

    /// Points of the grid on which complete contact is checked.
    fn checked_sampling<E: Error + 'static>(&self) -> Result<[usize; 2], RunError<E>> {
        let cell = self.problem.cell();
        let grids = self.sampling.grids(&cell)?;
        let points = grids[CHECKED_GRID.min(grids.len() - 1)];
        Grid::new(cell, points)?;
        Ok(points)
    }

    /// Solves all loads after a [check](Self::check), on finer and finer grids where an accuracy is prescribed.
    ///
    /// # Errors
    /// [`RunError`]; the calls of the recorder until then are complete.
    pub fn solve<R: Recorder>(&self, recorder: &mut R) -> Result<Outcome, RunError<R::Error>> {
        self.checked()?;
        let mut finished = recorder.finished();
        let (mut steps, last, points, change, end) = match self.sampling {
            Sampling::Points(points) => {
                if finished.as_ref().is_some_and(|finished| finished.points != points) {
                    return Err(OtherGrids.into());
                }
                let (steps, last) = self.steps_on(points, finished, recorder)?;
                (steps, last, points, None, None)
            }
            Sampling::Accuracy(accuracy) => {
                let mut refinement = self.refinement(accuracy)?;
                let mut coarse = None;
                if let Some(finished) = &mut finished {
                    refinement.go_on(finished.points, &finished.changes)?;
                    coarse = finished.coarser.take();
                    // Each grid but the first is compared with the one before.
                    let steps = coarse.as_ref().map_or(0, Vec::len);
                    if steps != if refinement.is_first() { 0 } else { self.loads.len() } {
                        return Err(OtherGrids.into());
                    }
                }
                loop {
                    let points = refinement.points();
                    let (steps, last) = self.steps_on(points, finished.take(), recorder)?;
                    let change = coarse.map(|coarse: Vec<StepRecord>| accuracy::change(&coarse, &steps));
                    if let Some(change) = change {
                        recorder.refined(points, change);
                    }
                    if let Some(end) = refinement.refine(change, |points| recorder.fits(points)) {
                        break (steps, last, points, change, Some(end));
                    }
                    coarse = Some(steps);
                }
            }
        };
        StepRecord::add_stiffness(&mut steps);
        let warnings = warnings::warnings(&self.problem, &steps, end, change);
        Ok(Outcome { steps, last, points, change, end, warnings })
    }

    /// Convention for the mean lateral stress; `None` where neither stresses are computed nor strengths or laws of fatigue are given.
    fn mean_stress(&self) -> Option<MeanStress> {
        let bodies = self.problem.bodies();
        let are_judged = || !Criterion::all(bodies).is_empty() || bodies.tire();
        self.stress.as_ref().map(|request| request.mean).or_else(|| are_judged().then(MeanStress::default))
    }

    /// Solves all loads on one grid, after those of the earlier run `finished`: with partial slip where there are drives, in time, or with
    /// adhesion.
    fn steps_on<R: Recorder>(
        &self,
        points: [usize; 2],
        finished: Option<EarlierRun>,
        recorder: &mut R,
    ) -> Result<Solved, RunError<R::Error>> {
        match (&self.motions, &self.times) {
            (Some(motions), _) => self.slip_on_grid(motions, points, finished, recorder),
            (None, Some(times)) => self.creep_on_grid(times, points, finished, recorder),
            (None, None) if self.problem.adhesion().is_some() => self.adhesive_on_grid(points, finished, recorder),
            (None, None) => self.on_grid(points, finished, recorder),
        }
    }

    /// Solves all loads on one grid, after those of the earlier run `finished`.
    fn on_grid<R: Recorder>(
        &self,
        points: [usize; 2],
        finished: Option<EarlierRun>,
        recorder: &mut R,
    ) -> Result<Solved, RunError<R::Error>> {
        let mut solver = Solver::new(Arc::clone(&self.problem), points, self.settings)?;
        NoSteadyState::of(&solver).map_or(Ok(()), Err)?;
        recorder.begin(&GridStart::from(&solver)).map_err(RunError::Recorder)?;
        let (mut records, mut saved) = finished.map_or((Vec::new(), None), |earlier| (earlier.steps, earlier.last));
        let Some(loads) = self.loads.get(records.len()..).filter(|loads| !loads.is_empty()) else {
            return Err(OtherGrids.into());
        };
        let (mut last, tables) = (None, Arc::default());
        for &load in loads {
            // The memory of a step is freed before the next one needs as much.
            drop(last.take());
            let (record, step) =
                self.solve_load(&mut solver, &tables, load, (Loading::Path, saved.take()), recorder)?;
            solver.keep_indentation();
            records.push(record);
            last = Some(step);
        }
        Ok((records, last))
    }

    /// Solves one load, or restores it where it is `saved`, with its stresses, which share the `tables` of all loads.
    fn solve_load<R: Recorder>(
        &self,
        solver: &mut Solver,
        tables: &Arc<Tables>,
        load: Load,
        (loading, saved): (Loading<'_>, Option<LastLoad>),
        recorder: &mut R,
    ) -> Result<(StepRecord, Step), RunError<R::Error>> {
        recorder.load(load);
        let began = recorder.clock();
        let before = saved.as_ref().map_or(0.0, |saved| saved.seconds);
        let step = match saved {
            Some(saved) => solver.restore(load, saved.checkpoint)?,
            None => {
                let mut iterated = Ok(());
                let step = solver.solve_with_progress(load, &mut |progress| {
                    iterated = recorder.iteration(progress);
                    if iterated.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
                });
                iterated.map_err(RunError::Recorder)?;
                recorder.solved(&solver.checkpoint(&step)).map_err(RunError::Recorder)?;
                step
            }
        };
        let mut record = StepRecord::new(&step, step.reading());
        let is_indented = record.kind().is_indentation();
        if matches!(loading, Loading::Path) && is_indented && step.report.stop.solved() {
            record = record.with_stiffness(solver.stiffness(&step));
        }
        let record = self.with_stresses(&step, record, tables, loading, (began, before), recorder)?;
        Ok((record, step))
    }

    /// The record of a step with its stresses, passed to the recorder.
    fn with_stresses<R: Recorder>(
        &self,
        step: &Step,
        mut record: StepRecord,
        tables: &Arc<Tables>,
        loading: Loading<'_>,
        (began, before): (Option<f64>, f64),
        recorder: &mut R,
    ) -> Result<StepRecord, RunError<R::Error>> {
        let fields = self.mean_stress().map(|mean| {
            recorder.stresses(step, &record);
            let strains = self.stress.as_ref().is_some_and(|request| request.strain);
            StressFields::with_tables(step.finest(), mean, tables).with_strains(strains)
        });
        if let Some(fields) = fields.as_ref().filter(|_| record.is_loaded()) {
            let ended = Cell::new(None);
            let goes_on = || recorder.searching().map_err(|error| ended.set(Some(error))).is_ok();
            let bodies = self.problem.bodies();
            let moments = match loading {
                Loading::InPlace(moments) | Loading::SearchInPlace(moments) => moments,
                Loading::Path | Loading::Search | Loading::Limit => &[],
            };
            let pass = Pass { moments, ..Pass::default() };
            let judged = match loading {
                Loading::Search | Loading::SearchInPlace(_) => {
                    let pass = Some(&pass).filter(|_| matches!(loading, Loading::Search) || !moments.is_empty());
                    reading::utilisations_while(step, &record.reading, fields, pass, &goes_on)
                        .map(|utilisations| record.clone().with_utilisations(utilisations))
                }
                // Without a cycle what stays in place meets no range of stresses.
                Loading::InPlace([]) => StressReading::of_while(step, &record.reading, fields, &goes_on)
                    .map(|stress| record.clone().with_stress(stress, bodies)),
                Loading::Path | Loading::Limit | Loading::InPlace(_) => {
                    let sought = (PathSought::ALL, &pass);
                    let (stress, path) = (
                        StressReading::of_while(step, &record.reading, fields, &goes_on),
                        PathReading::of_pass(step, &record.reading, fields, sought, &goes_on),
                    );
                    stress.zip(path).map(|(stress, path)| {
                        let record = record.clone().with_stress(stress, bodies);
                        if moments.is_empty() { record.with_path(path, &self.problem) } else { record.with_cycle(path) }
                    })
                }
            };
            if let Some(error) = ended.into_inner() {
                return Err(RunError::Recorder(error));
            }
            record = judged.expect("nothing has ended the search");
        }
        record.seconds = recorder.clock().zip(began).map(|(now, began)| before + now - began);
        recorder.step(step, &record, fields.as_ref()).map_err(RunError::Recorder)?;
        Ok(record)
    }
}
