//! Steps of the pressure along a direction: taken, scaled, taken back, and what they do to load and gap.

use crate::numeric::lanes::{LANES, RUN, Real, all_zero, lowest, splat, total, vectorised};
use crate::numeric::rows::{Parts, Totals, each, next, sweep};
use crate::numeric::sums::BLOCK;
use fearless_simd::{f64x8, prelude::*};
use rayon::prelude::*;

/// What a step p + d has met.
#[derive(Debug, Clone, Copy)]
pub(super) struct Advance {
    /// Σ p after it.
    pub load: f64,
    /// ⟨g, d⟩.
    pub slope: f64,
    /// Σ p (g + d's part of C t) after it: that of g + C d where nothing was clipped and `image` was C t.
    pub work: f64,
    /// Whether a pressure ended at zero before the step did.
    pub clipped: bool,
}

/// p ← max(p + unit d, 0) with d = factor · t, shortened where p ends at zero; d is left in `step`. `image` is C t, at the
/// first attempt.
pub(super) fn advance(
    p: &mut [f64],
    [gap, direction, image]: [&[f32]; 3],
    factor: f64,
    unit: f64,
    step: &mut [f32],
) -> Advance {
    let fields = (
        p.par_chunks_mut(BLOCK),
        gap.par_chunks(BLOCK),
        direction.par_chunks(BLOCK),
        image.par_chunks(BLOCK),
        step.par_chunks_mut(BLOCK),
    );
    let Totals { sums: [load, slope, work], least: [clipped] } = sweep(
        BLOCK,
        fields,
        |_, (p, gap, direction, image, step)| vectorised!(simd => advanced(simd, p, [gap, direction, image], factor, unit, step)),
    );
    Advance { load, slope, work, clipped: clipped < 0.0 }
}

#[inline(always)]
fn advanced<S: Simd>(
    simd: S,
    p: &mut [f64],
    [gap, direction, image]: [&[f32]; 3],
    factor: f64,
    unit: f64,
    step: &mut [f32],
) -> Totals<3, 1> {
    let zero = splat(simd, 0.0);
    let (mut load, mut slope, mut work, mut lowest_end) = (zero, zero, zero, zero);
    for run in (0..p.len()).step_by(RUN) {
        let last = p.len().min(run + RUN);
        if all_zero(simd, &direction[run..last]) && all_zero(simd, &p[run..last]) {
            step[run..last].fill(0.0);
            continue;
        }
        for at in (run..last).step_by(LANES) {
            let pressure = f64::group(simd, p, at, 0.0);
            // As it will be stored: what is taken back later is what was added (to 6e-8 where p ends at zero).
            let d = rounded(simd, f32::group(simd, direction, at, 0.0) * factor);
            let end = d.mul_add(splat(simd, unit), pressure);
            let short = end.simd_lt(zero);
            let d = short.select(pressure * (-1.0 / unit), d);
            let end = end.max(zero);
            lowest_end = lowest_end.min(short.select(splat(simd, -1.0), zero));
            let g = f32::group(simd, gap, at, 0.0);
            load += end;
            slope = g.mul_add(d, slope);
            work = end.mul_add(f32::group(simd, image, at, 0.0).mul_add(splat(simd, factor), g), work);
            Real::put(end, p, at);
            Real::put(d, step, at);
        }
    }
    Totals { sums: [total(load), total(slope), total(work)], least: [lowest(lowest_end)] }
}

/// To single precision and back.
#[inline(always)]
fn rounded<S: Simd>(simd: S, group: f64x8<S>) -> f64x8<S> {
    let mut single = [0.0f32; LANES];
    Real::put(group, &mut single, 0);
    f32::group(simd, &single, 0, 0.0)
}

/// p ← s p after a step d, which becomes the step from where it was to there.
pub(super) fn rescale(p: &mut [f64], scale: f64, unit: f64, step: &mut [f32]) {
    each(BLOCK, (p.par_chunks_mut(BLOCK), step.par_chunks_mut(BLOCK)), |_, (p, step)| {
        vectorised!(simd => rescaled(simd, p, scale, unit, step));
    });
}

