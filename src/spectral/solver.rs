//! A problem on its nested grids: each load step is solved from the coarsest grid up, each solution starting the next
//! finer one.
//!
//! Between load steps every grid keeps its pressure. A finer grid starts from its own last pressure plus the **change** of
//! the next coarser one, carried over, so that what a step leaves alone is never interpolated twice. The baseline method
//! works on the finest grid alone, as published.

use super::iteration::{GridProblem, Method, Progress, Report, Settings, Stop, Unknowns, Working};
use super::operator::{Operator, Workspace};
use super::prolongation::prolonged;
use super::{Contact, Step};
use crate::body::TransferFunction;
use crate::counterbody::Surface;
use crate::lattice::{Grid, LatticeError};
use crate::load::Load;
use crate::numeric::fourier::fast_points;
use crate::numeric::sums;
use crate::problem::Problem;
use std::fmt;
use std::ops::ControlFlow;
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
    largest_gap: f64,
    operator: Operator,
    unknowns: Unknowns,
    /// E* of the material at the surface.
    modulus: f64,
}

/// The next coarser grid before and after its part of a load step.
struct Coarser {
    grid: Arc<Grid>,
    before: Unknowns,
    after: Unknowns,
}

impl Solver {
    /// Grids of `points` = [N₁, N₂] and their coarser companions for a problem.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn new(problem: impl Into<Arc<Problem>>, points: [usize; 2], settings: Settings) -> Result<Self, LatticeError> {
        let problem = problem.into();
        let transfer = TransferFunction::new(problem.half_space());
        let modulus = problem.half_space().surface_material().contact_modulus();
        let nest = |surface: Surface| {
            let operator = match problem.friction() {
                Some(friction) => Operator::sliding(surface.grid(), &transfer, friction),
                None => Operator::new(surface.grid(), &transfer),
            };
            let unknowns = Unknowns::new(surface.grid().len());
            let largest_gap = surface.largest();
            Nest { surface: Arc::new(surface), largest_gap, operator, unknowns, modulus }
        };
        let mut nests: Vec<Nest> = Vec::new();
        for points in nested_points(points, settings.method) {
            let counterbody = problem.counterbody();
            let surface = match nests.last() {
                None => Surface::new(counterbody, points)?,
                Some(finer) => finer.surface.coarser(counterbody, points)?,
            };
            nests.push(nest(surface));
        }
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

    /// Least mean pressure of complete contact on the finest grid: that of the pressure which displaces the surface by
    /// mean f − f.
    ///
    /// It grows with the grid for shapes with ridges, whose complete contact takes an infinite pressure.
    pub fn full_contact_pressure(&mut self) -> f64 {
        let Nest { surface, operator, .. } = &mut self.nests[0];
        let mean = surface.mean();
        let mut pressure: Vec<f64> = surface.gaps().iter().map(|f| f - mean).collect();
        operator.pressure(&mut pressure, &mut Workspace::default());
        -sums::least(pressure.len(), |i| -pressure[i])
    }

    /// Solves the next load, starting from the last one.
    pub fn solve(&mut self, load: Load) -> Step {
        self.solve_with_progress(load, &mut |_| ControlFlow::Continue(()))
    }

    /// The same; `progress` hears of the iterations on the finest grid, and ends the step, as
    /// [interrupted](Stop::Interrupted), when it wants no more of them.
    pub fn solve_with_progress(
        &mut self,
        load: Load,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> Step {
        // Everything on the threads that share the work: none waits outside for each sweep to be done.
        rayon::scope(|_| self.solve_here(load, progress))
    }

    fn solve_here(&mut self, load: Load, progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send)) -> Step {
        let finest = self.grid().len() as f64;
        let mut convolutions = 0.0;
        let mut coarser = None;
        // A coarser grid may be beyond complete contact where the finest is not: it has no part in the step, and keeps
        // its pressure for the next.
        let mut left_out = Vec::new();
        // What every grid works on in turn; others may have the memory between load steps.
        let Self { nests, settings, .. } = self;
        let mut working = match settings.method {
            Method::Preconditioned => Working::of_finest(&nests[0].operator),
            Method::PolonskyKeer => Working::default(),
        };
        for (index, nest) in nests.iter_mut().enumerate().skip(1).rev() {
            let before = nest.unknowns.clone();
            let (report, work) =
                nest.solve(coarser.take(), load, *settings, &mut working, &mut |_| ControlFlow::Continue(()));
            convolutions += work / finest;
            if report.stop == Stop::BeyondFullContact {
                left_out.push((index, before));
                continue;
            }
            coarser = Some(Coarser { grid: Arc::clone(nest.surface.grid()), before, after: nest.unknowns.clone() });
        }
        let (mut report, work) = nests[0].solve(coarser, load, *settings, &mut working, progress);
        drop(working);
        if matches!(report.stop, Stop::Converged | Stop::Rounding)
            && !load.is_mean_pressure()
            && !nests[0].is_resolved()
        {
            report.stop = Stop::Unresolved;
        }
        let part = |index: &usize| left_out.iter().all(|(out, _)| out != index);
        let coarser = (1..nests.len()).take(KEPT).take_while(part).count();
        let step = self.step(load, report, convolutions + work / finest, coarser);
        for (index, before) in left_out {
            self.nests[index].unknowns = before;
        }
        if !report.stop.solved() {
            self.forget();
        }
        step
    }

