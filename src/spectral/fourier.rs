//! Periodic convolution u = F⁻¹[K · F p] on the grid in one fused pass.
//!
//! 1. Rows forward, real to complex: N₁ rows of N₂/2 + 1 components.
//! 2. Per block of 8 columns: gather, forward, multiply by K, inverse. Nothing is transposed as a whole.
//! 3. Rows back, complex to real.
//!
//! Work is split into a fixed number of contiguous parts, each with its own scratch, so that neither the number of
//! threads nor their order reaches the result, and nothing is allocated per call. The factor 1/(N₁N₂) of the inverse
//! transform stands in one place: [`Fourier::multiplier`] puts it into K.

use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner, num_complex::Complex64};
use std::fmt;
use std::sync::Arc;

/// Columns transformed together: 8 complex numbers are two cache lines of each row.
const COLUMNS: usize = 8;
/// Complex numbers between columns, and between blocks, so that a power of two points does not put them all into the
/// same lines of a cache.
const PAD: usize = 8;
/// Parts the rows, and the column blocks, are divided into.
const PARTS: usize = 16;

/// Plans for the transforms of N₁ × N₂ real samples.
#[derive(Clone)]
pub struct Fourier {
    points: [usize; 2],
    row_forward: Arc<dyn RealToComplex<f64>>,
    row_inverse: Arc<dyn ComplexToReal<f64>>,
    column_forward: Arc<dyn Fft<f64>>,
    column_inverse: Arc<dyn Fft<f64>>,
}

/// A real, even multiplier K(k₁, k₂) for k₂ ≤ N₂/2, in the order of the column pass.
#[derive(Debug, Clone)]
pub struct Multiplier {
    /// K/(N₁N₂), column by column.
    table: Vec<f64>,
    /// 1/(N₁N₂).
    normalisation: f64,
}

impl Multiplier {
    /// The multiplier 1/K, with `mean` for the component (0, 0).
    pub fn inverse(&self, mean: f64) -> Self {
        let normalisation = self.normalisation;
        let mut table: Vec<f64> = self.table.par_iter().map(|k| normalisation * normalisation / k).collect();
        table[0] = normalisation * mean;
        Self { table, normalisation }
    }
}

/// Buffers of one convolution, owned by the caller and used again and again.
#[derive(Debug)]
pub struct Workspace {
    rows: Vec<Complex64>,
    blocks: Vec<Complex64>,
    scratch: Vec<Scratch>,
}

#[derive(Debug, Clone)]
struct Scratch {
    real: Vec<f64>,
    spectrum: Vec<Complex64>,
    columns: Vec<Complex64>,
    fft: Vec<Complex64>,
}

impl Fourier {
    /// Plans for `points` = [N₁, N₂].
    pub fn new(points: [usize; 2]) -> Self {
        let [n1, n2] = points;
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        Self {
            points,
            row_forward: real.plan_fft_forward(n2),
            row_inverse: real.plan_fft_inverse(n2),
            column_forward: complex.plan_fft_forward(n1),
            column_inverse: complex.plan_fft_inverse(n1),
        }
    }

    /// [N₁, N₂].
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// Components of a row, N₂/2 + 1.
    fn half(&self) -> usize {
        self.points[1] / 2 + 1
    }

    /// Complex numbers from one row to the next: whole blocks of columns, whose borders are borders of cache lines.
    fn row_stride(&self) -> usize {
        self.half().div_ceil(COLUMNS) * COLUMNS
    }

    /// Complex numbers from one block of columns to the next.
    fn block_stride(&self) -> usize {
        COLUMNS * self.points[0] + PAD
    }

    /// Buffers for [`Fourier::convolve`].
    pub fn workspace(&self) -> Workspace {
        let [n1, n2] = self.points;
        let zero = Complex64::new(0.0, 0.0);
        let fft = [
            self.row_forward.get_scratch_len(),
            self.row_inverse.get_scratch_len(),
            self.column_forward.get_inplace_scratch_len(),
            self.column_inverse.get_inplace_scratch_len(),
        ];
        let scratch = Scratch {
            real: vec![0.0; n2],
            spectrum: vec![zero; self.half()],
            columns: vec![zero; COLUMNS * (n1 + PAD)],
            fft: vec![zero; fft.into_iter().max().unwrap_or(0)],
        };
        Workspace {
            rows: vec![zero; n1 * self.row_stride()],
            blocks: vec![zero; self.half().div_ceil(COLUMNS) * self.block_stride()],
            scratch: vec![scratch; PARTS],
        }
    }

