//! Peak pressure between the samples.

use crate::lattice::Grid;
use crate::numeric::paraboloid;

/// The value at `index` raised to the top of the paraboloid through the 3 × 3 samples around it, where there is one
/// nearby. Next to the contact edge the sample itself is returned.
pub fn interpolated(grid: &Grid, pressure: &[f64], index: usize) -> f64 {
    let [n1, n2] = grid.points();
    let (row, column) = ((index / n2) as i32, (index % n2) as i32);
    let wrapped = |k: i32, n: usize| k.rem_euclid(n as i32) as usize;
    let at = |i: i32, j: i32| pressure[wrapped(row + i, n1) * n2 + wrapped(column + j, n2)];
    // The surface is made to pass through the sample, which is as good as any fit.
    pressure[index] + paraboloid::rise(1, at).unwrap_or(0.0)
}
