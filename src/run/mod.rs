//! The engine of a run: load path, refinement to an accuracy, stresses, warnings.
//!
//! A [`Run`] says what is solved. A [`Recorder`] hears of every step as it is done, and keeps of it what it wants: the
//! command line writes files, a study reads numbers, `()` keeps nothing. What comes out at the end is an [`Outcome`].
//!
//! ```
//! use percoat::run::{Run, Sampling};
//! # use percoat::*;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let levels = vec![Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0)?];
//! # let indenters = Indenters::new(Lattice::hexagonal(1.0, 1)?, levels)?;
//! # let problem = Problem::new(indenters, HalfSpace::new(vec![], Material::from_young(1.0, 0.3)?));
//! let loads = [0.01, 0.02].map(Load::MeanPressure).to_vec();
//! let outcome = Run::new(problem, loads, Sampling::Accuracy(0.01)).solve(&mut (), &|_| true)?;
//! assert!(outcome.is_accurate() && outcome.steps.iter().all(|step| step.converged()));
//! # Ok(())
//! # }
//! ```

pub mod accuracy;
mod places;
mod record;
mod sampling;
pub mod warnings;

pub use places::{Places, SECTION, StressRequest, Volume};
pub use record::StepRecord;
pub use sampling::Sampling;

use crate::counterbody::Surface;
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::numeric::number::number;
use crate::problem::Problem;
use crate::reading::StressReading;
use crate::spectral::{Progress, Settings, Solver, Step};
use crate::stress::StressField;
use accuracy::{End, FIRST_POINTS, Refinement, TooOblong, balanced_points};
use std::convert::Infallible;
use std::error::Error;
use std::sync::Arc;

/// What is solved: loads one after another, on one grid or on finer and finer ones.
#[derive(Debug, Clone)]
pub struct Run {
    /// What is pressed into what.
    pub problem: Arc<Problem>,
    /// The load steps, in their order.
    pub loads: Vec<Load>,
    /// The grid.
    pub sampling: Sampling,
    /// Tolerance and limits of the solver.
    pub settings: Settings,
    /// Stresses, where they are wanted.
    pub stress: Option<StressRequest>,
}

/// What hears of a run while it goes on.
pub trait Recorder {
    /// Why it cannot go on.
    type Error: Error + Send + Sync + 'static;

    /// A grid begins. What was solved before is a coarser solution of the same steps.
    ///
    /// # Errors
    /// Ends the run.
    fn begin(&mut self, solver: &Solver) -> Result<(), Self::Error> {
        let _ = solver;
        Ok(())
    }

    /// An iteration on the finest grid is done.
    fn iteration(&mut self, progress: Progress) {
        let _ = progress;
    }

    /// The stresses of a step begin.
    fn stresses(&mut self) {}

    /// A step is done; `field` where stresses are wanted.
    ///
    /// # Errors
    /// Ends the run.
    fn step(&mut self, step: &Step, record: &StepRecord, field: Option<&StressField>) -> Result<(), Self::Error> {
        let _ = (step, record, field);
        Ok(())
    }

    /// All steps on a grid of `points` are done, with this change from the next coarser one.
    fn refined(&mut self, points: [usize; 2], change: f64) {
        let _ = (points, change);
    }
}

impl Recorder for () {
    type Error = Infallible;
}

/// What a run has found.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The load steps on the last grid.
    pub steps: Vec<StepRecord>,
    /// The last of them with its fields.
    pub last: Option<Step>,
    /// Points of the last grid along a₁ and a₂.
    pub points: [usize; 2],
    /// Change against the next coarser grid, where an accuracy was asked for.
    pub change: Option<f64>,
    /// Why the refinement ended, where there was one.
    pub end: Option<End>,
    /// What a reader should know before trusting the numbers.
    pub warnings: Vec<String>,
}

impl Outcome {
    /// Whether the accuracy, if one was asked for, is reached.
    pub fn is_accurate(&self) -> bool {
        self.end.is_none_or(|end| end == End::Reached)
    }

    /// Whether all steps converged, and the accuracy is reached.
    pub fn converged(&self) -> bool {
        self.is_accurate() && self.steps.iter().all(StepRecord::converged)
    }
}

/// A prescribed penetration that no load reaches.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "penetration = {penetration} is out of reach: contact becomes complete at {}, and no further however large the \
     load; prescribe less, or mean_pressure instead",
    number(*.complete)
)]
pub struct BeyondFullContact {
    /// What is prescribed, a length.
    pub penetration: f64,
    /// Where contact becomes complete, a length.
    pub complete: f64,
}