    /// The multiplier with the values `value([k₁, k₂])`, 0 ≤ k₁ < N₁, 0 ≤ k₂ ≤ N₂/2.
    ///
    /// The value must be even under (k₁, k₂) → (−k₁, −k₂): then real fields stay real.
    pub fn multiplier(&self, value: impl Fn([usize; 2]) -> f64 + Sync) -> Multiplier {
        let [n1, n2] = self.points;
        let normalisation = 1.0 / (n1 as f64 * n2 as f64);
        let mut table = vec![0.0; self.half() * n1];
        table.par_chunks_mut(n1).enumerate().for_each(|(k2, column)| {
            for (k1, entry) in column.iter_mut().enumerate() {
                *entry = normalisation * value([k1, k2]);
            }
        });
        Multiplier { table, normalisation }
    }

    /// output = F⁻¹[K · F input]; both hold N₁N₂ samples, a₂ fastest.
    ///
    /// # Panics
    /// When a length differs from N₁N₂ or the multiplier or workspace belongs to other `points`.
    pub fn convolve(&self, multiplier: &Multiplier, input: &[f64], output: &mut [f64], workspace: &mut Workspace) {
        let [n1, n2] = self.points;
        assert_eq!(input.len(), n1 * n2, "input of a convolution");
        assert_eq!(output.len(), n1 * n2, "output of a convolution");
        assert_eq!(multiplier.table.len(), self.half() * n1, "multiplier of a convolution");
        assert_eq!(workspace.rows.len(), n1 * self.row_stride(), "workspace of a convolution");
        let Workspace { rows, blocks, scratch } = workspace;
        self.rows_forward(input, rows, scratch);
        self.columns(multiplier, rows, blocks, scratch);
        self.rows_back(blocks, output, scratch);
    }

    /// Fourier coefficients F p /(N₁N₂) of N₁N₂ samples: N₂/2 + 1 columns of N₁ components, k₁ fastest.
    pub fn analyse(&self, samples: &[f64]) -> Vec<Complex64> {
        let ([n1, n2], half) = (self.points, self.half());
        let mut workspace = self.workspace();
        self.rows_forward(samples, &mut workspace.rows, &mut workspace.scratch);
        let rows = &workspace.rows;
        let normalisation = 1.0 / (n1 as f64 * n2 as f64);
        let mut columns = vec![Complex64::new(0.0, 0.0); half * n1];
        columns.par_chunks_mut(n1).enumerate().for_each(|(k2, column)| {
            for (i, value) in column.iter_mut().enumerate() {
                *value = normalisation * rows[i * self.row_stride() + k2];
            }
            self.column_forward.process(column);
        });
        columns
    }

    /// The samples with the given Fourier coefficients, laid out as [`Fourier::analyse`] returns them.
    pub fn synthesise(&self, mut columns: Vec<Complex64>) -> Vec<f64> {
        let ([n1, n2], half) = (self.points, self.half());
        columns.par_chunks_mut(n1).for_each(|column| self.column_inverse.process(column));
        let mut samples = vec![0.0; n1 * n2];
        samples.par_chunks_mut(n2).enumerate().for_each(|(i, samples)| {
            let mut row: Vec<Complex64> = (0..half).map(|k2| columns[k2 * n1 + i]).collect();
            self.row_inverse_real(
                &mut row,
                samples,
                &mut vec![Complex64::default(); self.row_inverse.get_scratch_len()],
            );
        });
        samples
    }

    /// One row back; components that are their own conjugates are real, and what rounding leaves of their imaginary
    /// part is dropped.
    fn row_inverse_real(&self, row: &mut [Complex64], samples: &mut [f64], scratch: &mut [Complex64]) {
        row[0].im = 0.0;
        if self.points[1].is_multiple_of(2) {
            row[self.half() - 1].im = 0.0;
        }
        let done = self.row_inverse.process_with_scratch(row, samples, scratch);
        debug_assert!(done.is_ok(), "lengths were planned");
    }

    fn rows_forward(&self, input: &[f64], rows: &mut [Complex64], scratch: &mut [Scratch]) {
        let ([n1, n2], half, stride) = (self.points, self.half(), self.row_stride());
        let part = n1.div_ceil(PARTS);
        rows.par_chunks_mut(part * stride).zip(input.par_chunks(part * n2)).zip(scratch).for_each(
            |((rows, input), scratch)| {
                for (row, samples) in rows.chunks_exact_mut(stride).zip(input.chunks_exact(n2)) {
                    scratch.real.copy_from_slice(samples);
                    let row = &mut row[..half];
                    let done = self.row_forward.process_with_scratch(&mut scratch.real, row, &mut scratch.fft);
                    debug_assert!(done.is_ok(), "lengths were planned");
                }
            },
        );
    }

