//! The residual continued beyond the active set I, for the preconditioner M = P_I Eᵀ C⁻¹ E P_I.
//!
//! Continued by zero, the residual jumps at the edge of contact, and C⁻¹ ~ |q| makes of that a spurious pressure like
//! 1/√distance. E keeps a field on I and continues it outside by a local mean that fades:
//!
//! E = P_I + (1 − P_I) W S P_I,  W = D c/(c² + c₀²),  c = S χ,
//!
//! where S is a smoothing over 15 samples each way (along a₁ and a₂ the mean over 16 samples of the mean over 16), χ is 1 on
//! I and 0 outside, S r/c is then the mean of the residual near by, D and c₀ how much of it is kept at the edge
//! and how far out. S is symmetric, so that Eᵀ = P_I + P_I S W (1 − P_I), and M is symmetric and positive.
//!
//! S is periodic over the grid. In free space the residual of a contact within 30 samples of the border of the window is therefore
//! smoothed into the opposite border too. The preconditioner M stays symmetric and positive, so that the pressure to which the
//! iteration converges is the same.

use crate::numeric::lanes::{LANES, own_group, vectorised};
use crate::numeric::rows::{RowBlocks, next};
use fearless_simd::{f32x8, prelude::*};
use rayon::prelude::*;

/// Part of the mean that is kept at the edge of contact.
pub(super) const DECAY: f32 = 0.8;
/// Share of I among the samples near by at which the continuation fades.
pub(super) const FADE: f32 = 0.07;
/// Samples of each mean, a power of two.
pub(super) const WIDTH: usize = 16;
/// Samples that the smoothing reaches each way.
const REACH: usize = WIDTH - 1;

/// Sources of E (r − mean) for a residual r on I (exactly 0 outside); `weight` becomes W outside and 0 on I, `reached` true for
/// the rows in which either is not zero.
pub(super) fn extended<'a>(
    blocks: RowBlocks,
    residual: &'a [f32],
    mean: f32,
    weight: &'a mut [f32],
    reached: &'a mut [bool],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let [_, columns] = blocks.points();
    let fields = blocks.of(residual).zip(blocks.of_mut(weight)).zip(reached.par_chunks_mut(blocks.rows()));
    fields.enumerate().map(move |(block, ((values, weight), reached))| {
        let mut sums = Triangles::new(blocks, block, residual, Centred { mean });
        let [mut near, mut share] = [(); 2].map(|()| PeriodicRow::new(columns));
        let mut rows = values.zip(weight).zip(reached);
        move |row: &mut [f32]| {
            let ((residual, weight), reached) = next(&mut rows);
            let [sum, count] = sums.next();
            *reached = count.iter().any(|&count| count != 0.0);
            if !*reached {
                row.fill(0.0);
                weight.fill(0.0);
                return;
            }
            let (near, share) = (near.smoothed(&sum[..columns]), share.smoothed(&count[..columns]));
            vectorised!(simd => continued(simd, residual, mean, [near, share], row, weight));
        }
    })
}

/// Sinks that put the rows of a field y into `image`; `weight` becomes W y, smoothed along a₂.
pub(super) fn gathered<'a>(
    blocks: RowBlocks,
    image: &'a mut [f32],
    weight: &'a mut [f32],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let [_, columns] = blocks.points();
    blocks.of_mut(image).zip(blocks.of_mut(weight)).map(move |(image, weight)| {
        let mut line = PeriodicRow::new(columns);
        let mut rows = image.zip(weight);
        move |row: &mut [f32]| {
            let (image, weight) = next(&mut rows);
            image.copy_from_slice(row);
            if weight.iter().any(|&w| w != 0.0) {
                row.iter_mut().zip(&*weight).for_each(|(y, w)| *y *= w);
                weight.copy_from_slice(&line.smoothed(row)[..columns]);
            }
        }
    })
}

/// S W y on row after row of a block, which Eᵀ adds to y on I, from the `weight` that [`gathered`] has set.
pub(super) fn gathering(blocks: RowBlocks, block: usize, weight: &[f32]) -> Triangles<'_, 1, Value> {
    Triangles::new(blocks, block, weight, Value)
}

/// Terms of each sample of a field that are summed.
pub(super) trait Terms<const F: usize>: Copy {
    fn of<S: Simd>(self, simd: S, samples: f32x8<S>) -> [f32x8<S>; F];
}

/// r − mean and χ, of a residual.
#[derive(Debug, Clone, Copy)]
struct Centred {
    mean: f32,
}

