//! Residual and certificate of an iterate, and the criteria of convergence: how the method terminates.

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
use fearless_simd::prelude::*;
use rayon::prelude::*;
use std::sync::Arc;

/// Residual, certificate and energy of an iterate.
#[derive(Debug, Clone, Copy)]
pub(super) struct ConvergenceCheck {
    /// ε = Σ p|g| / (δ Σp).
    pub residual: f64,
    /// Bounds on the error of the pressure.
    pub certificate: Certificate,
    /// Elastic energy ½⟨p, Cp⟩ over the number of samples.
    pub energy: f64,
}

/// Sums and least values of a gap over the samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapSums {
    /// Σ p.
    pub load: f64,
    /// Σ p g.
    pub work: f64,
    /// Σ p|g|.
    pub complementarity: f64,
    /// min g.
    pub least: f64,
    /// min g where p = 0.
    pub outside: f64,
}

impl GapSums {
    /// Sums of a gap in units of `length`, as lengths.
    pub fn times(self, length: f64) -> Self {
        let Self { load, work, complementarity, least, outside } = self;
        Self {
            load,
            work: length * work,
            complementarity: length * complementarity,
            least: length * least,
            outside: length * outside,
        }
    }
}

impl ConvergenceCheck {
    /// Convergence check of the present pressure of `unknowns`, whose gap, penetration and certificate are set, from one convolution.
    pub fn new<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> Self {
        let (load_control, len) = (problem.load.is_mean_pressure(), problem.initial_gap.len() as f64);
        let [load, energy, work, open] = displaced_gap(problem, unknowns);
        let (penetration, deviation) = match problem.load {
            Control::MeanPressure(mean) => (relative(work, load), relative((load / len - mean).abs(), mean)),
            Control::Penetration(given) => (given, relative((work - load * given).abs(), load * given)),
        };
        unknowns.penetration = penetration;
        let (p, g) = (&unknowns.pressure[..], Arc::make_mut(&mut unknowns.gap));
        let Totals { sums: [work, complementarity], least: [mut least, mut outside] } = rows::row_totals(
            BLOCK,
            (p.par_chunks(BLOCK), g.par_chunks_mut(BLOCK)),
            |_, (p, g)| vectorised!(simd => opened(simd, p, g, penetration)),
        );
        if !problem.admissible.is_everywhere() {
            [least, outside] = problem.admissible.least_gaps(p, g);
        }
        let gap = GapSums { load, work, complementarity, least, outside };
        let mut check = Self::of(gap, penetration, energy / len, load_control, len);
        check.certificate.load = deviation;
        let has_inverse = problem.operator.surroundings() == Surroundings::Periodic;
        if load_control && open == 0.0 && has_inverse {
            // Without p ≥ 0 the excess is ½⟨g, C⁻¹g⟩, whatever friction adds to C.
            let mut free = g.clone();
            problem.operator.symmetric_pressure(&mut free, &mut problem.working.transforms);
            let [excess] = sums::of(free.len(), |i| [0.5 * g[i] * free[i]]);
            check.certificate.energy_gap = check.certificate.energy_gap.min(relative(excess, energy));
        }
        unknowns.certificate = check.certificate;
        check
    }

    /// Convergence check from the sums of a gap; `energy` is the elastic one over the number of samples `len`.
    pub fn of(gap: GapSums, penetration: f64, energy: f64, load_control: bool, len: f64) -> Self {
        let GapSums { load, work, complementarity, least, outside } = gap;
        let least = if load_control { least } else { least.min(0.0) };
        Self {
            // Without any pressure the constraint g ≥ 0 alone decides.
            residual: relative(complementarity, load * penetration),
            certificate: Certificate {
                energy_gap: relative(work - least * load, len * energy),
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

/// g ← w + f for the pressure of `unknowns`; Σ p, ½ Σ p w, Σ p (w + f) and the number of samples without pressure.
fn displaced_gap<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> [f64; 4] {
    let (p, f) = (&unknowns.pressure[..], problem.initial_gap);
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
            totals.add(vectorised!(simd => deformed(simd, w, p, f, g, uniform)));
        }
    });
    problem.operator.displaced(&mut problem.working.transforms, rows_of(blocks, p)).rows(rows);
    Totals::of(totals).sums
}

/// Part over scale; 0 where there is no scale: a flat counterbody is in complete contact without any deformation.
fn relative(part: f64, scale: f64) -> f64 {
    if scale <= 0.0 || part <= 0.0 { 0.0 } else { part / scale }
}

/// g ← w + f; Σ p, ½ Σ (p − `uniform`) w, Σ p (w + f) and the number of samples without pressure. Where ⟨1, w⟩ = 0, a
/// uniform part of p would add nothing but rounding to the elastic energy.
#[inline(always)]
fn deformed<S: Simd>(simd: S, w: &[f64], p: &[f64], f: &[f64], g: &mut [f64], uniform: f64) -> Totals<4, 0> {
    let zero = splat(simd, 0.0);
    let (mut load, mut energy, mut work, mut open) = (zero, zero, zero, zero);
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        let (displacement, gap) = (f64::group(simd, w, at, 0.0), f64::group(simd, f, at, 0.0));
        let deformed = displacement + gap;
        load += pressure;
        energy = ((pressure - uniform) * 0.5).mul_add(displacement, energy);
        work = pressure.mul_add(deformed, work);
        open += pressure.simd_gt(zero).select(zero, splat(simd, 1.0));
        f64::put(deformed, g, at);
    }
    // The padding beyond the end was counted as open.
    let beyond = p.len().next_multiple_of(LANES) - p.len();
    Totals { sums: [total(load), total(energy), total(work), total(open) - beyond as f64], least: [] }
}

/// g becomes g − δ; Σ p g, Σ p|g|, min g, and min g where there is no pressure.
#[inline(always)]
fn opened<S: Simd>(simd: S, p: &[f64], g: &mut [f64], penetration: f64) -> Totals<2, 2> {
    let (zero, far) = (splat(simd, 0.0), splat(simd, f64::INFINITY));
    let (mut work, mut complementarity, mut least, mut outside) = (zero, zero, far, far);
    for at in (0..p.len()).step_by(LANES) {
        let pressure = Real::group(simd, p, at, 0.0);
        let gap = Real::group(simd, g, at, f64::MAX) - penetration;
        work = pressure.mul_add(gap, work);
        complementarity = pressure.mul_add(gap.abs(), complementarity);
        least = least.min(gap);
        outside = outside.min(pressure.simd_gt(zero).select(far, gap));
        Real::put(gap, g, at);
    }
    Totals { sums: [total(work), total(complementarity)], least: [lowest(least), lowest(outside)] }
}
