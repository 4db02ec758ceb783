//! Conjugate gradients of Polonsky & Keer, Wear 231 (1999) 206, the baseline.
//!
//! On {p > 0}: t = g + δ′ (G/G₀) t with G = Σ g² (δ′ = 0 right after samples have joined), τ = ⟨g,t⟩/⟨t,Ct⟩, p ← max(p
//! − τt, 0); samples outside contact that penetrate join with p ← −τ g. Under load control g is freed of its mean over
//! contact, Ct likewise, and p is scaled back to its mean. Samples where p = H and g ≤ 0 take no part, and where g > 0 they join with
//! p ← H − τ g.

use super::check::ConvergenceCheck;
use super::fields::Unknowns;
use super::problem::{ContactProblem, Settings};
use super::report::{Progress, Report, Route, Stop};
use super::stopping::StallDetector;
use crate::numeric::sums;
use crate::spectral::operator::ElasticOperator;
use std::sync::Arc;

/// First window of the stall detector, iterations: the criteria fall less steadily than in the preconditioned method.
const FIRST_WINDOW: usize = 100;

/// Iterates from and into `unknowns`; `iterations` are those before.
pub(super) fn solve<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    mut iterations: usize,
    unknowns: &mut Unknowns,
) -> Report {
    let len = problem.initial_gap.len();
    let (load, load_control) = (problem.load, problem.load.is_mean_pressure());
    let bounds = problem.admissible.bounds();
    let mut stall = StallDetector::new(FIRST_WINDOW);
    let (mut norm_before, mut conjugate) = (1.0, false);
    let (mut t, mut image) = (vec![0.0; len], vec![0.0; len]);
    unknowns.admit(load, problem.admissible);
    loop {
        let check = ConvergenceCheck::new(problem, unknowns);
        let ended = |stop, iterations| Report::new(stop, Route::Baseline, iterations, check.residual);
        if let Some(stop) = reason_to_end(&check, &problem.settings, &mut stall, iterations) {
            return ended(stop, iterations);
        }
        iterations += 1;

        let (p, g) = (Arc::make_mut(&mut unknowns.pressure), Arc::make_mut(&mut unknowns.gap));
        problem.admissible.open(g, f64::MAX);
        let over_contact = |field: &[f64]| {
            let [size, sum] = sums::of(len, |i| if bounds.is_free(p[i]) { [1.0, field[i]] } else { [0.0; 2] });
            if load_control && size > 0.0 { sum / size } else { 0.0 }
        };
        let mean = over_contact(g);
        sums::update(g, |_, g| g - mean);
        let [norm, violation] = sums::of(len, |i| match bounds.is_free(p[i]) {
            true => [g[i] * g[i], 0.0],
            false => [0.0, if bounds.is_violated(p[i], g[i]) { g[i] * g[i] } else { 0.0 }],
        });
        let beta = if conjugate { norm / norm_before } else { 0.0 };
        norm_before = norm;
        // Contact of one sample (or of equal ones) has no direction within contact: the penetrating samples give it.
        let lonely = norm <= 1e-24 * violation;
        let takes_part = |i: usize| bounds.is_free(p[i]) || (lonely && bounds.is_violated(p[i], g[i]));
        sums::update(&mut t, |i, t| if takes_part(i) { g[i] + beta * t } else { 0.0 });

        image.copy_from_slice(&t);
        problem.displace(&mut image);
        let image_mean = if lonely { 0.0 } else { over_contact(&image) };
        let [descent, curvature] = sums::of(len, |i| [g[i] * t[i], (image[i] - image_mean) * t[i]]);
        let step = descent / curvature;
        if !(step.is_finite() && curvature > 0.0) {
            // Samples that left contact can spoil the direction; steepest descent cannot fail that way.
            if beta > 0.0 {
                conjugate = false;
                continue;
            }
            // The mean over contact has been taken off the gap.
            ConvergenceCheck::new(problem, unknowns);
            return ended(Stop::Stalled, iterations);
        }
        sums::update(p, |i, p| if bounds.is_free(p) { bounds.clamp(p - step * t[i]) } else { p });
        let [joined] = sums::of(len, |i| [f64::from(u8::from(bounds.is_violated(p[i], g[i])))]);
        sums::update(p, |i, p| if bounds.is_violated(p, g[i]) { p - step * g[i] } else { p });
        conjugate = joined == 0.0;
        unknowns.admit(load, problem.admissible);
        if (problem.progress)(Progress { iteration: iterations, residual: check.residual }).is_break() {
            return Report::new(
                Stop::Interrupted,
                Route::Baseline,
                iterations,
                ConvergenceCheck::new(problem, unknowns).residual,
            );
        }
    }
}

/// Reason to end the iteration at a check, if there is one.
fn reason_to_end(
    check: &ConvergenceCheck,
    settings: &Settings,
    stall: &mut StallDetector,
    iterations: usize,
) -> Option<Stop> {
    if check.converged(settings.tolerance) {
        Some(Stop::Converged)
    } else if stall.detected(check.measure()) {
        Some(Stop::Stalled)
    } else {
        (iterations >= settings.max_iterations).then_some(Stop::IterationLimit)
    }
}
