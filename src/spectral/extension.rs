//! The residual continued beyond the active set I, for the preconditioner M = P_I Eᵀ C⁻¹ E P_I.
//!
//! Continued by zero, the residual jumps at the edge of contact, and C⁻¹ ~ |q| answers with a pressure like 1/√distance
//! that is not there. E leaves a field alone on I and continues it outside by a local mean that fades:
//!
//! E = P_I + (1 − P_I) W S P_I,  W = D c/(c² + c₀²),  c = S χ,
//!
//! where S is a smoothing over some 15 samples each way (means ¼, ½, ¼ of samples 1, 2, 4 and 8 apart, along a₁ and a₂), χ
//! is 1 on I and 0 outside, S r/c is then the mean of the residual near by, D and c₀ how much of it is kept at the edge
//! and how far out. S is symmetric, so that Eᵀ = P_I + P_I S W (1 − P_I), and M is symmetric and positive.

use crate::numeric::lanes::{LANES, vectorised};
use crate::numeric::rows;
use fearless_simd::{f32x8, prelude::*};
use rayon::prelude::*;
use std::ops::Range;

/// What is kept of the mean at the edge of contact.
const DECAY: f32 = 0.8;
/// Share of I among the samples near by at which the continuation fades.
const FADE: f32 = 0.07;
/// Distances of the means, samples.
const STEPS: [usize; 4] = [1, 2, 4, 8];
/// Samples that the smoothing reaches each way.
const REACH: usize = 15;
/// Rows, and columns, smoothed along a₁ together: with what they reach they stay in the cache.
const BLOCK: [usize; 2] = [64, 256];

/// The residual r on I (exactly 0 outside) becomes E (r − mean) in `result`, and `weight` becomes W outside and 0 on I.
pub(super) fn extend([n1, n2]: [usize; 2], residual: &[f32], mean: f32, [result, weight, aside]: [&mut [f32]; 3]) {
    along_first(
        [n1, n2],
        [&mut *aside, &mut *weight],
        |from, [near, share]| vectorised!(simd => told_apart(simd, &residual[from], mean, near, share)),
    );
    let fields = (result.par_chunks_mut(n2), weight.par_chunks_mut(n2), aside.par_chunks(n2), residual.par_chunks(n2));
    rows::each(n2, fields, |_, (result, weight, aside, residual)| {
        if weight.iter().all(|&share| share == 0.0) {
            result.fill(0.0);
            return;
        }
        let (near, share) = (along_second(aside), along_second(weight));
        vectorised!(simd => continued(simd, residual, mean, [&near, &share], result, weight));
    });
}

/// What Eᵀ adds to a `field` on I, S W field, in `weight`.
pub(super) fn gather([n1, n2]: [usize; 2], field: &[f32], [weight, aside]: [&mut [f32]; 2]) {
    let fields = (aside.par_chunks_mut(n2), weight.par_chunks(n2), field.par_chunks(n2));
    rows::each(n2, fields, |_, (aside, weight, field)| {
        if weight.iter().all(|&w| w == 0.0) {
            aside.fill(0.0);
            return;
        }
        for ((product, w), y) in aside.iter_mut().zip(weight).zip(field) {
            *product = w * y;
        }
        let smooth = along_second(aside);
        aside.copy_from_slice(&smooth[..n2]);
    });
    along_first([n1, n2], [weight], |from, [line]| {
        line.copy_from_slice(&aside[from]);
        line.iter().any(|&x| x != 0.0)
    });
}

