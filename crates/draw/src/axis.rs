//! Axes: a quantity with its unit, a range, and round numbers.

use super::label::Label;
use super::scale::Scale;
use super::ticks::{Ticks, ticks};
use percoat_common::unit::Prefixed;

/// An axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Label with the unit.
    pub label: Label,
    /// Spacing of the values.
    pub scale: Scale,
    /// First and last value; `None`, or a range of no length or without end, is replaced by that of the curves.
    pub range: Option<[f64; 2]>,
    /// Values of a horizontal axis that are marked by dotted lines across the plot, each with a word.
    pub marks: Vec<(f64, String)>,
}

impl Axis {
    /// A linear axis for the values of the curves.
    pub fn linear(label: impl Into<Label>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, range: None, marks: Vec::new() }
    }

    /// A logarithmic axis for the values of the curves.
    pub fn log(label: impl Into<Label>) -> Self {
        Self { label: label.into(), scale: Scale::Log, range: None, marks: Vec::new() }
    }

    /// The axis with a range from `first` to `last`.
    #[must_use]
    pub fn from_to(self, first: f64, last: f64) -> Self {
        Self { range: Some([first, last]), ..self }
    }

    /// The unit of its numbers over a range.
    pub fn unit(&self, [first, last]: [f64; 2]) -> Prefixed {
        self.label.unit(match self.scale {
            // The prefix suits the middle of the range.
            Scale::Log => (first * last).abs().sqrt(),
            Scale::Linear | Scale::Degrees => first.abs().max(last.abs()),
        })
    }

    /// Ticks of a range with at most `most` numbers, in the unit of the axis.
    pub fn ticks(&self, range: [f64; 2], most: usize) -> Ticks {
        let unit = self.unit(range);
        ticks(range.map(|end| unit.shown(end)), self.scale, most).in_unit(&unit)
    }

    /// The range, or that of the values if it is not given, with a `margin` of its length on both sides; on a linear axis it includes
    /// zero where that is near.
    pub fn reach(&self, values: impl Iterator<Item = f64>, margin: f64) -> [f64; 2] {
        if let Some([first, last]) = self.range.filter(|[first, last]| (last - first).is_finite() && first != last) {
            return [first, last];
        }
        let usable = |x: &f64| x.is_finite() && (self.scale != Scale::Log || *x > 0.0);
        let (least, most) = values
            .filter(usable)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
        match self.scale {
            _ if least > most => [if self.scale == Scale::Log { 0.1 } else { 0.0 }, 1.0],
            Scale::Linear | Scale::Degrees => {
                // The range includes zero where that is near.
                let (low, high) = (if least > 0.0 && least < 0.6 * most { 0.0 } else { least }, most);
                let high = if high < 0.0 && high > 0.6 * least { 0.0 } else { high };
                let length = if high > low { high - low } else { high.abs().max(1e-300) };
                let beyond = |end: f64, sign: f64| if end == 0.0 { 0.0 } else { end + sign * margin * length };
                if high > low {
                    [beyond(low, -1.0), beyond(high, 1.0)]
                } else {
                    [low - 0.5 * length, high + 0.5 * length]
                }
            }
            Scale::Log => {
                let factor = (most / least).powf(margin).max(1.1);
                [least / factor, most * factor]
            }
        }
    }
}

/// Whether values are spread evenly on a logarithmic axis rather than on a linear one.
pub fn log_spaced(values: &[f64]) -> bool {
    let spread = |place: fn(f64) -> f64| {
        let gaps = values.windows(2).map(|pair| (place(pair[1]) - place(pair[0])).abs());
        let (least, most) = gaps.fold((f64::INFINITY, 0.0f64), |(a, b), gap| (a.min(gap), b.max(gap)));
        most / least
    };
    values.len() > 2 && values.iter().all(|&value| value > 0.0) && spread(f64::ln) < 0.5 * spread(|value| value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_reaches_to_zero_when_zero_is_near() {
        let axis = Axis::linear("p");
        assert_eq!(axis.reach([0.1, 1.0].into_iter(), 0.05), [0.0, 1.05]);
        assert_eq!(axis.reach([3.0, 3.0, f64::NAN].into_iter(), 0.05), [1.5, 4.5]);
        let [low, high] = Axis::log("p").reach([0.0, 1e-3, 1.0].into_iter(), 0.05);
        assert!(low < 1e-3 && low > 5e-4 && high > 1.0 && high < 2.0);
    }

    #[test]
    fn a_range_without_length_or_end_is_not_taken() {
        for [first, last] in [[0.0, 0.0], [f64::INFINITY, 0.0], [0.0, f64::NAN]] {
            let axis = Axis::linear("p").from_to(first, last);
            assert_eq!(axis.reach([0.0, 2.0].into_iter(), 0.0), [0.0, 2.0]);
        }
    }
}
