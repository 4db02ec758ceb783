//! A problem on its nested grids: each load step is solved from the coarsest grid up, each solution is the start on the next
//! finer one.
//!
//! Between load steps every grid keeps its pressure. A finer grid starts from its own last pressure plus the **change** of
//! the next coarser one, carried over, so that nothing unchanged by a step is interpolated twice. The baseline method
//! works on the finest grid alone, as published.

use super::body_operator::OperatorMemory;
use super::frictional_heat::FrictionalHeat;
use super::grid_level::{Coarser, GridLevel};
use super::iteration::{Method, Progress, Report, Settings, Stop, Unknowns, Working};
use super::worn::Worn;
use super::{Contact, FieldError, HeatStep, Step, Tangent};
use crate::counterbody::Surface;
use crate::friction::Friction;
use crate::lattice::{Cell, Grid, LatticeError};
use crate::load::Load;
use crate::numeric::array::field;
use crate::numeric::fourier::fast_points;
use crate::numeric::sums;
use crate::problem::Problem;
use ndarray::Array2;
use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Fewest points of a coarser grid along a lattice vector.
pub(crate) const MIN_POINTS: usize = 24;

/// Coarser grids that a step keeps beside the finest, for the errors of its readings.
const COARSER_KEPT: usize = 2;

/// Most turns of a contact and the partition of its heat, and the change of the swelling over the penetration at which they end.
const HEAT_TURNS: usize = 40;
/// Turns after which the samples in which heat is shared are held: one that touches in every other turn keeps all others from settling.
const FREE_TURNS: usize = 16;
const HEAT_TOLERANCE: f64 = 1e-8;

/// Weights of the changes of a contact stiffness from the coarser grids, the next coarser first, and that of the samples that join at a time
/// on coated bodies: read off 250 random contacts, see `tests/library/stated_errors.rs`.
const STIFFNESS_WEIGHTS: [f64; COARSER_KEPT] = [0.75, 0.2];
const JOINING_WEIGHT: f64 = 2.0;

/// A contact problem on its nested grids, with the pressures that it keeps from load to load.
#[derive(Debug)]
pub struct Solver {
    problem: Arc<Problem>,
    settings: Settings,
    /// Levels from the finest grid to the coarsest.
    pub(super) levels: Vec<GridLevel>,
    /// Depths that sliding has worn off; `None` before any wear.
    pub(super) worn: Option<Worn>,
    /// Frictional heat on the finest grid and the next coarser one; none where nothing heats.
    heats: Vec<FrictionalHeat>,
}