    /// The step that its grids have just solved, with the contact on so many `coarser` ones.
    pub(super) fn step(&self, load: Load, report: Report, convolutions: f64, coarser: usize) -> Step {
        let contact = |nest: &Nest| nest.contact(&self.problem);
        let (finest, coarser) = (contact(&self.nests[0]), self.nests[1..=coarser].iter().map(contact).collect());
        let certificate = self.nests[0].unknowns.certificate;
        Step { load, report, certificate, convolutions, finest, coarser }
    }

    /// Forgets what it has found: a spoilt solution is no start for the next step.
    pub(super) fn forget(&mut self) {
        self.nests.iter_mut().for_each(|nest| nest.unknowns = Unknowns::new(nest.surface.grid().len()));
    }

    /// What each grid has found, the finest first.
    pub(super) fn unknowns(&self) -> impl Iterator<Item = &Unknowns> {
        self.nests.iter().map(|nest| &nest.unknowns)
    }

    /// Gives each grid what it is to have found, the finest first.
    pub(super) fn adopt(&mut self, unknowns: Vec<Unknowns>) {
        self.nests.iter_mut().zip(unknowns).for_each(|(nest, unknowns)| nest.unknowns = unknowns);
    }
}

impl Nest {
    fn points(&self) -> [usize; 2] {
        self.surface.grid().points()
    }

    /// The last step on this grid, shared.
    fn contact(&self, problem: &Arc<Problem>) -> Contact {
        let Unknowns { pressure, gap, penetration, .. } = &self.unknowns;
        Contact::new(problem, &self.surface, Arc::clone(pressure), Arc::clone(gap), *penetration)
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

    /// Solves on this grid after adding the change of the next `coarser` one; also gives convolutions times samples.
    fn solve(
        &mut self,
        coarser: Option<Coarser>,
        load: Load,
        settings: Settings,
        working: &mut Working,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> (Report, f64) {
        if let Some(coarser) = coarser {
            self.follow(&coarser, settings.tolerance);
        }
        let Self { surface, largest_gap, operator, unknowns, .. } = self;
        let (samples, before) = (surface.grid().len(), operator.convolutions());
        let (initial_gap, largest_gap) = (surface.gaps(), *largest_gap);
        let report = GridProblem { operator, working, initial_gap, largest_gap, load, settings, outer: 0, progress }
            .solve(unknowns);
        (report, (operator.convolutions() - before) * samples as f64)
    }

    /// Adds to the pressure what the next `coarser` grid's has changed by.
    fn follow(&mut self, coarser: &Coarser, tolerance: f64) {
        let points = self.points();
        let carried =
            |Unknowns { pressure, gap, .. }: &Unknowns| prolonged(&coarser.grid, pressure, gap, self.modulus, points);
        let after = carried(&coarser.after);
        if coarser.before.pressure.iter().all(|&p| p == 0.0) {
            self.unknowns.pressure = Arc::new(after);
            return;
        }
        let before = carried(&coarser.before);
        // A change below the tolerance is none: it would leave traces of pressure around the contact, which no
        // iteration takes away again where none is needed.
        let least = -tolerance * sums::least(after.len(), |i| -after[i]);
        let pressure = Arc::make_mut(&mut self.unknowns.pressure);
        sums::update(pressure, |i, p| {
            let rise = after[i] - before[i];
            if rise.abs() > least { (p + rise).max(0.0) } else { p }
        });
    }
}

/// Memory of a solver, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// What its grids keep from load to load.
    pub kept: usize,
    /// What solving a load takes besides, by the method that begins.
    pub working: usize,
}

impl Memory {
    /// On a finest grid of `points`.
    ///
    /// Per sample of each grid: pressure, gap, initial gap and its owner, the multiplier (half the components). Per row
    /// and column of each grid: what its transforms need. In turn, per sample of the finest grid: three fields of single
    /// precision and a spectrum in double precision; for the baseline two fields in double precision and the spectrum.
    /// Coupled friction adds a second multiplier.
    pub fn of(points: [usize; 2], method: Method, coupled: bool) -> Self {
        let (grid, rows) = (3 * 8 + 4 + 4 + 4 * usize::from(coupled), 512);
        let working = match method {
            Method::Preconditioned => 3 * 4 + 8,
            Method::PolonskyKeer => 3 * 8,
        };
        let of_grid = |[n1, n2]: [usize; 2]| n1 * n2 * grid + (n1 + n2) * rows;
        let kept = nested_points(points, method).into_iter().map(of_grid).sum();
        Self { kept, working: points[0] * points[1] * working }
    }
}

impl fmt::Display for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let grids: Vec<String> = self.nests.iter().map(|nest| nest.points()[0].to_string()).collect();
        write!(f, "{}\nnested grids: {} points along a₁", self.grid(), grids.join(", "))
    }
}

/// Points of the nested grids, the finest first. The baseline has one grid.
pub(super) fn nested_points(finest: [usize; 2], method: Method) -> Vec<[usize; 2]> {
    let coarser = |points: &[usize; 2]| {
        let halved = points.map(|n| fast_points(n.div_ceil(2)));
        (method == Method::Preconditioned && halved.iter().all(|&n| n >= COARSEST)).then_some(halved)
    };
    std::iter::successors(Some(finest), coarser).collect()
}
