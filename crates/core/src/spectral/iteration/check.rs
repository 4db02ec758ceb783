//! Residual and certificate of an iterate, and the criteria of convergence: how the method terminates.

use super::admissible::{LoadSums, WeightedSums, between};
use super::certificate::Certificate;
use super::fields::Unknowns;
use super::problem::ContactProblem;
use crate::load::Control;
use crate::numeric::lanes::{LANES, Real, lowest, splat, total, vectorised};
use crate::numeric::rows::{self, Totals, next};
use crate::numeric::search::largest;
use crate::numeric::sums::{self, BLOCK};
use crate::spectral::by_rows::{ResultRows, rows_of};
use crate::spectral::operator::{ElasticOperator, Surroundings};
use fearless_simd::{f64x8, prelude::*};
use rayon::prelude::*;
use std::sync::Arc;

/// Residual, certificate and energy of an iterate.
#[derive(Debug, Clone, Copy)]
pub(super) struct ConvergenceCheck {
    /// ε = Σ p|g| / (δ Σp), with min(p, H − p) in the place of p where g < 0.
    pub residual: f64,
    /// Bounds on the error of the pressure.
    pub certificate: Certificate,
    /// Elastic energy ½⟨p, Cp⟩ over the number of samples.
    pub energy: f64,
}

/// Sums and least values of a gap over the samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapSums {
    /// Σ p where p < H, and the number of samples where p = H.
    pub load: LoadSums,
    /// Σ p g where p < H.
    pub work: f64,
    /// Σ p|g|, with min(p, H − p) in the place of p where g < 0.
    pub complementarity: f64,
    /// Σ max(−g, 0) where p < H, and Σ max(g, 0) where p = H.
    pub beyond: f64,
    /// Σ max(g, 0) where p = H.
    pub open: f64,
    /// min g.
    pub least: f64,
    /// min g where p < H.
    pub below: f64,
    /// min g where p = 0.
    pub outside: f64,
}

impl GapSums {
    /// Sums of a gap in units of `length`, as lengths.
    pub fn times(self, length: f64) -> Self {
        let Self { load, work, complementarity, beyond, open, least, below, outside } = self;
        Self {
            load,
            work: length * work,
            complementarity: length * complementarity,
            beyond: length * beyond,
            open: length * open,
            least: length * least,
            below: length * below,
            outside: length * outside,
        }
    }
}

impl ConvergenceCheck {
    /// Convergence check of the present pressure of `unknowns`, whose gap, penetration and certificate are set, from one convolution.
    pub fn new<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> Self {
        let (load_control, len) = (problem.load.is_mean_pressure(), problem.initial_gap.len() as f64);
        let bound = problem.admissible.bound();
        let [free, energy, work, unpressed, full, weight, weighted] = displaced_gap(problem, unknowns);
        let load = LoadSums { free, full };
        let (penetration, deviation) = match problem.load {
            Control::MeanPressure(mean) => {
                let deviation = relative((load.total(bound.most) / len - mean).abs(), mean);
                let free = WeightedSums { work, weight, weighted }.mean(load);
                let samples = || problem.admissible.samples(&unknowns.pressure, &unknowns.gap);
                (free.unwrap_or_else(|| between(samples(), bound.most)).max(0.0), deviation)
            }
            Control::Penetration(given) => (given, relative((work - free * given).abs(), free * given)),
        };
        unknowns.penetration = penetration;
        let (p, g) = (&unknowns.pressure[..], Arc::make_mut(&mut unknowns.gap));
        let Totals { sums: [work, complementarity, mut beyond, open], least: [mut least, mut below, mut outside] } =
            rows::row_totals(
                BLOCK,
                (p.par_chunks(BLOCK), g.par_chunks_mut(BLOCK)),
                |_, (p, g)| vectorised!(simd => opened(simd, p, g, penetration, bound.most)),
            );
        if !problem.admissible.is_everywhere() {
            [least, below, outside, beyond] = problem.admissible.least_gaps(p, g);
        }
        let gap = GapSums { load, work, complementarity, beyond, open, least, below, outside };
        let mut check = Self::of(gap, penetration, energy / len, problem);
        check.certificate.load = deviation;
        let has_inverse = problem.operator.surroundings() == Surroundings::Periodic;
        if load_control && unpressed == 0.0 && has_inverse {
            // Without p ≥ 0 the excess is ½⟨g, C⁻¹g⟩, whatever friction adds to C.
            let mut free = g.clone();
            problem.operator.symmetric_pressure(&mut free, &mut problem.working.transforms);
            let [excess] = sums::of(free.len(), |i| [0.5 * g[i] * free[i]]);
            check.certificate.energy_gap = check.certificate.energy_gap.min(relative(excess, energy));
        }
        unknowns.certificate = check.certificate;
        check
    }