impl Solver {
    /// Grids of `points` = [N₁, N₂] and their coarser companions for a problem.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn new(problem: impl Into<Arc<Problem>>, points: [usize; 2], settings: Settings) -> Result<Self, LatticeError> {
        let problem = problem.into();
        let mut levels: Vec<GridLevel> = Vec::new();
        let loaded_by = problem.loaded_by();
        for points in nested_points(points, settings.method, loaded_by.line()) {
            let surface = match levels.last() {
                None => loaded_by.surface(points)?,
                Some(finer) => loaded_by.coarser_surface(finer.surface(), points)?,
            };
            let share = FrictionalHeat::first_share(&problem, surface.grid().least_wavenumber());
            levels.push(GridLevel::new(&problem, surface, share));
        }
        let heated = levels.iter().take(2).map_while(|level| FrictionalHeat::new(&problem, level.surface().grid()));
        let heats = heated.collect();
        Ok(Self { problem, settings, levels, worn: None, heats })
    }

    /// Solver with a given initial gap in the place of that of the counterbody: of a worn or deformed surface, or between two
    /// rough ones. Pressures of earlier loads are dropped.
    ///
    /// `gap` holds lengths f ≥ 0, one per sample of the finest grid, axes along a₁ and a₂. The penetration is measured from
    /// f = 0: from first touch, where the least f is 0. Coarser grids receive every k-th sample where they have a whole fraction of
    /// the points, else the waves that they hold, as for a [`Topography`](crate::Topography). The samples of each indenter
    /// stay those of the counterbody.
    ///
    /// # Errors
    /// [`FieldError`] for another shape, and for a value that is negative or not finite.
    pub fn with_gap(mut self, gap: Array2<f64>) -> Result<Self, FieldError> {
        self.set_gap(gap)?;
        Ok(self)
    }

    /// Gives the solver another initial gap, as [`Self::with_gap`].
    ///
    /// # Errors
    /// [`FieldError`] as for [`Self::with_gap`].
    pub fn set_gap(&mut self, mut gap: Array2<f64>) -> Result<(), FieldError> {
        self.grid().check(gap.dim().into())?;
        if let Some((index, &value)) = gap.indexed_iter().find(|(_, gap)| !(gap.is_finite() && **gap >= 0.0)) {
            return Err(FieldError::Gap { sample: index.into(), value });
        }
        for level in &mut self.levels {
            gap = level.give_gap(gap);
        }
        self.worn = None;
        Ok(())
    }

    /// Solver with contact on a part of the cell alone; elsewhere there is no pressure, and the gap may become
    /// negative. Pressures of earlier loads are dropped.
    ///
    /// `mask` says where contact may occur, one value per sample of the finest grid, axes along a₁ and a₂. A sample of a
    /// coarser grid has the value of the nearest sample of the finest one. With a mask no penetration counts as beyond
    /// complete contact.
    ///
    /// # Errors
    /// [`FieldError`] for another shape, and for a mask that leaves no sample.
    pub fn with_mask(mut self, mask: Array2<bool>) -> Result<Self, FieldError> {
        self.grid().check(mask.dim().into())?;
        if !mask.iter().any(|&admissible| admissible) {
            return Err(FieldError::EmptyMask);
        }
        for level in &mut self.levels {
            level.give_mask(&mask);
        }
        // A grid too coarse for the mask, and those below it, take no part.
        let count = self.levels.iter().take_while(|level| level.has_admissible()).count();
        self.levels.truncate(count);
        Ok(self)
    }

    /// The problem.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The finest grid.
    pub fn grid(&self) -> &Arc<Grid> {
        self.surface().grid()
    }

    /// The counterbody's surface on the finest grid.
    pub fn surface(&self) -> &Arc<Surface> {
        self.levels[0].surface()
    }

    /// Least penetration of complete contact, a length: the mean of the initial gap on the finest grid, and on a rigid base the mean
    /// displacement under the [pressure](Self::full_contact_pressure) of complete contact.
    pub fn full_contact_penetration(&mut self) -> f64 {
        let mean_compliance = self.problem.bodies().mean_compliance();
        let compression = if mean_compliance > 0.0 { mean_compliance * self.full_contact_pressure() } else { 0.0 };
        self.surface().mean() + compression
    }

    /// Least mean pressure of complete contact on the finest grid: that of the pressure which displaces the surface by
    /// mean f − f.
    ///
    /// The pressure grows with the grid for shapes with ridges, whose complete contact takes an infinite pressure.
    pub fn full_contact_pressure(&mut self) -> f64 {
        self.levels[0].full_contact_pressure()
    }

    /// Solves the next load, starting from the last one.
    pub fn solve(&mut self, load: Load) -> Step {
        self.solve_with_progress(load, &mut |_| ControlFlow::Continue(()))
    }

    /// Solves the next load, starting from the last one. Calls `progress` after each iteration on the finest grid; `Break` ends
    /// the step as [interrupted](Stop::Interrupted).
    pub fn solve_with_progress(
        &mut self,
        load: Load,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> Step {
        // Everything on the threads that share the work, where no pass has to wake them.
        rayon::scope(|_| match self.heats.first().is_some_and(FrictionalHeat::lifts) {
            true => self.solve_heated(load, progress),
            false => self.solve_on_levels(load, progress),
        })
    }

    /// Solves a load on the finest grid alone, from its last pressure, with the gap opened by `lift`, lengths sample by sample: displacements
    /// that the pressure does not cause.
    pub(super) fn solve_lifted(&mut self, load: Load, lift: &[f64]) -> Step {
        let level = &mut self.levels[0];
        let (surface, indented) = (Arc::clone(level.surface()), level.indented().cloned());
        level.set_surface(Arc::new(surface.opened(lift)), indented.clone());
        let mut working = level.working_memory();
        let progress = &mut |_: Progress| ControlFlow::Continue(());
        let settings = self.settings;
        let (report, work) = rayon::scope(|_| level.solve(None, load, settings, &mut working, progress));
        level.set_surface(surface, indented);
        let samples = level.surface().grid().len() as f64;
        self.step(load, report, work / samples, 0)
    }

    /// Solves a load with the swelling by heat whose share differs from place to place: in turns of the contact and the partition.
    fn solve_heated(&mut self, load: Load, progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send)) -> Step {
        let originals: Vec<Arc<Surface>> = self.levels.iter().map(|level| Arc::clone(level.surface())).collect();
        let points = self.grid().points();
        let share = FrictionalHeat::first_share(&self.problem, self.grid().least_wavenumber());
        let (mut before, mut step) = (vec![0.0; self.grid().len()], self.solve_on_levels(load, progress));
        let mut is_settled = false;
        for turn in 0..HEAT_TURNS {
            if !step.report.stop.solved() {
                break;
            }
            if turn == FREE_TURNS {
                self.heats[0].hold(Some(step.finest.pressures()));
            }
            // Each step has the heat of its contact.
            let Some(heat) = step.finest.heat() else { break };
            let lift = self.heats[0].lift(heat, share);
            let change = -sums::least(lift.len(), |i| -(lift[i] - before[i]).abs());
            if change <= HEAT_TOLERANCE * step.penetration().abs() {
                is_settled = true;
                break;
            }
            let mut finer = field(points, lift.clone());
            for (level, original) in self.levels.iter_mut().zip(&originals) {
                finer = level.lift(original, &finer);
            }
            before = lift;
            let convolutions = step.convolutions;
            step = self.solve_on_levels(load, progress);
            step.convolutions += convolutions;
        }
        self.heats[0].hold(None);
        for (level, original) in self.levels.iter_mut().zip(originals) {
            level.set_surface(original, None);
        }
        if !step.report.stop.solved() {
            return step;
        }
        let stop = if is_settled { step.report.stop } else { Stop::Stalled };
        self.step(load, Report { stop, ..step.report }, step.convolutions, step.coarser.len())
    }

    fn solve_on_levels(&mut self, load: Load, progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send)) -> Step {
        let finest = self.grid().len() as f64;
        let mut convolutions = 0.0;
        let mut coarser = None;
        // A coarser grid may be beyond complete contact where the finest is not: it has no part in the step, and keeps
        // its pressure for the next.
        let mut left_out = Vec::new();
        // Memory for all grids in turn, freed between load steps.
        let Self { levels, settings, .. } = self;
        let mut working = match settings.method {
            Method::Preconditioned => levels[0].working_memory(),
            Method::PolonskyKeer => Working::default(),
        };
        for (index, level) in levels.iter_mut().enumerate().skip(1).rev() {
            let before = level.unknowns().clone();
            let (report, work) =
                level.solve(coarser.take(), load, *settings, &mut working, &mut |_| ControlFlow::Continue(()));
            convolutions += work / finest;
            if matches!(report.stop, Stop::BeyondFullContact | Stop::BeyondHardness) {
                left_out.push((index, before));
                continue;
            }
            coarser =
                Some(Coarser { grid: Arc::clone(level.surface().grid()), before, after: level.unknowns().clone() });
        }
        let (mut report, work) = levels[0].solve(coarser, load, *settings, &mut working, progress);
        drop(working);
        if matches!(report.stop, Stop::Converged | Stop::Rounding)
            && !load.is_load_control()
            && !levels[0].is_resolved()
        {
            report.stop = Stop::Unresolved;
        }
        if report.stop.solved() && levels[0].reaches_border() {
            report.stop = Stop::AtBorder;
        }
        let part = |index: &usize| left_out.iter().all(|(out, _)| out != index);
        let coarser = (1..levels.len()).take(COARSER_KEPT).take_while(part).count();
        let step = self.step(load, report, convolutions + work / finest, coarser);
        for (index, before) in left_out {
            self.levels[index].set_unknowns(before);
        }
        if !report.stop.solved() {
            self.forget();
        }
        step
    }

    /// The step just solved, with the contact on the next `coarser` grids.
    pub(super) fn step(&mut self, load: Load, report: Report, convolutions: f64, coarser: usize) -> Step {
        let contact = |level: &GridLevel| level.contact(&self.problem);
        let (mut finest, mut coarser) =
            (contact(&self.levels[0]), self.levels[1..=coarser].iter().map(contact).collect::<Vec<_>>());
        let contacts = std::iter::once(&mut finest).chain(&mut coarser);
        let mut grids = Vec::new();
        for (heat, contact) in self.heats.iter_mut().zip(contacts) {
            let found = heat.under(contact.pressures());
            grids.push(heat.hottest(contact.grid(), &found));
            *contact = contact.clone().with_heat(found);
        }
        let left = self.left_by_heat();
        let heat = (!grids.is_empty()).then_some(HeatStep { grids, left });
        let motion = self.problem.motion().and_then(|_| self.levels[0].motion_loss(&finest, &coarser));
        let certificate = self.levels[0].unknowns().certificate;
        Step { load, report, certificate, convolutions, motion, heat, finest, coarser }
    }

    /// Least part of the compliance of a wave that swelling by frictional heat leaves, 1 without heat: no steady state is unique from 0 down.
    ///
    /// A given pressure stays as it is.
    pub fn left_by_heat(&self) -> f64 {
        if self.problem.given_pressure().is_some() { 1.0 } else { self.levels[0].left_by_heat() }
    }

    /// Keeps what the last load has pressed in, where its pressure is that of the hardness: the depths −g are in the initial gap of the
    /// next loads, which unload and reload elastically up to this load. Without it each load meets the surface as it was before.
    ///
    /// Every grid keeps its depths: what differs from grid to grid is an error of the loads that follow, too.
    ///
    /// A body that is softer and [slid over](Problem::is_swept) moves away below the counterbody: it keeps no shape in the frame of the
    /// contact.
    pub fn keep_indentation(&mut self) {
        if self.problem.is_swept() {
            return;
        }
        let depths: Option<Vec<Vec<f64>>> =
            self.levels.iter().map(|level| level.contact(&self.problem).indentation()).collect();
        if let Some(depths) = depths.filter(|all| all.iter().flatten().any(|&depth| depth > 0.0)) {
            self.press_in(depths.into_iter().map(Arc::new).collect());
        }
    }

    /// Depths that earlier loads have pressed in for good, lengths sample by sample of the finest grid; `None` without any.
    pub fn indented(&self) -> Option<&[f64]> {
        self.levels[0].indented().map(|(_, depths)| &depths[..])
    }

    /// Presses the surface in by these depths, those of the finest grid first, in the place of those before.
    pub(super) fn press_in(&mut self, depths: Vec<Arc<Vec<f64>>>) {
        self.levels.iter_mut().zip(depths).for_each(|(level, depths)| level.press_in(depths));
    }

    /// Depths that earlier loads have pressed in on all grids, the finest first; none where nothing is.
    pub(super) fn depths(&self) -> Vec<Arc<Vec<f64>>> {
        self.levels.iter().filter_map(|level| level.indented().map(|(_, depths)| Arc::clone(depths))).collect()
    }

    /// The tangent of the load that was solved last; `None` without contact, and under friction that couples.
    pub fn tangent(&mut self) -> Option<Tangent> {
        if self.problem.friction().is_some_and(Friction::couples) {
            return None;
        }
        rayon::scope(|_| self.levels[0].tangent(&self.problem))
    }

    /// Contact stiffness S = ∂P/∂δ of the `step` that was solved last and its estimated error, forces per length; `None` as for the
    /// [tangent](Self::tangent). The error is that by which S steps where samples join the contact, or by which it changes from the coarser
    /// grids.
    pub fn stiffness(&mut self, step: &Step) -> Option<[f64; 2]> {
        let tangent = self.tangent()?;
        let levels = self.levels.iter_mut().skip(1).zip(step.coarser()).zip(STIFFNESS_WEIGHTS);
        let change = |((level, contact), weight): ((&mut GridLevel, &Contact), f64)| {
            let coarse = level.tangent_of(contact)?;
            Some(weight * (coarse.stiffness() - tangent.stiffness()).abs())
        };
        // On a bare half-space S grows as the root of the area in contact, on soft layers that keep their volume up to its square.
        let weight = if self.problem.bodies().is_bare() { 1.0 } else { JOINING_WEIGHT };
        let error = rayon::scope(|_| levels.filter_map(change).fold(weight * tangent.stiffness_error(), f64::max));
        Some([tangent.stiffness(), error])
    }

    /// Drops all pressures: those of a failed step are no start for the next one.
    pub(super) fn forget(&mut self) {
        self.levels.iter_mut().for_each(GridLevel::forget);
    }

    /// Unknowns of all grids, the finest first.
    pub(super) fn unknowns(&self) -> impl Iterator<Item = &Unknowns> {
        self.levels.iter().map(GridLevel::unknowns)
    }

    /// Sets the unknowns of all grids, the finest first.
    pub(super) fn set_unknowns(&mut self, unknowns: Vec<Unknowns>) {
        self.levels.iter_mut().zip(unknowns).for_each(|(level, unknowns)| level.set_unknowns(unknowns));
    }
}