/// r − mean and χ of a line; whether there is I in it.
#[inline(always)]
fn told_apart<S: Simd>(_: S, residual: &[f32], mean: f32, near: &mut [f32], share: &mut [f32]) -> bool {
    let mut most = 0.0f32;
    for ((&r, near), share) in residual.iter().zip(near).zip(share) {
        *near = if r == 0.0 { 0.0 } else { r - mean };
        *share = if r == 0.0 { 0.0 } else { 1.0 };
        most = most.max(*share);
    }
    most > 0.0
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

/// A row smoothed along a₂; what follows its samples means nothing.
fn along_second(row: &[f32]) -> Vec<f32> {
    let n2 = row.len();
    let mut line = vec![0.0; n2 + 2 * REACH + LANES];
    line[REACH..REACH + n2].copy_from_slice(row);
    for k in 0..REACH {
        line[REACH - 1 - k] = row[(n2 - 1) - k % n2];
        line[REACH + n2 + k] = row[k % n2];
    }
    vectorised!(simd => smooth(simd, &mut line, n2, 1));
    line
}

/// `F` fields smoothed along a₁; `fill` puts the samples of a range into a line of each, and tells whether any counts.
fn along_first<const F: usize>(
    [n1, n2]: [usize; 2],
    to: [&mut [f32]; F],
    fill: impl Fn(Range<usize>, [&mut [f32]; F]) -> bool + Sync,
) {
    let [block, widest] = BLOCK;
    let mut blocks: Vec<Vec<&mut [f32]>> = (0..n1.div_ceil(block)).map(|_| Vec::with_capacity(F)).collect();
    for field in to {
        field.chunks_mut(block * n2).zip(&mut blocks).for_each(|(rows, block)| block.push(rows));
    }
    blocks.into_par_iter().enumerate().for_each(|(number, mut to)| {
        let height = to[0].len() / n2;
        let size = (height + 2 * REACH) * widest.min(n2) + LANES;
        let mut strips: [Vec<f32>; F] = std::array::from_fn(|_| vec![0.0; size]);
        for left in (0..n2).step_by(widest) {
            let width = widest.min(n2 - left);
            let mut any = false;
            for line in 0..height + 2 * REACH {
                // (line − REACH) mod n1, however few rows there are.
                let start = (number * block + line + REACH * (n1 - 1)) % n1 * n2 + left;
                let lines = strips.each_mut().map(|strip| &mut strip[line * width..][..width]);
                any |= fill(start..start + width, lines);
            }
            for (to, strip) in to.iter_mut().zip(&mut strips) {
                if any {
                    vectorised!(simd => smooth(simd, strip, height * width, width));
                }
                for (to, line) in to.chunks_exact_mut(n2).zip(strip.chunks_exact(width)) {
                    to[left..left + width].copy_from_slice(line);
                }
            }
        }
    });
}

/// The means one after the other, in place: the result's `len` numbers start where the reach of the first one started.
#[inline(always)]
fn smooth<S: Simd>(simd: S, line: &mut [f32], len: usize, stride: usize) {
    let (quarter, half) = (f32x8::simd_from(simd, 0.25), f32x8::simd_from(simd, 0.5));
    let mut left = REACH;
    for step in STEPS {
        left -= step;
        let apart = step * stride;
        for at in (0..len + 2 * left * stride).step_by(LANES) {
            let before = f32x8::from_slice(simd, &line[at..][..LANES]);
            let here = f32x8::from_slice(simd, &line[at + apart..][..LANES]);
            let after = f32x8::from_slice(simd, &line[at + 2 * apart..][..LANES]);
            (before + after).mul_add(quarter, here * half).store_slice(&mut line[at..at + LANES]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ⟨E r, y⟩ = ⟨r, Eᵀ y⟩, on grids smaller than the reach and wider than a block.
    #[test]
    fn what_is_gathered_is_the_adjoint_of_what_is_extended() {
        for [n1, n2] in [[4, 7], [90, 24], [131, 300]] {
            let noise = |k: usize| ((k * k * 7919 + 13 * k) % 1009) as f32 / 1009.0 - 0.5;
            let (mean, size) = (0.1, n1 * n2);
            let inside = |k: usize| (k / n2 / 3 + k % n2 / 5) % 4 == 1;
            let residual: Vec<f32> = (0..size).map(|k| if inside(k) { noise(k) + 2.0 } else { 0.0 }).collect();
            let other: Vec<f32> = (0..size).map(|k| noise(k + 77)).collect();
            let zero = vec![0.0; size];
            let (mut extended, mut weight, mut aside) = (zero.clone(), zero.clone(), zero);
            extend([n1, n2], &residual, mean, [&mut extended, &mut weight, &mut aside]);
            let outside = (0..size).filter(|&k| !inside(k) && extended[k] != 0.0).count();
            assert!(outside > size / 2, "{outside} of {size} samples continued");
            gather([n1, n2], &other, [&mut weight, &mut aside]);
            let dot = |a: f32, b: f32| f64::from(a) * f64::from(b);
            let forth: f64 = (0..size).map(|k| dot(extended[k], other[k])).sum();
            let back: f64 =
                (0..size).filter(|&k| inside(k)).map(|k| dot(residual[k] - mean, other[k] + weight[k])).sum();
            assert!((forth / back - 1.0).abs() < 1e-5, "{n1} × {n2}: {forth} {back}");
        }
    }
}
