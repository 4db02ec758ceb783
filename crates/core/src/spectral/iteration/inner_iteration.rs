//! Lines 3 to 5 of the method, and line 1 by changes: iterations in single precision from one gap in double precision to the
//! next.

use super::bounds::Bounds;
use super::check::ConvergenceCheck;
use super::direction;
use super::duality::{LoadSums, WeightedSums};
use super::fields::{Fields, Unknowns};
use super::problem::ContactProblem;
use super::update::{self, ActiveSet};
use crate::load::Control;
use crate::numeric::rows::{RowBlocks, Totals};
use crate::spectral::by_rows::{ResultRows, rows_of, rows_to};
use crate::spectral::extension;
use crate::spectral::operator::{ElasticOperator, TractionUpdate};
use std::sync::Arc;

/// Shorter steps that are tried after one that raises the energy, before the step ends at the minimum along it.
pub(super) const MAX_BACKTRACKS: usize = 2;
/// Range of the part of a step that the next shorter one has.
pub(super) const MIN_BACKTRACK: f64 = 0.25;
pub(super) const MAX_BACKTRACK: f64 = 0.5;
/// Most trials of the shift that restores a load, and its largest relative deviation: single precision holds no less.
const MAX_SHIFTS: usize = 40;
const SHIFT_TOLERANCE: f64 = 1e-9;
/// Gap, over the unit of lengths, of samples where contact may not occur: no displacement closes it.
const FAR: f64 = 1e30;

/// Continuation of the residual beyond the active set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Continuation {
    /// Continuation by a fading mean (E): fewer iterations.
    Fading,
    /// Continuation by zero: C⁻¹ on the active set itself.
    Zero,
}

/// Variant of the method.
#[derive(Debug, Clone, Copy)]
pub(super) struct Variant {
    pub continuation: Continuation,
    pub traction: TractionUpdate,
}

/// The iteration before, as the next direction needs it.
#[derive(Debug)]
pub(super) struct LastDirection {
    /// ⟨r′, z′⟩; 0 for a new start.
    norm: f64,
    /// Mean of r′ on I′.
    mean: f64,
    /// Whether the next step is the first one, which may raise the energy.
    is_first: bool,
}

impl LastDirection {
    /// No iteration before: the first step is next.
    pub const NONE: Self = Self { norm: 0.0, mean: 0.0, is_first: true };
}

/// A direction t.
#[derive(Debug, Clone, Copy)]
struct Direction {
    /// ⟨r, z⟩.
    norm: f64,
    beta: f64,
    /// Step to the minimum along it, without p ≥ 0.
    tau: f64,
}

/// A step that was taken.
#[derive(Debug, Clone, Copy)]
struct TakenStep {
    /// Whether the next direction has to start anew.
    restart: bool,
    /// Change of the gap over the field in `image`.
    factor: f64,
    /// Sums of p, and those with g after it, the gap with the old δ.
    load: LoadSums,
    work: WeightedSums,
}

/// Iterations in single precision from one gap in double precision to the next.
#[derive(Debug)]
pub(super) struct InnerIteration {
    blocks: RowBlocks,
    variant: Variant,
    /// Unit of the working fields: the largest f.
    length: f64,
    /// Unit of the steps: the pressure that displaces by it at the least wavenumber.
    pressure: f64,
    active: ActiveSet,
    penetration: f64,
    /// Convergence check of the pressure by the gap in single precision.
    pub check: ConvergenceCheck,
}

impl InnerIteration {
    /// Init: from a `share` of the gap of the `check`.
    pub fn new<O: ElasticOperator>(
        problem: &mut ContactProblem<'_, O>,
        unknowns: &mut Unknowns,
        check: ConvergenceCheck,
        share: f64,
        variant: Variant,
    ) -> Self {
        let length = problem.length();
        if !problem.admissible.is_everywhere() {
            problem.admissible.open(&mut Arc::make_mut(&mut unknowns.gap)[..], FAR * length);
        }
        let (gap, residual) = problem.working.gap_and_residual(problem.operator);
        let bounds = problem.admissible.bounds();
        let active = update::gap_from(&unknowns.pressure, &unknowns.gap, (length / share, bounds), gap, residual);
        let (blocks, pressure) = (problem.operator.blocks(), length / problem.operator.unit());
        Self { blocks, variant, length, pressure, active, penetration: unknowns.penetration, check }
    }

