//! Interpolation of fields between the samples of a grid that keeps the symmetry of the cell.

use super::Cell;
use crate::numeric::{parallel, sums};

/// Interpolation of a field between four neighbouring samples of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Bilinear: keeps the symmetry of rectangular cells.
    Bilinear,
    /// Linear on the two triangles that the diagonal between the ends of a₁ and a₂ makes: keeps the symmetry of a 60°
    /// rhombus.
    AcrossDiagonal,
    /// Linear on the two triangles that the diagonal along a₁ + a₂ makes: keeps the symmetry of a 120° rhombus.
    AlongDiagonal,
}

impl Interpolation {
    /// Interpolation that keeps the symmetry of the cell: triangles along the shorter diagonal, if there is a shorter one.
    pub fn on(cell: Cell) -> Self {
        let [[x1, y1], [x2, y2]] = cell.vectors();
        let cosine = (x1 * x2 + y1 * y2) / (x1.hypot(y1) * x2.hypot(y2));
        match cosine {
            c if c > 1e-9 => Self::AcrossDiagonal,
            c if c < -1e-9 => Self::AlongDiagonal,
            _ => Self::Bilinear,
        }
    }

    /// Value at the fractions s, t between the samples at (0, 0), (0, 1), (1, 0), (1, 1).
    fn between(self, [v00, v01, v10, v11]: [f64; 4], s: f64, t: f64) -> f64 {
        match self {
            Self::Bilinear => (1.0 - s) * ((1.0 - t) * v00 + t * v01) + s * ((1.0 - t) * v10 + t * v11),
            Self::AcrossDiagonal if s + t <= 1.0 => (1.0 - s - t) * v00 + (s * v10 + t * v01),
            Self::AcrossDiagonal => (s + t - 1.0) * v11 + ((1.0 - s) * v01 + (1.0 - t) * v10),
            Self::AlongDiagonal if s >= t => (1.0 - s) * v00 + ((s - t) * v10 + t * v11),
            Self::AlongDiagonal => (1.0 - t) * v00 + ((t - s) * v01 + s * v11),
        }
    }
}

/// Periodic interpolation of a field from one grid of a cell to another, followed by the function `value` of each positive value and
/// 0 of others; exact where samples coincide.
pub(crate) fn resampled(
    field: &[f64],
    from: [usize; 2],
    to: [usize; 2],
    interpolation: Interpolation,
    value: impl Fn(f64) -> f64 + Sync,
) -> Vec<f64> {
    if from == to {
        let mut result = field.to_vec();
        sums::update(&mut result, |_, x| if x > 0.0 { value(x) } else { 0.0 });
        return result;
    }
    let any_positive = |row: &[f64]| row.iter().any(|&x| x > 0.0);
    let positive: Vec<bool> = parallel::map_chunks(field, from[1], any_positive);
    let place = |index: usize, axis: usize| {
        let (before, rest) = (index * from[axis] / to[axis], index * from[axis] % to[axis]);
        (before, (before + 1) % from[axis], rest as f64 / to[axis] as f64)
    };
    let columns: Vec<(usize, usize, f64)> = (0..to[1]).map(|j| place(j, 1)).collect();
    let mut result = vec![0.0; to[0] * to[1]];
    parallel::each_chunk(&mut result, to[1], |i, row| {
        let (low, high, s) = place(i, 0);
        if !(positive[low] || positive[high]) {
            return;
        }
        let [low, high] = [low, high].map(|row| &field[row * from[1]..][..from[1]]);
        for (to, &(left, right, t)) in row.iter_mut().zip(&columns) {
            let corners = [low[left], low[right], high[left], high[right]];
            if corners[0] > 0.0 || corners[1] > 0.0 || corners[2] > 0.0 || corners[3] > 0.0 {
                let between = interpolation.between(corners, s, t);
                *to = if between > 0.0 { value(between) } else { 0.0 };
            }
        }
    });
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resampling_keeps_common_samples_and_constants() {
        let field: Vec<f64> = (0..24).map(|i| f64::from(i * i % 7)).collect();
        for interpolation in [Interpolation::Bilinear, Interpolation::AcrossDiagonal, Interpolation::AlongDiagonal] {
            let finer = resampled(&field, [4, 6], [8, 12], interpolation, |x| x);
            assert!((0..24).all(|i| finer[(2 * (i / 6)) * 12 + 2 * (i % 6)] == field[i]));
            let constant = resampled(&[2.5; 24], [4, 6], [7, 5], interpolation, |x| x);
            assert!(constant.iter().all(|&x| (x - 2.5).abs() < 1e-15));
        }
    }
}
