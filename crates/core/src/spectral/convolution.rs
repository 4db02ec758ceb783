//! Periodic convolution u = F⁻¹[K · F p] on the grid, in one fused pass.
//!
//! 1. Rows forward, a group at a time, real to complex: N₁ rows of N₂/2 + 1 components.
//! 2. A tile of columns at a time: forward, times K or over K, inverse. Nothing is transposed as a whole.
//! 3. Rows back, complex to real.
//!
//! Rows of a group and columns of a tile are as many as take 64 bytes: eight in double, sixteen in single precision. Between
//! rows and columns the components lie in tiles, [tile][row][real parts, imaginary parts], where columns are transformed
//! in place. A block of the rows has a run of lines in every tile; only the thread that transforms these rows writes there. Work is split into fixed
//! blocks: neither the number of threads nor their order reaches the result, and nothing of the size of a field is allocated.
//! Groups of rows whose samples are all zero, and groups whose result is not used ([`ResultRows::some_rows`]), are not transformed.
//! Rows come from a source and go to a sink, one after the other in each block (`by_rows`).
//!
//! **Padded**, the samples are a window of those that are transformed, the first of each row and the first rows; the others are
//! zero before and not used after. Rows of zeros have no place between the passes: a column gets them while it is transformed.
//! The factor 1/(N₁N₂) of the inverse transform is applied in one place: [`Convolution::multiplier`] puts it into K.

mod pair;

pub use pair::{PairAction, ShearMultiplier, VectorMultiplier};

use super::by_rows::{ByRows, ResultRows};
use super::multiplier::{Action, Multiplier, SkewPart, SkewRatio};
use crate::numeric::aligned::Aligned;
use crate::numeric::fourier::{Columns, Rows, line};
use crate::numeric::lanes::{LANES, Real};
use crate::numeric::parallel;
use crate::numeric::rows::RowBlocks;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::fmt;
use std::ops::Range;

/// Plans for the transforms of N₁ × N₂ real samples of one precision.
#[derive(Clone)]
pub struct Convolution<T: Real> {
    /// [N₁, N₂].
    points: [usize; 2],
    /// The rows of the window, all of the samples unless they are padded.
    blocks: RowBlocks,
    rows: Rows<T>,
    columns: Columns<T>,
    /// k₁ at each place of a column between forward and inverse.
    order: Vec<usize>,
}

/// A convolution before its last pass.
#[must_use]
pub struct Convolved<'a, T: Real> {
    convolution: &'a Convolution<T>,
    spectrum: &'a [T],
}

impl<T: Real> Convolution<T> {
    /// Plans for `points` = [N₁, N₂].
    pub fn new(points: [usize; 2]) -> Self {
        Self::padded(points, points)
    }

    /// Plans for `points` = [N₁, N₂], the samples outside a `window` of the first ones along each axis being zero.
    pub fn padded(window: [usize; 2], points: [usize; 2]) -> Self {
        let ([n1, n2], columns) = (points, Columns::new(points[0]));
        Self { points, blocks: RowBlocks::new(window), rows: Rows::new(n2), order: columns.order(n1), columns }
    }

    /// [N₁, N₂].
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// The blocks of the rows that sources and sinks are for.
    pub fn blocks(&self) -> RowBlocks {
        self.blocks
    }

    /// Components of a row, N₂/2 + 1.
    fn half(&self) -> usize {
        self.points[1] / 2 + 1
    }

    /// Tiles of columns.
    fn tiles(&self) -> usize {
        self.half().div_ceil(T::WIDTH)
    }

    /// Numbers of a tile: the rows of the window.
    fn tile(&self) -> usize {
        self.blocks.points()[0] * line::<T>()
    }

    /// Numbers between two passes.
    fn size(&self) -> usize {
        self.tiles() * self.tile()
    }

