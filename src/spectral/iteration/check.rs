//! How an iterate stands: its residual ε and its [`Certificate`], from one convolution.

use super::certificate::Certificate;
use super::problem::GridProblem;
use super::unknowns::Unknowns;
use crate::load::Load;
use crate::numeric::lanes::{LANES, Real, lowest, splat, total, vectorised};
use crate::numeric::rows::{self, Totals, next};
use crate::numeric::search::largest;
use crate::numeric::sums::{self, BLOCK};
use crate::spectral::convolution::rows_of;
use fearless_simd::prelude::*;
use rayon::prelude::*;
use std::sync::Arc;

/// How the iterate stands, from one convolution.
#[derive(Debug, Clone, Copy)]
pub(super) struct Check {
    /// ε = Σ p|g| / (δ Σp).
    pub residual: f64,
    /// What the pressure proves about itself.
    pub certificate: Certificate,
    /// Elastic energy ½⟨p, Cp⟩ over the number of samples.
    pub energy: f64,
}

/// What a gap adds up to over the samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct Residuals {
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

impl Residuals {
    /// With gaps in units of `length`.
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

impl Check {
    /// Check of the present pressure of `unknowns`, gap and penetration left there.
    pub fn new(problem: &mut GridProblem<'_>, unknowns: &mut Unknowns) -> Self {
        let (p, f, load_control) = (&unknowns.pressure[..], problem.initial_gap, problem.load.is_mean_pressure());
        if Arc::get_mut(&mut unknowns.gap).is_none() {
            unknowns.gap = Arc::new(vec![0.0; p.len()]);
        }
        let g = Arc::make_mut(&mut unknowns.gap);
        let (len, mean) = (p.len() as f64, if let Load::MeanPressure(mean) = problem.load { mean } else { 0.0 });
        let parts = problem.operator.parts();
        let mut totals = parts.totals();
        let fields = parts.of(p).zip(parts.of(f)).zip(parts.of_mut(g)).zip(&mut totals);
        let rows = fields.map(|(((p, f), g), totals)| {
            let mut rows = p.zip(f).zip(g);
            move |w: &mut [f64]| {
                let ((p, f), g) = next(&mut rows);
                totals.add(vectorised!(simd => deformed(simd, w, p, f, g, mean)));
            }
        });
        problem.operator.displaced(&mut problem.working.transforms, rows_of(parts, p)).rows(rows);
        let [load, energy, work, open] = Totals::of(totals).sums;
        let (penetration, deviation) = match problem.load {
            Load::MeanPressure(mean) => (relative(work, load), relative((load / len - mean).abs(), mean)),
            Load::Penetration(given) => (given, relative((work - load * given).abs(), load * given)),
        };
        unknowns.penetration = penetration;
        let Totals { sums: [work, complementarity], least: [least, outside] } = rows::sweep(
            BLOCK,
            (p.par_chunks(BLOCK), g.par_chunks_mut(BLOCK)),
            |_, (p, g)| vectorised!(simd => opened(simd, p, g, penetration)),
        );
        let residuals = Residuals { load, work, complementarity, least, outside };
        let mut check = Self::of(residuals, penetration, energy / len, load_control, len);
        check.certificate.load = deviation;
        if load_control && open == 0.0 {
            // Without p ≥ 0 the excess is ½⟨g, C⁻¹g⟩, whatever friction adds to C.
            let mut free = g.clone();
            problem.operator.frictionless_pressure(&mut free, &mut problem.working.transforms);
            let [excess] = sums::of(free.len(), |i| [0.5 * g[i] * free[i]]);
            check.certificate.energy_gap = check.certificate.energy_gap.min(relative(excess, energy));
        }
        unknowns.certificate = check.certificate;
        check
    }

    /// How a gap stands whose residuals are given; `energy` is the elastic one over the number of samples `len`.
    pub fn of(residuals: Residuals, penetration: f64, energy: f64, load_control: bool, len: f64) -> Self {
        let Residuals { load, work, complementarity, least, outside } = residuals;
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

    /// One number that falls as the criteria do.
    pub(super) fn measure(&self) -> f64 {
        largest(self.criteria())
    }

    /// What must fall below the tolerance.
    pub(super) fn criteria(&self) -> [f64; 3] {
        let Certificate { energy_gap, penetration, .. } = self.certificate;
        Self::criteria_of([self.residual, energy_gap, penetration])
    }

    /// What must fall below the tolerance, of a residual, an energy gap and a penetration outside contact.
    pub(super) fn criteria_of([residual, energy_gap, penetration]: [f64; 3]) -> [f64; 3] {
        [residual, energy_gap / Certificate::ENERGY_GAP, penetration / Certificate::PENETRATION]
    }
}

/// A flat counterbody is in complete contact without any deformation: nothing to be relative to.
fn relative(part: f64, scale: f64) -> f64 {
    if scale <= 0.0 || part <= 0.0 { 0.0 } else { part / scale }
}

/// g ← w + f; Σ p, ½ Σ (p − `uniform`) w, Σ p (w + f) and the number of samples without pressure. As ⟨1, w⟩ = 0, a
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
    // What lies beyond the end counts as open.
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
