//! Real fields and their Fourier coefficients on n₁ × n₂ points,
//!
//! f(i, j) = Σ F(k₁, k₂) e^{2πi (k₁i/n₁ + k₂j/n₂)},  F(−k₁, −k₂) = F*(k₁, k₂): half of the columns k₂ tell all.
//!
//! Several fields are transformed at once: first all columns, by blocks, each where it is filled in, then single rows,
//! which may be used up as they come and need not be kept. A column or a row is the work of one thread, so that their number
//! does not reach the result.

use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;
use rustfft::{Fft, FftPlanner};
use std::fmt;
use std::sync::Arc;

/// Columns of a block: 8 complex numbers are two lines of a cache.
const BLOCK: usize = 8;
/// Complex numbers between columns, so that a power of two does not put them all into the same lines of a cache.
const PAD: usize = 8;

/// Transforms between fields and coefficients on [n₁, n₂] points.
pub(super) struct Transform {
    points: [usize; 2],
    columns: [Arc<dyn Fft<f64>>; 2],
    forward: Arc<dyn RealToComplex<f64>>,
    back: Arc<dyn ComplexToReal<f64>>,
}

/// K fields transformed along their columns: by blocks of columns, then fields, rows, columns of the block.
pub(super) struct Columns<'a, const K: usize> {
    transform: &'a Transform,
    values: Vec<Complex64>,
}

/// K rows of real fields, and what their transform needs.
pub(super) struct Rows<const K: usize> {
    spectrum: Vec<Complex64>,
    scratch: Vec<Complex64>,
    samples: Vec<f64>,
}

impl Transform {
    /// On [n₁, n₂] points.
    pub fn new(points: [usize; 2]) -> Self {
        let (mut complex, mut real) = (FftPlanner::new(), RealFftPlanner::new());
        let columns = [complex.plan_fft_forward(points[0]), complex.plan_fft_inverse(points[0])];
        Self { points, columns, forward: real.plan_fft_forward(points[1]), back: real.plan_fft_inverse(points[1]) }
    }

    /// [n₁, n₂].
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// Columns 0 ≤ k₂ ≤ n₂/2.
    fn half(&self) -> usize {
        self.points[1] / 2 + 1
    }

    /// Fourier coefficients of a field, its samples row by row: half of the columns, k₁ fastest.
    pub fn analysed(&self, samples: &[f64]) -> Vec<Complex64> {
        let ([n1, n2], half) = (self.points, self.half());
        let mut rows = vec![Complex64::default(); n1 * half];
        rows.par_chunks_mut(half).zip(samples.par_chunks(n2)).for_each_init(
            || (vec![0.0; n2], self.forward.make_scratch_vec()),
            |(input, scratch), (row, samples)| {
                input.copy_from_slice(samples);
                let done = self.forward.process_with_scratch(input, row, scratch);
                debug_assert!(done.is_ok(), "lengths were planned");
            },
        );
        let normalisation = 1.0 / (n1 as f64 * n2 as f64);
        let [forward, _] = &self.columns;
        let mut columns = vec![Complex64::default(); half * n1];
        columns.par_chunks_mut(BLOCK * n1).enumerate().for_each_init(
            || vec![Complex64::default(); forward.get_inplace_scratch_len()],
            |scratch, (block, columns)| {
                for (i, row) in rows.chunks_exact(half).enumerate() {
                    for (column, value) in columns.chunks_exact_mut(n1).zip(&row[block * BLOCK..]) {
                        column[i] = normalisation * value;
                    }
                }
                forward.process_with_scratch(columns, scratch);
            },
        );
        columns
    }

    /// K fields along their columns. `fill` adds the coefficients of column k₂ to K columns of zeros; where it says that
    /// there are none, nothing is transformed. The `room` is that of columns that are needed no more, or empty.
    pub fn columns<const K: usize>(
        &self,
        room: Vec<Complex64>,
        fill: impl Fn(usize, &mut [&mut [Complex64]; K]) -> bool + Sync,
    ) -> Columns<'_, K> {
        let ([n1, _], half) = (self.points, self.half());
        let [_, inverse] = &self.columns;
        let (size, mut values) = (half.div_ceil(BLOCK) * K * n1 * BLOCK, room);
        // Fresh memory is zero, and costs nothing before it is written.
        let is_fresh = values.len() != size;
        if is_fresh {
            values = vec![Complex64::default(); size];
        }
        values.par_chunks_mut(K * n1 * BLOCK).enumerate().for_each_init(
            || {
                let scratch = vec![Complex64::default(); inverse.get_inplace_scratch_len()];
                (vec![Complex64::default(); K * BLOCK * (n1 + PAD)], scratch)
            },
            |(columns, scratch), (block, values)| {
                let first = block * BLOCK;
                let count = BLOCK.min(half - first);
                let mut any = [false; BLOCK];
                for c in 0..count {
                    let mut all = columns[c * K * (n1 + PAD)..].chunks_mut(n1 + PAD);
                    let mut own: [&mut [Complex64]; K] =
                        std::array::from_fn(|_| all.next().map_or(&mut [][..], |column| &mut column[..n1]));
                    own.iter_mut().for_each(|column| column.fill(Complex64::default()));
                    any[c] = fill(first + c, &mut own);
                    if any[c] {
                        own.iter_mut().for_each(|column| inverse.process_with_scratch(column, scratch));
                    }
                }
                if any.contains(&true) {
                    for (k, field) in values.chunks_exact_mut(n1 * BLOCK).enumerate() {
                        for (i, line) in field.chunks_exact_mut(BLOCK).enumerate() {
                            for (c, value) in line[..count].iter_mut().enumerate() {
                                *value = columns[(c * K + k) * (n1 + PAD) + i];
                            }
                        }
                    }
                } else if !is_fresh {
                    values.fill(Complex64::default());
                }
            },
        );
        Columns { transform: self, values }
    }
}