    /// Groups of eight columns that a multiplier has factors for: whole tiles in either precision.
    fn eights(&self) -> usize {
        self.half().next_multiple_of(f32::WIDTH) / LANES
    }

    /// Numbers of double precision that a convolution has for its [memory](Self::convolve).
    pub fn memory(&self) -> usize {
        // Lines are even.
        self.size() * size_of::<T>() / size_of::<f64>()
    }

    /// The multiplier of the positive values that `fill([k₁, k₂], values)` gives the components (k₁, k₂), (k₁, k₂ + 1), …,
    /// 0 ≤ k₁ < N₁, 0 ≤ k₂ ≤ N₂/2.
    ///
    /// Values must be even under (k₁, k₂) → (−k₁, −k₂): then real fields stay real. Where they are also even in k₁ alone
    /// (`mirrored`), half of them are computed.
    pub fn multiplier(&self, mirrored: bool, fill: impl Fn([usize; 2], &mut [f64]) + Sync) -> Multiplier {
        let ([n1, _], normalisation) = (self.points, self.normalisation());
        let table = self.table(1.0, mirrored, |first, values| {
            fill(first, values);
            values.iter_mut().for_each(|value| *value *= normalisation);
        });
        Multiplier::new(table, n1, normalisation)
    }

    /// The odd multiplier of the values that `fill([k₁, k₂], values)` gives the components (k₁, k₂), (k₁, k₂ + 1), …,
    /// 0 ≤ k₁ < N₁, 0 ≤ k₂ ≤ N₂/2.
    ///
    /// Values must be odd under (k₁, k₂) → (−k₁, −k₂), and with it zero for components that are their own conjugates: then real
    /// fields stay real.
    pub fn skew_ratio(&self, fill: impl Fn([usize; 2], &mut [f64]) + Sync) -> SkewRatio {
        SkewRatio::new(self.table(0.0, false, fill))
    }

    /// The odd multiplier of the values that `fill([k₁, k₂], values)` gives, as [`skew_ratio`](Self::skew_ratio) has them.
    pub fn skew_part(&self, fill: impl Fn([usize; 2], &mut [f64]) + Sync) -> SkewPart {
        SkewPart::new(self.table(0.0, false, |first, values| {
            fill(first, values);
            values.iter_mut().for_each(|value| *value *= self.normalisation());
        }))
    }

    /// The multiplier Re K and the ratio T = −Im K/Re K of the values K that `fill([k₁, k₂], values)` gives the components (k₁, k₂),
    /// (k₁, k₂ + 1), …, so that K = Re K (1 − iT).
    ///
    /// Values must be conjugate under (k₁, k₂) → (−k₁, −k₂), and with it real for components that are their own conjugates: then real fields
    /// stay real. Re K must be positive.
    pub fn complex_multiplier(&self, fill: impl Fn([usize; 2], &mut [Complex64]) + Sync) -> (Multiplier, SkewRatio) {
        let normalisation = self.normalisation();
        let values = self.table(Complex64::new(1.0 / normalisation, 0.0), false, fill);
        let ratios = values.iter().map(|value| -value.im / value.re).collect();
        let compliance = values.iter().map(|value| value.re * normalisation).collect();
        (Multiplier::new(compliance, self.points[0], normalisation), SkewRatio::new(ratios))
    }

    /// The multiplier H − iG of the values that `fill([k₁, k₂], values)` gives, conjugate under (k₁, k₂) → (−k₁, −k₂) as
    /// [`complex_multiplier`](Self::complex_multiplier) has them, of any sign.
    pub fn complex_parts(&self, fill: impl Fn([usize; 2], &mut [Complex64]) + Sync) -> (Multiplier, SkewPart) {
        let normalisation = self.normalisation();
        let values = self.table(Complex64::default(), false, fill);
        let even = values.iter().map(|value| value.re * normalisation).collect();
        let odd = values.iter().map(|value| -value.im * normalisation).collect();
        (Multiplier::new(even, self.points[0], normalisation), SkewPart::new(odd))
    }

