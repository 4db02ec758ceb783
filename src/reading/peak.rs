//! Peak pressure between the samples.

use crate::lattice::Grid;

/// Largest value of the paraboloid through the 3 × 3 samples around `index` (least squares), never below the sample
/// itself.
///
/// In units of the samples' indices i, j ∈ {−1, 0, 1}: p ≈ c₀ + c₁i + c₂j + c₃i² + c₄ij + c₅j², whose error near a
/// smooth peak falls with the fourth power of the spacing. Next to the contact edge the sample itself is returned.
pub fn interpolated(grid: &Grid, pressure: &[f64], index: usize) -> f64 {
    let [n1, n2] = grid.points();
    let (row, column) = (index / n2, index % n2);
    let mut around = [[0.0; 3]; 3];
    for (i, line) in around.iter_mut().enumerate() {
        for (j, value) in line.iter_mut().enumerate() {
            *value = pressure[(row + n1 + i - 1) % n1 * n2 + (column + n2 + j - 1) % n2];
        }
    }
    let sample = pressure[index];
    if around.iter().flatten().any(|&p| p <= 0.0) {
        return sample;
    }
    let sum = |weight: fn(f64, f64) -> f64| -> f64 {
        let mut total = 0.0;
        for (i, line) in around.iter().enumerate() {
            for (j, value) in line.iter().enumerate() {
                total += weight(i as f64 - 1.0, j as f64 - 1.0) * value;
            }
        }
        total
    };
    let (all, c1, c2) = (sum(|_, _| 1.0), sum(|i, _| i) / 6.0, sum(|_, j| j) / 6.0);
    let c4 = sum(|i, j| i * j) / 4.0;
    let c3 = 0.5 * sum(|i, _| i * i) - all / 3.0;
    let c5 = 0.5 * sum(|_, j| j * j) - all / 3.0;
    // The constant makes the surface pass through the centre, where the sample is as good as any fit.
    let determinant = 4.0 * c3 * c5 - c4 * c4;
    if c3 >= 0.0 || determinant <= 0.0 {
        return sample;
    }
    let i = (c4 * c2 - 2.0 * c5 * c1) / determinant;
    let j = (c4 * c1 - 2.0 * c3 * c2) / determinant;
    if i.abs() > 1.0 || j.abs() > 1.0 {
        return sample;
    }
    sample + 0.5 * (c1 * i + c2 * j)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    #[test]
    fn the_peak_of_a_paraboloid_between_samples_is_exact() {
        let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [8, 8]).unwrap();
        let mut pressure = vec![0.0; 64];
        for (index, p) in pressure.iter_mut().enumerate() {
            let (i, j) = ((index / 8) as f64 - 4.3, (index % 8) as f64 - 3.8);
            *p = 50.0 - i * i - 0.7 * i * j - 1.5 * j * j;
        }
        assert!((interpolated(&grid, &pressure, 4 * 8 + 4) - 50.0).abs() < 1e-12);
    }
}
