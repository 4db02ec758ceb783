//! One convolution, beside its slow twin with full transposes: only their ratio means something on a noisy machine.

mod shared;

use divan::Bencher;
use rayon::prelude::*;
use realfft::RealFftPlanner;
use rustfft::{FftPlanner, num_complex::Complex64};
use shared::{Convolution, bare};

fn main() {
    divan::main();
}

const POINTS: [usize; 7] = [512, 768, 1024, 1536, 2048, 3072, 4096];

#[divan::bench(args = POINTS, max_time = 5)]
fn one(bencher: Bencher, n: usize) {
    let mut convolution = Convolution::new(&bare(), n);
    let (pressure, mut displacement) = (vec![1.0; n * n], vec![0.0; n * n]);
    bencher.bench_local(|| convolution.run(&pressure, &mut displacement));
}

#[divan::bench(args = POINTS, max_time = 5)]
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
