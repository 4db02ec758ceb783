//! Real fields and their Fourier coefficients on n₁ × n₂ points,
//!
//! f(i, j) = Σ F(k₁, k₂) e^{2πi (k₁i/n₁ + k₂j/n₂)},  F(−k₁, −k₂) = F*(k₁, k₂): half of the columns k₂ suffice.
//!
//! Several fields are transformed at once: first the columns, in tiles of eight, each right after it is filled, then the rows, in
//! groups of eight, which may be processed one by one without being kept. A tile or a group is the work of one thread, so that
//! the result does not depend on the number of threads.

use super::far_plane::FarPlane;
use crate::numeric::fourier::{self, Buffers, LINE, Rows};
use crate::numeric::lanes::LANES;
use crate::numeric::parallel;
use ndarray::ArrayView3;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::fmt;
use std::ops::Range;

/// Least number of groups of rows that are read at a time.
const BATCH: usize = 8;

/// Transforms between fields and coefficients on [n₁, n₂] points.
pub(super) struct Transform {
    points: [usize; 2],
    columns: fourier::Columns<f64>,
    /// Place of the component k₁ in a column.
    places: Vec<usize>,
    rows: Rows<f64>,
}

/// K fields transformed along their columns; stored by tiles, then fields, then lines of eight columns.
pub(super) struct FieldColumns<'a, const K: usize> {
    transform: &'a Transform,
    values: Vec<f64>,
    /// The field of an isolated contact that the periodic series lacks, added to it; `None` on a periodic cell.
    far: Option<Far<K>>,
}

/// A smooth field that is added to K fields.
struct Far<const K: usize> {
    plane: FarPlane<K>,
    /// Fraction of the first row.
    start: f64,
    /// The columns that are read.
    columns: Range<usize>,
    /// Polynomials at each of these columns, one column after another.
    across: Vec<f64>,
}

impl<const K: usize> Far<K> {
    /// Adds field `k` to a row at the fraction s.
    fn add(&self, k: usize, s: f64, row: &mut [f64]) {
        if !self.plane.is_read(0, s) {
            return;
        }
        let line: Vec<f64> = self.plane.along(s).iter().map(|coefficients| coefficients[k]).collect();
        for (sample, weights) in row[self.columns.clone()].iter_mut().zip(self.across.chunks_exact(line.len())) {
            *sample += line.iter().zip(weights).map(|(coefficient, weight)| coefficient * weight).sum::<f64>();
        }
    }
}

/// One column of K fields, in its tile.
pub(super) struct FieldColumn<'a, const K: usize> {
    lines: &'a mut [f64],
    lane: usize,
    places: &'a [usize],
}

impl Transform {
    /// Transform on [n₁, n₂] points.
    pub fn new([n1, n2]: [usize; 2]) -> Self {
        let columns = fourier::Columns::new(n1);
        let places = columns.places(n1);
        Self { points: [n1, n2], columns, places, rows: Rows::new(n2) }
    }

    /// Number of points [n₁, n₂].
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// Number of columns 0 ≤ k₂ ≤ n₂/2.
    fn half(&self) -> usize {
        self.points[1] / 2 + 1
    }

    /// Length of a tile of one field.
    fn tile(&self) -> usize {
        self.points[0] * LINE
    }

    fn scratch(&self) -> Vec<Complex64> {
        vec![Complex64::default(); self.columns.scratch(self.points[0])]
    }