    /// One iteration; false where no step can be found.
    pub fn step<O: ElasticOperator>(
        &mut self,
        problem: &mut ContactProblem<'_, O>,
        unknowns: &mut Unknowns,
        last: &mut LastDirection,
    ) -> bool {
        let (p, double) = (Arc::make_mut(&mut unknowns.pressure), Arc::make_mut(&mut unknowns.gap));
        let Some(direction) = self.direction(problem, double, last) else { return false };
        let Some(step) = self.advance(problem, p, double, direction, last.is_first) else { return false };
        let norm = if step.restart { 0.0 } else { direction.norm };
        *last = LastDirection { norm, mean: self.mean(problem.load), is_first: false };
        self.update_gap(problem, p, double, step);
        true
    }

    /// Mean that r is freed of.
    fn mean(&self, load: Control) -> f64 {
        if load.is_mean_pressure() { self.active.mean() } else { 0.0 }
    }

    /// z = M r, t = z + βt and C t, which is left in `image`.
    fn direction<O: ElasticOperator>(
        &self,
        problem: &mut ContactProblem<'_, O>,
        double: &mut [f64],
        last: &LastDirection,
    ) -> Option<Direction> {
        let (blocks, mean, load_control) = (self.blocks, self.mean(problem.load), problem.load.is_mean_pressure());
        let operator = &mut *problem.operator;
        let mut fields = problem.working.of(operator, double);
        self.precondition(operator, &mut fields, mean);
        let Fields { residual, previous, direction, image, weight, memory, .. } = fields;
        let weight = (self.variant.continuation == Continuation::Fading).then_some(&*weight);
        let overlaps = direction::overlap(blocks, [residual, previous, direction], weight, image);
        let z_mean = if load_control { overlaps.sum / self.active.size } else { 0.0 };
        let norm = overlaps.with_residual - mean * overlaps.sum;
        let overlap = overlaps.with_previous(last.mean, z_mean);
        let beta = if last.norm > 0.0 { ((norm - overlap) / last.norm).max(0.0) } else { 0.0 };
        // The last direction on I is freed of its mean too, or the load would drift.
        let t_mean = if load_control && beta > 0.0 { overlaps.direction / self.active.size } else { 0.0 };
        let [mut descent, mut curvature] = [(); 2].map(|()| blocks.totals());
        let t = direction::conjugate(blocks, [residual, image], z_mean + beta * t_mean, beta, direction, &mut descent);
        let displaced = operator.displaced_single(self.variant.traction, memory, t);
        displaced.rows(direction::curvature(blocks, direction, image, &mut curvature));
        let ([descent], [curvature]) = (Totals::of(descent).sums, Totals::of(curvature).sums);
        let tau = descent / curvature;
        (tau.is_finite() && curvature > 0.0).then_some(Direction { norm, beta, tau })
    }

    /// C⁻¹ E (r − mean) in `image`, and in `weight` what Eᵀ gathers of it.
    fn precondition<O: ElasticOperator>(&self, operator: &mut O, fields: &mut Fields<'_>, mean: f64) {
        let (blocks, mean) = (self.blocks, mean as f32);
        let Fields { residual, image, weight, memory, .. } = fields;
        match self.variant.continuation {
            Continuation::Fading => {
                let mut reached = vec![false; blocks.points()[0]];
                let extended = extension::extended(blocks, residual, mean, weight, &mut reached);
                let convolved = operator.preconditioned(memory, extended);
                convolved.some_rows(|row| reached[row], extension::gathered(blocks, image, weight));
            }
            Continuation::Zero => {
                let centred = direction::centred(blocks, residual, mean);
                operator.preconditioned(memory, centred).rows(rows_to(blocks, image));
            }
        }
    }

