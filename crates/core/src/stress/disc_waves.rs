//! Waves of uniform pressures on discs.
//!
//! A pressure p on a disc of the radius a around **x**₀ has the transform 2πa p J₁(qa)/q e^{−i**q**·**x**₀}: no samples are needed. A grid has it up to
//! its shortest waves; at the depth z those beyond them have e^{−qz} of their pressure.

use crate::counterbody::LoadedDisc;
use crate::lattice::Cell;
use crate::lattice::waves::Waves;
use crate::numeric::parallel;
use rustfft::num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Coefficients c of the waves of discs on a cell, pressures: p = p̄ + Re Σ c e^{2πi(κ₁s + κ₂t)} by the fractions s, t of the cell.
pub(super) fn waves_of_discs(waves: &Waves, cell: Cell, discs: &[LoadedDisc]) -> Vec<Complex64> {
    let mut radii: Vec<f64> = discs.iter().map(|disc| disc.radius).collect();
    radii.sort_by(f64::total_cmp);
    radii.dedup();
    let of_radius: Vec<Vec<Complex64>> = parallel::map_items(&radii, |&radius| of_equal(waves, cell, discs, radius));
    let mut sums = vec![Complex64::default(); waves.shells().len()];
    for coefficients in of_radius {
        sums.iter_mut().zip(coefficients).for_each(|(sum, coefficient)| *sum += coefficient);
    }
    sums
}

/// Coefficients of the waves of all discs of one radius.
fn of_equal(waves: &Waves, cell: Cell, discs: &[LoadedDisc], radius: f64) -> Vec<Complex64> {
    let rows = waves.rows_within(waves.wavenumbers().len());
    let first = rows.iter().map(|row| row.first).min().unwrap_or(0);
    let end = rows.iter().map(|row| row.first + row.len as i32).max().unwrap_or(first);
    let most = rows.iter().map(|row| row.across + 1).max().unwrap_or(0);
    let phase = |k: i32, s: f64| Complex64::cis(-TAU * (f64::from(k) * s).fract());
    let phases: Vec<(f64, Vec<Complex64>, Vec<Complex64>)> = discs
        .iter()
        .filter(|disc| disc.radius == radius)
        .map(|disc| {
            let [s, t] = cell.fractions(disc.centre);
            (disc.pressure, (first..end).map(|k| phase(k, s)).collect(), (0..most).map(|k| phase(k, t)).collect())
        })
        .collect();
    let mut all = waves.coefficients(|[k1, k2]| {
        phases
            .iter()
            .map(|(p, along, across)| *p * along[(k1 - first) as usize] * across[k2 as usize])
            .sum::<Complex64>()
    });
    // A wave and its conjugate share one coefficient: twice the transform over the area of the cell.
    let profile = |&q: &f64| 4.0 * PI * radius * libm::j1(q * radius) / (q * cell.area());
    let profiles: Vec<f64> = waves.wavenumbers().iter().map(profile).collect();
    for (c, &shell) in all.iter_mut().zip(waves.shells()) {
        *c *= profiles[shell as usize];
    }
    all
}
