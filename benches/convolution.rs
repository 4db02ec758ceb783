//! One convolution against its slow twin with full transposes, and the kernel evaluated over a whole grid.
//!
//! `cargo bench` prints both in one run; only their ratio means something on a noisy machine.

use divan::Bencher;
use percoat::body::TransferFunction;
use percoat::spectral::fourier::Fourier;
use percoat::spectral::operator::Operator;
use percoat::{Cell, Grid, HalfSpace, Interface, Layer, Material};
use rayon::prelude::*;
use realfft::RealFftPlanner;
use rustfft::{FftPlanner, num_complex::Complex64};
use std::sync::Arc;

fn main() {
    divan::main();
}

const POINTS: [usize; 3] = [512, 1024, 2048];

fn half_space() -> HalfSpace {
    let substrate = Material::from_young(1.0, 0.3).expect("valid");
    let coating = Material::from_shear(2.0 * substrate.shear(), 0.2).expect("valid");
    HalfSpace::new(vec![Layer::new(coating, 0.5, Interface::Bonded).expect("valid")], substrate)
}

#[divan::bench(args = POINTS)]
fn fused_pass(bencher: Bencher, n: usize) {
    let fourier = Fourier::new([n, n]);
    let multiplier = fourier.multiplier(|[k1, k2]| 1.0 / (1.0 + (k1 + k2) as f64));
    let input = vec![1.0; n * n];
    let mut output = vec![0.0; n * n];
    let mut workspace = fourier.workspace();
    bencher.bench_local(|| fourier.convolve(&multiplier, &input, &mut output, &mut workspace));
}

#[divan::bench(args = POINTS)]
fn full_transposes(bencher: Bencher, n: usize) {
    let (mut real, mut complex) = (RealFftPlanner::<f64>::new(), FftPlanner::<f64>::new());
    let (forward, inverse) = (real.plan_fft_forward(n), real.plan_fft_inverse(n));
    let (column_forward, column_inverse) = (complex.plan_fft_forward(n), complex.plan_fft_inverse(n));
    let half = n / 2 + 1;
    let zero = Complex64::new(0.0, 0.0);
    let (mut rows, mut columns) = (vec![zero; n * half], vec![zero; n * half]);
    let input = vec![1.0; n * n];
    // The transforms overwrite what they read: rows are copied to the output, as large as they are, and read there.
    let mut output = vec![0.0; n * n];
    let transpose = |from: &[Complex64], to: &mut [Complex64], width: usize, height: usize| {
        to.par_chunks_mut(height).enumerate().for_each(|(c, line)| {
            for (r, value) in line.iter_mut().enumerate() {
                *value = from[r * width + c];
            }
        });
    };
    bencher.bench_local(|| {
        output.copy_from_slice(&input);
        rows.par_chunks_mut(half).zip(output.par_chunks_mut(n)).for_each(|(row, samples)| {
            forward.process(samples, row).expect("lengths match");
        });
        transpose(&rows, &mut columns, half, n);
        columns.par_chunks_mut(n).enumerate().for_each(|(k2, column)| {
            column_forward.process(column);
            for (k1, value) in column.iter_mut().enumerate() {
                *value *= 1.0 / (1.0 + (k1 + k2) as f64);
            }
            column_inverse.process(column);
        });
        transpose(&columns, &mut rows, n, half);
        output.par_chunks_mut(n).zip(rows.par_chunks_mut(half)).for_each(|(samples, row)| {
            row[0].im = 0.0;
            row[half - 1].im = 0.0;
            inverse.process(row, samples).expect("lengths match");
        });
    });
}

#[divan::bench(args = POINTS)]
fn kernel_of_one_layer(bencher: Bencher, n: usize) {
    let grid = Arc::new(Grid::new(Cell::hexagonal(1.0).expect("valid"), [n, n]).expect("valid"));
    let transfer = TransferFunction::new(&half_space());
    bencher.bench_local(|| Operator::new(&grid, &transfer));
}