#[inline(always)]
fn rescaled<S: Simd>(simd: S, p: &mut [f64], scale: f64, unit: f64, step: &mut [f32]) {
    for run in (0..p.len()).step_by(RUN) {
        let last = p.len().min(run + RUN);
        if all_zero(simd, &step[run..last]) && all_zero(simd, &p[run..last]) {
            continue;
        }
        for at in (run..last).step_by(LANES) {
            let (end, d) = (f64::group(simd, p, at, 0.0), f32::group(simd, step, at, 0.0));
            let whole = rounded(simd, end.mul_add(splat(simd, (scale - 1.0) / unit), d));
            let before = end - d * unit;
            let zero = splat(simd, 0.0);
            Real::put((before.max(zero) + whole * unit).max(zero), p, at);
            Real::put(whole, step, at);
        }
    }
}

/// p ← max(p − unit d, 0).
pub(super) fn retreat(p: &mut [f64], step: &[f32], unit: f64) {
    each(BLOCK, (p.par_chunks_mut(BLOCK), step.par_chunks(BLOCK)), |_, (p, step)| {
        vectorised!(simd => retreated(simd, p, step, unit));
    });
}

#[inline(always)]
fn retreated<S: Simd>(simd: S, p: &mut [f64], step: &[f32], unit: f64) {
    for at in (0..p.len()).step_by(LANES) {
        let end = f64::group(simd, p, at, 0.0) - f32::group(simd, step, at, 0.0) * unit;
        Real::put(end.max(splat(simd, 0.0)), p, at);
    }
}

/// Takes the rows of C d for a step d into `image`, by parts; ⟨d, C d⟩, and Σ p and Σ p (g + C d), in `sums`.
pub(super) fn ended<'a>(
    parts: Parts,
    p: &'a [f64],
    [gap, step]: [&'a [f32]; 2],
    image: &'a mut [f32],
    sums: &'a mut [Totals<3, 0>],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let fields = parts.of(p).zip(parts.of(gap)).zip(parts.of(step)).zip(parts.of_mut(image)).zip(sums);
    fields.map(move |((((p, gap), step), image), sums)| {
        let mut rows = p.zip(gap).zip(step).zip(image);
        move |row: &mut [f32]| {
            let (((p, gap), step), image) = next(&mut rows);
            image.copy_from_slice(row);
            sums.add(vectorised!(simd => ends(simd, p, [gap, step, row])));
        }
    })
}

#[inline(always)]
fn ends<S: Simd>(simd: S, p: &[f64], [gap, step, image]: [&[f32]; 3]) -> Totals<3, 0> {
    let zero = splat(simd, 0.0);
    let (mut curvature, mut load, mut work) = (zero, zero, zero);
    for at in (0..p.len()).step_by(LANES) {
        let (pressure, change) = (f64::group(simd, p, at, 0.0), f32::group(simd, image, at, 0.0));
        curvature = f32::group(simd, step, at, 0.0).mul_add(change, curvature);
        load += pressure;
        work = pressure.mul_add(f32::group(simd, gap, at, 0.0) + change, work);
    }
    Totals { sums: [total(curvature), total(load), total(work)], least: [] }
}

/// Σ p and Σ p (g + factor · changes).
pub(super) fn works(p: &[f64], gap: &[f32], (changes, factor): (&[f32], f64)) -> [f64; 2] {
    let fields = (p.par_chunks(BLOCK), gap.par_chunks(BLOCK), changes.par_chunks(BLOCK));
    let Totals { sums, least: [] } =
        sweep(BLOCK, fields, |_, (p, gap, changes)| vectorised!(simd => worked(simd, p, gap, (changes, factor))));
    sums
}

#[inline(always)]
fn worked<S: Simd>(simd: S, p: &[f64], gap: &[f32], (changes, factor): (&[f32], f64)) -> Totals<2, 0> {
    let (mut load, mut work) = (splat(simd, 0.0), splat(simd, 0.0));
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        let g = f32::group(simd, changes, at, 0.0).mul_add(splat(simd, factor), f32::group(simd, gap, at, 0.0));
        load += pressure;
        work = pressure.mul_add(g, work);
    }
    Totals { sums: [total(load), total(work)], least: [] }
}
