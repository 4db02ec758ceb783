//! Periodic convolution u = F⁻¹[K · F p] on the grid, in place and in one fused pass.
//!
//! 1. Rows forward, real to complex: N₁ rows of N₂/2 + 1 components.
//! 2. Eight columns at a time: forward, times K or over K, inverse. Nothing is transposed as a whole.
//! 3. Rows back, complex to real.
//!
//! Between rows and columns the components stand in tiles: [part of the rows][eight columns][row][8 real, 8 imaginary
//! parts], so that rows fill, and columns gather, runs of memory that nobody else touches. Work is split into fixed parts:
//! neither the number of threads nor their order reaches the result, and nothing of the size of a field is allocated.
//! The factor 1/(N₁N₂) of the inverse transform stands in one place: [`Fourier::multiplier`] puts it into K.

mod butterflies;
mod columns;

use crate::numeric::lanes::{LANES, Real, vectorised};
use columns::{Columns, LINE};
use fearless_simd::prelude::*;
use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use std::fmt;
use std::sync::Arc;

/// Parts the rows are divided into.
const PARTS: usize = 16;

/// Plans for the transforms of N₁ × N₂ real samples of one precision.
#[derive(Clone)]
pub struct Fourier<T: Real> {
    points: [usize; 2],
    row_forward: Arc<dyn RealToComplex<T>>,
    row_inverse: Arc<dyn ComplexToReal<T>>,
    columns: Columns<T>,
    /// k₁ at each place of a column between forward and inverse.
    order: Vec<usize>,
}

/// A positive, even multiplier K(k₁, k₂), k₂ ≤ N₂/2, in the order of the column pass.
#[derive(Debug, Clone)]
pub struct Multiplier<T> {
    /// K/(N₁N₂), eight columns at a time, padded with ones.
    table: Vec<T>,
    /// 1/(N₁N₂).
    normalisation: f64,
}

impl Multiplier<f64> {
    /// `factor` K in single precision.
    pub fn single(&self, factor: f64) -> Multiplier<f32> {
        let table = self.table.par_iter().map(|&entry| (factor * entry) as f32).collect();
        Multiplier { table, normalisation: self.normalisation }
    }
}

/// What a convolution does with its multiplier K.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// u = F⁻¹[K · F p], of zero mean: the component (0, 0) is dropped.
    Times,
    /// u = F⁻¹[F p / K].
    Over,
}

/// Buffers of one convolution, used again and again, on any grid.
#[derive(Debug, Default)]
pub struct Workspace<T> {
    spectrum: Vec<T>,
}

