//! Lines 1, 3 and 5 of the method, fused: the step of the pressure, the gap after it, and the residual on the new active set.
//!
//! - [`advance`]: p ← max(p − τt, 0), shortened again ([`retreat`]) or scaled to the mean ([`rescale`]);
//! - [`after_step`]: C d, with what it does to energy and load;
//! - [`gap_from`], [`update_gap`]: g in single precision, I = {p > 0} ∪ {g < 0}, r = g on I.
//!
//! Sums are taken in double precision, whatever the fields are stored in.

use super::check::GapSums;
use crate::numeric::lanes::{LANES, RUN, Real, all_zero, lowest, splat, total, vectorised};
use crate::numeric::rows::{RowBlocks, Totals, each_row, next, row_totals};
use crate::numeric::sums::BLOCK;
use fearless_simd::{f64x8, mask64x8, prelude::*};
use rayon::prelude::*;

/// The active set I = {p > 0} ∪ {g < 0}.
#[derive(Debug, Clone, Copy)]
pub(super) struct ActiveSet {
    /// Number of samples.
    pub size: f64,
    /// Σ r.
    pub sum: f64,
}

impl ActiveSet {
    /// Mean of r on I.
    pub fn mean(&self) -> f64 {
        if self.size > 0.0 { self.sum / self.size } else { 0.0 }
    }
}

/// gap ← g/length; r is the gap on the active set.
pub(super) fn gap_from(p: &[f64], g: &[f64], length: f64, gap: &mut [f32], residual: &mut [f32]) -> ActiveSet {
    let fields = (p.par_chunks(BLOCK), g.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK), residual.par_chunks_mut(BLOCK));
    let Totals { sums: [size, sum], .. } = row_totals(
        BLOCK,
        fields,
        |_, (p, g, gap, residual)| vectorised!(simd => gap_from_block(simd, p, g, 1.0 / length, gap, residual)),
    );
    ActiveSet { size, sum }
}

#[inline(always)]
fn gap_from_block<S: Simd>(
    simd: S,
    p: &[f64],
    g: &[f64],
    factor: f64,
    gap: &mut [f32],
    residual: &mut [f32],
) -> Totals<2, 0> {
    let zero = splat(simd, 0.0);
    let (mut size, mut sum) = (zero, zero);
    for at in (0..p.len()).step_by(LANES) {
        let pressed = f64::group(simd, p, at, 0.0).simd_gt(zero);
        let g = f64::group(simd, g, at, f64::MAX) * factor;
        Real::put(g, gap, at);
        let (active, r) = on_active(simd, pressed, g);
        Real::put(r, residual, at);
        size += active;
        sum += r;
    }
    Totals { sums: [total(size), total(sum)], least: [] }
}

/// χ and r = χ g, which is never exactly zero on the active set.
#[inline(always)]
fn on_active<S: Simd>(simd: S, pressed: mask64x8<S>, g: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    let (zero, tiny) = (splat(simd, 0.0), splat(simd, f64::from(f32::MIN_POSITIVE)));
    let active = pressed | g.simd_lt(zero);
    let r = active.select(g.abs().simd_lt(tiny).select(tiny, g), zero);
    (active.select(splat(simd, 1.0), zero), r)
}

/// g ← g + factor · changes − shift; r is the gap on the active set. `load` is Σ p.
pub(super) fn update_gap(
    p: &[f64],
    load: f64,
    (changes, factor): (&[f32], f64),
    shift: f64,
    gap: &mut [f32],
    residual: &mut [f32],
) -> (ActiveSet, GapSums) {
    let fields =
        (p.par_chunks(BLOCK), changes.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK), residual.par_chunks_mut(BLOCK));
    let Totals { sums: [size, sum, work, complementarity], least: [least, outside] } = row_totals(
        BLOCK,
        fields,
        |_, (p, changes, gap, residual)| vectorised!(simd => update_gap_block(simd, p, (changes, factor), shift, gap, residual)),
    );
    (ActiveSet { size, sum }, GapSums { load, work, complementarity, least, outside })
}

#[inline(always)]
fn update_gap_block<S: Simd>(
    simd: S,
    p: &[f64],
    (changes, factor): (&[f32], f64),
    shift: f64,
    gap: &mut [f32],
    residual: &mut [f32],
) -> Totals<4, 2> {
    let (zero, far) = (splat(simd, 0.0), splat(simd, f64::INFINITY));
    let (mut size, mut sum, mut work, mut complementarity) = (zero, zero, zero, zero);
    let (mut least, mut outside) = (far, far);
    for at in (0..p.len()).step_by(LANES) {
        let (pressure, before) = (f64::group(simd, p, at, 0.0), f32::group(simd, gap, at, f32::MAX) - shift);
        let g = f32::group(simd, changes, at, 0.0).mul_add(splat(simd, factor), before);
        Real::put(g, gap, at);
        let pressed = pressure.simd_gt(zero);
        let (active, r) = on_active(simd, pressed, g);
        Real::put(r, residual, at);
        size += active;
        sum += r;
        work = pressure.mul_add(g, work);
        complementarity = pressure.mul_add(g.abs(), complementarity);
        least = least.min(g);
        outside = outside.min(pressed.select(far, g));
    }
    let sums = [total(size), total(sum), total(work), total(complementarity)];
    Totals { sums, least: [lowest(least), lowest(outside)] }
}

