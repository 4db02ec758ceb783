//! Line 4 of the method, fused: from z = M r to the direction t = z + βt and to C t, on their way through the convolutions.

use crate::numeric::lanes::{LANES, RUN, Real, all_zero, splat, total, vectorised};
use crate::numeric::rows::{RowBlocks, Totals, next};
use crate::spectral::extension;
use fearless_simd::prelude::*;
use rayon::prelude::*;

/// Sums of z on I with the residuals r and, of the iteration before, r′ on I′.
#[derive(Debug, Clone, Copy)]
pub(super) struct Overlaps {
    /// Σ z.
    pub sum: f64,
    /// Σ r z.
    pub with_residual: f64,
    /// Σ r′ z.
    before: f64,
    /// Σ z on I′.
    sum_before: f64,
    /// Σ r′ on I.
    before_here: f64,
    /// Samples of I ∩ I′.
    common: f64,
    /// Σ t′ on I.
    pub direction: f64,
}

impl Overlaps {
    /// ⟨r′ − m′, z − m⟩ with the means m′ and m on I′ and I.
    pub fn with_previous(&self, previous_mean: f64, mean: f64) -> f64 {
        self.before - previous_mean * self.sum_before - mean * self.before_here + previous_mean * mean * self.common
    }
}

/// Sources of r − mean on the active set, 0 outside.
pub(super) fn centred(
    blocks: RowBlocks,
    residual: &[f32],
    mean: f32,
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> {
    blocks.of(residual).map(move |mut residual| {
        move |row: &mut [f32]| {
            let centred = |(to, &r): (&mut f32, &f32)| *to = if r == 0.0 { 0.0 } else { r - mean };
            row.iter_mut().zip(next(&mut residual)).for_each(centred);
        }
    })
}

/// z on the active set, from C⁻¹ E r in `image` and what Eᵀ adds by the `weight`, goes to `image`; its sums with r, r′ and t′.
pub(super) fn overlap(
    blocks: RowBlocks,
    [residual, previous, direction]: [&[f32]; 3],
    weight: Option<&[f32]>,
    image: &mut [f32],
) -> Overlaps {
    let [_, columns] = blocks.points();
    let nothing = vec![0.0; columns];
    let fields = blocks.of(residual).zip(blocks.of(previous)).zip(blocks.of(direction)).zip(blocks.of_mut(image));
    let totals = fields.enumerate().map(|(block, (((residual, previous), direction), image))| {
        let mut gathering = weight.map(|weight| extension::gathering(blocks, block, weight));
        let mut totals = Totals::NONE;
        for (((residual, previous), direction), image) in residual.zip(previous).zip(direction).zip(image) {
            let gathered = gathering.as_mut().map_or(&nothing[..], |gathering| &gathering.next()[0][..columns]);
            totals.add(vectorised!(simd => overlaps(simd, [residual, previous, direction, gathered], image)));
        }
        totals
    });
    let totals = Totals::of(totals.collect());
    let [sum, with_residual, before, sum_before, before_here, common, direction] = totals.sums;
    Overlaps { sum, with_residual, before, sum_before, before_here, common, direction }
}

#[inline(always)]
fn overlaps<S: Simd>(
    simd: S,
    [residual, previous, direction, gathered]: [&[f32]; 4],
    image: &mut [f32],
) -> Totals<7, 0> {
    let (zero, one) = (splat(simd, 0.0), splat(simd, 1.0));
    let (mut sum, mut with_residual, mut before, mut sum_before) = (zero, zero, zero, zero);
    let (mut before_here, mut common, mut last_direction) = (zero, zero, zero);
    for run in (0..residual.len()).step_by(RUN) {
        let end = residual.len().min(run + RUN);
        // Without contact nothing is added to the sums, and z is not used.
        if all_zero(simd, &residual[run..end]) {
            continue;
        }
        for at in (run..end).step_by(LANES) {
            let (r, last) = (f32::group(simd, residual, at, 0.0), f32::group(simd, previous, at, 0.0));
            let (outside, left) = (r.simd_eq(zero), last.simd_eq(zero));
            let z = f32::group(simd, image, at, 0.0) + f32::group(simd, gathered, at, 0.0);
            let z = outside.select(zero, z);
            Real::put(z, image, at);
            sum += z;
            with_residual = r.mul_add(z, with_residual);
            before = last.mul_add(z, before);
            sum_before += left.select(zero, z);
            before_here += outside.select(zero, last);
            common += (outside | left).select(zero, one);
            last_direction += outside.select(zero, f32::group(simd, direction, at, 0.0));
        }
    }
    let lanes = [sum, with_residual, before, sum_before, before_here, common, last_direction];
    let mut sums = [0.0; 7];
    for (sum, lanes) in sums.iter_mut().zip(lanes) {
        *sum = total(lanes);
    }
    Totals { sums, least: [] }
}

/// Sources of t ← z − mean + βt on the active set, 0 outside, from z in `image`; ⟨r, t⟩ goes to `descent`.
pub(super) fn conjugate<'a>(
    blocks: RowBlocks,
    [residual, image]: [&'a [f32]; 2],
    mean: f64,
    beta: f64,
    direction: &'a mut [f32],
    descent: &'a mut [Totals<1, 0>],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let fields = blocks.of(residual).zip(blocks.of(image)).zip(blocks.of_mut(direction)).zip(descent);
    fields.map(move |(((residual, image), direction), descent)| {
        let mut rows = residual.zip(image).zip(direction);
        move |row: &mut [f32]| {
            let ((residual, image), direction) = next(&mut rows);
            descent.add(vectorised!(simd => conjugate_row(simd, [residual, image], mean, beta, direction, row)));
        }
    })
}

#[inline(always)]
fn conjugate_row<S: Simd>(
    simd: S,
    [residual, image]: [&[f32]; 2],
    mean: f64,
    beta: f64,
    direction: &mut [f32],
    row: &mut [f32],
) -> Totals<1, 0> {
    let zero = splat(simd, 0.0);
    let mut descent = zero;
    for run in (0..residual.len()).step_by(RUN) {
        let end = residual.len().min(run + RUN);
        if all_zero(simd, &residual[run..end]) {
            direction[run..end].fill(0.0);
            row[run..end].fill(0.0);
            continue;
        }
        for at in (run..end).step_by(LANES) {
            let r = f32::group(simd, residual, at, 0.0);
            let z = f32::group(simd, image, at, 0.0) - mean;
            // In a first iteration there is no last direction.
            let t = if beta > 0.0 { f32::group(simd, direction, at, 0.0).mul_add(splat(simd, beta), z) } else { z };
            let t = r.simd_eq(zero).select(zero, t);
            descent = r.mul_add(t, descent);
            Real::put(t, direction, at);
            Real::put(t, row, at);
        }
    }
    Totals { sums: [total(descent)], least: [] }
}

/// Sinks that put the rows of C t into `image`; ⟨t, C t⟩ goes to `curvature`.
pub(super) fn curvature<'a>(
    blocks: RowBlocks,
    direction: &'a [f32],
    image: &'a mut [f32],
    curvature: &'a mut [Totals<1, 0>],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let fields = blocks.of(direction).zip(blocks.of_mut(image)).zip(curvature);
    fields.map(move |((direction, image), curvature)| {
        let mut rows = direction.zip(image);
        move |row: &mut [f32]| {
            let (direction, image) = next(&mut rows);
            image.copy_from_slice(row);
            curvature.add(vectorised!(simd => product(simd, direction, row)));
        }
    })
}

#[inline(always)]
fn product<S: Simd>(simd: S, a: &[f32], b: &[f32]) -> Totals<1, 0> {
    let mut sum = splat(simd, 0.0);
    for at in (0..a.len()).step_by(LANES) {
        sum = f32::group(simd, a, at, 0.0).mul_add(f32::group(simd, b, at, 0.0), sum);
    }
    Totals { sums: [total(sum)], least: [] }
}
