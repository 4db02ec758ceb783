//! Lines 1, 3 and 5 of the method, fused: the step of the pressure, the gap after it, and the residual on the new active set.
//!
//! - [`advance`]: p ← min(max(p − τt + λ, 0), H), shortened again ([`retreat`]) or scaled to the mean ([`rescale`]); [`shifted_load`]: the
//!   load for a shift λ;
//! - [`after_step`]: C d, with what it does to energy and load;
//! - [`gap_from`], [`update_gap`]: g in single precision, I = ({p > 0} ∪ {g < 0}) ∖ {p = H, g ≤ 0}, r = g on I.
//!
//! Sums are taken in double precision, whatever the fields are stored in.

use super::bounds::{Bounded, Bounds};
use super::duality::{GapLanes, GapSums, LoadLanes, LoadSums, WeightedSums};
use crate::numeric::lanes::{LANES, RUN, Real, all_zero, lowest, splat, total, vectorised};
use crate::numeric::rows::{RowBlocks, Totals, each_row, next, row_totals};
use crate::numeric::sums::BLOCK;
use fearless_simd::{f64x8, prelude::*};
use rayon::prelude::*;

/// The active set I = ({p > 0} ∪ {g < 0}) ∖ {p = H, g ≤ 0}.
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
pub(super) fn gap_from(
    p: &[f64],
    g: &[f64],
    (length, bounds): (f64, Bounds),
    gap: &mut [f32],
    residual: &mut [f32],
) -> ActiveSet {
    let fields = (p.par_chunks(BLOCK), g.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK), residual.par_chunks_mut(BLOCK));
    let Totals { sums: [size, sum], .. } = row_totals(
        BLOCK,
        fields,
        |_, (p, g, gap, residual)| vectorised!(simd => gap_from_block(simd, [p, g], (1.0 / length, bounds), gap, residual)),
    );
    ActiveSet { size, sum }
}

#[inline(always)]
fn gap_from_block<S: Simd>(
    simd: S,
    [p, g]: [&[f64]; 2],
    (factor, bounds): (f64, Bounds),
    gap: &mut [f32],
    residual: &mut [f32],
) -> Totals<2, 0> {
    let (zero, bounds) = (splat(simd, 0.0), bounds.lanes(simd));
    let (mut size, mut sum) = (zero, zero);
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        let g = f64::group(simd, g, at, f64::MAX) * factor;
        Real::put(g, gap, at);
        let (active, r) = bounds.on_active(pressure, g);
        Real::put(r, residual, at);
        size += active;
        sum += r;
    }
    Totals { sums: [total(size), total(sum)], least: [] }
}

/// g ← g + factor · changes − shift; r is the gap on the active set. `load` are the sums of p.
pub(super) fn update_gap(
    p: &[f64],
    load: LoadSums,
    (changes, factor): (&[f32], f64),
    (shift, bounds): (f64, Bounds),
    gap: &mut [f32],
    residual: &mut [f32],
) -> (ActiveSet, GapSums) {
    let fields =
        (p.par_chunks(BLOCK), changes.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK), residual.par_chunks_mut(BLOCK));
    let Totals { sums: [size, sum, gap @ ..], least } = row_totals(
        BLOCK,
        fields,
        |_, (p, changes, gap, residual)| vectorised!(simd => update_gap_block(simd, p, (changes, factor), (shift, bounds), gap, residual)),
    );
    (ActiveSet { size, sum }, GapSums::of(load, Totals { sums: gap, least }))
}

