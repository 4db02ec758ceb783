//! The distribution of a surface's heights: mean, rms, skewness, kurtosis.
//!
//! m_n = ⟨(h − h̄)ⁿ⟩; h_rms = √m₂, skewness m₃/m₂^{3/2}, kurtosis m₄/m₂²: 0 and 3 for heights of a Gaussian distribution.

use crate::numeric::sums;
use ndarray::ArrayView2;
use serde::Serialize;

/// Mean, rms value, range, skewness and kurtosis of heights.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Statistics {
    /// Mean height, a length.
    pub mean: f64,
    /// Rms height: root mean square of the heights from their mean, a length.
    pub rms_height: f64,
    /// Highest minus lowest sample, a length.
    pub range: f64,
    /// Skewness, positive where peaks are higher than valleys are deep; 0 for a flat surface.
    pub skewness: f64,
    /// Kurtosis, 3 for a Gaussian distribution; 0 for a flat surface.
    pub kurtosis: f64,
}

impl Statistics {
    /// Statistics of heights in any memory layout, lengths.
    pub fn of(heights: ArrayView2<'_, f64>) -> Self {
        let heights = heights.as_standard_layout();
        let heights = heights.as_slice().expect("in standard layout");
        let mean = sums::mean(heights);
        let n = heights.len();
        let [two, three, four] = sums::of(n, |k| {
            let h = heights[k] - mean;
            [h * h, h * h * h, h * h * h * h]
        })
        .map(|sum| sum / n as f64);
        let range = -sums::least(n, |k| -heights[k]) - sums::least(n, |k| heights[k]);
        let over = |moment: f64, scale: f64| if scale > 0.0 { moment / scale } else { 0.0 };
        Self {
            mean,
            rms_height: two.sqrt(),
            range,
            skewness: over(three, two * two.sqrt()),
            kurtosis: over(four, two * two),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::arr2;

    #[test]
    fn moments_are_those_of_two_heights_and_of_none() {
        // Three samples at 0, one at 4: mean 1, m₂ = 3, m₃ = 6, m₄ = 21.
        let found = Statistics::of(arr2(&[[0.0, 4.0], [0.0, 0.0]]).view());
        assert_eq!((found.mean, found.range), (1.0, 4.0));
        assert!((found.rms_height - 3f64.sqrt()).abs() < 1e-15);
        assert!((found.skewness - 6.0 / 27f64.sqrt()).abs() < 1e-15 && (found.kurtosis - 21.0 / 9.0).abs() < 1e-15);
        let flat = Statistics::of(arr2(&[[2.0, 2.0]]).view());
        assert_eq!((flat.rms_height, flat.skewness, flat.kurtosis), (0.0, 0.0, 0.0));
    }
}
