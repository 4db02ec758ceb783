//! The mean plane of a surface under a window, by weighted least squares.
//!
//! Σ w₁(i) w₂(j) (h_ij − c − c₁ s_i − c₂ t_j)² is least, s and t measured from the middle over the length. With weights that are
//! even about the middle 1, s and t are orthogonal: c = Σwh/Σw, c₁ = Σwsh/Σws², c₂ = Σwth/Σwt².

use ndarray::ArrayView2;

/// Mean plane of the heights at some samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MeanPlane {
    /// Height in the middle, a length.
    pub mean: f64,
    /// Rise over the whole length along a₁ and a₂, lengths.
    pub slopes: [f64; 2],
    /// Number of samples along a₁ and a₂.
    pub points: [usize; 2],
}

/// Position of sample k of n from the middle, over the length.
fn place(k: usize, n: usize) -> f64 {
    (k as f64 - 0.5 * (n as f64 - 1.0)) / n as f64
}

impl MeanPlane {
    /// Mean plane by weights along a₁ and a₂ that are even about the middle.
    pub fn fit(heights: ArrayView2<'_, f64>, weights: &[Vec<f64>; 2]) -> Self {
        let (n1, n2) = heights.dim();
        // Moments of the rows, then of all.
        let mut sums = [0.0; 3];
        for (i, row) in heights.rows().into_iter().enumerate() {
            let (mut plain, mut across) = (0.0, 0.0);
            for (j, height) in row.iter().enumerate() {
                plain += weights[1][j] * height;
                across += weights[1][j] * height * place(j, n2);
            }
            let weight = weights[0][i];
            sums = [sums[0] + weight * plain, sums[1] + weight * plain * place(i, n1), sums[2] + weight * across];
        }
        let total = weights.each_ref().map(|weights| weights.iter().sum::<f64>());
        let square = |k: usize, n: usize| -> f64 {
            weights[k].iter().enumerate().map(|(index, weight)| weight * place(index, n).powi(2)).sum()
        };
        let slope = |sum: f64, square: f64, other: f64| if square > 0.0 { sum / (square * other) } else { 0.0 };
        let slopes = [slope(sums[1], square(0, n1), total[1]), slope(sums[2], square(1, n2), total[0])];
        Self { mean: sums[0] / (total[0] * total[1]), slopes, points: [n1, n2] }
    }

    /// Height of the plane at a sample, a length.
    pub fn at(&self, [i, j]: [usize; 2]) -> f64 {
        let [n1, n2] = self.points;
        self.mean + self.slopes[0] * place(i, n1) + self.slopes[1] * place(j, n2)
    }
}