impl<T: Real> Fourier<T> {
    /// Plans for `points` = [N₁, N₂].
    pub fn new(points: [usize; 2]) -> Self {
        let [n1, n2] = points;
        let (mut planner, columns) = (RealFftPlanner::new(), Columns::new(n1));
        Self {
            points,
            row_forward: planner.plan_fft_forward(n2),
            row_inverse: planner.plan_fft_inverse(n2),
            order: columns.order(n1),
            columns,
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

    /// Groups of eight columns.
    fn tiles(&self) -> usize {
        self.half().div_ceil(LANES)
    }

    /// The multiplier with the values `value([k₁, k₂])` > 0, 0 ≤ k₁ < N₁, 0 ≤ k₂ ≤ N₂/2.
    ///
    /// The value must be even under (k₁, k₂) → (−k₁, −k₂): then real fields stay real. Where it is also even in k₁ alone
    /// (`mirrored`), half of them are asked for.
    pub fn multiplier(&self, mirrored: bool, value: impl Fn([usize; 2]) -> f64 + Sync) -> Multiplier<T> {
        let [n1, n2] = self.points;
        let normalisation = 1.0 / (n1 as f64 * n2 as f64);
        let mut table = vec![T::one(); self.tiles() * n1 * LANES];
        table.par_chunks_mut(n1 * LANES).enumerate().for_each(|(tile, table)| {
            let mut lines = vec![[T::one(); LANES]; n1];
            for k1 in 0..if mirrored { n1 / 2 + 1 } else { n1 } {
                for (k2, entry) in (tile * LANES..self.half()).zip(&mut lines[k1]) {
                    *entry = T::rounded(normalisation * value([k1, k2]));
                }
                if mirrored {
                    lines[(n1 - k1) % n1] = lines[k1];
                }
            }
            for (line, &k1) in table.chunks_exact_mut(LANES).zip(&self.order) {
                line.copy_from_slice(&lines[k1]);
            }
        });
        Multiplier { table, normalisation }
    }

    /// The field u of N₁N₂ samples, a₂ fastest, becomes F⁻¹[K · F u] or F⁻¹[F u / K]; `finish(row, samples)` sees each row
    /// of the result, and what it returns is added up in the order of rows.
    ///
    /// # Panics
    /// When the field has other than N₁N₂ samples or the multiplier belongs to other `points`.
    pub fn convolve<const K: usize>(
        &self,
        action: Action,
        multiplier: &Multiplier<T>,
        field: &mut [T],
        workspace: &mut Workspace<T>,
        finish: impl Fn(usize, &mut [T]) -> [f64; K] + Sync,
    ) -> [f64; K] {
        let [n1, n2] = self.points;
        assert_eq!(field.len(), n1 * n2, "samples of a convolution");
        assert_eq!(multiplier.table.len(), self.tiles() * n1 * LANES, "multiplier of a convolution");
        let size = self.tiles() * n1 * LINE;
        if workspace.spectrum.len() < size {
            workspace.spectrum = vec![T::zero(); size];
        }
        let spectrum = &mut workspace.spectrum[..size];
        let part = n1.div_ceil(PARTS);
        self.rows_forward(field, part, spectrum);
        self.column_pass(action, multiplier, part, spectrum);
        self.rows_back(spectrum, part, field, finish)
    }

    fn rows_forward(&self, field: &mut [T], part: usize, spectrum: &mut [T]) {
        let (n2, half, tiles) = (self.points[1], self.half(), self.tiles());
        let parts = spectrum.par_chunks_mut(part * tiles * LINE).zip(field.par_chunks_mut(part * n2));
        parts.for_each(|(spectrum, field)| {
            let mut components = vec![Complex::new(T::zero(), T::zero()); tiles * LANES];
            let mut scratch = self.row_forward.make_scratch_vec();
            let run = field.len() / n2 * LINE;
            for (number, row) in field.chunks_exact_mut(n2).enumerate() {
                let done = self.row_forward.process_with_scratch(row, &mut components[..half], &mut scratch);
                done.expect("lengths were planned");
                let lines = spectrum.chunks_exact_mut(run).map(|tile| &mut tile[number * LINE..][..LINE]);
                vectorised!(simd => separate(simd, &components, lines));
            }
        });
    }

    fn column_pass(&self, action: Action, multiplier: &Multiplier<T>, part: usize, spectrum: &mut [T]) {
        let (n1, tiles) = (self.points[0], self.tiles());
        let mut gathered: Vec<Vec<&mut [T]>> = (0..tiles).map(|_| Vec::with_capacity(PARTS)).collect();
        for part in spectrum.chunks_mut(part * tiles * LINE) {
            let run = part.len() / tiles;
            part.chunks_exact_mut(run).zip(&mut gathered).for_each(|(run, tile)| tile.push(run));
        }
        let normalisation = multiplier.normalisation;
        let square = T::rounded(normalisation * normalisation);
        let buffers = || {
            let scratch = vec![Complex::new(T::zero(), T::zero()); self.columns.scratch(n1)];
            (vec![T::zero(); n1 * LINE], scratch)
        };
        let tables = multiplier.table.par_chunks(n1 * LANES);
        gathered.into_par_iter().zip(tables).enumerate().for_each_init(
            buffers,
            |(lines, scratch), (tile, (runs, table))| {
                let mut rest = &mut lines[..];
                for run in &runs {
                    let (to, after) = rest.split_at_mut(run.len());
                    to.copy_from_slice(run);
                    rest = after;
                }
                self.columns.forward(lines, scratch);
                match action {
                    Action::Times => {
                        vectorised!(simd => times(simd, table, lines));
                        if tile == 0 {
                            (lines[0], lines[LANES]) = (T::zero(), T::zero());
                        }
                    }
                    Action::Over => vectorised!(simd => over(simd, square, table, lines)),
                }
                self.columns.inverse(lines, scratch);
                let mut rest = &lines[..];
                for run in runs {
                    let (from, after) = rest.split_at(run.len());
                    run.copy_from_slice(from);
                    rest = after;
                }
            },
        );
    }

    /// Components that are their own conjugates are real, and what rounding leaves of their imaginary part is dropped.
    fn rows_back<const K: usize>(
        &self,
        spectrum: &[T],
        part: usize,
        field: &mut [T],
        finish: impl Fn(usize, &mut [T]) -> [f64; K] + Sync,
    ) -> [f64; K] {
        let (n2, half, tiles) = (self.points[1], self.half(), self.tiles());
        let parts = spectrum.par_chunks(part * tiles * LINE).zip(field.par_chunks_mut(part * n2)).enumerate();
        let sums: Vec<[f64; K]> = parts
            .map(|(index, (spectrum, field))| {
                let mut components = vec![Complex::new(T::zero(), T::zero()); tiles * LANES];
                let mut scratch = self.row_inverse.make_scratch_vec();
                let run = field.len() / n2 * LINE;
                let mut sums = [0.0; K];
                for (number, row) in field.chunks_exact_mut(n2).enumerate() {
                    let lines = spectrum.chunks_exact(run).map(|tile| &tile[number * LINE..][..LINE]);
                    vectorised!(simd => unite(simd, lines, &mut components));
                    components[0].im = T::zero();
                    if n2.is_multiple_of(2) {
                        components[half - 1].im = T::zero();
                    }
                    let done = self.row_inverse.process_with_scratch(&mut components[..half], row, &mut scratch);
                    done.expect("lengths were planned, what must be real is");
                    let of_row = finish(index * part + number, row);
                    sums.iter_mut().zip(of_row).for_each(|(sum, term)| *sum += term);
                }
                sums
            })
            .collect();
        sums.into_iter().fold([0.0; K], |mut total, part| {
            total.iter_mut().zip(part).for_each(|(total, part)| *total += part);
            total
        })
    }
}

/// The components of a row, real and imaginary parts apart, to the lines of its tiles.
#[inline(always)]
fn separate<'a, S: Simd, T: Real>(simd: S, components: &[Complex<T>], lines: impl Iterator<Item = &'a mut [T]>) {
    for (group, line) in components.chunks_exact(LANES).zip(lines) {
        let mut flat = [T::zero(); LINE];
        for (number, value) in group.iter().enumerate() {
            (flat[2 * number], flat[2 * number + 1]) = (value.re, value.im);
        }
        let (low, high) =
            (T::Lanes::<S>::from_slice(simd, &flat[..LANES]), T::Lanes::<S>::from_slice(simd, &flat[LANES..]));
        let (re, im) = low.deinterleave(high);
        re.store_slice(&mut line[..LANES]);
        im.store_slice(&mut line[LANES..]);
    }
}

/// The other way round.
#[inline(always)]
fn unite<'a, S: Simd, T: Real>(simd: S, lines: impl Iterator<Item = &'a [T]>, components: &mut [Complex<T>]) {
    for (group, line) in components.chunks_exact_mut(LANES).zip(lines) {
        let (re, im) =
            (T::Lanes::<S>::from_slice(simd, &line[..LANES]), T::Lanes::<S>::from_slice(simd, &line[LANES..]));
        let (low, high) = re.interleave(im);
        let mut flat = [T::zero(); LINE];
        low.store_slice(&mut flat[..LANES]);
        high.store_slice(&mut flat[LANES..]);
        for (number, value) in group.iter_mut().enumerate() {
            *value = Complex::new(flat[2 * number], flat[2 * number + 1]);
        }
    }
}

