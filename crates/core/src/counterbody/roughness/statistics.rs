//! The distribution of a surface's heights: mean, rms, skewness, kurtosis.
//!
//! m_n = ⟨(h − h̄)ⁿ⟩; h_rms = √m₂, skewness m₃/m₂^{3/2}, kurtosis m₄/m₂²: 0 and 3 for heights of a Gaussian distribution.

use crate::lattice::Cell;
use crate::numeric::{parallel, sums};
use ndarray::ArrayView2;
use serde::Serialize;
use std::f64::consts::TAU;

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

/// Rms height and slope of a surface over the samples with a measurement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeasuredRms {
    /// Rms height: root mean square of the heights from their mean, a length.
    pub height: f64,
    /// Rms slope √⟨|∇h|²⟩ by the differences of neighbours, where both are measured; waves of few samples count less than in a spectrum.
    pub slope: f64,
}

impl MeasuredRms {
    /// Rms values of heights on a cell, lengths; NaN where there is no measurement.
    pub fn of(cell: Cell, heights: ArrayView2<'_, f64>) -> Self {
        let (n1, n2) = heights.dim();
        let measured = || heights.iter().filter(|height| !height.is_nan());
        let (sum, count) = measured().fold((0.0, 0.0), |(sum, count), height| (sum + height, count + 1.0));
        let mean: f64 = sum / count;
        let square = measured().map(|height| (height - mean).powi(2)).sum::<f64>() / count;
        let reciprocal = cell.reciprocal().map(|b| b.map(|c| c / TAU));
        let of_row = |row: usize| {
            let mut slopes = (0.0, 0.0);
            let (before, here) = (heights.row(row), heights.row(row + 1));
            for j in 1..n2 {
                // Derivatives by the fractions of a₁ and a₂.
                let rise = [(here[j] - before[j]) * n1 as f64, (here[j] - here[j - 1]) * n2 as f64];
                let [x, y] = [0, 1].map(|c| rise[0] * reciprocal[0][c] + rise[1] * reciprocal[1][c]);
                if !x.is_nan() && !y.is_nan() {
                    slopes = (slopes.0 + x * x + y * y, slopes.1 + 1.0);
                }
            }
            slopes
        };
        let rows = parallel::map(n1.saturating_sub(1), of_row);
        let slopes = rows.into_iter().fold((0.0, 0.0), |(sum, count), row| (sum + row.0, count + row.1));
        Self { height: square.sqrt(), slope: (slopes.0 / f64::max(slopes.1, 1.0)).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::{Array2, arr2};

    #[test]
    fn rms_values_of_what_is_measured_are_those_of_a_plane() {
        let cell = Cell::new([3.0, 0.0], [1.0, 2.0]).unwrap();
        let plane = Array2::from_shape_fn((6, 8), |(i, j)| {
            let [x, y] = cell.vector([i as f64 / 6.0, j as f64 / 8.0]);
            if (i, j) == (2, 2) { f64::NAN } else { 0.3 * x - 0.4 * y }
        });
        assert!((MeasuredRms::of(cell, plane.view()).slope - 0.5).abs() < 1e-14);
        let two = arr2(&[[1.0, f64::NAN], [f64::NAN, 3.0]]);
        assert_eq!(MeasuredRms::of(cell, two.view()), MeasuredRms { height: 1.0, slope: 0.0 });
    }

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
