//! The sweeps over the fields that an iteration of the preconditioned method consists of, besides its convolutions.
//!
//! Sums are taken in double precision, whatever the fields are stored in.

use super::check::Residuals;
use crate::numeric::lanes::{LANES, Real, lowest, splat, total, vectorised};
use crate::numeric::rows::{Totals, each, sweep};
use crate::numeric::sums::BLOCK;
use fearless_simd::prelude::*;
use rayon::prelude::*;

/// The active set I = {p > 0} ∪ {g < 0}.
#[derive(Debug, Clone, Copy)]
pub(super) struct Active {
    /// Its samples.
    pub size: f64,
    /// Σ r.
    pub sum: f64,
}

impl Active {
    /// Mean of r on I.
    pub fn mean(&self) -> f64 {
        if self.size > 0.0 { self.sum / self.size } else { 0.0 }
    }
}

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

/// What a step p + d has met.
#[derive(Debug, Clone, Copy)]
pub(super) struct Advance {
    /// Σ p after it.
    pub load: f64,
    /// ⟨g, d⟩.
    pub slope: f64,
    /// Whether a pressure ended at zero before the step did.
    pub clipped: bool,
}

/// gap ← g/length.
pub(super) fn take(g: &[f64], length: f64, gap: &mut [f32]) {
    each(BLOCK, (g.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK)), |_, (g, gap)| {
        vectorised!(simd => taken(simd, g, 1.0 / length, gap));
    });
}

#[inline(always)]
fn taken<S: Simd>(simd: S, g: &[f64], factor: f64, gap: &mut [f32]) {
    for at in (0..g.len()).step_by(LANES) {
        Real::put(f64::group(simd, g, at, 0.0) * factor, gap, at);
    }
}

/// g ← g − shift; r is g on the active set, never exactly zero there. `load` is Σ p.
pub(super) fn residual(p: &[f64], load: f64, shift: f64, gap: &mut [f32], residual: &mut [f32]) -> (Active, Residuals) {
    let fields = (p.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK), residual.par_chunks_mut(BLOCK));
    let Totals { sums: [size, sum, work, complementarity], least: [least, outside] } =
        sweep(BLOCK, fields, |_, (p, gap, residual)| vectorised!(simd => residuals(simd, p, shift, gap, residual)));
    (Active { size, sum }, Residuals { load, work, complementarity, least, outside })
}

#[inline(always)]
fn residuals<S: Simd>(simd: S, p: &[f64], shift: f64, gap: &mut [f32], residual: &mut [f32]) -> Totals<4, 2> {
    let (zero, one, far) = (splat(simd, 0.0), splat(simd, 1.0), splat(simd, f64::INFINITY));
    let tiny = splat(simd, f64::from(f32::MIN_POSITIVE));
    let (mut size, mut sum, mut work, mut complementarity) = (zero, zero, zero, zero);
    let (mut least, mut outside) = (far, far);
    for at in (0..p.len()).step_by(LANES) {
        let (pressure, g) = (f64::group(simd, p, at, 0.0), f32::group(simd, gap, at, f32::MAX) - shift);
        Real::put(g, gap, at);
        let pressed = pressure.simd_gt(zero);
        let active = pressed | g.simd_lt(zero);
        let r = active.select(g.abs().simd_lt(tiny).select(tiny, g), zero);
        Real::put(r, residual, at);
        size += active.select(one, zero);
        sum += r;
        work = pressure.mul_add(g, work);
        complementarity = pressure.mul_add(g.abs(), complementarity);
        least = least.min(g);
        outside = outside.min(pressed.select(far, g));
    }
    let sums = [total(size), total(sum), total(work), total(complementarity)];
    Totals { sums, least: [lowest(least), lowest(outside)] }
}

/// image ← r − mean on the active set, 0 outside.
pub(super) fn centred(residual: &[f32], mean: f64, image: &mut [f32]) {
    each(BLOCK, (residual.par_chunks(BLOCK), image.par_chunks_mut(BLOCK)), |_, (r, image)| {
        for (image, &r) in image.iter_mut().zip(r) {
            *image = if r == 0.0 { 0.0 } else { r - mean as f32 };
        }
    });
}