    /// Fourier coefficients of a field, its samples row by row: half of the columns, k₁ fastest.
    pub fn analysed(&self, samples: &[f64]) -> Vec<Complex64> {
        let ([n1, n2], half) = (self.points, self.half());
        let mut tiles = vec![0.0; half.div_ceil(LANES) * self.tile()];
        let mut groups: Vec<Vec<&mut [f64]>> = (0..n1.div_ceil(LANES)).map(|_| Vec::new()).collect();
        for tile in tiles.chunks_exact_mut(self.tile()) {
            tile.chunks_mut(LANES * LINE).zip(&mut groups).for_each(|(lines, group)| group.push(lines));
        }
        groups.into_par_iter().zip(samples.par_chunks(LANES * n2)).for_each_init(
            || self.rows.buffers(),
            |buffers, (lines, samples)| {
                let mut rows = samples.chunks_exact(n2);
                let mut next = |row: &mut [f64]| row.copy_from_slice(rows.next().expect("a group has its rows"));
                self.rows.forward(samples.len() / n2, &mut next, buffers, lines.into_iter());
            },
        );
        let normalisation = 1.0 / (n1 as f64 * n2 as f64);
        let mut columns = vec![Complex64::default(); half * n1];
        columns.par_chunks_mut(LANES * n1).zip(tiles.par_chunks_exact_mut(self.tile())).for_each_init(
            || self.scratch(),
            |scratch, (columns, lines)| {
                self.columns.forward(lines, scratch);
                for (c, column) in columns.chunks_exact_mut(n1).enumerate() {
                    for (value, place) in column.iter_mut().zip(&self.places) {
                        let line = &lines[place * LINE..][..LINE];
                        *value = normalisation * Complex64::new(line[c], line[LANES + c]);
                    }
                }
            },
        );
        columns
    }

    /// K fields transformed along their columns. `fill` adds the coefficients of column k₂ to zeros; tiles of columns that are
    /// not `occupied` have none. The `buffer` is that of earlier columns, or empty.
    pub fn columns<const K: usize>(
        &self,
        buffer: Vec<f64>,
        occupied: impl Fn(Range<usize>) -> bool + Sync,
        fill: impl Fn(usize, &mut FieldColumn<'_, K>) + Sync,
    ) -> FieldColumns<'_, K> {
        let half = self.half();
        let size = half.div_ceil(LANES) * K * self.tile();
        // Fresh memory is zero and is mapped at the first write.
        let is_fresh = buffer.is_empty();
        let mut values = if is_fresh { vec![0.0; size] } else { buffer };
        values.reserve_exact(size.saturating_sub(values.len()));
        values.resize(size, 0.0);
        parallel::each_chunk_with(
            &mut values,
            K * self.tile(),
            || self.scratch(),
            |scratch, tile, lines| {
                let columns = tile * LANES..half.min((tile + 1) * LANES);
                let any = occupied(columns.clone());
                if any || !is_fresh {
                    // Fresh memory too: a read before the first write would map it twice.
                    lines.fill(0.0);
                }
                if any {
                    for (lane, k2) in columns.enumerate() {
                        fill(k2, &mut FieldColumn { lines, lane, places: &self.places });
                    }
                    let fields = lines.chunks_exact_mut(self.tile());
                    fields.for_each(|lines| self.columns.inverse(lines, scratch));
                }
            },
        );
        FieldColumns { transform: self, values, far: None }
    }
}

impl<const K: usize> FieldColumn<'_, K> {
    /// Adds to the coefficients k₁ of the fields.
    #[inline(always)]
    pub fn add(&mut self, k1: usize, coefficients: [Complex64; K]) {
        let (size, at) = (self.places.len() * LINE, self.places[k1] * LINE + self.lane);
        for (k, coefficient) in coefficients.into_iter().enumerate() {
            self.lines[k * size + at] += coefficient.re;
            self.lines[k * size + at + LANES] += coefficient.im;
        }
    }
}