    /// Convergence check from the sums of a gap; `energy` is the elastic one over the number of samples.
    pub fn of<O>(gap: GapSums, penetration: f64, energy: f64, problem: &ContactProblem<'_, O>) -> Self {
        let GapSums { load, work, complementarity, beyond, open, least, below, outside } = gap;
        let (most, len) = (problem.admissible.bound().most, problem.initial_gap.len() as f64);
        let gap = match load.full {
            0.0 if problem.load.is_mean_pressure() => work - least * load.free,
            0.0 => work - least.min(0.0) * load.free,
            // θ = 0, or θ = min g where p < H with max(g − θ, 0) ≤ max(g, 0) − θ where p = H.
            _ => {
                let theta = below.min(0.0);
                let least = work - theta * load.free + most * (open - theta * load.full);
                (work + most * beyond).min(least)
            }
        };
        Self {
            // Without any pressure the constraint g ≥ 0 alone decides.
            residual: relative(complementarity, load.total(most) * penetration),
            certificate: Certificate {
                energy_gap: relative(gap, len * energy),
                penetration: relative(-outside, penetration),
                load: 0.0,
            },
            energy,
        }
    }

    /// Whether ε, energy gap and penetration all are below their multiples of the tolerance.
    pub fn converged(&self, tolerance: f64) -> bool {
        self.criteria().iter().all(|&criterion| criterion < tolerance)
    }

    /// Largest of the criteria.
    pub(super) fn measure(&self) -> f64 {
        largest(self.criteria())
    }

    /// Criteria of convergence, each to fall below the tolerance.
    pub(super) fn criteria(&self) -> [f64; 3] {
        let Certificate { energy_gap, penetration, .. } = self.certificate;
        Self::criteria_of([self.residual, energy_gap, penetration])
    }

    /// Criteria of convergence from a residual, an energy gap and a penetration outside contact.
    pub(super) fn criteria_of([residual, energy_gap, penetration]: [f64; 3]) -> [f64; 3] {
        [residual, energy_gap / Certificate::ENERGY_GAP, penetration / Certificate::PENETRATION]
    }
}

/// g ← w + f for the pressure of `unknowns`; Σ p where p < H, ½ Σ p w, Σ p (w + f) where p < H, the number of samples without pressure,
/// that of samples where p = H, Σ p(1 − p/H) and Σ p(1 − p/H)(w + f).
fn displaced_gap<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> [f64; 7] {
    let (p, f, most) = (&unknowns.pressure[..], problem.initial_gap, problem.admissible.bound().most);
    if Arc::get_mut(&mut unknowns.gap).is_none() {
        unknowns.gap = Arc::new(vec![0.0; p.len()]);
    }
    let g = Arc::make_mut(&mut unknowns.gap);
    let uniform = match (problem.load, problem.operator.surroundings()) {
        (Control::MeanPressure(mean), Surroundings::Periodic) => mean,
        _ => 0.0,
    };
    let blocks = problem.operator.blocks();
    let mut totals = blocks.totals();
    let fields = blocks.of(p).zip(blocks.of(f)).zip(blocks.of_mut(g)).zip(&mut totals);
    let rows = fields.map(|(((p, f), g), totals)| {
        let mut rows = p.zip(f).zip(g);
        move |w: &mut [f64]| {
            let ((p, f), g) = next(&mut rows);
            totals.add(vectorised!(simd => deformed(simd, w, [p, f], g, [uniform, most])));
        }
    });
    problem.operator.displaced(&mut problem.working.transforms, rows_of(blocks, p)).rows(rows);
    Totals::of(totals).sums
}

/// Part over scale; 0 where there is no scale: a flat counterbody is in complete contact without any deformation.
fn relative(part: f64, scale: f64) -> f64 {
    if scale <= 0.0 || part <= 0.0 { 0.0 } else { part / scale }
}

