//! How often a quantity lies in each of several intervals.

use std::borrow::Cow;

/// Intervals of an even histogram.
const EVEN: usize = 64;
/// Intervals to a decade of one by decades.
const TO_A_DECADE: f64 = 8.0;

/// Counts in neighbouring intervals, the upper end of the last one counted.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Histogram {
    /// Of what.
    pub quantity: Cow<'static, str>,
    /// Ends of the intervals, ascending: one more than counts.
    pub ends: Vec<f64>,
    /// How many values lie in each.
    pub counts: Vec<usize>,
    /// Of how many in all: those that are in none count too.
    pub total: usize,
}

impl Histogram {
    /// 64 equal intervals from 0 to the largest value; none without values above 0. `total` samples stand for the whole, so
    /// that the integral of the [density](Self::densities) is the part of them that has a value.
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

    /// Eight intervals to a decade from the smallest value on, each as many times as long as the one before; of values
    /// above 0.
    pub fn by_decades(quantity: &'static str, values: impl Iterator<Item = f64> + Clone) -> Self {
        let total = values.clone().count();
        let least = values.clone().fold(f64::INFINITY, f64::min);
        if !(least > 0.0 && least.is_finite()) {
            return Self { quantity: quantity.into(), ends: Vec::new(), counts: Vec::new(), total };
        }
        // The smallest spots have one sample, the next two: no interval begins at a value.
        let first = least * 10f64.powf(-0.5 / TO_A_DECADE);
        let place = |value: f64| (TO_A_DECADE * (value / first).log10()) as usize;
        let most = values.clone().map(place).max().unwrap_or(0);
        let ends = (0..=most + 1).map(|k| first * 10f64.powf(k as f64 / TO_A_DECADE)).collect();
        let mut counts = vec![0; most + 1];
        values.for_each(|value| counts[place(value)] += 1);
        Self { quantity: quantity.into(), ends, counts, total }
    }

    /// Part of the whole per unit of the quantity, in each interval.
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