#[inline(always)]
fn update_gap_block<S: Simd>(
    simd: S,
    p: &[f64],
    (changes, factor): (&[f32], f64),
    (shift, bounds): (f64, Bounds),
    gap: &mut [f32],
    residual: &mut [f32],
) -> Totals<6, 3> {
    let (zero, bounds) = (splat(simd, 0.0), bounds.lanes(simd));
    let (mut size, mut sum, mut sums) = (zero, zero, GapLanes::new(simd, bounds));
    for at in (0..p.len()).step_by(LANES) {
        let (pressure, before) = (f64::group(simd, p, at, 0.0), f32::group(simd, gap, at, f32::MAX) - shift);
        let g = f32::group(simd, changes, at, 0.0).mul_add(splat(simd, factor), before);
        Real::put(g, gap, at);
        let (active, r) = bounds.on_active(pressure, g);
        Real::put(r, residual, at);
        size += active;
        sum += r;
        sums.add(pressure, g);
    }
    let Totals { sums: [work, complementarity, beyond, open], least } = sums.totals();
    Totals { sums: [total(size), total(sum), work, complementarity, beyond, open], least }
}

/// Sums over a step p + d.
#[derive(Debug, Clone, Copy)]
pub(super) struct Advance {
    /// Sums of p after it.
    pub load: LoadSums,
    /// ⟨g, d⟩.
    pub slope: f64,
    /// Sums with g − τ C t after it, which is g + C d where nothing was clipped.
    pub work: WeightedSums,
    /// Whether a pressure ended at zero or at H before the step did.
    pub clipped: bool,
}

/// p ← min(max(p + unit d, 0), H) with d = factor · t + λ on the active set, shortened where p ends at a bound; d goes to `step`. `image`
/// is C t, at the first attempt; λ is a `shift`, in units of pressure.
pub(super) fn advance(
    p: &mut [f64],
    [gap, direction, image, residual]: [&[f32]; 4],
    [factor, shift, unit]: [f64; 3],
    bounds: Bounds,
    step: &mut [f32],
) -> Advance {
    let fields = (
        p.par_chunks_mut(BLOCK),
        gap.par_chunks(BLOCK),
        direction.par_chunks(BLOCK),
        image.par_chunks(BLOCK),
        residual.par_chunks(BLOCK),
        step.par_chunks_mut(BLOCK),
    );
    let Totals { sums: [free, full, slope, work, weight, weighted], least: [clipped] } = row_totals(
        BLOCK,
        fields,
        |_, (p, gap, direction, image, residual, step)| vectorised!(simd => advance_block(simd, p, [gap, direction, image, residual], [factor, shift, unit], bounds, step)),
    );
    let work = WeightedSums { work, weight, weighted };
    Advance { load: LoadSums { free, full }, slope, work, clipped: clipped < 0.0 }
}

#[inline(always)]
fn advance_block<S: Simd>(
    simd: S,
    p: &mut [f64],
    [gap, direction, image, residual]: [&[f32]; 4],
    [factor, shift, unit]: [f64; 3],
    bounds: Bounds,
    step: &mut [f32],
) -> Totals<6, 1> {
    let (zero, bounds) = (splat(simd, 0.0), bounds.lanes(simd));
    let (mut slope, mut lowest_end, mut load) = (zero, zero, LoadLanes::new(simd, bounds));
    for run in (0..p.len()).step_by(RUN) {
        let last = p.len().min(run + RUN);
        if all_zero(simd, &direction[run..last]) && all_zero(simd, &p[run..last]) {
            step[run..last].fill(0.0);
            continue;
        }
        for at in (run..last).step_by(LANES) {
            let pressure = f64::group(simd, p, at, 0.0);
            // The increment as it is stored: a retreat takes back what was added (to 6e-8 where p ends at zero).
            let along = f32::group(simd, direction, at, 0.0) * factor;
            let along =
                if shift == 0.0 { along } else { along + shifted(simd, f32::group(simd, residual, at, 0.0), shift) };
            let Bounded { end, step: d, parts, clipped } = bounds.stepped(pressure, rounded(simd, along), unit);
            lowest_end = lowest_end.min(clipped);
            let g = f32::group(simd, gap, at, 0.0);
            slope = g.mul_add(d, slope);
            load.add(parts, end, f32::group(simd, image, at, 0.0).mul_add(splat(simd, factor), g));
            Real::put(end, p, at);
            Real::put(d, step, at);
        }
    }
    let [free, full, work, weight, weighted] = load.totals();
    Totals { sums: [free, full, total(slope), work, weight, weighted], least: [lowest(lowest_end)] }
}

