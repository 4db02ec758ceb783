//! Termination besides convergence: no more progress, and convergence to rounding.
//!
//! **Rounding.** In double precision the gap g = w + f − δ has the rounding errors of the convolution w = C p and of the
//! pressure itself. Where a large pressure causes small displacements (in complete contact, where most of it is uniform; under a
//! stiff coating, whose short waves take large pressures) they may exceed the tolerance, which no iteration then reaches.
//! Rounding is measured: w is computed again as C(λp)/λ, λ = 0.7, with other rounding errors. With the difference d of both gaps,
//!
//! Σ p|d| / (δ Σp),  Σ p (|d| + max |d|) / ½⟨p, Cp⟩,  max |d| / δ
//!
//! are the residual, the energy gap and the penetration outside contact of an exact solution after rounding. An iteration that
//! no longer advances while each criterion is below its tolerance, or below eight times this, has converged to rounding.

use super::check::ConvergenceCheck;
use super::fields::Unknowns;
use super::problem::ContactProblem;
use super::report::Stop;
use crate::numeric::sums;
use crate::spectral::operator::ElasticOperator;

/// A window of iterations has made progress when its mean has fallen below this part of the last window's.
const STALL_RATIO: f64 = 0.9;

/// Largest criterion of an iterate at rest, over what rounding makes of it: two gaps differ by the rounding of either, an
/// iterate carries that of all its steps.
const ROUNDING_MARGIN: f64 = 8.0;

/// λ: no power of two, so that every rounding differs.
const PERTURBATION: f64 = 0.7;

/// Comparison of windows of iterations, each twice as long as the one before.
///
/// The criteria do not fall from one iteration to the next: an interpolated start nearly fulfils them, and its first
/// steps worsen them by orders of magnitude where a coating bends like a plate. Their mean over a window falls while
/// the method advances, however slowly, and no longer once rounding prevails.
pub(super) struct StallDetector {
    window: usize,
    left: usize,
    sum: f64,
    before: f64,
}

impl StallDetector {
    /// Detector with a first window of `window` iterations.
    pub fn new(window: usize) -> Self {
        Self { window, left: window, sum: 0.0, before: f64::INFINITY }
    }

    /// Adds a measure; true when the last window has made no progress.
    pub fn detected(&mut self, measure: f64) -> bool {
        self.sum += measure;
        self.left -= 1;
        if self.left > 0 {
            return false;
        }
        let (window, mean) = (2 * self.window, self.sum / self.window as f64);
        let progress = mean < STALL_RATIO * self.before;
        *self = Self { window, left: window, sum: 0.0, before: mean };
        !progress
    }
}

/// `stop`, but converged to rounding where an iteration has stalled or come to its limit and rounding alone keeps it from the
/// tolerance.
pub(super) fn unless_rounding<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    unknowns: &mut Unknowns,
    stop: Stop,
) -> Stop {
    let ended = matches!(stop, Stop::Stalled | Stop::IterationLimit);
    if ended && is_at_rounding(problem, unknowns) { Stop::Rounding } else { stop }
}

/// Whether rounding alone keeps a pressure from the tolerance; sets its gap in `unknowns`.
fn is_at_rounding<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> bool {
    let check = ConvergenceCheck::new(problem, unknowns);
    let roundings = rounding(problem, unknowns, &check);
    let tolerance = problem.settings.tolerance;
    let is_met = |(criterion, rounding): (f64, f64)| criterion < tolerance.max(ROUNDING_MARGIN * rounding);
    check.criteria().into_iter().zip(roundings).all(is_met)
}

/// The criteria of the difference of the gap and the gap computed again.
fn rounding<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    unknowns: &Unknowns,
    check: &ConvergenceCheck,
) -> [f64; 3] {
    let Unknowns { pressure: p, gap: g, penetration, .. } = unknowns;
    let (f, len) = (problem.initial_gap, problem.initial_gap.len());
    let mut again: Vec<f64> = p.iter().map(|p| PERTURBATION * p).collect();
    problem.displace(&mut again);
    sums::update(&mut again, |i, w| w / PERTURBATION + f[i] - penetration - g[i]);
    let [load, work] = sums::of(len, |i| [p[i], p[i] * again[i]]);
    // Under load control δ goes with the gap.
    let mean = if problem.load.is_mean_pressure() && load > 0.0 { work / load } else { 0.0 };
    let [complementarity] = sums::of(len, |i| [p[i] * (again[i] - mean).abs()]);
    let largest = -sums::least(len, |i| -(again[i] - mean).abs());
    let beyond = problem.admissible.bounds().gap_of_change(p, |i| (again[i] - mean).abs(), largest, load);
    ConvergenceCheck::criteria_of([
        complementarity / (load * penetration),
        (complementarity + beyond) / (len as f64 * check.energy),
        largest / penetration,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measures until a stall is detected.
    fn granted(measure: impl Fn(usize) -> f64) -> usize {
        let mut stall = StallDetector::new(30);
        (1..=100_000).find(|&k| stall.detected(measure(k))).unwrap()
    }

    #[test]
    fn slow_progress_and_a_start_that_is_too_good_are_no_stall() {
        // 1/√k: each window's mean is 0.7 of the last one's. At 1e-20 rounding ends it.
        assert_eq!(granted(|k| if k < 50_000 { (k as f64).powf(-0.5) } else { 1e-2 }), 30 * (2048 - 1));
        // Best at the start, worse at once, then a factor 10 in 100 iterations.
        let worsened = |k: usize| if k < 3 { 1e-7 } else { 1e-3 * 0.1f64.powf(k as f64 / 100.0).max(1e-9) };
        assert!(granted(worsened) > 900, "{}", granted(worsened));
        assert_eq!(granted(|_| 1.0), 90, "nothing gained in the second window");
        assert_eq!(granted(|_| f64::NAN), 30);
    }
}
