//! Conjugate gradients preconditioned with C⁻¹ on the active set.
//!
//! On I = {p > 0} ∪ {g < 0} the direction is t = z + βt with z = P_I F⁻¹C⁻¹F P_I g (Polak–Ribière β ≥ 0; a restart
//! where I has grown). Under load control g and z are freed of their mean on I first, so that the load stays: the
//! preconditioner is then symmetric on the admissible directions. Step τ = ⟨g,t⟩/⟨t,Ct⟩, p ← max(p − τt, 0), and p is
//! scaled back to its mean. C⁻¹ makes the spectrum of the iteration nearly independent of the grid.

use super::check::Check;
use super::problem::GridProblem;
use super::report::{Progress, Report, Route, Stop};
use super::stopping::Patience;
use super::unknowns::Unknowns;
use crate::numeric::sums;

/// First window of the patience, iterations.
const PATIENCE: usize = 30;

/// Iterates from and into `unknowns`; `iterations` are those before.
pub(super) fn solve(problem: &mut GridProblem<'_>, mut iterations: usize, unknowns: &mut Unknowns) -> Report {
    let len = problem.initial_gap.len();
    let (load, load_control) = (problem.load, problem.load.is_mean_pressure());
    let mut patience = Patience::new(PATIENCE);
    let mut norm_before = 0.0;
    unknowns.direction.fill(0.0);
    unknowns.active.fill(false);
    unknowns.admit(load);
    loop {
        let check = Check::new(problem, unknowns);
        let ended = |stop, iterations| Report { stop, route: Route::Direct, iterations, residual: check.residual };
        if let Some(stop) = check.stop(&problem.settings, &mut patience, iterations) {
            return ended(stop, iterations);
        }
        iterations += 1;

        let Unknowns { pressure: p, gap: g, direction: t, image, previous, active, .. } = unknowns;
        let belongs = |i: usize| p[i] > 0.0 || g[i] < 0.0;
        let [size, sum, grown] =
            sums::of(len, |i| if belongs(i) { [1.0, g[i], f64::from(u8::from(!active[i]))] } else { [0.0; 3] });
        let mean = if load_control { sum / size } else { 0.0 };
        sums::update(active, |i, _| belongs(i));
        sums::update(g, |i, g| if active[i] { g - mean } else { 0.0 });
        problem.compliance.precondition(g, image);
        let z_mean = if load_control {
            let [sum] = sums::of(len, |i| [if active[i] { image[i] } else { 0.0 }]);
            sum / size
        } else {
            0.0
        };
        sums::update(image, |i, z| if active[i] { z - z_mean } else { 0.0 });
        let [norm, overlap] = sums::of(len, |i| [g[i] * image[i], previous[i] * image[i]]);
        let beta = if grown > 0.0 || norm_before <= 0.0 { 0.0 } else { ((norm - overlap) / norm_before).max(0.0) };
        norm_before = norm;
        sums::update(t, |i, t| if active[i] { image[i] + beta * t } else { 0.0 });
        previous.copy_from_slice(g);

        problem.compliance.displacement(t, image);
        let [descent, curvature] = sums::of(len, |i| [g[i] * t[i], t[i] * image[i]]);
        let step = descent / curvature;
        if !(step.is_finite() && curvature > 0.0) {
            return ended(Stop::Stalled, iterations);
        }
        sums::update(p, |i, p| if active[i] { p - step * t[i] } else { 0.0 });
        unknowns.admit(load);
        (problem.progress)(Progress { iteration: iterations, residual: check.residual });
    }
}