/// g ← w + f; the sums of [`displaced_gap`], the energy ½ Σ (p − `uniform`) w. Where ⟨1, w⟩ = 0, a uniform part of p would add nothing
/// but rounding to it.
#[inline(always)]
fn deformed<S: Simd>(
    simd: S,
    w: &[f64],
    [p, f]: [&[f64]; 2],
    g: &mut [f64],
    [uniform, most]: [f64; 2],
) -> Totals<7, 0> {
    let (zero, one, most) = (splat(simd, 0.0), splat(simd, 1.0), splat(simd, most));
    let (mut load, mut energy, mut work, mut unpressed) = (zero, zero, zero, zero);
    let (mut full, mut weight, mut weighted) = (zero, zero, zero);
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        let (displacement, gap) = (f64::group(simd, w, at, 0.0), f64::group(simd, f, at, 0.0));
        let deformed = displacement + gap;
        let below = pressure.simd_lt(most);
        let free = below.select(pressure, zero);
        load += free;
        energy = ((pressure - uniform) * 0.5).mul_add(displacement, energy);
        work = free.mul_add(deformed, work);
        unpressed += pressure.simd_gt(zero).select(zero, one);
        full += below.select(zero, one);
        let own = weight_of(pressure, most);
        weight += own;
        weighted = own.mul_add(deformed, weighted);
        f64::put(deformed, g, at);
    }
    // The padding beyond the end was counted as without pressure.
    let beyond = p.len().next_multiple_of(LANES) - p.len();
    let unpressed = total(unpressed) - beyond as f64;
    let [full, weight, weighted] = [full, weight, weighted].map(total);
    Totals { sums: [total(load), total(energy), total(work), unpressed, full, weight, weighted], least: [] }
}

/// g becomes g − δ; work, complementarity and what is beyond of [`GapSums`], min g, and min g where there is no pressure.
#[inline(always)]
fn opened<S: Simd>(simd: S, p: &[f64], g: &mut [f64], penetration: f64, most: f64) -> Totals<4, 3> {
    let (zero, far, most) = (splat(simd, 0.0), splat(simd, f64::INFINITY), splat(simd, most));
    let (mut work, mut complementarity, mut beyond, mut open) = (zero, zero, zero, zero);
    let (mut least, mut below, mut outside) = (far, far, far);
    for at in (0..p.len()).step_by(LANES) {
        let pressure = Real::group(simd, p, at, 0.0);
        let gap = Real::group(simd, g, at, f64::MAX) - penetration;
        let sums = PointSums::of(simd, pressure, gap, most);
        work = sums.free.mul_add(gap, work);
        complementarity = sums.away.mul_add(gap.abs(), complementarity);
        beyond += sums.beyond;
        open += sums.open;
        least = least.min(gap);
        below = below.min(pressure.simd_lt(most).select(gap, far));
        outside = outside.min(pressure.simd_gt(zero).select(far, gap));
        Real::put(gap, g, at);
    }
    let least = [least, below, outside].map(lowest);
    Totals { sums: [work, complementarity, beyond, open].map(total), least }
}

/// p(1 − p/H) of a group of samples: p without hardness, 0 where p = H.
#[inline(always)]
pub(super) fn weight_of<S: Simd>(pressure: f64x8<S>, most: f64x8<S>) -> f64x8<S> {
    pressure - pressure * (pressure / most)
}

/// What a group of samples adds to the [`GapSums`].
#[derive(Clone, Copy)]
pub(super) struct PointSums<S: Simd> {
    /// p where p < H, else 0.
    pub free: f64x8<S>,
    /// p where g > 0, min(p, H − p) elsewhere: how far p is from where the sign of g puts it.
    pub away: f64x8<S>,
    /// max(−g, 0) where p < H, max(g, 0) where p = H.
    pub beyond: f64x8<S>,
    /// max(g, 0) where p = H, else 0.
    pub open: f64x8<S>,
}

impl<S: Simd> PointSums<S> {
    #[inline(always)]
    pub fn of(simd: S, pressure: f64x8<S>, gap: f64x8<S>, most: f64x8<S>) -> Self {
        let (zero, below) = (splat(simd, 0.0), pressure.simd_lt(most));
        let open = gap.max(zero);
        Self {
            free: below.select(pressure, zero),
            away: gap.simd_gt(zero).select(pressure, pressure.min(most - pressure)),
            beyond: below.select((-gap).max(zero), open),
            open: below.select(zero, open),
        }
    }
}
