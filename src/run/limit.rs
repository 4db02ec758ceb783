//! Limit loads: the mean pressure at which each criterion of strength is reached.
//!
//! Contact is not linear: a limit is found by solving. From a first load the mean pressure is halved until nothing fails and
//! doubled until everything has failed or contact is complete; then the root of ln u(ln p̄) = 0 of each criterion, u its
//! utilisation, is enclosed between two loads and found by secants with bisection as their safeguard. Every load that is
//! solved counts for all criteria, and starts from the one before. Beyond complete contact stresses grow in proportion, with
//! what shape there is gone: no limit is looked for there.
//!
//! Where a utilisation is not monotone, its first crossing between the loads that were solved is taken.

use super::places::SECTION;
use super::{Refinement, Run, Sampling, StepRecord, TooOblong};
use crate::body::MeanStress;
use crate::friction::Friction;
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::numeric::number::number;
use crate::numeric::search::largest;
use crate::problem::Problem;
use crate::reading::{Criterion, FEW_SAMPLES, StressReading, Utilisation};
use crate::spectral::{Settings, Solver, Step};
use crate::stress::{Line, Section, StressField};
use std::cmp::Ordering;
use std::f64::consts::PI;
use std::sync::Arc;

/// Relative accuracy of a limit.
const TOLERANCE: f64 = 1e-3;

/// Doublings and halvings of the first load at most.
const DOUBLINGS: usize = 40;
/// Loads to enclose one root at most; bisection alone takes eleven from a factor of two on.
const TRIALS: usize = 40;
/// Samples that a contact needs to be worth halving its load further.
const LEAST_SAMPLES: f64 = 12.0;

/// What is looked for.
#[derive(Debug, Clone)]
pub struct LimitTask {
    /// The problem, with its strengths.
    pub problem: Arc<Problem>,
    /// The grid, or how accurate the limits shall be.
    pub sampling: Sampling,
    /// Tolerance and limits of the solver.
    pub settings: Settings,
    /// What the mean lateral stress is.
    pub mean: MeanStress,
    /// The load that is solved first.
    pub start: Load,
    /// Relative accuracy of a limit.
    pub tolerance: f64,
}

/// Where a criterion is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// Residual stress alone reaches it.
    Rest,
    /// At this mean pressure.
    Load {
        /// p̄.
        mean_pressure: f64,
        /// Its estimated error by the grid, a pressure: that of the utilisation over its slope.
        error: Option<f64>,
        /// x, y, z of the place that fails; lengths.
        position: [f64; 3],
    },
    /// So small a load that contact is a few samples wide reaches it already: at less than this mean pressure.
    Below {
        /// p̄.
        mean_pressure: f64,
    },
    /// Not up to complete contact (or the largest load that was solved).
    Never {
        /// Up to this mean pressure,
        up_to: f64,
        /// where the utilisation is.
        utilisation: f64,
    },
}

/// The limit load of a criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Which.
    pub criterion: Criterion,
    /// Where it is reached.
    pub at: At,
}

/// All limit loads.
#[derive(Debug, Clone)]
pub struct Limits {
    /// One of each criterion: yield and cracking from the surface down, then the interfaces.
    pub limits: Vec<Limit>,
    /// Every load that was solved, by ascending mean pressure.
    pub steps: Vec<StepRecord>,
    /// The step at the first limit load, with its fields; at the largest load where nothing fails.
    pub last: Option<Step>,
}

impl Limit {
    /// The mean pressure up to which it holds; infinite where it is never reached.
    pub fn mean_pressure(&self) -> f64 {
        match self.at {
            At::Rest => 0.0,
            At::Load { mean_pressure, .. } | At::Below { mean_pressure } => mean_pressure,
            At::Never { .. } => f64::INFINITY,
        }
    }
}

