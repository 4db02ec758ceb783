//! Lines 3 to 5 of the method, and line 1 by changes: iterations in single precision from one gap in double precision to the
//! next.

use super::check::ConvergenceCheck;
use super::direction;
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
/// Gap, over the unit of lengths, of samples where contact may not occur: no displacement closes it.
const FAR: f64 = 1e30;

/// Continuation of the residual beyond the active set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Continuation {
    /// By a fading mean (E): fewer iterations.
    Fading,
    /// By zero: C⁻¹ on the active set itself.
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
    /// None: the first step is next.
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
    /// Σ p and Σ p g after it, the gap with the old δ.
    sums: [f64; 2],
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
        let active = update::gap_from(&unknowns.pressure, &unknowns.gap, length / share, gap, residual);
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
        let (blocks, unit, load) = (self.blocks, self.pressure, problem.load);
        let operator = &mut *problem.operator;
        let Fields { gap, direction, image, weight: step, memory, .. } = problem.working.of(operator, double);
        for backtracks in 0..=MAX_BACKTRACKS {
            let advance = update::advance(p, [gap, direction, image], -tau, unit, step);
            if backtracks == 0 && !advance.clipped {
                // C d = −τ C t.
                return Some(TakenStep { restart: false, factor: -tau, sums: [advance.load, advance.work] });
            }
            let Some(scale) = scale_to_mean(load, advance.load, p.len()) else {
                update::retreat(p, step, unit);
                return None;
            };
            if scale != 1.0 {
                update::rescale(p, scale, unit, step);
            }
            let mut sums = blocks.totals();
            let displaced = operator.displaced_single(self.variant.traction, memory, rows_of(blocks, step));
            displaced.rows(update::after_step(blocks, p, [gap, step], image, &mut sums));
            let [curvature, load, work] = Totals::of(sums).sums;
            // ⟨g, p⟩ = 0 under load control: the scale adds nothing to the slope.
            let slope = scale * advance.slope;
            let (uphill, part) = (slope >= 0.0, -slope / curvature);
            if curvature.is_finite() && (is_first || slope + 0.5 * curvature <= 0.0) {
                return Some(TakenStep { restart: false, factor: 1.0, sums: [load, work] });
            }
            let is_last = backtracks == MAX_BACKTRACKS;
            if is_last && !uphill && part.is_finite() {
                update::retreat(p, step, (1.0 - part) * unit);
                let sums = update::load_and_work(p, gap, (image, part));
                return Some(TakenStep { restart: false, factor: part, sums });
            }
            update::retreat(p, step, unit);
            if uphill && beta > 0.0 {
                let sums = update::load_and_work(p, gap, (image, 0.0));
                return Some(TakenStep { restart: true, factor: 0.0, sums });
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
        let load_control = problem.load.is_mean_pressure();
        problem.working.keep_residual();
        let Fields { gap, residual, image, .. } = problem.working.of(problem.operator, double);
        let [load, work] = step.sums;
        let shift = if load_control { work / load } else { 0.0 };
        self.penetration += shift * self.length;
        let (active, sums) = update::update_gap(p, load, (image, step.factor), shift, gap, residual);
        self.active = active;
        self.check = ConvergenceCheck::of(
            sums.times(self.length),
            self.penetration,
            self.check.energy,
            load_control,
            p.len() as f64,
        );
    }
}

/// Factor that restores the mean of a pressure whose sum is `load`; `None` where nothing is left of it.
fn scale_to_mean(prescribed: Control, load: f64, samples: usize) -> Option<f64> {
    match prescribed {
        Control::MeanPressure(mean) => (load > 0.0).then(|| mean * samples as f64 / load),
        Control::Penetration(_) => Some(1.0),
    }
}