impl Terms<2> for Centred {
    #[inline(always)]
    fn of<S: Simd>(self, simd: S, residual: f32x8<S>) -> [f32x8<S>; 2] {
        let (zero, one) = (f32x8::simd_from(simd, 0.0), f32x8::simd_from(simd, 1.0));
        let outside = residual.simd_eq(zero);
        [outside.select(zero, residual - self.mean), outside.select(zero, one)]
    }
}

/// The sample itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Value;

impl Terms<1> for Value {
    #[inline(always)]
    fn of<S: Simd>(self, _: S, samples: f32x8<S>) -> [f32x8<S>; 1] {
        [samples]
    }
}

/// Means over `WIDTH` rows of means over `WIDTH` rows, times `WIDTH`², on row after row of a periodic field: running sums. Those of χ are whole numbers, and exact; others err by some 1e-7 of the largest sample
/// that has passed in this block.
#[derive(Debug)]
pub(super) struct Triangles<'a, const F: usize, T> {
    rows: usize,
    columns: usize,
    field: &'a [f32],
    terms: T,
    /// Rows summed so far, from `REACH` before the first one on.
    summed: usize,
    first: usize,
    /// Sums over the last `WIDTH` rows, all of these of the last `WIDTH` rows one after the other, and their sums.
    once: [Vec<f32>; F],
    past: [Vec<f32>; F],
    twice: [Vec<f32>; F],
}

impl<'a, const F: usize, T: Terms<F>> Triangles<'a, F, T> {
    fn new(blocks: RowBlocks, block: usize, field: &'a [f32], terms: T) -> Self {
        let ([rows, columns], first) = (blocks.points(), block * blocks.rows());
        let padded = columns.next_multiple_of(LANES);
        let sums = |rows: usize| std::array::from_fn(|_| vec![0.0; rows * padded]);
        let (once, past, twice) = (sums(1), sums(WIDTH), sums(1));
        let mut triangles = Self { rows, columns, field, terms, summed: 0, first, once, past, twice };
        for _ in 0..2 * REACH {
            triangles.add();
        }
        triangles
    }

    /// The sums on the next row, padded with values of no use.
    pub fn next(&mut self) -> [&[f32]; F] {
        self.add();
        self.twice.each_ref().map(|sums| &sums[..])
    }

    fn add(&mut self) {
        let row = |number: usize| {
            // (first + number − REACH) mod rows, however few there are.
            let row = (self.first + number + REACH * (self.rows - 1)) % self.rows;
            &self.field[row * self.columns..][..self.columns]
        };
        let joining = row(self.summed);
        // The first `WIDTH` rows replace none.
        let leaving = if self.summed < WIDTH { &[][..] } else { row(self.summed - WIDTH) };
        let padded = self.once[0].len();
        let slot = self.summed % WIDTH * padded;
        let past = self.past.each_mut().map(|past| &mut past[slot..][..padded]);
        let (once, twice) = (self.once.each_mut(), self.twice.each_mut());
        vectorised!(simd => moved(simd, self.terms, [joining, leaving], once, past, twice));
        self.summed += 1;
    }
}

#[inline(always)]
fn moved<const F: usize, S: Simd>(
    simd: S,
    terms: impl Terms<F>,
    [joining, leaving]: [&[f32]; 2],
    once: [&mut Vec<f32>; F],
    past: [&mut [f32]; F],
    twice: [&mut Vec<f32>; F],
) {
    for at in (0..joining.len()).step_by(LANES) {
        let mut change = terms.of(simd, own_group(simd, joining, at, 0.0));
        if !leaving.is_empty() {
            let left = terms.of(simd, own_group(simd, leaving, at, 0.0));
            for field in 0..F {
                change[field] -= left[field];
            }
        }
        for field in 0..F {
            let place = at..at + LANES;
            let sum = f32x8::from_slice(simd, &once[field][place.clone()]) + change[field];
            let last = f32x8::from_slice(simd, &past[field][place.clone()]);
            let whole = f32x8::from_slice(simd, &twice[field][place.clone()]) + (sum - last);
            sum.store_slice(&mut once[field][place.clone()]);
            sum.store_slice(&mut past[field][place.clone()]);
            whole.store_slice(&mut twice[field][place]);
        }
    }
}

/// A row with its periodic surroundings.
#[derive(Debug)]
struct PeriodicRow {
    samples: Vec<f32>,
}

impl PeriodicRow {
    fn new(columns: usize) -> Self {
        Self { samples: vec![0.0; columns + 2 * REACH + LANES] }
    }