    /// 1/(N₁N₂).
    fn normalisation(&self) -> f64 {
        let [n1, n2] = self.points;
        1.0 / (n1 as f64 * n2 as f64)
    }

    /// Values in the order of the column pass, eight columns at a time, padded to whole tiles.
    fn table<V: Copy + Send + Sync>(
        &self,
        padding: V,
        mirrored: bool,
        fill: impl Fn([usize; 2], &mut [V]) + Sync,
    ) -> Vec<V> {
        let n1 = self.points[0];
        let mut table = vec![padding; self.eights() * n1 * LANES];
        parallel::each_chunk(&mut table, n1 * LANES, |eight, table| {
            let k2 = eight * LANES;
            if k2 >= self.half() {
                return;
            }
            let mut lines = vec![[padding; LANES]; n1];
            for k1 in 0..if mirrored { n1 / 2 + 1 } else { n1 } {
                fill([k1, k2], &mut lines[k1][..LANES.min(self.half() - k2)]);
                if mirrored {
                    lines[(n1 - k1) % n1] = lines[k1];
                }
            }
            for (line, &k1) in table.chunks_exact_mut(LANES).zip(&self.order) {
                line.copy_from_slice(&lines[k1]);
            }
        });
        table
    }

    /// Index in a multiplier's table of each component (k₁, k₂), 0 ≤ k₁ < N₁, that the table holds: k₂ ≤ N₂/2.
    pub fn indices(&self) -> impl Fn([usize; 2]) -> Option<usize> + use<T> {
        let ([n1, half], mut places) = ([self.points[0], self.half()], vec![0; self.points[0]]);
        self.order.iter().enumerate().for_each(|(place, &k1)| places[k1] = place);
        move |[k1, k2]| (k2 < half).then(|| (k2 / LANES * n1 + places[k1]) * LANES + k2 % LANES)
    }

    /// F⁻¹[cK · F u] or F⁻¹[c F u / K] of a field u, still to be fetched. There is one of the `sources` for each
    /// [block](Self::blocks) of the rows; it puts row after row of u into what it is given. The [`memory`](Self::memory) is what the
    /// convolution works in.
    ///
    /// # Panics
    /// When the multiplier belongs to other `points`, the memory is too small, or there are not as many sources as blocks.
    pub fn convolve<'a>(
        &'a self,
        action: Action<'_>,
        multiplier: &Multiplier,
        memory: &'a mut [f64],
        sources: impl ByRows<T>,
    ) -> Convolved<'a, T> {
        assert_eq!(multiplier.len(), self.eights() * self.points[0] * LANES, "multiplier of a convolution");
        let spectrum = &mut bytemuck::cast_slice_mut(memory)[..self.size()];
        self.rows_forward(sources.into_par_iter(), spectrum);
        self.column_pass(action, multiplier, spectrum);
        Convolved { convolution: self, spectrum }
    }

    fn rows_forward<S>(&self, sources: S, spectrum: &mut [T])
    where
        S: IndexedParallelIterator<Item: FnMut(&mut [T])>,
    {
        let mut blocks: Vec<Vec<&mut [T]>> =
            (0..self.blocks.count()).map(|_| Vec::with_capacity(self.tiles())).collect();
        for tile in spectrum.chunks_exact_mut(self.tile()) {
            let runs = tile.chunks_mut(self.blocks.rows() * line::<T>());
            runs.zip(&mut blocks).for_each(|(run, block)| block.push(run));
        }
        assert_eq!(sources.len(), blocks.len(), "sources of a convolution");
        let blocks = blocks.into_par_iter().zip(sources);
        let [_, columns] = self.blocks.points();
        blocks.for_each_init(
            || self.rows.buffers(),
            |buffers, (mut runs, mut source)| {
                let mut source = |row: &mut [T]| {
                    let (window, beyond) = row.split_at_mut(columns);
                    source(window);
                    beyond.fill(T::zero());
                };
                for lines in self.groups(runs[0].len()) {
                    let tiles = runs.iter_mut().map(|run| &mut run[lines.clone()]);
                    self.rows.forward(lines.len() / line::<T>(), &mut source, buffers, tiles);
                }
            },
        );
    }

    /// The lines of the groups of rows in a run of `run` numbers.
    fn groups(&self, run: usize) -> impl Iterator<Item = Range<usize>> + use<T> {
        let group = T::WIDTH * line::<T>();
        (0..run).step_by(group).map(move |first| first..run.min(first + group))
    }

    fn column_pass(&self, action: Action<'_>, multiplier: &Multiplier, spectrum: &mut [T]) {
        let (size, whole) = (self.tile(), self.points[0] * line::<T>());
        let padded = if size < whole { whole } else { 0 };
        let scratch = || (vec![Complex64::ZERO; self.columns.scratch(self.points[0])], Aligned::new(padded));
        spectrum.par_chunks_exact_mut(size).enumerate().for_each_init(scratch, |(scratch, padded), (tile, lines)| {
            let multiply = |first: usize, lines: &mut [T]| action.multiply(multiplier, tile, first, lines);
            if padded.is_empty() {
                return self.columns.there_and_back(lines, scratch, &multiply);
            }
            padded[..size].copy_from_slice(lines);
            padded[size..].fill(T::zero());
            self.columns.there_and_back(padded, scratch, &multiply);
            lines.copy_from_slice(&padded[..size]);
        });
    }
}