/// Memory of a solver, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// Memory that its grids keep from load to load.
    pub kept: usize,
    /// Further memory while it is set up, or a load is solved by the method that begins.
    pub working: usize,
}

impl Memory {
    /// Memory of a solver whose finest grid has `points` on a cell.
    ///
    /// Per sample of each grid: pressure, gap, initial gap and its owner, the multiplier (half the components). Per row
    /// and column of each grid: the plans of its transforms. In turn, per sample of the finest grid: three fields of single
    /// precision and a spectrum in double precision; for the baseline two fields in double precision and the spectrum.
    /// Coupled friction adds a second multiplier. An isolated contact has the transforms of its kernel, a spectrum twice as wide,
    /// and three tables while the kernel is made.
    pub fn of(cell: Cell, points: [usize; 2], method: Method, coupled: bool) -> Self {
        let OperatorMemory { multipliers, spectrum, setup } = OperatorMemory::of(cell, points, coupled);
        let (grid, rows) = (3 * 8 + 4 + multipliers, 512);
        let working = match method {
            Method::Preconditioned => 3 * 4 + spectrum,
            Method::PolonskyKeer => 2 * 8 + spectrum,
        };
        let of_grid = |[n1, n2]: [usize; 2]| n1 * n2 * grid + (n1 + n2) * rows;
        // A surface may be constant along either axis.
        let grids = [None, Some(0), Some(1)].map(|line| nested_points(points, method, line));
        let kept = grids.map(|grids| grids.into_iter().map(of_grid).sum()).into_iter().max().unwrap_or(0);
        Self { kept, working: setup.max(points[0] * points[1] * working) }
    }
}

impl fmt::Display for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let grids: Vec<String> = self.levels.iter().map(|level| level.points()[0].to_string()).collect();
        write!(f, "{}\nnested grids: {} points along a₁", self.grid(), grids.join(", "))
    }
}

/// Points of the nested grids, the finest first. The baseline has one grid. Along the axis `line`, on which nothing depends, few points are
/// kept: nothing is lost on them.
pub(super) fn nested_points(finest: [usize; 2], method: Method, line: Option<usize>) -> Vec<[usize; 2]> {
    let coarser = |points: &[usize; 2]| {
        let halved = |axis: usize| {
            let n = fast_points(points[axis].div_ceil(2));
            if line == Some(axis) && n < MIN_POINTS { points[axis] } else { n }
        };
        let halved = [0, 1].map(halved);
        let is_held = |axis: usize| line == Some(axis) || halved[axis] >= MIN_POINTS;
        (method == Method::Preconditioned && [0, 1].into_iter().all(is_held)).then_some(halved)
    };
    std::iter::successors(Some(finest), coarser).collect()
}