/// Sums over a step p + d.
#[derive(Debug, Clone, Copy)]
pub(super) struct Advance {
    /// Σ p after it.
    pub load: f64,
    /// ⟨g, d⟩.
    pub slope: f64,
    /// Σ p (g − τ C t) after it, which is Σ p (g + C d) where nothing was clipped.
    pub work: f64,
    /// Whether a pressure ended at zero before the step did.
    pub clipped: bool,
}

/// p ← max(p + unit d, 0) with d = factor · t, shortened where p ends at zero; d goes to `step`. `image` is C t, at the
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
    let Totals { sums: [load, slope, work], least: [clipped] } = row_totals(
        BLOCK,
        fields,
        |_, (p, gap, direction, image, step)| vectorised!(simd => advance_block(simd, p, [gap, direction, image], factor, unit, step)),
    );
    Advance { load, slope, work, clipped: clipped < 0.0 }
}

#[inline(always)]
fn advance_block<S: Simd>(
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
            // As it is stored: a retreat takes back what was added (to 6e-8 where p ends at zero).
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

/// p ← s p after a step d, which becomes the whole step from the pressure before it.
pub(super) fn rescale(p: &mut [f64], scale: f64, unit: f64, step: &mut [f32]) {
    each_row(BLOCK, (p.par_chunks_mut(BLOCK), step.par_chunks_mut(BLOCK)), |_, (p, step)| {
        vectorised!(simd => rescale_block(simd, p, scale, unit, step));
    });
}

#[inline(always)]
fn rescale_block<S: Simd>(simd: S, p: &mut [f64], scale: f64, unit: f64, step: &mut [f32]) {
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
    each_row(BLOCK, (p.par_chunks_mut(BLOCK), step.par_chunks(BLOCK)), |_, (p, step)| {
        vectorised!(simd => retreat_block(simd, p, step, unit));
    });
}

#[inline(always)]
fn retreat_block<S: Simd>(simd: S, p: &mut [f64], step: &[f32], unit: f64) {
    for at in (0..p.len()).step_by(LANES) {
        let end = f64::group(simd, p, at, 0.0) - f32::group(simd, step, at, 0.0) * unit;
        Real::put(end.max(splat(simd, 0.0)), p, at);
    }
}

/// Sinks that put the rows of C d for a step d into `image`; ⟨d, C d⟩, Σ p and Σ p (g + C d) go to `sums`.
pub(super) fn after_step<'a>(
    blocks: RowBlocks,
    p: &'a [f64],
    [gap, step]: [&'a [f32]; 2],
    image: &'a mut [f32],
    sums: &'a mut [Totals<3, 0>],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let fields = blocks.of(p).zip(blocks.of(gap)).zip(blocks.of(step)).zip(blocks.of_mut(image)).zip(sums);
    fields.map(move |((((p, gap), step), image), sums)| {
        let mut rows = p.zip(gap).zip(step).zip(image);
        move |row: &mut [f32]| {
            let (((p, gap), step), image) = next(&mut rows);
            image.copy_from_slice(row);
            sums.add(vectorised!(simd => step_sums(simd, p, [gap, step, row])));
        }
    })
}

#[inline(always)]
fn step_sums<S: Simd>(simd: S, p: &[f64], [gap, step, image]: [&[f32]; 3]) -> Totals<3, 0> {
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
pub(super) fn load_and_work(p: &[f64], gap: &[f32], (changes, factor): (&[f32], f64)) -> [f64; 2] {
    let fields = (p.par_chunks(BLOCK), gap.par_chunks(BLOCK), changes.par_chunks(BLOCK));
    let Totals { sums, least: [] } = row_totals(
        BLOCK,
        fields,
        |_, (p, gap, changes)| vectorised!(simd => load_and_work_of(simd, p, gap, (changes, factor))),
    );
    sums
}

#[inline(always)]
fn load_and_work_of<S: Simd>(simd: S, p: &[f64], gap: &[f32], (changes, factor): (&[f32], f64)) -> Totals<2, 0> {
    let (mut load, mut work) = (splat(simd, 0.0), splat(simd, 0.0));
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        let g = f32::group(simd, changes, at, 0.0).mul_add(splat(simd, factor), f32::group(simd, gap, at, 0.0));
        load += pressure;
        work = pressure.mul_add(g, work);
    }
    Totals { sums: [total(load), total(work)], least: [] }
}