/// Sums of z = image + gathered on the active set, from r, r′, image, gathered and t′.
pub(super) fn overlap([residual, previous, image, gathered, direction]: [&[f32]; 5]) -> Overlaps {
    let fields = (
        residual.par_chunks(BLOCK),
        previous.par_chunks(BLOCK),
        image.par_chunks(BLOCK),
        gathered.par_chunks(BLOCK),
        direction.par_chunks(BLOCK),
    );
    let totals = sweep(
        BLOCK,
        fields,
        |_, (r, previous, image, gathered, direction)| vectorised!(simd => overlaps(simd, [r, previous, image, gathered, direction])),
    );
    let [sum, with_residual, before, sum_before, before_here, common, direction] = totals.sums;
    Overlaps { sum, with_residual, before, sum_before, before_here, common, direction }
}

#[inline(always)]
fn overlaps<S: Simd>(simd: S, [residual, previous, image, gathered, direction]: [&[f32]; 5]) -> Totals<7, 0> {
    let (zero, one) = (splat(simd, 0.0), splat(simd, 1.0));
    let (mut sum, mut with_residual, mut before, mut sum_before) = (zero, zero, zero, zero);
    let (mut before_here, mut common, mut last_direction) = (zero, zero, zero);
    for at in (0..residual.len()).step_by(LANES) {
        let (r, last) = (f32::group(simd, residual, at, 0.0), f32::group(simd, previous, at, 0.0));
        let z = f32::group(simd, image, at, 0.0) + f32::group(simd, gathered, at, 0.0);
        let (outside, left) = (r.simd_eq(zero), last.simd_eq(zero));
        let z = outside.select(zero, z);
        sum += z;
        with_residual = r.mul_add(z, with_residual);
        before = last.mul_add(z, before);
        sum_before += left.select(zero, z);
        before_here += outside.select(zero, last);
        common += (outside | left).select(zero, one);
        last_direction += outside.select(zero, f32::group(simd, direction, at, 0.0));
    }
    let lanes = [sum, with_residual, before, sum_before, before_here, common, last_direction];
    let mut sums = [0.0; 7];
    for (sum, lanes) in sums.iter_mut().zip(lanes) {
        *sum = total(lanes);
    }
    Totals { sums, least: [] }
}

/// t ← z − mean + βt on the active set, 0 outside, also in `image`; ⟨r, t⟩.
pub(super) fn turn(
    residual: &[f32],
    gathered: &[f32],
    mean: f64,
    beta: f64,
    direction: &mut [f32],
    image: &mut [f32],
) -> f64 {
    let fields = (
        residual.par_chunks(BLOCK),
        gathered.par_chunks(BLOCK),
        direction.par_chunks_mut(BLOCK),
        image.par_chunks_mut(BLOCK),
    );
    let Totals { sums: [descent], .. } = sweep(
        BLOCK,
        fields,
        |_, (r, gathered, direction, image)| vectorised!(simd => turned(simd, r, gathered, mean, beta, direction, image)),
    );
    descent
}

#[inline(always)]
fn turned<S: Simd>(
    simd: S,
    residual: &[f32],
    gathered: &[f32],
    mean: f64,
    beta: f64,
    direction: &mut [f32],
    image: &mut [f32],
) -> Totals<1, 0> {
    let zero = splat(simd, 0.0);
    let mut descent = zero;
    for at in (0..residual.len()).step_by(LANES) {
        let r = f32::group(simd, residual, at, 0.0);
        let z = f32::group(simd, image, at, 0.0) + f32::group(simd, gathered, at, 0.0) - mean;
        // What is left of the last step means nothing in a first one.
        let t = if beta > 0.0 { f32::group(simd, direction, at, 0.0).mul_add(splat(simd, beta), z) } else { z };
        let t = r.simd_eq(zero).select(zero, t);
        descent = r.mul_add(t, descent);
        Real::put(t, direction, at);
        Real::put(t, image, at);
    }
    Totals { sums: [total(descent)], least: [] }
}

/// ⟨a, b⟩ of a row.
pub(super) fn product(a: &[f32], b: &[f32]) -> f64 {
    vectorised!(simd => multiplied(simd, a, b))
}

#[inline(always)]
fn multiplied<S: Simd>(simd: S, a: &[f32], b: &[f32]) -> f64 {
    let mut sum = splat(simd, 0.0);
    for at in (0..a.len()).step_by(LANES) {
        sum = f32::group(simd, a, at, 0.0).mul_add(f32::group(simd, b, at, 0.0), sum);
    }
    total(sum)
}