/// Why a run has not come to its end; `E` is the recorder's reason.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError<E: Error + 'static> {
    /// There is no such grid.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// The cell is too oblong to be refined.
    #[error(transparent)]
    TooOblong(#[from] TooOblong),
    /// A penetration is beyond complete contact.
    #[error(transparent)]
    BeyondFullContact(#[from] BeyondFullContact),
    /// The recorder cannot go on.
    #[error("a step cannot be recorded: {0}")]
    Recorder(#[source] E),
}

/// Records of all loads on one grid, and the last step.
type Solved = (Vec<StepRecord>, Option<Step>);

impl Run {
    /// A run without stresses, with the solver's defaults.
    pub fn new(problem: impl Into<Arc<Problem>>, loads: Vec<Load>, sampling: Sampling) -> Self {
        Self { problem: problem.into(), loads, sampling, settings: Settings::default(), stress: None }
    }

    /// Whether every prescribed penetration can be reached, on the grid of the run or one like its last.
    ///
    /// # Errors
    /// [`BeyondFullContact`] for the first that cannot, [`LatticeError`] when there is no such grid.
    pub fn check(&self) -> Result<(), RunError<Infallible>> {
        if self.loads.iter().all(|load| load.is_mean_pressure()) {
            return Ok(());
        }
        let cell = self.problem.cell();
        let points = match self.sampling {
            Sampling::Points(points) => points,
            Sampling::Accuracy(_) => balanced_points(&cell, 8 * FIRST_POINTS),
        };
        let complete = Surface::new(self.problem.counterbody(), points)?.mean();
        for load in &self.loads {
            if let Load::Penetration(penetration) = *load
                && penetration >= complete
            {
                return Err(BeyondFullContact { penetration, complete }.into());
            }
        }
        Ok(())
    }

    /// Solves all loads, on finer and finer grids where an accuracy is asked for. `fits` tells whether there is room for
    /// a grid.
    ///
    /// # Errors
    /// [`RunError`]; what the recorder heard of until then stands.
    pub fn solve<R: Recorder>(
        &self,
        recorder: &mut R,
        fits: &dyn Fn([usize; 2]) -> bool,
    ) -> Result<Outcome, RunError<R::Error>> {
        let accuracy = match self.sampling {
            Sampling::Points(points) => {
                let (steps, last) = self.on_grid(points, recorder)?;
                return Ok(self.outcome(steps, last, points, None, None));
            }
            Sampling::Accuracy(accuracy) => accuracy,
        };
        let mut refinement = Refinement::new(self.problem.cell(), accuracy)?;
        let mut coarse: Option<Vec<StepRecord>> = None;
        loop {
            let points = refinement.points();
            let (steps, last) = self.on_grid(points, recorder)?;
            let change = coarse.map(|coarse| accuracy::change(&coarse, &steps));
            if let Some(change) = change {
                recorder.refined(points, change);
            }
            if let Some(end) = refinement.refine(change, fits) {
                return Ok(self.outcome(steps, last, points, change, Some(end)));
            }
            coarse = Some(steps);
        }
    }

    fn outcome(
        &self,
        steps: Vec<StepRecord>,
        last: Option<Step>,
        points: [usize; 2],
        change: Option<f64>,
        end: Option<End>,
    ) -> Outcome {
        let warnings = warnings::warnings(&self.problem, &steps, end, change);
        Outcome { steps, last, points, change, end, warnings }
    }

    /// All loads on one grid.
    fn on_grid<R: Recorder>(&self, points: [usize; 2], recorder: &mut R) -> Result<Solved, RunError<R::Error>> {
        let mut solver = Solver::new(Arc::clone(&self.problem), points, self.settings)?;
        recorder.begin(&solver).map_err(RunError::Recorder)?;
        let (mut records, mut last) = (Vec::new(), None);
        for &load in &self.loads {
            // Its memory goes before the next one takes as much.
            drop(last.take());
            let step = solver.solve_with_progress(load, &mut |progress| recorder.iteration(progress));
            let mut record = StepRecord::new(&step, step.reading());
            let field = self.stress.as_ref().map(|request| {
                recorder.stresses();
                StressField::new(step.finest(), request.mean)
            });
            if let Some(field) = field.as_ref().filter(|_| record.reading.max_pressure > 0.0) {
                record.stress = Some(StressReading::of(&step, &record.reading, field));
            }
            recorder.step(&step, &record, field.as_ref()).map_err(RunError::Recorder)?;
            records.push(record);
            last = Some(step);
        }
        Ok((records, last))
    }
}
