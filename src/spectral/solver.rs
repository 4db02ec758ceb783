//! A problem on its nested grids: each load step is solved from the coarsest grid up, each solution starting the next
//! finer one.
//!
//! Between load steps every grid keeps its pressure. A finer grid starts from its own last pressure plus the
//! interpolated **change** of the next coarser one, so that what a step leaves alone is never interpolated twice. The
//! baseline method works on the finest grid alone, as published.

use super::fourier::fast_points;
use super::iteration::{Certificate, Compliance, GridProblem, Method, Progress, Report, Settings, Stop, Unknowns};
use super::operator::Operator;
use super::{Contact, Step};
use crate::body::TransferFunction;
use crate::counterbody::Surface;
use crate::lattice::{Grid, Interpolation, LatticeError, resample};
use crate::load::Load;
use crate::numeric::array::field;
use crate::numeric::sums;
use crate::problem::Problem;
use std::fmt;
use std::sync::Arc;

/// No grid has fewer points along a vector, unless the finest one has.
const COARSEST: usize = 24;

/// Coarser grids that a step keeps beside the finest, for the errors of what is read off it.
const KEPT: usize = 2;

/// Samples of a contact that is no wider than the spacing: an apex between samples may press the four around it with any
/// load from zero on.
const UNRESOLVED: usize = 4;

/// A contact problem on its nested grids, with all it needs from load to load.
#[derive(Debug)]
pub struct Solver {
    problem: Arc<Problem>,
    settings: Settings,
    /// From the finest to the coarsest.
    nests: Vec<Nest>,
}

#[derive(Debug)]
struct Nest {
    surface: Arc<Surface>,
    operator: Operator,
    unknowns: Unknowns,
}

impl Solver {
    /// Grids of `points` = [N₁, N₂] and their coarser companions for a problem.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn new(problem: impl Into<Arc<Problem>>, points: [usize; 2], settings: Settings) -> Result<Self, LatticeError> {
        let problem = problem.into();
        let transfer = TransferFunction::new(problem.half_space());
        let nest = |points| -> Result<Nest, LatticeError> {
            let surface = Surface::new(problem.counterbody(), points)?;
            let (operator, unknowns) = (Operator::new(surface.grid(), &transfer), Unknowns::new(surface.grid().len()));
            Ok(Nest { surface: Arc::new(surface), operator, unknowns })
        };
        let nests = nested_points(points, settings.method).into_iter().map(nest).collect::<Result<_, _>>()?;
        Ok(Self { problem, settings, nests })
    }

    /// What is pressed into what.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The finest grid.
    pub fn grid(&self) -> &Arc<Grid> {
        self.surface().grid()
    }

    /// The counterbody's surface on the finest grid.
    pub fn surface(&self) -> &Arc<Surface> {
        &self.nests[0].surface
    }

    /// Penetration at which contact becomes complete: the mean of the initial gap on the finest grid, a length.
    pub fn full_contact_penetration(&self) -> f64 {
        self.surface().mean()
    }

    /// Least mean pressure of complete contact on the finest grid: max of C⁻¹(f − mean f).
    ///
    /// It grows with the grid for shapes with ridges, whose complete contact takes an infinite pressure.
    pub fn full_contact_pressure(&mut self) -> f64 {
        let Nest { surface, operator, .. } = &mut self.nests[0];
        let mean = surface.mean();
        let deviation: Vec<f64> = surface.gaps().iter().map(|f| f - mean).collect();
        let mut pressure = vec![0.0; deviation.len()];
        operator.precondition(&deviation, &mut pressure);
        -sums::least(pressure.len(), |i| -pressure[i])
    }

    /// Solves the next load, starting from the last one.
    pub fn solve(&mut self, load: Load) -> Step {
        self.solve_with_progress(load, &mut |_| ())
    }

    /// The same; `progress` hears of the iterations on the finest grid.
    pub fn solve_with_progress(&mut self, load: Load, progress: &mut dyn FnMut(Progress)) -> Step {
        let finest = self.grid().len() as f64;
        let coarsest = self.nests.len() - 1;
        let mut convolutions = 0.0;
        let mut change: Option<([usize; 2], Vec<f64>)> = None;
        // A coarser grid may be beyond complete contact where the finest is not: it has no part in the step, and keeps
        // its pressure for the next.
        let mut left_out = Vec::new();
        for index in (1..=coarsest).rev() {
            let nest = &mut self.nests[index];
            let before = nest.unknowns.pressure.clone();
            let (report, work) = nest.solve(change.take(), load, self.settings, &mut |_| ());
            convolutions += work / finest;
            if report.stop == Stop::BeyondFullContact {
                left_out.push((index, before));
                continue;
            }
            let mut rise = before;
            sums::update(&mut rise, |i, p| nest.unknowns.pressure[i] - p);
            change = Some((nest.points(), rise));
        }
        let nest = &mut self.nests[0];
        let (mut report, work) = nest.solve(change, load, self.settings, progress);
        if report.stop == Stop::Converged && !load.is_mean_pressure() && !nest.is_resolved() {
            report.stop = Stop::Unresolved;
        }
        let mut displacement = vec![0.0; nest.surface.grid().len()];
        let certificate = nest.certificate(load, self.settings, &mut displacement);
        let kept = |nest: &Nest| nest.contact(&self.problem);
        let part = |(index, _): &(usize, &Nest)| left_out.iter().all(|(out, _)| out != index);
        let coarser = (1..).zip(&self.nests[1..]).take(KEPT).take_while(part);
        let step = Step {
            load,
            report,
            certificate,
            convolutions: convolutions + work / finest + 1.0,
            finest: kept(&self.nests[0]),
            displacement: field(self.nests[0].points(), displacement),
            coarser: coarser.map(|(_, nest)| kept(nest)).collect(),
        };
        for (index, before) in left_out {
            self.nests[index].unknowns.pressure = before;
        }
        if !report.stop.solved() {
            // A spoilt solution is no start for the next step.
            self.nests.iter_mut().for_each(|nest| nest.unknowns.pressure.fill(0.0));
        }
        step
    }
}