/// p ← max(p + unit d, 0) with d = factor · t, shortened where p ends at zero; d is left in both fields of `step`.
pub(super) fn advance(
    p: &mut [f64],
    gap: &[f32],
    direction: &[f32],
    factor: f64,
    unit: f64,
    [step, copy]: [&mut [f32]; 2],
) -> Advance {
    let fields = (
        p.par_chunks_mut(BLOCK),
        gap.par_chunks(BLOCK),
        direction.par_chunks(BLOCK),
        step.par_chunks_mut(BLOCK),
        copy.par_chunks_mut(BLOCK),
    );
    let Totals { sums: [load, slope], least: [clipped] } = sweep(
        BLOCK,
        fields,
        |_, (p, gap, direction, step, copy)| vectorised!(simd => advanced(simd, p, gap, direction, factor, unit, [step, copy])),
    );
    Advance { load, slope, clipped: clipped < 0.0 }
}

#[inline(always)]
fn advanced<S: Simd>(
    simd: S,
    p: &mut [f64],
    gap: &[f32],
    direction: &[f32],
    factor: f64,
    unit: f64,
    [step, copy]: [&mut [f32]; 2],
) -> Totals<2, 1> {
    let zero = splat(simd, 0.0);
    let (mut load, mut slope, mut lowest_end) = (zero, zero, zero);
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        // As it will be stored: what is taken back later is what was added (to 6e-8 where p ends at zero).
        let d = rounded(simd, f32::group(simd, direction, at, 0.0) * factor);
        let end = d.mul_add(splat(simd, unit), pressure);
        let short = end.simd_lt(zero);
        let d = short.select(pressure * (-1.0 / unit), d);
        let end = end.max(zero);
        lowest_end = lowest_end.min(short.select(splat(simd, -1.0), zero));
        load += end;
        slope = f32::group(simd, gap, at, 0.0).mul_add(d, slope);
        Real::put(end, p, at);
        Real::put(d, step, at);
        Real::put(d, copy, at);
    }
    Totals { sums: [total(load), total(slope)], least: [lowest(lowest_end)] }
}

/// To single precision and back.
#[inline(always)]
fn rounded<S: Simd>(simd: S, group: fearless_simd::f64x8<S>) -> fearless_simd::f64x8<S> {
    let mut single = [0.0f32; LANES];
    Real::put(group, &mut single, 0);
    f32::group(simd, &single, 0, 0.0)
}

/// p ← s p after a step d, which becomes the step from where it was to there; it is left in both fields of `step`.
pub(super) fn rescale(p: &mut [f64], scale: f64, unit: f64, [step, copy]: [&mut [f32]; 2]) {
    each(
        BLOCK,
        (p.par_chunks_mut(BLOCK), step.par_chunks_mut(BLOCK), copy.par_chunks_mut(BLOCK)),
        |_, (p, step, copy)| {
            vectorised!(simd => rescaled(simd, p, scale, unit, [step, copy]));
        },
    );
}

#[inline(always)]
fn rescaled<S: Simd>(simd: S, p: &mut [f64], scale: f64, unit: f64, [step, copy]: [&mut [f32]; 2]) {
    for at in (0..p.len()).step_by(LANES) {
        let (end, d) = (f64::group(simd, p, at, 0.0), f32::group(simd, step, at, 0.0));
        let whole = rounded(simd, end.mul_add(splat(simd, (scale - 1.0) / unit), d));
        let before = end - d * unit;
        let zero = splat(simd, 0.0);
        Real::put((before.max(zero) + whole * unit).max(zero), p, at);
        Real::put(whole, step, at);
        Real::put(whole, copy, at);
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

/// g ← g + factor · changes; Σ p and Σ p g.
pub(super) fn follow(p: &[f64], gap: &mut [f32], changes: &[f32], factor: f64) -> [f64; 2] {
    let fields = (p.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK), changes.par_chunks(BLOCK));
    let Totals { sums, least: [] } =
        sweep(BLOCK, fields, |_, (p, gap, changes)| vectorised!(simd => followed(simd, p, gap, changes, factor)));
    sums
}

#[inline(always)]
fn followed<S: Simd>(simd: S, p: &[f64], gap: &mut [f32], changes: &[f32], factor: f64) -> Totals<2, 0> {
    let (mut load, mut work) = (splat(simd, 0.0), splat(simd, 0.0));
    for at in (0..p.len()).step_by(LANES) {
        let pressure = f64::group(simd, p, at, 0.0);
        let g = f32::group(simd, changes, at, 0.0).mul_add(splat(simd, factor), f32::group(simd, gap, at, 0.0));
        load += pressure;
        work = pressure.mul_add(g, work);
        Real::put(g, gap, at);
    }
    Totals { sums: [total(load), total(work)], least: [] }
}