impl Limits {
    /// The limit that is reached first; `None` where nothing fails.
    pub fn first(&self) -> Option<&Limit> {
        let reached = self.limits.iter().filter(|limit| limit.mean_pressure().is_finite());
        reached.min_by(|a, b| a.mean_pressure().total_cmp(&b.mean_pressure()))
    }

    /// Largest relative change of the limits from those of a coarser grid; infinite where one is reached on one grid alone.
    fn change(&self, coarse: &Self) -> f64 {
        let pairs = self.limits.iter().zip(&coarse.limits).map(|(fine, coarse)| (fine.mean_pressure(), coarse.mean_pressure()));
        largest(pairs.map(|(fine, coarse)| if fine == coarse { 0.0 } else { (fine - coarse).abs() / fine.min(coarse) })).max(0.0)
    }

    /// What a reader should know before trusting the numbers.
    pub fn warnings(&self) -> Vec<String> {
        let few = |limit: &Limit| {
            let pressure = limit.mean_pressure();
            let near = self.steps.iter().find(|step| step.reading.mean_pressure >= pressure)?;
            let resolution = near.reading.spot_resolution;
            (pressure > 0.0 && pressure.is_finite() && resolution < FEW_SAMPLES).then(|| {
                format!(
                    "{}: at its limit contact has {resolution:.0} samples along its radius; raise grid.points",
                    limit.criterion
                )
            })
        };
        let stopped = self.steps.iter().filter(|step| !step.converged()).map(|step| {
            format!("the load {} did not converge: {}", number(step.reading.mean_pressure), step.stop_reason())
        });
        self.limits.iter().filter_map(few).chain(stopped).collect()
    }

    /// The stresses under the place that fails first, at its limit: a cut along the sliding (else along x), a contact's
    /// width to both sides and deep enough for it; `None` where nothing fails under a load.
    pub fn section(&self, task: &LimitTask) -> Option<Section> {
        let (step, At::Load { position: [x, y, z], .. }) = (self.last.as_ref()?, self.first()?.at) else { return None };
        let (half_space, cell) = (task.problem.half_space(), task.problem.cell());
        let direction = task.problem.friction().map_or([1.0, 0.0], Friction::direction);
        let spots = step.reading().contact_spots.max(1) as f64;
        let radius = (step.reading().contact_fraction * cell.area() / PI / spots).sqrt();
        let reach = (3.0 * radius).min(0.5 * cell.reduced().longer_side());
        let coating = half_space.interface_depths().last().copied().unwrap_or(0.0);
        let [rows, points] = SECTION;
        let line = Line { origin: [x, y], direction, span: [-reach, reach], points };
        let depths = half_space.rows((2.0 * radius).max(1.5 * z).max(1.25 * coating.min(8.0 * radius)), rows);
        Some(StressField::new(step.finest(), task.mean).section(&line, &depths))
    }

    /// Whether all loads were solved.
    pub fn converged(&self) -> bool {
        self.steps.iter().all(StepRecord::converged)
    }
}

/// Why there are no limits to look for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LimitError {
    /// Nothing has a strength.
    #[error(
        "limit needs strengths: give materials a yield_strength or a tensile_strength, or layers an interface_strength"
    )]
    NoStrengths,
    /// There is nothing to begin with.
    #[error("limit needs a load to begin with that is greater than 0")]
    NoLoad,
    /// There is no such grid.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// The cell is too oblong to be refined.
    #[error(transparent)]
    TooOblong(#[from] TooOblong),
}

/// The search on one grid, load by load.
struct Search<'a> {
    task: &'a LimitTask,
    samples: f64,
    solver: Solver,
    steps: Vec<StepRecord>,
    last: Option<Step>,
    heard: &'a mut (dyn FnMut(&StepRecord) + Send),
}