impl<const K: usize> Columns<'_, K> {
    /// What rows need, for one thread.
    pub fn rows(&self) -> Rows<K> {
        let transform = self.transform;
        Rows {
            spectrum: vec![Complex64::default(); transform.half()],
            scratch: transform.back.make_scratch_vec(),
            samples: vec![0.0; K * transform.points[1]],
        }
    }

    /// Row i of the fields.
    pub fn row<'a>(&self, i: usize, rows: &'a mut Rows<K>) -> [&'a [f64]; K] {
        let Transform { points: [n1, n2], ref back, .. } = *self.transform;
        let size = K * n1 * BLOCK;
        for (k, samples) in rows.samples.chunks_exact_mut(n2).enumerate() {
            for (line, block) in rows.spectrum.chunks_mut(BLOCK).zip(self.values.chunks_exact(size)) {
                let from = (k * n1 + i) * BLOCK;
                line.copy_from_slice(&block[from..from + line.len()]);
            }
            // Coefficients that are their own conjugates are real up to rounding.
            rows.spectrum[0].im = 0.0;
            if n2.is_multiple_of(2) {
                rows.spectrum[n2 / 2].im = 0.0;
            }
            let done = back.process_with_scratch(&mut rows.spectrum, samples, &mut rows.scratch);
            debug_assert!(done.is_ok(), "lengths were planned");
        }
        let samples = &rows.samples;
        std::array::from_fn(|k| &samples[k * n2..(k + 1) * n2])
    }

    /// The room they take, for others.
    pub fn into_room(self) -> Vec<Complex64> {
        self.values
    }

    /// `read` of each row: its number, and the rows of the fields.
    pub fn map<R: Send>(&self, read: impl Fn(usize, [&[f64]; K]) -> R + Sync) -> Vec<R> {
        let each = |rows: &mut Rows<K>, i: usize| read(i, self.row(i, rows));
        (0..self.transform.points[0]).into_par_iter().map_init(|| self.rows(), each).collect()
    }

    /// The fields, one after the other.
    pub fn write(&self, fields: &mut [f64]) {
        let [n1, n2] = self.transform.points;
        let mut lines: Vec<Vec<&mut [f64]>> = (0..n1).map(|_| Vec::with_capacity(K)).collect();
        for field in fields.chunks_exact_mut(n1 * n2) {
            lines.iter_mut().zip(field.chunks_exact_mut(n2)).for_each(|(line, row)| line.push(row));
        }
        lines.par_iter_mut().enumerate().for_each_init(
            || self.rows(),
            |rows, (i, line)| line.iter_mut().zip(self.row(i, rows)).for_each(|(to, from)| to.copy_from_slice(from)),
        );
    }
}

impl fmt::Debug for Transform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Transform").field("points", &self.points).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn fields_come_back_from_their_coefficients_and_those_are_direct_sums() {
        for [n1, n2] in [[8, 6], [5, 9], [12, 20], [1, 4], [7, 1]] {
            let transform = Transform::new([n1, n2]);
            let field = |k: usize| (0..n1 * n2).map(move |i| ((i * i * 31 + 7 * i + 5 * k) % 101) as f64 / 101.0);
            let fields: Vec<f64> = field(1).chain(field(2)).collect();
            let spectra: Vec<Vec<Complex64>> =
                fields.chunks(n1 * n2).map(|samples| transform.analysed(samples)).collect();
            let [k1, k2] = [n1 - 1, n2 / 2];
            let wave = |i: usize| ((k1 * (i / n2)) as f64 / n1 as f64 + (k2 * (i % n2)) as f64 / n2 as f64) * -TAU;
            let direct: Complex64 = field(1).enumerate().map(|(i, x)| x * Complex64::cis(wave(i))).sum();
            assert!((spectra[0][k2 * n1 + k1] - direct / (n1 * n2) as f64).norm() < 1e-14);

            let columns = transform.columns(Vec::new(), |k2, own: &mut [&mut [Complex64]; 2]| {
                let from = spectra.iter().map(|spectrum| &spectrum[k2 * n1..][..n1]);
                own.iter_mut().zip(from).for_each(|(column, from)| column.copy_from_slice(from));
                true
            });
            let mut back = vec![0.0; 2 * n1 * n2];
            columns.write(&mut back);
            assert!(back.iter().zip(&fields).all(|(a, b)| (a - b).abs() < 1e-13), "{n1} × {n2}");
            let firsts: Vec<f64> = columns.map(|_, [_, second]| second[0]);
            assert!(firsts.iter().zip(back[n1 * n2..].chunks(n2)).all(|(first, row)| *first == row[0]));
        }
    }
}