impl<T: Real> ResultRows<T> for Convolved<'_, T> {
    fn some_rows(self, needed: impl Fn(usize) -> bool + Sync, sinks: impl ByRows<T>) {
        let (Self { convolution, spectrum }, sinks) = (self, sinks.into_par_iter());
        let (blocks, [rows, columns]) = (convolution.blocks, convolution.blocks.points());
        assert_eq!(sinks.len(), blocks.count(), "sinks of a convolution");
        sinks.enumerate().for_each_init(
            || convolution.rows.buffers(),
            |buffers, (block, mut sink)| {
                let (first, last) = (block * blocks.rows(), rows.min((block + 1) * blocks.rows()));
                let mut sink = |row: &mut [T]| sink(&mut row[..columns]);
                let run = first * line::<T>()..last * line::<T>();
                for lines in convolution.groups(run.len()) {
                    let (count, before) = (lines.len() / line::<T>(), first + lines.start / line::<T>());
                    if !(before..before + count).any(&needed) {
                        convolution.rows.blank(count, buffers, &mut sink);
                        continue;
                    }
                    let tiles = spectrum.chunks_exact(convolution.tile()).map(|tile| &tile[run.clone()][lines.clone()]);
                    convolution.rows.back(count, tiles, buffers, &mut sink);
                }
            },
        );
    }
}

impl<T: Real> fmt::Debug for Convolved<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Convolved").field("points", &self.convolution.points).finish_non_exhaustive()
    }
}