impl<const K: usize> FieldColumns<'_, K> {
    /// The fields with each row i shifted by a number of its periods, `by(i)`: what stood at the fraction t + by(i) stands at t. The columns must
    /// hold all waves along the rows, without aliases.
    pub fn sheared(mut self, by: impl Fn(usize) -> f64 + Sync) -> Self {
        let (tile, half) = (self.transform.tile(), self.transform.half());
        parallel::each_chunk(&mut self.values, K * tile, |number, fields| {
            for (lane, k2) in (number * LANES..half.min((number + 1) * LANES)).enumerate() {
                for row in 0..tile / LINE {
                    let phase = Complex64::cis(std::f64::consts::TAU * (k2 as f64 * by(row)).fract());
                    for lines in fields.chunks_exact_mut(tile) {
                        let line = &mut lines[row * LINE..][..LINE];
                        let turned = phase * Complex64::new(line[lane], line[LANES + lane]);
                        (line[lane], line[LANES + lane]) = (turned.re, turned.im);
                    }
                }
            }
        });
        self
    }

    /// The columns of fields to which the `far` one is added; the first point is at the fractions `start`.
    pub fn with_far(self, far: Option<FarPlane<K>>, start: [f64; 2]) -> Self {
        let columns = self.transform.points[1];
        let far = far.map(|plane| {
            let fraction = |j: usize| start[1] + j as f64 / columns as f64;
            let is_read = |j: &usize| plane.is_read(1, fraction(*j));
            let first = (0..columns).find(is_read).unwrap_or(0);
            let read = first..(first..columns).rfind(is_read).map_or(first, |last| last + 1);
            let across = read.clone().flat_map(|j| plane.across(fraction(j))).collect();
            Far { columns: read, across, start: start[0], plane }
        });
        Self { far, ..self }
    }

    /// Buffers of one thread for groups of rows.
    fn buffers(&self) -> [Buffers<f64>; K] {
        std::array::from_fn(|_| self.transform.rows.buffers())
    }

    /// Transforms a group of eight rows (fewer at the end) of the fields into the buffers; returns the number of rows.
    fn group(&self, group: usize, buffers: &mut [Buffers<f64>; K]) -> usize {
        let Transform { points: [n1, _], ref rows, .. } = *self.transform;
        let (tile, first) = (self.transform.tile(), group * LANES);
        let count = LANES.min(n1 - first);
        for (k, buffers) in buffers.iter_mut().enumerate() {
            let lines = k * tile + first * LINE..k * tile + (first + count) * LINE;
            let tiles = self.values.chunks_exact(K * tile).map(|fields| &fields[lines.clone()]);
            let mut row = first;
            rows.back(count, tiles, buffers, &mut |samples: &mut [f64]| {
                if let Some(far) = &self.far {
                    far.add(k, far.start + row as f64 / n1 as f64, samples);
                }
                row += 1;
            });
        }
        count
    }

    /// Buffer of the fields, for other columns.
    pub fn into_buffer(self) -> Vec<f64> {
        self.values
    }

    /// Values of `read` for each row, called with its number and the row of each field.
    pub fn map<R: Send + Sync>(&self, read: impl Fn(usize, [&[f64]; K]) -> R + Sync) -> Vec<R> {
        self.map_first(self.transform.points[0], read)
    }

    /// Values of `read` for the first `count` rows.
    pub fn map_first<R: Send + Sync>(&self, count: usize, read: impl Fn(usize, [&[f64]; K]) -> R + Sync) -> Vec<R> {
        let each = |buffers: &mut [Buffers<f64>; K], group: usize| -> Vec<R> {
            let rows = 0..self.group(group, buffers).min(count - group * LANES);
            let row = |row: usize| std::array::from_fn(|k| self.transform.rows.row(row, &buffers[k]));
            rows.map(|number| read(group * LANES + number, row(number))).collect()
        };
        parallel::map_with(count.div_ceil(LANES), || self.buffers(), each).into_iter().flatten().collect()
    }

    /// Writes the fields one after the other.
    pub fn write(&self, fields: &mut [f64]) {
        let [n1, n2] = self.transform.points;
        let mut groups: Vec<Vec<&mut [f64]>> = (0..n1.div_ceil(LANES)).map(|_| Vec::with_capacity(K)).collect();
        for field in fields.chunks_exact_mut(n1 * n2) {
            field.chunks_mut(LANES * n2).zip(&mut groups).for_each(|(rows, group)| group.push(rows));
        }
        parallel::each_chunk_with(
            &mut groups,
            1,
            || self.buffers(),
            |buffers, group, fields| {
                self.group(group, buffers);
                for (rows, buffers) in fields[0].iter_mut().zip(buffers) {
                    for (number, row) in rows.chunks_exact_mut(n2).enumerate() {
                        row.copy_from_slice(self.transform.rows.row(number, buffers));
                    }
                }
            },
        );
    }

    /// Calls `sink` with the C values that `read` returns for each sample of the K fields, in order, some rows at a time: arrays of
    /// [C, rows, n₂].
    pub fn hand_on<const C: usize, E>(
        &self,
        read: impl Fn([f64; K]) -> [f64; C] + Sync,
        mut sink: impl FnMut(ArrayView3<'_, f64>) -> Result<(), E>,
    ) -> Result<(), E> {
        let [n1, n2] = self.transform.points;
        let groups = n1.div_ceil(LANES);
        let at_a_time = BATCH.max(rayon::current_num_threads()).min(groups);
        let mut batch: Vec<_> = (0..at_a_time).map(|_| (self.buffers(), vec![0.0; C * LANES * n2], 0)).collect();
        for first in (0..groups).step_by(at_a_time) {
            let used = &mut batch[..at_a_time.min(groups - first)];
            parallel::each_chunk(used, 1, |group, of_group| {
                let (buffers, results, count) = &mut of_group[0];
                *count = self.group(first + group, buffers);
                for number in 0..*count {
                    let rows: [&[f64]; K] = std::array::from_fn(|k| self.transform.rows.row(number, &buffers[k]));
                    for j in 0..n2 {
                        let values = read(std::array::from_fn(|k| rows[k][j]));
                        for c in 0..C {
                            results[(c * *count + number) * n2 + j] = values[c];
                        }
                    }
                }
            });
            for (_, results, count) in used {
                let rows = ArrayView3::from_shape([C, *count, n2], &results[..C * *count * n2]);
                sink(rows.expect("as many numbers as rows take"))?;
            }
        }
        Ok(())
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

    /// Buffers of columns of other numbers of fields, tiles without coefficients, and lengths left to the library.
    #[test]
    fn a_buffer_of_other_columns_leaves_nothing_behind() {
        fn waves<const K: usize>(transform: &Transform, buffer: Vec<f64>, k2: usize) -> Vec<f64> {
            let [n1, n2] = transform.points();
            let columns = transform.columns(
                buffer,
                |columns| columns.contains(&k2),
                |column, fields: &mut FieldColumn<'_, K>| {
                    if column == k2 {
                        fields.add(1, std::array::from_fn(|k| Complex64::from(0.5 * (k + 1) as f64)));
                    }
                },
            );
            let mut fields = vec![0.0; K * n1 * n2];
            columns.write(&mut fields);
            for (index, value) in fields.iter().enumerate() {
                let (k, i, j) = (index / (n1 * n2), index / n2 % n1, index % n2);
                let expected = (k + 1) as f64 * (TAU * (i as f64 / n1 as f64 + (k2 * j) as f64 / n2 as f64)).cos();
                assert!((value - expected).abs() < 1e-13, "{n1} × {n2}, {k2}: {value}, {expected}");
            }
            columns.into_buffer()
        }
        for points in [[17, 34], [24, 60], [9, 41]] {
            let transform = Transform::new(points);
            let buffer = waves::<3>(&transform, Vec::new(), 1);
            let buffer = waves::<4>(&transform, buffer, 9);
            let buffer = waves::<2>(&transform, buffer, 16);
            waves::<6>(&transform, buffer, 2);
        }
    }

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

            let columns = transform.columns(
                Vec::new(),
                |_| true,
                |k2, column: &mut FieldColumn<'_, 2>| {
                    (0..n1).for_each(|k1| column.add(k1, [0, 1].map(|field| spectra[field][k2 * n1 + k1])));
                },
            );
            let mut back = vec![0.0; 2 * n1 * n2];
            columns.write(&mut back);
            assert!(back.iter().zip(&fields).all(|(a, b)| (a - b).abs() < 1e-13), "{n1} × {n2}");
            let firsts: Vec<f64> = columns.map(|_, [_, second]| second[0]);
            assert!(firsts.iter().zip(back[n1 * n2..].chunks(n2)).all(|(first, row)| *first == row[0]));
        }
    }
}
