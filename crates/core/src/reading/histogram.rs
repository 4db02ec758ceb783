//! Histograms: the number of values of a quantity in each of several intervals.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Number of intervals of an even histogram.
const EVEN: usize = 64;
/// Number of intervals in a decade of a logarithmic histogram.
const PER_DECADE: f64 = 8.0;

/// Counts in neighbouring intervals; the upper end belongs to the last one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Histogram {
    /// Name of the quantity.
    pub quantity: Cow<'static, str>,
    /// Ends of the intervals, ascending, in the unit of the quantity: one more than counts.
    pub ends: Vec<f64>,
    /// Number of values in each interval.
    pub counts: Vec<usize>,
    /// Number of all values, those in no interval included.
    pub total: usize,
}

impl Histogram {
    /// Histogram of 64 equal intervals from 0 to the largest value; no intervals without values above 0. `total` is the number of
    /// all samples: the integral of the [density](Self::densities) is the part of the samples that has a value.
    pub fn even(quantity: &'static str, values: impl Iterator<Item = f64> + Clone, total: usize) -> Self {
        let most = values.clone().fold(0.0, f64::max);
        if !(most > 0.0 && most.is_finite()) {
            return Self { quantity: quantity.into(), ends: Vec::new(), counts: Vec::new(), total };
        }
        let ends = (0..=EVEN).map(|k| most * k as f64 / EVEN as f64).collect();
        let mut counts = vec![0; EVEN];
        values.for_each(|value| counts[((value / most * EVEN as f64) as usize).min(EVEN - 1)] += 1);
        Self { quantity: quantity.into(), ends, counts, total }
    }

    /// Histogram of values above 0, with eight intervals in a decade from the smallest value on, each longer than the one before by
    /// a constant factor.
    pub fn by_decades(quantity: &'static str, values: impl Iterator<Item = f64> + Clone) -> Self {
        let total = values.clone().count();
        let least = values.clone().fold(f64::INFINITY, f64::min);
        if !(least > 0.0 && least.is_finite()) {
            return Self { quantity: quantity.into(), ends: Vec::new(), counts: Vec::new(), total };
        }
        // The smallest spots have one sample, the next two: intervals begin between such values.
        let first = least * 10f64.powf(-0.5 / PER_DECADE);
        let place = |value: f64| (PER_DECADE * (value / first).log10()) as usize;
        let most = values.clone().map(place).max().unwrap_or(0);
        let ends = (0..=most + 1).map(|k| first * 10f64.powf(k as f64 / PER_DECADE)).collect();
        let mut counts = vec![0; most + 1];
        values.for_each(|value| counts[place(value)] += 1);
        Self { quantity: quantity.into(), ends, counts, total }
    }

    /// Density of each interval: part of all values over the length of the interval.
    pub fn densities(&self) -> Vec<f64> {
        let widths = self.ends.windows(2).map(|ends| ends[1] - ends[0]);
        self.counts.iter().zip(widths).map(|(count, width)| *count as f64 / (self.total as f64 * width)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_integrate_to_the_part_that_has_a_value() {
        let values: Vec<f64> = (1..=30).map(|k| f64::from(k * k)).collect();
        for (histogram, part) in [
            (Histogram::even("a", values.iter().copied(), 120), 0.25),
            (Histogram::by_decades("b", values.iter().copied()), 1.0),
        ] {
            let widths = histogram.ends.windows(2).map(|ends| ends[1] - ends[0]);
            let integral: f64 = histogram.densities().iter().zip(widths).map(|(density, width)| density * width).sum();
            assert!((integral - part).abs() < 1e-12, "{histogram:?}");
            assert_eq!(histogram.counts.iter().sum::<usize>(), 30);
            assert!(histogram.ends.windows(2).all(|ends| ends[0] < ends[1]));
        }
        assert!(Histogram::even("none", std::iter::empty(), 5).counts.is_empty());
        assert!(Histogram::by_decades("none", std::iter::empty()).counts.is_empty());
    }
}
