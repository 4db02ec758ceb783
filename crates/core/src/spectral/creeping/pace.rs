//! Pace in time: the lengths of steps by the error of each.
//!
//! The pressure is linear in time within a step, an error of second order in its length h in all, of third in one step. One step of h and two
//! of h/2 then differ by 3 times the error of the two. Steps long beside retardation times are not of that order: their whole difference is taken
//! for the error.

use std::ops::Range;

/// Order of the error of one step.
const ORDER: f64 = 3.0;
/// Part of the length with which an error is expected to meet the tolerance.
const SAFETY: f64 = 0.9;
/// Factors of the length from step to step, and after a step that was refused.
const CHANGE: Range<f64> = 0.3..8.0;
const REFUSED: Range<f64> = 0.05..0.5;

/// Steps from one time to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    tolerance: f64,
    /// Length below which steps are not divided, a time.
    least: f64,
    /// Time that is left.
    left: f64,
    /// Length of the next step.
    length: f64,
}

impl Pace {
    /// Steps over a duration with errors below a tolerance, none shorter than half of `least`; the first one tried is all of it.
    pub fn new(duration: f64, tolerance: f64, least: f64) -> Self {
        Self { tolerance, least, left: duration, length: duration }
    }

    /// Length of the next step; `None` at the end.
    pub fn next(&self) -> Option<f64> {
        let whole = self.left;
        (whole > 0.0).then_some(match self.length {
            length if length < whole => length.min(0.5 * whole),
            _ => whole,
        })
    }

    /// Time that is left.
    pub fn left(&self) -> f64 {
        self.left
    }

    /// Whether a step of a length with an error counts; chooses the length of the next one.
    pub fn accepts(&mut self, length: f64, error: f64) -> bool {
        let accepted = error <= self.tolerance || length <= self.least;
        let best = SAFETY * (self.tolerance / error.max(f64::MIN_POSITIVE)).powf(1.0 / ORDER);
        let Range { start, end } = if accepted { CHANGE } else { REFUSED };
        self.length = (length * best.clamp(start, end)).max(self.least);
        if accepted {
            self.left = if length == self.left { 0.0 } else { self.left - length };
        }
        accepted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps over an error that falls with time as the slope of e^{−t}: they grow, and meet the tolerance.
    #[test]
    fn steps_grow_as_the_error_falls() {
        let (mut pace, mut time, mut lengths, mut refused) = (Pace::new(50.0, 1e-3, 1e-6), 0.0f64, Vec::new(), 0);
        while let Some(length) = pace.next() {
            let error = 0.1 * length.powi(3) * (-time).exp();
            if pace.accepts(length, error) {
                assert!(error <= 1e-3);
                time += length;
                lengths.push(length);
            } else {
                refused += 1;
            }
        }
        assert!((time - 50.0).abs() < 1e-12 && lengths.len() < 30 && refused < 8, "{lengths:?}, {refused}");
        assert!(lengths[lengths.len() - 2] > 5.0 * lengths[0]);
    }

    #[test]
    fn without_error_one_step_is_all_and_none_is_shorter_than_the_least() {
        let mut pace = Pace::new(7.0, 1e-3, 0.01);
        assert_eq!(pace.next(), Some(7.0));
        assert!(pace.accepts(7.0, 0.0) && pace.next().is_none());
        let mut pace = Pace::new(1.0, 1e-3, 0.1);
        while let Some(length) = pace.next() {
            assert!(length >= 0.05);
            pace.accepts(length, 1.0);
        }
    }
}