    /// p + d with C t or C d in `image`; the first step may raise the energy.
    fn advance<O: ElasticOperator>(
        &self,
        problem: &mut ContactProblem<'_, O>,
        p: &mut [f64],
        double: &mut [f64],
        Direction { beta, mut tau, .. }: Direction,
        is_first: bool,
    ) -> Option<TakenStep> {
        let (blocks, unit, bounds) = (self.blocks, self.pressure, problem.admissible.bounds());
        let prescribed = problem.load;
        let operator = &mut *problem.operator;
        let Fields { gap, direction, image, weight: step, residual, memory, .. } = problem.working.of(operator, double);
        for backtracks in 0..=MAX_BACKTRACKS {
            let along = [&*gap, &*direction, &*image, &*residual];
            let mut advance = update::advance(p, along, [-tau, 0.0, unit], bounds, step);
            if backtracks == 0 && !advance.clipped {
                // C d = −τ C t.
                return Some(TakenStep { restart: false, factor: -tau, load: advance.load, work: advance.work });
            }
            let total = match prescribed {
                Control::MeanPressure(mean) => Some(mean * p.len() as f64),
                Control::Penetration(_) => None,
            };
            let mut is_full = advance.load.full > 0.0;
            if let Some(total) = total.filter(|_| !is_full) {
                if advance.load.free <= 0.0 {
                    update::retreat(p, step, unit, bounds);
                    return None;
                }
                let scale = total / advance.load.free;
                is_full = scale != 1.0 && update::rescale(p, scale, unit, bounds, step);
                // ⟨g, p⟩ = 0 under load control: the scale adds nothing to the slope.
                advance.slope *= scale;
            }
            if let Some(total) = total.filter(|_| is_full) {
                // A shift of the active set restores the load where pressures are H.
                update::retreat(p, step, unit, bounds);
                let shift = shift_to(total, p, [direction, residual], [-tau, unit], bounds);
                advance = update::advance(p, along, [-tau, shift, unit], bounds, step);
            }
            let mut sums = blocks.totals();
            let displaced = operator.displaced_single(self.variant.traction, memory, rows_of(blocks, step));
            displaced.rows(update::after_step(blocks, (p, bounds), [gap, step], image, &mut sums));
            let [curvature, free, full, work, weight, weighted] = Totals::of(sums).sums;
            let slope = advance.slope;
            let (load, work) = (LoadSums { free, full }, WeightedSums { work, weight, weighted });
            let (uphill, part) = (slope >= 0.0, -slope / curvature);
            if curvature.is_finite() && (is_first || slope + 0.5 * curvature <= 0.0) {
                return Some(TakenStep { restart: false, factor: 1.0, load, work });
            }
            let is_last = backtracks == MAX_BACKTRACKS;
            if is_last && !uphill && part.is_finite() {
                update::retreat(p, step, (1.0 - part) * unit, bounds);
                let (load, work) = update::load_and_work((p, bounds), gap, (image, part));
                return Some(TakenStep { restart: false, factor: part, load, work });
            }
            update::retreat(p, step, unit, bounds);
            if uphill && beta > 0.0 {
                let (load, work) = update::load_and_work((p, bounds), gap, (image, 0.0));
                return Some(TakenStep { restart: true, factor: 0.0, load, work });
            }
            if !curvature.is_finite() {
                return None;
            }
            tau *= part.clamp(MIN_BACKTRACK, MAX_BACKTRACK);
        }
        None
    }

    /// The new gap and δ, residual and active set, and their check.
    fn update_gap<O: ElasticOperator>(
        &mut self,
        problem: &mut ContactProblem<'_, O>,
        p: &[f64],
        double: &mut [f64],
        step: TakenStep,
    ) {
        let bounds = problem.admissible.bounds();
        problem.working.keep_residual();
        let Fields { gap, residual, image, .. } = problem.working.of(problem.operator, double);
        let samples = || {
            let gaps =
                gap.iter().zip(&*image).map(|(gap, change)| f64::from(*change).mul_add(step.factor, f64::from(*gap)));
            p.iter().copied().zip(gaps)
        };
        let shift = match problem.load {
            Control::MeanPressure(_) => step.work.mean(step.load).unwrap_or_else(|| bounds.between(samples())),
            Control::Penetration(_) => 0.0,
        };
        self.penetration += shift * self.length;
        let (active, sums) = update::update_gap(p, step.load, (image, step.factor), (shift, bounds), gap, residual);
        self.active = active;
        self.check = ConvergenceCheck::of(sums.times(self.length), self.penetration, self.check.energy, problem);
    }
}

/// The shift λ of the active set, in units of pressure, that gives the pressure after a step the sum `total`: Σ min(max(p − τt + λ, 0), H)
/// rises with λ, by one for each sample that it moves (Newton's method, kept between bounds of the root).
fn shift_to(
    total: f64,
    p: &[f64],
    [direction, residual]: [&[f32]; 2],
    [factor, unit]: [f64; 2],
    bounds: Bounds,
) -> f64 {
    let [mut low, mut high] = [f64::NEG_INFINITY, f64::INFINITY];
    let mut shift = 0.0;
    for _ in 0..MAX_SHIFTS {
        let [load, moves] = update::shifted_load(p, [direction, residual], [factor, shift, unit], bounds);
        let missing = total - load;
        if missing.abs() <= SHIFT_TOLERANCE * total {
            break;
        }
        if missing > 0.0 {
            low = shift
        } else {
            high = shift
        };
        // A step as large as H reaches some samples where none moves.
        let step = if moves > 0.0 { missing / moves } else { missing.signum() * bounds.largest() };
        let next = shift + step / unit;
        let middle = 0.5 * (low + high);
        shift = match low < next && next < high {
            true => next,
            false if middle.is_finite() => middle,
            // The missing load is less than the shift resolves.
            false => break,
        };
    }
    shift
}
