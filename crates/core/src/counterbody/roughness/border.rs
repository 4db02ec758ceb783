//! Jump of a surface across the border of its period.
//!
//! rᵢ = rms of the differences across the border of the period along **a**ᵢ / rms of the differences of neighbours within.
//!
//! The border of a periodic surface does not differ from other lines between samples. The mean of r² over all N lines
//! is 1, so that at most a ninth of them can have r > 3; the lines of a random surface hardly differ. A surface with
//! r > 3 at the border is not periodic.

use crate::numeric::parallel;
use ndarray::{ArrayView2, Axis};

/// Largest border jump of a surface that counts as periodic.
pub const MAX_BORDER_JUMP: f64 = 3.0;

/// Border jumps rᵢ along a₁ and a₂; 0 along a direction of less than three samples, or where all differences vanish.
pub fn border_jumps(heights: ArrayView2<'_, f64>) -> [f64; 2] {
    [0, 1].map(|axis| {
        let n = heights.shape()[axis];
        if n < 3 {
            return 0.0;
        }
        let line = |k: usize| heights.index_axis(Axis(axis), k);
        let squares = |a: usize, b: usize| -> f64 { line(a).iter().zip(line(b)).map(|(x, y)| (x - y) * (x - y)).sum() };
        let across = squares(0, n - 1);
        let within = parallel::map(n - 1, |k| squares(k + 1, k)).into_iter().sum::<f64>() / (n - 1) as f64;
        if across == 0.0 { 0.0 } else { (across / within).sqrt() }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::Array2;
    use std::f64::consts::TAU;

    #[test]
    fn a_slope_jumps_and_a_wave_does_not() {
        let wave = Array2::from_shape_fn((32, 24), |(i, j)| (TAU * (i as f64 / 32.0 + 2.0 * j as f64 / 24.0)).cos());
        assert!(border_jumps(wave.view()).iter().all(|jump| *jump < 2f64.sqrt()));
        // A plane falls back over 31 steps at once.
        let slope = Array2::from_shape_fn((32, 24), |(i, _)| i as f64);
        assert_eq!(border_jumps(slope.view()), [31.0, 0.0]);
        assert_eq!(border_jumps(Array2::zeros((8, 2)).view()), [0.0, 0.0]);
    }
}
