//! Residual and certificate of an iterate, and the criteria of convergence: how the method terminates.

use super::bounds::Bounds;
use super::certificate::Certificate;
use super::duality::{GapLanes, GapSums, LoadLanes, LoadSums, WeightedSums};
use super::fields::Unknowns;
use super::problem::ContactProblem;
use crate::lattice::Surroundings;
use crate::load::Control;
use crate::numeric::lanes::{LANES, Real, splat, total, vectorised};
use crate::numeric::rows::{self, Totals, next};
use crate::numeric::search::largest;
use crate::numeric::sums::{self, BLOCK};
use crate::spectral::by_rows::{ResultRows, rows_of};
use crate::spectral::operator::ElasticOperator;
use fearless_simd::prelude::*;
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

impl ConvergenceCheck {
    /// Convergence check of the present pressure of `unknowns`, whose gap, penetration and certificate are set, from one convolution.
    pub fn new<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> Self {
        let (load_control, len) = (problem.load.is_mean_pressure(), problem.initial_gap.len() as f64);
        let bounds = problem.admissible.bounds();
        let [free, energy, work, unpressed, full, weight, weighted] = displaced_gap(problem, unknowns);
        let load = LoadSums { free, full };
        let (penetration, deviation) = match problem.load {
            Control::MeanPressure(mean) => {
                let deviation = relative((load.total(bounds) / len - mean).abs(), mean);
                let free = WeightedSums { work, weight, weighted }.mean(load);
                let samples = || problem.admissible.samples(&unknowns.pressure, &unknowns.gap);
                (free.unwrap_or_else(|| bounds.between(samples())).max(0.0), deviation)
            }
            Control::Penetration(given) => (given, relative((work - free * given).abs(), free * given)),
        };
        unknowns.penetration = penetration;
        let (p, g) = (&unknowns.pressure[..], Arc::make_mut(&mut unknowns.gap));
        let fields = (p.par_chunks(BLOCK), g.par_chunks_mut(BLOCK));
        let totals =
            rows::row_totals(BLOCK, fields, |_, (p, g)| vectorised!(simd => opened(simd, p, g, penetration, bounds)));
        let mut gap = GapSums::of(load, totals);
        if !problem.admissible.is_everywhere() {
            [gap.least, gap.below, gap.outside, gap.beyond] = problem.admissible.least_gaps(p, g);
        }
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
        let (bounds, len) = (problem.admissible.bounds(), problem.initial_gap.len() as f64);
        let energy_gap = gap.energy_gap(bounds, problem.load.is_mean_pressure());
        Self {
            // Without any pressure the constraint g ≥ 0 alone decides.
            residual: relative(gap.complementarity, gap.load.total(bounds) * penetration),
            certificate: Certificate {
                energy_gap: relative(energy_gap, len * energy),
                penetration: relative(-gap.outside, penetration),
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
    let (p, f, bounds) = (&unknowns.pressure[..], problem.initial_gap, problem.admissible.bounds());
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
            totals.add(vectorised!(simd => deformed(simd, w, [p, f], g, (uniform, bounds))));
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
    (uniform, bounds): (f64, Bounds),
) -> Totals<7, 0> {
    let (zero, bounds) = (splat(simd, 0.0), bounds.lanes(simd));
    let (mut energy, mut unpressed, mut load) = (zero, zero, LoadLanes::new(simd, bounds));
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        let (displacement, gap) = (f64::group(simd, w, at, 0.0), f64::group(simd, f, at, 0.0));
        let deformed = displacement + gap;
        load.add(bounds.parts(pressure), pressure, deformed);
        energy = ((pressure - uniform) * 0.5).mul_add(displacement, energy);
        unpressed += bounds.unpressed(pressure);
        f64::put(deformed, g, at);
    }
    // The padding beyond the end was counted as without pressure.
    let beyond = p.len().next_multiple_of(LANES) - p.len();
    let [free, full, work, weight, weighted] = load.totals();
    let unpressed = total(unpressed) - beyond as f64;
    Totals { sums: [free, total(energy), work, unpressed, full, weight, weighted], least: [] }
}

/// g becomes g − δ; the sums and least values of [`GapSums`].
#[inline(always)]
fn opened<S: Simd>(simd: S, p: &[f64], g: &mut [f64], penetration: f64, bounds: Bounds) -> Totals<4, 3> {
    let mut sums = GapLanes::new(simd, bounds.lanes(simd));
    for at in (0..p.len()).step_by(LANES) {
        let pressure = Real::group(simd, p, at, 0.0);
        let gap = Real::group(simd, g, at, f64::MAX) - penetration;
        sums.add(pressure, gap);
        Real::put(gap, g, at);
    }
    sums.totals()
}