impl LimitTask {
    /// What a run's problem bears, to 10⁻³, beginning with its first load.
    ///
    /// # Errors
    /// [`LimitError::NoStrengths`], [`LimitError::NoLoad`].
    pub fn of(run: &Run) -> Result<Self, LimitError> {
        if Criterion::all(run.problem.half_space()).is_empty() {
            return Err(LimitError::NoStrengths);
        }
        let start = run.loads.iter().copied().find(|load| load.value() > 0.0).ok_or(LimitError::NoLoad)?;
        let mean = run.stress.as_ref().map_or(MeanStress::default(), |request| request.mean);
        let (problem, sampling, settings) = (Arc::clone(&run.problem), run.sampling, run.settings);
        Ok(Self { problem, sampling, settings, mean, start, tolerance: TOLERANCE })
    }

    /// Looks for the limit loads of all criteria, on finer and finer grids where an accuracy is asked for; `heard` hears of
    /// every load that is solved.
    ///
    /// # Errors
    /// [`LimitError`] when there is no such grid.
    pub fn solve(&self, heard: &mut (dyn FnMut(&StepRecord) + Send)) -> Result<Limits, LimitError> {
        match self.sampling {
            Sampling::Points(points) => self.on_grid(points, heard),
            Sampling::Accuracy(accuracy) => {
                let mut refinement = Refinement::new(&self.problem.cell(), accuracy)?;
                let mut coarse: Option<Limits> = None;
                loop {
                    let limits = self.on_grid(refinement.points(), heard)?;
                    let change = coarse.map(|coarse| limits.change(&coarse));
                    if refinement.refine(change, |_| true).is_some() {
                        return Ok(limits);
                    }
                    coarse = Some(limits);
                }
            }
        }
    }

    fn on_grid(
        &self,
        points: [usize; 2],
        heard: &mut (dyn FnMut(&StepRecord) + Send),
    ) -> Result<Limits, LimitError> {
        let solver = Solver::new(Arc::clone(&self.problem), points, self.settings)?;
        let criteria = Criterion::all(self.problem.half_space());
        let samples = points.iter().product::<usize>() as f64;
        let mut search = Search { task: self, samples, solver, steps: Vec::new(), last: None, heard };
        let at_rest: Vec<f64> =
            criteria.iter().map(|criterion| criterion.at_rest(self.problem.half_space())).collect();
        if criteria.iter().zip(&at_rest).any(|(_, rest)| *rest < 1.0) {
            search.enclose(&criteria, &at_rest);
        }
        let limits: Vec<Limit> = criteria
            .iter()
            .zip(&at_rest)
            .map(|(&criterion, &rest)| Limit {
                criterion,
                at: if rest >= 1.0 { At::Rest } else { search.limit(criterion) },
            })
            .collect();
        let Search { mut solver, steps, last, .. } = search;
        let mut limits = Limits { limits, steps, last };
        let first = limits.first().map(Limit::mean_pressure).filter(|pressure| *pressure > 0.0);
        if let Some(pressure) = first {
            limits.last = Some(solver.solve(Load::MeanPressure(pressure)));
        }
        Ok(limits)
    }
}