/// λ on the active set, where r is not zero.
#[inline(always)]
fn shifted<S: Simd>(simd: S, residual: f64x8<S>, shift: f64) -> f64x8<S> {
    let zero = splat(simd, 0.0);
    residual.simd_eq(zero).select(zero, splat(simd, shift))
}

/// The load after a step with a shift λ: Σ p, and the number of samples that λ moves.
pub(super) fn shifted_load(
    p: &[f64],
    [direction, residual]: [&[f32]; 2],
    [factor, shift, unit]: [f64; 3],
    bounds: Bounds,
) -> [f64; 2] {
    let fields = (p.par_chunks(BLOCK), direction.par_chunks(BLOCK), residual.par_chunks(BLOCK));
    let Totals { sums, least: [] } = row_totals(
        BLOCK,
        fields,
        |_, (p, direction, residual)| vectorised!(simd => shifted_load_of(simd, p, [direction, residual], [factor, shift, unit], bounds)),
    );
    sums
}

#[inline(always)]
fn shifted_load_of<S: Simd>(
    simd: S,
    p: &[f64],
    [direction, residual]: [&[f32]; 2],
    [factor, shift, unit]: [f64; 3],
    bounds: Bounds,
) -> Totals<2, 0> {
    let (zero, bounds) = (splat(simd, 0.0), bounds.lanes(simd));
    let (mut load, mut moves) = (zero, zero);
    for run in (0..p.len()).step_by(RUN) {
        let last = p.len().min(run + RUN);
        if all_zero(simd, &residual[run..last]) && all_zero(simd, &p[run..last]) {
            continue;
        }
        for at in (run..last).step_by(LANES) {
            let (pressure, r) = (f64::group(simd, p, at, 0.0), f32::group(simd, residual, at, 0.0));
            let along = f32::group(simd, direction, at, 0.0) * factor + shifted(simd, r, shift);
            let end = along.mul_add(splat(simd, unit), pressure);
            load += bounds.clamp(end);
            moves += bounds.unless(r.simd_eq(zero), bounds.count(bounds.is_free(end)));
        }
    }
    Totals { sums: [total(load), total(moves)], least: [] }
}

/// The numbers rounded to single precision.
#[inline(always)]
fn rounded<S: Simd>(simd: S, group: f64x8<S>) -> f64x8<S> {
    let mut single = [0.0f32; LANES];
    Real::put(group, &mut single, 0);
    f32::group(simd, &single, 0, 0.0)
}

/// p ← s p after a step d, which becomes the whole step from the pressure before it. Whether any of it is beyond H then.
pub(super) fn rescale(p: &mut [f64], scale: f64, unit: f64, bounds: Bounds, step: &mut [f32]) -> bool {
    let fields = (p.par_chunks_mut(BLOCK), step.par_chunks_mut(BLOCK));
    let Totals { sums: [], least: [beyond] } = row_totals(
        BLOCK,
        fields,
        |_, (p, step)| vectorised!(simd => rescale_block(simd, p, scale, unit, bounds, step)),
    );
    beyond < 0.0
}

#[inline(always)]
fn rescale_block<S: Simd>(
    simd: S,
    p: &mut [f64],
    scale: f64,
    unit: f64,
    bounds: Bounds,
    step: &mut [f32],
) -> Totals<0, 1> {
    let (zero, bounds) = (splat(simd, 0.0), bounds.lanes(simd));
    let mut beyond = zero;
    for run in (0..p.len()).step_by(RUN) {
        let last = p.len().min(run + RUN);
        if all_zero(simd, &step[run..last]) && all_zero(simd, &p[run..last]) {
            continue;
        }
        for at in (run..last).step_by(LANES) {
            let (end, d) = (f64::group(simd, p, at, 0.0), f32::group(simd, step, at, 0.0));
            let whole = rounded(simd, end.mul_add(splat(simd, (scale - 1.0) / unit), d));
            let before = end - d * unit;
            let scaled = bounds.raise(bounds.raise(before) + whole * unit);
            beyond = beyond.min(bounds.is_nearly_full(scaled).select(splat(simd, -1.0), zero));
            Real::put(scaled, p, at);
            Real::put(whole, step, at);
        }
    }
    Totals { sums: [], least: [lowest(beyond)] }
}

