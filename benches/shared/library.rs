//! The convolution of the bare half-space by the libraries `realfft` and `rustfft`, as fast as plain code makes them: rows
//! forward; columns eight at a time, gathered into a block, transformed, multiplied, transformed back and scattered; rows back.
//!
//! Between rows and columns the components stand in tiles of eight columns, [tile][row][column], so that nothing is transposed
//! as a whole. The number of points is a multiple of eight.

use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftNum, FftPlanner, num_complex::Complex};
use std::f64::consts::PI;
use std::sync::Arc;

/// Columns of a tile, and rows of a group.
const EIGHT: usize = 8;

/// Plans, factors and the spectrum of n × n samples of the unit square, E* = 1.
pub struct Library<T: FftNum + Default> {
    n: usize,
    row_forward: Arc<dyn RealToComplex<T>>,
    row_inverse: Arc<dyn ComplexToReal<T>>,
    column_forward: Arc<dyn Fft<T>>,
    column_inverse: Arc<dyn Fft<T>>,
    /// 2/(E* q n²), [tile][column][row]; zero for the mean, and beyond the last column.
    factors: Vec<T>,
    spectrum: Vec<Complex<T>>,
}

impl<T: FftNum + Default> Library<T> {
    pub fn new(n: usize) -> Self {
        assert!(n.is_multiple_of(EIGHT), "{n} points");
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let factor = |index: usize| {
            let (k1, k2) = (index % n, index / n);
            let k = (k1.min(n - k1) as f64).hypot(k2 as f64);
            let factor = if k == 0.0 || k2 > n / 2 { 0.0 } else { 1.0 / (PI * k * (n * n) as f64) };
            T::from_f64(factor).expect("a number")
        };
        let size = (n / 2 + 1).next_multiple_of(EIGHT) * n;
        Self {
            n,
            row_forward: real.plan_fft_forward(n),
            row_inverse: real.plan_fft_inverse(n),
            column_forward: complex.plan_fft_forward(n),
            column_inverse: complex.plan_fft_inverse(n),
            factors: (0..size).map(factor).collect(),
            spectrum: vec![Complex::default(); size],
        }
    }

    /// Pressure → displacement, in place.
    pub fn run(&mut self, field: &mut [T]) {
        self.rows_forward(field);
        self.columns();
        self.rows_back(field);
    }

    /// Components of a row, in whole tiles.
    fn width(&self) -> usize {
        self.spectrum.len() / self.n
    }

    fn rows_forward(&mut self, field: &mut [T]) {
        let (n, half, width, plan) = (self.n, self.n / 2 + 1, self.width(), &*self.row_forward);
        // Parts of each tile, by groups of rows.
        let mut groups: Vec<Vec<&mut [Complex<T>]>> = (0..n / EIGHT).map(|_| Vec::new()).collect();
        for tile in self.spectrum.chunks_exact_mut(n * EIGHT) {
            tile.chunks_exact_mut(EIGHT * EIGHT).zip(&mut groups).for_each(|(lines, group)| group.push(lines));
        }
        let memory = || (vec![Complex::default(); EIGHT * width], plan.make_scratch_vec());
        field.par_chunks_exact_mut(EIGHT * n).zip(groups).for_each_init(memory, |(rows, scratch), (samples, group)| {
            for (samples, row) in samples.chunks_exact_mut(n).zip(rows.chunks_exact_mut(width)) {
                plan.process_with_scratch(samples, &mut row[..half], scratch).expect("lengths match");
            }
            for (tile, lines) in group.into_iter().enumerate() {
                for (row, line) in rows.chunks_exact(width).zip(lines.chunks_exact_mut(EIGHT)) {
                    line.copy_from_slice(&row[tile * EIGHT..][..EIGHT]);
                }
            }
        });
    }

    fn columns(&mut self) {
        let (n, forward, inverse) = (self.n, &*self.column_forward, &*self.column_inverse);
        let scratch = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
        let memory = || (vec![Complex::default(); EIGHT * n], vec![Complex::default(); scratch]);
        let tiles = self.spectrum.par_chunks_exact_mut(EIGHT * n).zip(self.factors.par_chunks_exact(EIGHT * n));
        tiles.for_each_init(memory, |(block, scratch), (lines, factors)| {
            for (row, line) in lines.chunks_exact(EIGHT).enumerate() {
                line.iter().enumerate().for_each(|(column, &value)| block[column * n + row] = value);
            }
            forward.process_with_scratch(block, scratch);
            block.iter_mut().zip(factors).for_each(|(value, &factor)| *value = *value * factor);
            inverse.process_with_scratch(block, scratch);
            for (row, line) in lines.chunks_exact_mut(EIGHT).enumerate() {
                line.iter_mut().enumerate().for_each(|(column, value)| *value = block[column * n + row]);
            }
        });
    }

    fn rows_back(&self, field: &mut [T]) {
        let (n, half, width, plan) = (self.n, self.n / 2 + 1, self.width(), &*self.row_inverse);
        let memory = || (vec![Complex::default(); EIGHT * width], plan.make_scratch_vec());
        field.par_chunks_exact_mut(EIGHT * n).enumerate().for_each_init(memory, |(rows, scratch), (group, samples)| {
            for (tile, lines) in self.spectrum.chunks_exact(EIGHT * n).enumerate() {
                let lines = lines[group * EIGHT * EIGHT..].chunks_exact(EIGHT);
                for (row, line) in rows.chunks_exact_mut(width).zip(lines) {
                    row[tile * EIGHT..][..EIGHT].copy_from_slice(line);
                }
            }
            for (samples, row) in samples.chunks_exact_mut(n).zip(rows.chunks_exact_mut(width)) {
                // Real but for rounding, as they have to be.
                (row[0].im, row[half - 1].im) = (T::zero(), T::zero());
                plan.process_with_scratch(&mut row[..half], samples, scratch).expect("lengths match");
            }
        });
    }
}