    /// S of sums over rows, padded with values of no use.
    fn smoothed(&mut self, row: &[f32]) -> &[f32] {
        let (n2, line) = (row.len(), &mut self.samples);
        line[REACH..REACH + n2].copy_from_slice(row);
        for k in 0..REACH {
            line[REACH - 1 - k] = row[(n2 - 1) - k % n2];
            line[REACH + n2 + k] = row[k % n2];
        }
        vectorised!(simd => smooth(simd, line, n2));
        line
    }
}

/// Two means over `WIDTH` samples as means ¼, ½, ¼ of samples 1, 2, 4 and 8 apart, in place: the result's `len` numbers
/// start where the reach of the first one started. They are divided by `WIDTH`² too, as the sums over rows are no means yet.
#[inline(always)]
fn smooth<S: Simd>(simd: S, line: &mut [f32], len: usize) {
    let mut part = 0.25 / (WIDTH * WIDTH) as f32;
    let (mut left, mut apart) = (REACH, 1);
    while apart < WIDTH {
        left -= apart;
        let (quarter, half) = (f32x8::simd_from(simd, part), f32x8::simd_from(simd, 2.0 * part));
        for at in (0..len + 2 * left).step_by(LANES) {
            let before = f32x8::from_slice(simd, &line[at..][..LANES]);
            let here = f32x8::from_slice(simd, &line[at + apart..][..LANES]);
            let after = f32x8::from_slice(simd, &line[at + 2 * apart..][..LANES]);
            (before + after).mul_add(quarter, here * half).store_slice(&mut line[at..at + LANES]);
        }
        (part, apart) = (0.25, 2 * apart);
    }
}

#[inline(always)]
fn continued<S: Simd>(
    _: S,
    residual: &[f32],
    mean: f32,
    [near, share]: [&[f32]; 2],
    result: &mut [f32],
    weight: &mut [f32],
) {
    for ((((result, weight), &r), &near), &share) in result.iter_mut().zip(weight).zip(residual).zip(near).zip(share) {
        let outside = DECAY * share / (share * share + FADE * FADE);
        *weight = if r == 0.0 { outside } else { 0.0 };
        *result = if r == 0.0 { outside * near } else { r - mean };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ⟨E r, y⟩ = ⟨r, Eᵀ y⟩, on grids smaller than the reach and of several blocks.
    #[test]
    fn gathering_is_the_adjoint_of_the_extension() {
        for [n1, n2] in [[4, 7], [90, 24], [131, 300]] {
            let noise = |k: usize| ((k * k * 7919 + 13 * k) % 1009) as f32 / 1009.0 - 0.5;
            let (mean, size) = (0.1, n1 * n2);
            let inside = |k: usize| (k / n2 / 3 + k % n2 / 5) % 4 == 1;
            let residual: Vec<f32> = (0..size).map(|k| if inside(k) { noise(k) + 2.0 } else { 0.0 }).collect();
            let other: Vec<f32> = (0..size).map(|k| noise(k + 77)).collect();
            let [mut extension, mut weight, mut image] = [(); 3].map(|()| vec![0.0; size]);
            let blocks = RowBlocks::new([n1, n2]);
            extended(blocks, &residual, mean, &mut weight, &mut vec![false; n1])
                .zip(extension.par_chunks_mut(blocks.rows() * n2))
                .for_each(|(mut source, rows)| rows.chunks_mut(n2).for_each(&mut source));
            let outside = (0..size).filter(|&k| !inside(k) && extension[k] != 0.0).count();
            assert!(outside > size / 2, "{outside} of {size} samples continued");
            let mut rows = other.clone();
            gathered(blocks, &mut image, &mut weight)
                .zip(rows.par_chunks_mut(blocks.rows() * n2))
                .for_each(|(mut sink, rows)| rows.chunks_mut(n2).for_each(&mut sink));
            assert_eq!(image, other);
            let mut gathered = Vec::new();
            for block in 0..blocks.count() {
                let mut rows = gathering(blocks, block, &weight);
                let count = blocks.rows().min(n1 - block * blocks.rows());
                (0..count).for_each(|_| gathered.extend_from_slice(&rows.next()[0][..n2]));
            }
            let dot = |a: f32, b: f32| f64::from(a) * f64::from(b);
            let forth: f64 = (0..size).map(|k| dot(extension[k], other[k])).sum();
            let back: f64 =
                (0..size).filter(|&k| inside(k)).map(|k| dot(residual[k] - mean, other[k] + gathered[k])).sum();
            assert!((forth / back - 1.0).abs() < 1e-5, "{n1} × {n2}: {forth} {back}");
        }
    }
}