/// Each component times its factor.
#[inline(always)]
fn times<S: Simd, T: Real>(simd: S, table: &[T], lines: &mut [T]) {
    for (line, factors) in lines.chunks_exact_mut(LINE).zip(table.chunks_exact(LANES)) {
        let factor = T::Lanes::<S>::from_slice(simd, factors);
        let (re, im) = line.split_at_mut(LANES);
        (T::Lanes::<S>::from_slice(simd, re) * factor).store_slice(re);
        (T::Lanes::<S>::from_slice(simd, im) * factor).store_slice(im);
    }
}

/// Each component over its factor, times the square of the normalisation, which the factor holds once.
#[inline(always)]
fn over<S: Simd, T: Real>(simd: S, square: T, table: &[T], lines: &mut [T]) {
    for (line, factors) in lines.chunks_exact_mut(LINE).zip(table.chunks_exact(LANES)) {
        let factor = T::Lanes::<S>::simd_from(simd, square) / T::Lanes::<S>::from_slice(simd, factors);
        let (re, im) = line.split_at_mut(LANES);
        (T::Lanes::<S>::from_slice(simd, re) * factor).store_slice(re);
        (T::Lanes::<S>::from_slice(simd, im) * factor).store_slice(im);
    }
}

impl<T: Real> fmt::Debug for Fourier<T> {
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

