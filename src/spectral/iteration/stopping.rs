//! When an iteration ends.
//!
//! One convolution tells how an iterate stands: its residual ε and its [`Certificate`]. Converged is what is certified,
//! whatever the grid; the rest is patience.

use super::check::Check;
use super::report::Stop;
use super::settings::Settings;

/// A window of iterations has made progress when its mean has fallen below this part of the last window's.
const PROGRESS: f64 = 0.9;

impl Check {
    /// Why the iteration has to end here, if it has to.
    pub fn stop(&self, settings: &Settings, patience: &mut Patience, iterations: usize) -> Option<Stop> {
        if self.converged(settings.tolerance) {
            Some(Stop::Converged)
        } else if patience.ends(self.measure()) {
            Some(Stop::Stalled)
        } else {
            (iterations >= settings.max_iterations).then_some(Stop::IterationLimit)
        }
    }
}

/// Compares windows of iterations, each twice as long as the one before.
///
/// The criteria do not fall from one iteration to the next: an interpolated start meets them nearly, and its first
/// steps worsen them by orders of magnitude where a coating bends like a plate. Their mean over a window falls while
/// the method advances, however slowly, and no longer once rounding rules.
pub(super) struct Patience {
    window: usize,
    left: usize,
    sum: f64,
    before: f64,
}

impl Patience {
    /// Patience with a first window of so many iterations.
    pub fn new(window: usize) -> Self {
        Self { window, left: window, sum: 0.0, before: f64::INFINITY }
    }

    /// Notes a new measure; true when patience is at its end.
    pub fn ends(&mut self, measure: f64) -> bool {
        self.sum += measure;
        self.left -= 1;
        if self.left > 0 {
            return false;
        }
        let (window, mean) = (2 * self.window, self.sum / self.window as f64);
        let progress = mean < PROGRESS * self.before;
        *self = Self { window, left: window, sum: 0.0, before: mean };
        !progress
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measures until patience ends.
    fn granted(measure: impl Fn(usize) -> f64) -> usize {
        let mut patience = Patience::new(30);
        (1..=100_000).find(|&k| patience.ends(measure(k))).unwrap()
    }

    #[test]
    fn patience_outlasts_slow_progress_and_a_start_that_is_too_good() {
        // 1/√k: each window's mean is 0.7 of the last one's. At 1e-20 rounding ends it.
        assert_eq!(granted(|k| if k < 50_000 { (k as f64).powf(-0.5) } else { 1e-2 }), 30 * (2048 - 1));
        // Best at the start, worse at once, then a factor 10 in 100 iterations.
        let worsened = |k: usize| if k < 3 { 1e-7 } else { 1e-3 * 0.1f64.powf(k as f64 / 100.0).max(1e-9) };
        assert!(granted(worsened) > 900, "{}", granted(worsened));
        assert_eq!(granted(|_| 1.0), 90, "nothing gained in the second window");
        assert_eq!(granted(|_| f64::NAN), 30);
    }
}
