//! Waves of a traction in a window, as that of a wider cell around it.

use super::disc_waves::waves_of_discs;
use super::phases::Phases;
use super::traction::Traction;
use super::traction_waves::TractionWaves;
use crate::lattice::waves::{WaveRow, Waves};
use crate::lattice::{Cell, Grid};
use crate::numeric::lanes::{LANES, vectorised};
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
    // Around an isolated contact nothing heats.
    TractionWaves { pressure, shear: traction.fields().map(|fields| fields.map(of)), heat: None }
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
    // Along y first: of each row of samples the sums for all κ₂.
    let loaded: Vec<usize> = (0..n1).filter(|i| field[i * n2..][..n2].iter().any(|&p| p != 0.0)).collect();
    let steps: Vec<Complex64> = across.iter().map(|t| Complex64::cis(-TAU * t)).collect();
    let sums = parallel::map_items(&loaded, |&i| row_sums(&field[i * n2..][..n2], &steps, most));
    let phases = parallel::map_items(&loaded, |&i| Phases::new([first, last], [-along[i]]));
    let scale = 2.0 * grid.sample_area() / cell.area();
    let of_wave_row = |row: &WaveRow| {
        let samples = sums.iter().map(|sums| sums[row.across as usize]).zip(&phases);
        vectorised!(_simd => along_row(row.len, samples.clone().map(|(sum, phases)| (sum, phases.from(row)))))
    };
    let components = parallel::map_items(&rows, of_wave_row);
    // A wave and its conjugate share one coefficient.
    let numbers: Vec<i32> = rows.iter().map(|row| row.across).collect();
    waves.coefficients(|[k1, k2]| {
        let row = numbers.partition_point(|&across| across < k2);
        scale * components[row][(k1 - rows[row].first) as usize]
    })
}

/// Sums Σ p e^{−2πiκt} over the samples of a row, given the `steps` e^{−2πit}, for 0 ≤ κ ≤ `most`.
fn row_sums(samples: &[f64], steps: &[Complex64], most: i32) -> Vec<Complex64> {
    let loaded: Vec<(f64, Complex64)> =
        samples.iter().copied().zip(steps.iter().copied()).filter(|(p, _)| *p != 0.0).collect();
    let mut sums = vec![[[0.0; LANES]; 2]; most as usize + 1];
    for eight in loaded.chunks(LANES) {
        let (mut terms, mut turns) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
        for (lane, &(p, step)) in eight.iter().enumerate() {
            (terms[0][lane], turns[0][lane], turns[1][lane]) = (p, step.re, step.im);
        }
        vectorised!(_simd => add_powers(&mut sums, terms, turns));
    }
    sums.into_iter().map(|[re, im]| Complex64::new(re.iter().sum(), im.iter().sum())).collect()
}

/// Adds eight terms to the first of the sums, and each of them times the next power of its step to the next.
#[inline(always)]
fn add_powers(sums: &mut [[[f64; LANES]; 2]], [mut re, mut im]: [[f64; LANES]; 2], steps: [[f64; LANES]; 2]) {
    for [sums_re, sums_im] in sums {
        for lane in 0..LANES {
            sums_re[lane] += re[lane];
            sums_im[lane] += im[lane];
            let next = re[lane] * steps[0][lane] - im[lane] * steps[1][lane];
            im[lane] = re[lane] * steps[1][lane] + im[lane] * steps[0][lane];
            re[lane] = next;
        }
    }
}

/// Sums over rows of samples, each of its sum times the phases of `count` waves.
#[inline(always)]
fn along_row<'a>(count: usize, samples: impl Iterator<Item = (Complex64, &'a [[[f64; 1]; 2]])>) -> Vec<Complex64> {
    let mut all = vec![Complex64::default(); count];
    for (sum, phases) in samples {
        for (wave, &[[re], [im]]) in all.iter_mut().zip(phases) {
            wave.re += sum.re * re - sum.im * im;
            wave.im += sum.re * im + sum.im * re;
        }
    }
    all
}