    /// Mean errors of a convolution, and of what undoes it, against a symbol that is a sum of shifts.
    fn errors<T: Real>([n1, n2]: [usize; 2]) -> [f64; 2] {
        let fourier = Fourier::<T>::new([n1, n2]);
        let symbol = |k1: usize, k2: usize| {
            let (c1, c2) = (TAU * k1 as f64 / n1 as f64, TAU * k2 as f64 / n2 as f64);
            1.0 + 0.3 * c1.cos() + 0.2 * (c1 - c2).cos() + 0.1 * (2.0 * c2).cos()
        };
        let input = noise(n1 * n2);
        let mean = input.iter().sum::<f64>() / input.len() as f64;
        let multiplier = fourier.multiplier(false, |[k1, k2]| symbol(k1, k2));
        let (mut field, mut workspace) =
            (input.iter().map(|&x| T::rounded(x)).collect::<Vec<T>>(), Workspace::default());
        let at = |i: usize, j: usize| input[(i % n1) * n2 + j % n2] - mean;
        let expected = |i: usize, j: usize| {
            at(i, j)
                + 0.15 * (at(i + 1, j) + at(i + n1 - 1, j))
                + 0.1 * (at(i + 1, j + n2 - 1) + at(i + n1 - 1, j + 1))
                + 0.05 * (at(i, j + 2) + at(i, j + 2 * n2 - 2))
        };
        let [sum] = fourier.convolve(Action::Times, &multiplier, &mut field, &mut workspace, |i, row| {
            [row.iter().enumerate().map(|(j, u)| (u.wide() - expected(i, j)).abs()).sum()]
        });
        fourier.convolve(Action::Over, &multiplier, &mut field, &mut workspace, |_, _| []);
        let back = field.iter().enumerate().map(|(k, u)| (u.wide() - at(k / n2, k % n2)).abs());
        // Means, which a number that is none spoils.
        [sum, back.sum::<f64>()].map(|sum| sum / (n1 * n2) as f64)
    }

    #[test]
    fn a_convolution_is_its_direct_double_sum_and_can_be_undone() {
        for points in [[1, 1], [8, 6], [5, 9], [12, 20], [7, 4], [36, 50], [26, 22], [64, 128], [17, 34], [37, 19]] {
            assert!(
                errors::<f64>(points).into_iter().all(|error| error < 1e-15),
                "{points:?}: {:?}",
                errors::<f64>(points)
            );
            assert!(
                errors::<f32>(points).into_iter().all(|error| error < 5e-7),
                "{points:?}: {:?}",
                errors::<f32>(points)
            );
        }
    }
}