impl Nest {
    fn points(&self) -> [usize; 2] {
        self.surface.grid().points()
    }

    /// The last step on this grid, kept.
    fn contact(&self, problem: &Arc<Problem>) -> Contact {
        let Unknowns { pressure, gap, penetration, .. } = &self.unknowns;
        Contact::new(problem, &self.surface, pressure.clone(), gap.clone(), *penetration)
    }

    /// Whether contact is wider than the grid's spacing, on the average of the indenters that touch.
    fn is_resolved(&self) -> bool {
        let (owners, pressure) = (self.surface.owners(), &self.unknowns.pressure);
        let (mut pressed, mut indenters) = (0, vec![false; self.surface.sites().len().max(1)]);
        for index in (0..pressure.len()).filter(|&i| pressure[i] > 0.0) {
            pressed += 1;
            indenters[owners.get(index).map_or(0, |&site| site as usize)] = true;
        }
        pressed > UNRESOLVED * indenters.into_iter().filter(|&touches| touches).count()
    }

    /// What the present pressure proves about itself; its displacement is left behind.
    fn certificate(&mut self, load: Load, settings: Settings, displacement: &mut [f64]) -> Certificate {
        let Self { surface, operator, unknowns } = self;
        let progress = &mut |_| ();
        let mut problem = GridProblem { compliance: operator, initial_gap: surface.gaps(), load, settings, progress };
        Certificate::new(&mut problem, unknowns, displacement)
    }

    /// Solves on this grid after adding the `change` of the next coarser one; also gives convolutions times samples.
    fn solve(
        &mut self,
        change: Option<([usize; 2], Vec<f64>)>,
        load: Load,
        settings: Settings,
        progress: &mut dyn FnMut(Progress),
    ) -> (Report, f64) {
        let Self { surface, operator, unknowns } = self;
        let grid = surface.grid();
        if let Some((from, change)) = change {
            let rise = resample(&change, from, grid.points(), Interpolation::on(grid.cell()));
            // A change below the tolerance is none: it would leave traces of pressure around the contact, which no
            // iteration takes away again where none is needed.
            let highest = -sums::least(rise.len(), |i| -unknowns.pressure[i]);
            let least = settings.tolerance * highest;
            sums::update(&mut unknowns.pressure, |i, p| if rise[i].abs() > least { p + rise[i] } else { p });
        }
        let before = operator.convolutions();
        let compliance: &mut Operator = operator;
        let report = GridProblem { compliance, initial_gap: surface.gaps(), load, settings, progress }.solve(unknowns);
        (report, (operator.convolutions() - before) as f64 * grid.len() as f64)
    }
}

/// Peak of the memory that solving and reading on a finest grid of `points` takes, bytes.
///
/// Per sample of each grid: the solver's 5 fields and 1 flag, the initial gap and its owner, 2 multipliers and 2 spectra
/// of half the components; of the finest grid also the step's 3 fields, one for interpolation, what the step keeps of
/// coarser grids, and what passes from grid to grid. Per row and column of each grid: what its transforms need.
pub fn memory(points: [usize; 2], method: Method) -> usize {
    let (iteration, surface, operator) = (5 * 8 + 1, 8 + 4, 2 * 4 + 2 * 8);
    let (step, rows) = (4 * 8, 2048);
    // Changes from grid to grid, and two fields of grids with a quarter and a sixteenth of the samples.
    let passing = if method == Method::Preconditioned { 5 * 8 + 4 + 5 } else { 0 };
    let of_grid = |[n1, n2]: [usize; 2]| n1 * n2 * (iteration + surface + operator) + (n1 + n2) * rows;
    let nested: usize = nested_points(points, method).into_iter().map(of_grid).sum();
    nested + points[0] * points[1] * (step + passing)
}

impl fmt::Display for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let grids: Vec<String> = self.nests.iter().map(|nest| nest.points()[0].to_string()).collect();
        write!(f, "{}\nnested grids: {} points along a₁", self.grid(), grids.join(", "))
    }
}

/// Points of the nested grids, the finest first. The baseline has one grid.
fn nested_points(finest: [usize; 2], method: Method) -> Vec<[usize; 2]> {
    let coarser = |points: &[usize; 2]| {
        let halved = points.map(|n| fast_points(n.div_ceil(2)));
        (method == Method::Preconditioned && halved.iter().all(|&n| n >= COARSEST)).then_some(halved)
    };
    std::iter::successors(Some(finest), coarser).collect()
}
