//! Waves of a traction in a window, as that of a wider cell around it.

use super::disc_waves::waves_of_discs;
use super::traction::Traction;
use super::traction_waves::TractionWaves;
use crate::lattice::waves::Waves;
use crate::lattice::{Cell, Grid};
use crate::numeric::parallel;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Coefficients c of the `waves` of a cell whose middle is that of the window of a traction: p = Re Σ c e^{2πi(κ₁s + κ₂t)} by the
/// fractions s, t of the cell, and q_x and q_y alike. The pressure of discs has the exact waves of the discs.
pub(super) fn window_waves(waves: &Waves, cell: Cell, traction: &Traction<'_>) -> TractionWaves {
    let of = |field: &[f64]| waves_of_samples(waves, cell, traction.grid(), field);
    let pressure = match traction.discs() {
        [] => of(traction.pressure()),
        discs => waves_of_discs(waves, cell, discs),
    };
    TractionWaves { pressure, shear: traction.fields().map(|fields| fields.map(of)) }
}

/// Coefficients of the waves of a `field` with one value per sample of the `grid` of the window, a₂ fastest.
///
/// The sums over the samples are exact: the spacings of the cell's grid may be any.
fn waves_of_samples(waves: &Waves, cell: Cell, grid: &Grid, field: &[f64]) -> Vec<Complex64> {
    let [n1, n2] = grid.points();
    let fractions = |axis: usize, n: usize| -> Vec<f64> {
        let (corner, step) = (grid.cell().corner()[axis], grid.steps()[axis][axis]);
        let side = cell.vectors()[axis][axis];
        (0..n).map(|i| (corner + i as f64 * step) / side + 0.5).collect()
    };
    let (along, across) = (fractions(0, n1), fractions(1, n2));
    let rows = waves.rows_within(waves.wavenumbers().len());
    let most = rows.iter().map(|row| row.across).max().unwrap_or(0);
    let first = rows.iter().map(|row| row.first).min().unwrap_or(0);
    let last = rows.iter().map(|row| row.first + row.len as i32).max().unwrap_or(0);
    let phase = |k: i32, s: f64| Complex64::cis(-TAU * (f64::from(k) * s).fract());
    // Along y first: of each row of samples the sums for all κ₂.
    let loaded: Vec<usize> = (0..n1).filter(|i| field[i * n2..][..n2].iter().any(|&p| p != 0.0)).collect();
    let of_row = |&i: &usize| {
        let mut sums = vec![Complex64::default(); most as usize + 1];
        for (&p, &t) in field[i * n2..][..n2].iter().zip(&across).filter(|(p, _)| **p != 0.0) {
            let (step, mut term) = (phase(1, t), Complex64::from(p));
            for sum in &mut sums {
                (sum.re, sum.im) = (sum.re + term.re, sum.im + term.im);
                term = Complex64::new(term.re * step.re - term.im * step.im, term.re * step.im + term.im * step.re);
            }
        }
        sums
    };
    let sums: Vec<Vec<Complex64>> = parallel::map_items(&loaded, of_row);
    let phases: Vec<Vec<Complex64>> =
        parallel::map_items(&loaded, |&i| (first..last).map(|k| phase(k, along[i])).collect());
    // A wave and its conjugate share one coefficient.
    let scale = 2.0 * grid.sample_area() / cell.area();
    waves.coefficients(|[k1, k2]| {
        let terms = sums.iter().zip(&phases);
        scale * terms.map(|(sums, phases)| sums[k2 as usize] * phases[(k1 - first) as usize]).sum::<Complex64>()
    })
}