impl Search<'_> {
    /// Solves a load and keeps what it says.
    fn solve(&mut self, mean_pressure: f64) -> &StepRecord {
        let step = self.solver.solve(Load::MeanPressure(mean_pressure));
        let mut record = StepRecord::new(&step, step.reading());
        if record.reading.max_pressure > 0.0 {
            let field = StressField::new(step.finest(), self.task.mean);
            record.add_stress(StressReading::of(&step, &record.reading, &field), self.task.problem.half_space());
        }
        (self.heard)(&record);
        let place = self.steps.partition_point(|other| other.reading.mean_pressure < mean_pressure);
        self.steps.insert(place, record);
        self.last = Some(step);
        &self.steps[place]
    }

    /// Solves loads until each criterion that is not reached at rest has one load below and one above, or none is left.
    fn enclose(&mut self, criteria: &[Criterion], at_rest: &[f64]) {
        let sought: Vec<Criterion> =
            criteria.iter().zip(at_rest).filter(|(_, rest)| **rest < 1.0).map(|(criterion, _)| *criterion).collect();
        let complete = self.solver.full_contact_pressure();
        let complete = if complete > 0.0 { complete } else { f64::INFINITY };
        let start = match self.task.start {
            Load::MeanPressure(pressure) => pressure,
            penetration @ Load::Penetration(_) => self.solver.solve(penetration).reading().mean_pressure,
        };
        let mut lowest = start.min(complete);
        let mut highest = lowest;
        self.solve(lowest);
        for _ in 0..DOUBLINGS {
            let record = &self.steps[0];
            let samples = record.reading.contact_fraction * self.samples;
            let fails = sought.iter().any(|criterion| utilisation(record, *criterion).value >= 1.0);
            if !fails || samples < LEAST_SAMPLES {
                break;
            }
            lowest *= 0.5;
            self.solve(lowest);
        }
        for _ in 0..DOUBLINGS {
            let holds = |criterion: &Criterion| {
                self.steps.iter().all(|record| utilisation(record, *criterion).value < 1.0)
            };
            if highest >= complete || !sought.iter().any(holds) {
                break;
            }
            highest = (2.0 * highest).min(complete);
            self.solve(highest);
        }
    }

    /// The limit of a criterion that is enclosed, or why it is not.
    fn limit(&mut self, criterion: Criterion) -> At {
        for trial in 0..TRIALS {
            let reached = self.steps.iter().position(|record| utilisation(record, criterion).value >= 1.0);
            let Some(above) = reached else {
                let record = self.steps.last().expect("a load was solved");
                let utilisation = utilisation(record, criterion).value;
                return At::Never { up_to: record.reading.mean_pressure, utilisation };
            };
            let Some(below) = above.checked_sub(1) else {
                return At::Below { mean_pressure: self.steps[0].reading.mean_pressure };
            };
            let ends = [below, above].map(|index| {
                let record = &self.steps[index];
                (record.reading.mean_pressure, utilisation(record, criterion))
            });
            let [(low, under), (high, over)] = ends;
            let slope = (over.value / under.value).ln() / (high / low).ln();
            // The root of the secant in logarithms; an infinite utilisation has none.
            let secant = low * (-under.value.ln() / slope).exp();
            let near = [(low, under), (high, over)].into_iter().min_by(|(_, a), (_, b)| closer(a.value, b.value));
            let (pressure, nearest) = near.expect("two of them");
            let off = (nearest.value.ln() / slope).abs();
            if high / low - 1.0 <= self.task.tolerance || off <= 0.1 * self.task.tolerance {
                let root = if secant.is_finite() { secant.clamp(low, high) } else { pressure };
                let error = nearest.error.map(|error| root * error / (nearest.value * slope));
                return At::Load { mean_pressure: root, error, position: nearest.position };
            }
            // Every third load halves what is enclosed.
            let middle = (low * high).sqrt();
            let next = if trial % 3 == 2 || !(low < secant && secant < high) { middle } else { secant };
            self.solve(next);
        }
        // Bisection has halved it some thirteen times.
        let above = self.steps.iter().find(|record| utilisation(record, criterion).value >= 1.0);
        let record = above.expect("it was enclosed");
        let Utilisation { position, .. } = utilisation(record, criterion);
        At::Load { mean_pressure: record.reading.mean_pressure, error: None, position }
    }
}

/// Which of two utilisations is nearer to one.
fn closer(a: f64, b: f64) -> Ordering {
    a.ln().abs().total_cmp(&b.ln().abs())
}

/// What a step takes up of a criterion; nothing without contact.
fn utilisation(record: &StepRecord, criterion: Criterion) -> Utilisation {
    let found = record.strength.iter().find(|utilisation| utilisation.criterion == criterion);
    found.copied().unwrap_or(Utilisation { criterion, value: 0.0, error: None, position: [0.0; 3] })
}