/// p ← max(p − unit d, 0), at most H.
pub(super) fn retreat(p: &mut [f64], step: &[f32], unit: f64, bounds: Bounds) {
    each_row(BLOCK, (p.par_chunks_mut(BLOCK), step.par_chunks(BLOCK)), |_, (p, step)| {
        vectorised!(simd => retreat_block(simd, p, step, unit, bounds));
    });
}

#[inline(always)]
fn retreat_block<S: Simd>(simd: S, p: &mut [f64], step: &[f32], unit: f64, bounds: Bounds) {
    let bounds = bounds.lanes(simd);
    for at in (0..p.len()).step_by(LANES) {
        let end = f64::group(simd, p, at, 0.0) - f32::group(simd, step, at, 0.0) * unit;
        Real::put(bounds.project(end), p, at);
    }
}

/// Sinks that put the rows of C d for a step d into `image`; ⟨d, C d⟩ and the sums with g + C d go to `sums`.
pub(super) fn after_step<'a>(
    blocks: RowBlocks,
    (p, bounds): (&'a [f64], Bounds),
    [gap, step]: [&'a [f32]; 2],
    image: &'a mut [f32],
    sums: &'a mut [Totals<6, 0>],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let fields = blocks.of(p).zip(blocks.of(gap)).zip(blocks.of(step)).zip(blocks.of_mut(image)).zip(sums);
    fields.map(move |((((p, gap), step), image), sums)| {
        let mut rows = p.zip(gap).zip(step).zip(image);
        move |row: &mut [f32]| {
            let (((p, gap), step), image) = next(&mut rows);
            image.copy_from_slice(row);
            sums.add(vectorised!(simd => step_sums(simd, (p, bounds), [gap, step, row])));
        }
    })
}

#[inline(always)]
fn step_sums<S: Simd>(simd: S, (p, bounds): (&[f64], Bounds), [gap, step, image]: [&[f32]; 3]) -> Totals<6, 0> {
    let mut curvature = splat(simd, 0.0);
    for at in (0..p.len()).step_by(LANES) {
        curvature = f32::group(simd, step, at, 0.0).mul_add(f32::group(simd, image, at, 0.0), curvature);
    }
    let [free, full, work, weight, weighted] = load_and_work_of(simd, (p, bounds), gap, (image, 1.0)).sums;
    Totals { sums: [total(curvature), free, full, work, weight, weighted], least: [] }
}

/// Sums of p, and those with g + factor · changes.
pub(super) fn load_and_work(
    (p, bounds): (&[f64], Bounds),
    gap: &[f32],
    (changes, factor): (&[f32], f64),
) -> (LoadSums, WeightedSums) {
    let fields = (p.par_chunks(BLOCK), gap.par_chunks(BLOCK), changes.par_chunks(BLOCK));
    let Totals { sums: [free, full, work, weight, weighted], least: [] } = row_totals(
        BLOCK,
        fields,
        |_, (p, gap, changes)| vectorised!(simd => load_and_work_of(simd, (p, bounds), gap, (changes, factor))),
    );
    (LoadSums { free, full }, WeightedSums { work, weight, weighted })
}

#[inline(always)]
fn load_and_work_of<S: Simd>(
    simd: S,
    (p, bounds): (&[f64], Bounds),
    gap: &[f32],
    (changes, factor): (&[f32], f64),
) -> Totals<5, 0> {
    let bounds = bounds.lanes(simd);
    let mut load = LoadLanes::new(simd, bounds);
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        let g = f32::group(simd, changes, at, 0.0).mul_add(splat(simd, factor), f32::group(simd, gap, at, 0.0));
        load.add(bounds.parts(pressure), pressure, g);
    }
    Totals { sums: load.totals(), least: [] }
}