    fn columns(&self, multiplier: &Multiplier, rows: &[Complex64], blocks: &mut [Complex64], scratch: &mut [Scratch]) {
        let ([n1, _], half, stride) = (self.points, self.half(), self.row_stride());
        let part = half.div_ceil(COLUMNS).div_ceil(PARTS);
        let size = self.block_stride();
        blocks.par_chunks_mut(part * size).enumerate().zip(scratch).for_each(|((part_index, blocks), scratch)| {
            let Scratch { columns, fft, .. } = scratch;
            for (index, block) in blocks.chunks_exact_mut(size).enumerate() {
                let first = (part_index * part + index) * COLUMNS;
                let count = COLUMNS.min(half - first);
                for (i, row) in rows.chunks_exact(stride).enumerate() {
                    for (c, &value) in row[first..first + count].iter().enumerate() {
                        columns[c * (n1 + PAD) + i] = value;
                    }
                }
                for (c, column) in columns.chunks_exact_mut(n1 + PAD).take(count).enumerate() {
                    let column = &mut column[..n1];
                    self.column_forward.process_with_scratch(column, fft);
                    for (value, &factor) in column.iter_mut().zip(&multiplier.table[(first + c) * n1..]) {
                        *value *= factor;
                    }
                    self.column_inverse.process_with_scratch(column, fft);
                }
                for (i, line) in block[..COLUMNS * n1].chunks_exact_mut(COLUMNS).enumerate() {
                    for (c, value) in line[..count].iter_mut().enumerate() {
                        *value = columns[c * (n1 + PAD) + i];
                    }
                }
            }
        });
    }

    fn rows_back(&self, blocks: &[Complex64], output: &mut [f64], scratch: &mut [Scratch]) {
        let [n1, n2] = self.points;
        let part = n1.div_ceil(PARTS);
        output.par_chunks_mut(part * n2).enumerate().zip(scratch).for_each(|((part_index, output), scratch)| {
            for (index, samples) in output.chunks_exact_mut(n2).enumerate() {
                let i = part_index * part + index;
                for (line, block) in scratch.spectrum.chunks_mut(COLUMNS).zip(blocks.chunks_exact(self.block_stride()))
                {
                    line.copy_from_slice(&block[i * COLUMNS..i * COLUMNS + line.len()]);
                }
                self.row_inverse_real(&mut scratch.spectrum, samples, &mut scratch.fft);
            }
        });
    }
}

impl fmt::Debug for Fourier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Fourier").field("points", &self.points).finish_non_exhaustive()
    }
}

/// The least number ≥ `n` whose prime factors are 2, 3, 5 and 7, for which transforms are fast.
pub fn fast_points(n: usize) -> usize {
    (n.max(1)..).find(|&m| has_fast_factors(m)).unwrap_or(n)
}

/// Whether the prime factors of `n` are 2, 3, 5 and 7 only.
pub fn has_fast_factors(n: usize) -> bool {
    let mut rest = n;
    for factor in [2, 3, 5, 7] {
        while rest > 0 && rest.is_multiple_of(factor) {
            rest /= factor;
        }
    }
    rest == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn noise(len: usize) -> Vec<f64> {
        let mut state = 0x2545_f491_4f6c_dd1d_u64;
        (0..len)
            .map(|_| {
                state ^= state << 13;
                state ^= state >> 7;
                state ^= state << 17;
                state as f64 / u64::MAX as f64 - 0.5
            })
            .collect()
    }

    #[test]
    fn a_convolution_is_its_direct_double_sum() {
        for [n1, n2] in [[8, 6], [5, 9], [12, 20], [7, 4], [36, 50]] {
            let fourier = Fourier::new([n1, n2]);
            let symbol = |k1: usize, k2: usize| {
                let (c1, c2) = (TAU * k1 as f64 / n1 as f64, TAU * k2 as f64 / n2 as f64);
                1.0 + 0.3 * c1.cos() + 0.2 * (c1 - c2).cos() + 0.1 * (2.0 * c2).cos()
            };
            let input = noise(n1 * n2);
            let mut output = vec![0.0; n1 * n2];
            let multiplier = fourier.multiplier(|[k1, k2]| symbol(k1, k2));
            fourier.convolve(&multiplier, &input, &mut output, &mut fourier.workspace());
            // The symbol is a sum of shifts.
            let at = |i: usize, j: usize| input[(i % n1) * n2 + j % n2];
            for (i, j) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))) {
                let expected = at(i, j)
                    + 0.15 * (at(i + 1, j) + at(i + n1 - 1, j))
                    + 0.1 * (at(i + 1, j + n2 - 1) + at(i + n1 - 1, j + 1))
                    + 0.05 * (at(i, j + 2) + at(i, j + 2 * n2 - 2));
                assert!((output[i * n2 + j] - expected).abs() < 1e-14, "{n1} × {n2}");
            }
        }
    }
}