impl<T: Real> fmt::Debug for Convolution<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Convolution").field("points", &self.points).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectral::by_rows::{rows_of, rows_to};
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
        let convolution = Convolution::<T>::new([n1, n2]);
        let symbol = |k1: usize, k2: usize| {
            let (c1, c2) = (TAU * k1 as f64 / n1 as f64, TAU * k2 as f64 / n2 as f64);
            1.0 + 0.3 * c1.cos() + 0.2 * (c1 - c2).cos() + 0.1 * (2.0 * c2).cos()
        };
        let input = noise(n1 * n2);
        let mean = input.iter().sum::<f64>() / input.len() as f64;
        let multiplier = convolution.multiplier(false, |[k1, k2], values| {
            values.iter_mut().zip(k2..).for_each(|(value, k2)| *value = symbol(k1, k2));
        });
        let multiplier = multiplier.dropping_mean();
        let (mut field, mut memory) =
            (input.iter().map(|&x| T::rounded(x)).collect::<Vec<T>>(), vec![0.0; convolution.memory()]);
        let at = |i: usize, j: usize| input[(i % n1) * n2 + j % n2] - mean;
        let expected = |i: usize, j: usize| {
            at(i, j)
                + 0.15 * (at(i + 1, j) + at(i + n1 - 1, j))
                + 0.1 * (at(i + 1, j + n2 - 1) + at(i + n1 - 1, j + 1))
                + 0.05 * (at(i, j + 2) + at(i, j + 2 * n2 - 2))
        };
        let scale = 3.0;
        let mut convolve = |action, field: &mut [T]| {
            let convolved =
                convolution.convolve(action, &multiplier, &mut memory, rows_of(convolution.blocks(), field));
            convolved.rows(rows_to(convolution.blocks(), field));
        };
        convolve(Action::Multiply(scale), &mut field);
        let there: f64 =
            field.iter().enumerate().map(|(k, u)| (u.double() / scale - expected(k / n2, k % n2)).abs()).sum();
        convolve(Action::Divide(1.0 / scale), &mut field);
        let back: f64 = field.iter().enumerate().map(|(k, u)| (u.double() - at(k / n2, k % n2)).abs()).sum();
        // Means, which a number that is none spoils.
        [there, back].map(|sum| sum / (n1 * n2) as f64)
    }

    /// The field has zeros in all rows but 26 of 150, and only the results of these rows are needed: they are, bit for bit, those of
    /// a transform of every row. The rows fill some groups that are transformed together, and parts of others.
    #[test]
    fn rows_that_are_left_out_change_no_other() {
        let [n1, n2] = [150, 36];
        let convolution = Convolution::<f32>::new([n1, n2]);
        let blocks = convolution.blocks();
        let multiplier = convolution.multiplier(false, |[k1, k2], values| {
            values.iter_mut().zip(k2..).for_each(|(value, k2)| *value = 1.0 / (1 + k1.min(n1 - k1) + k2) as f64);
        });
        let is_used = |row: usize| (20..45).contains(&row) || row == 140;
        let input: Vec<f32> = noise(n1 * n2).into_iter().map(|x| x as f32).collect();
        // Rows that are next to nothing are all transformed.
        let padded = |padding: f32| -> Vec<f32> {
            let rows = input.chunks(n2).enumerate();
            rows.flat_map(|(row, samples)| samples.iter().map(move |&x| if is_used(row) { x } else { padding }))
                .collect()
        };
        let mut memory = vec![0.0; convolution.memory()];
        let mut convolve = |field: &[f32], is_used: &(dyn Fn(usize) -> bool + Sync)| {
            let mut result = vec![0.0; n1 * n2];
            let convolved = convolution.convolve(Action::Divide(1.0), &multiplier, &mut memory, rows_of(blocks, field));
            convolved.some_rows(is_used, rows_to(blocks, &mut result));
            result
        };
        let (some, all) = (convolve(&padded(0.0), &is_used), convolve(&padded(1e-30), &|_| true));
        for row in (0..n1).filter(|&row| is_used(row)) {
            assert_eq!(some[row * n2..][..n2], all[row * n2..][..n2], "row {row}");
        }
        assert_eq!(some[80 * n2..][..n2], [0.0; 36], "row 80 is not used");
    }

    #[test]
    fn a_convolution_is_its_direct_double_sum_and_can_be_undone() {
        for points in [
            [1, 1],
            [8, 6],
            [5, 9],
            [12, 20],
            [7, 4],
            [36, 50],
            [26, 22],
            [64, 128],
            [17, 34],
            [37, 19],
            [130, 9],
            [65, 16],
            [96, 64],
            [288, 512],
            [129, 2],
            [70, 1],
            [1, 40],
            [3, 2],
        ] {
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
