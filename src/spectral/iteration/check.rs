//! How an iterate stands: its residual ε and its [`Certificate`], from one convolution.

use super::certificate::Certificate;
use super::problem::GridProblem;
use super::unknowns::Unknowns;
use crate::load::Load;
use crate::numeric::search::largest;
use crate::numeric::sums;

/// Largest energy gap of a converged solution, over the tolerance.
const ENERGY_GAP: f64 = 20.0;
/// Deepest penetration outside contact of a converged solution, over the tolerance.
const PENETRATION: f64 = 10.0;

/// How the iterate stands, from one convolution.
#[derive(Debug, Clone, Copy)]
pub(super) struct Check {
    /// ε = Σ p|g| / (δ Σp).
    pub residual: f64,
    /// What the pressure proves about itself.
    pub certificate: Certificate,
}

impl Check {
    /// Check of the present pressure of `unknowns`, gap and penetration left there.
    pub fn new(problem: &mut GridProblem<'_>, unknowns: &mut Unknowns) -> Self {
        problem.compliance.displacement(&unknowns.pressure, &mut unknowns.gap);
        judge(problem, unknowns)
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
    fn criteria(&self) -> [f64; 3] {
        [self.residual, self.certificate.energy_gap / ENERGY_GAP, self.certificate.penetration / PENETRATION]
    }
}

impl Certificate {
    /// Certificate of `unknowns.pressure`; leaves the fresh gap, penetration and displacement w = C p behind.
    pub(crate) fn new(problem: &mut GridProblem<'_>, unknowns: &mut Unknowns, displacement: &mut [f64]) -> Self {
        problem.compliance.displacement(&unknowns.pressure, displacement);
        unknowns.gap.copy_from_slice(displacement);
        judge(problem, unknowns).certificate
    }
}

/// How `unknowns.pressure` stands, whose displacement w = C p is in `unknowns.gap`; leaves gap and penetration there.
pub(super) fn judge(problem: &mut GridProblem<'_>, unknowns: &mut Unknowns) -> Check {
    // A flat counterbody is in complete contact without any deformation: nothing to be relative to.
    let relative = |part: f64, scale: f64| if scale <= 0.0 || part <= 0.0 { 0.0 } else { part / scale };
    let (f, load_control) = (problem.initial_gap, problem.load.is_mean_pressure());
    let Unknowns { pressure: p, gap, image, .. } = unknowns;
    let (w, len) = (&*gap, f.len());
    // ⟨1, w⟩ = 0, so that a uniform part of p adds nothing but rounding to the elastic energy.
    let uniform = if let Load::MeanPressure(mean) = problem.load { mean } else { 0.0 };
    let [load, energy, work, open] = sums::of(len, |i| {
        [p[i], 0.5 * (p[i] - uniform) * w[i], p[i] * (w[i] + f[i]), if p[i] > 0.0 { 0.0 } else { 1.0 }]
    });
    let (penetration, deviation) = match problem.load {
        Load::MeanPressure(mean) => (relative(work, load), relative((load / len as f64 - mean).abs(), mean)),
        Load::Penetration(given) => (given, relative((work - load * given).abs(), load * given)),
    };
    unknowns.penetration = penetration;
    sums::update(gap, |i, w| w + f[i] - penetration);
    let g = &*gap;
    let outside = sums::least(len, |i| if p[i] > 0.0 { 0.0 } else { g[i] });
    let least = sums::least(len, |i| g[i]);
    let least = if load_control { least } else { least.min(0.0) };
    let [mut excess, complementarity] = sums::of(len, |i| [p[i] * (g[i] - least), p[i] * g[i].abs()]);
    if load_control && open == 0.0 {
        problem.compliance.precondition(g, image);
        let [free] = sums::of(len, |i| [0.5 * g[i] * image[i]]);
        excess = excess.min(free);
    }
    Check {
        // Without any pressure the constraint g ≥ 0 alone decides.
        residual: relative(complementarity, load * penetration),
        certificate: Certificate {
            energy_gap: relative(excess, energy),
            penetration: relative(-outside, penetration),
            load: deviation,
        },
    }
}
