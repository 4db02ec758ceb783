//! The sweeps over the fields that an iteration of the preconditioned method consists of, besides its convolutions.
//!
//! Sums are taken in double precision, whatever the fields are stored in.

use super::check::Residuals;
use crate::numeric::lanes::{LANES, Real, lowest, splat, total, vectorised};
use crate::numeric::rows::{Totals, each, sweep};
use crate::numeric::sums::BLOCK;
use crate::spectral::extension;
use crate::spectral::fourier::part_of;
use fearless_simd::{f64x8, mask64x8, prelude::*};
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
    /// Σ p (g + C d) after it, where nothing was clipped.
    pub work: f64,
    /// Whether a pressure ended at zero before the step did.
    pub clipped: bool,
}

/// gap ← g/length; r is the gap on the active set.
pub(super) fn take(p: &[f64], g: &[f64], length: f64, gap: &mut [f32], residual: &mut [f32]) -> Active {
    let fields = (p.par_chunks(BLOCK), g.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK), residual.par_chunks_mut(BLOCK));
    let Totals { sums: [size, sum], .. } = sweep(
        BLOCK,
        fields,
        |_, (p, g, gap, residual)| vectorised!(simd => taken(simd, p, g, 1.0 / length, gap, residual)),
    );
    Active { size, sum }
}

#[inline(always)]
fn taken<S: Simd>(simd: S, p: &[f64], g: &[f64], factor: f64, gap: &mut [f32], residual: &mut [f32]) -> Totals<2, 0> {
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
pub(super) fn settle(
    p: &[f64],
    load: f64,
    (changes, factor): (&[f32], f64),
    shift: f64,
    gap: &mut [f32],
    residual: &mut [f32],
) -> (Active, Residuals) {
    let fields =
        (p.par_chunks(BLOCK), changes.par_chunks(BLOCK), gap.par_chunks_mut(BLOCK), residual.par_chunks_mut(BLOCK));
    let Totals { sums: [size, sum, work, complementarity], least: [least, outside] } = sweep(
        BLOCK,
        fields,
        |_, (p, changes, gap, residual)| vectorised!(simd => settled(simd, p, (changes, factor), shift, gap, residual)),
    );
    (Active { size, sum }, Residuals { load, work, complementarity, least, outside })
}

#[inline(always)]
fn settled<S: Simd>(
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

/// Rows of r − mean on the active set, 0 outside, by parts.
pub(super) fn centred<'a>(
    [n1, n2]: [usize; 2],
    residual: &'a [f32],
    mean: f32,
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    residual.par_chunks(part_of(n1) * n2).map(move |residual| {
        let mut rows = residual.chunks_exact(n2);
        move |row: &mut [f32]| {
            let residual = rows.next().expect("a part has its rows");
            row.iter_mut().zip(residual).for_each(|(to, &r)| *to = if r == 0.0 { 0.0 } else { r - mean });
        }
    })
}

/// z, the image and what is gathered of `weight`, on the active set, left in `image`; its sums with r, r′ and t′.
pub(super) fn overlap(
    points: [usize; 2],
    [residual, previous, direction]: [&[f32]; 3],
    weight: Option<&[f32]>,
    image: &mut [f32],
) -> Overlaps {
    let ([n1, n2], part) = (points, part_of(points[0]));
    let size = part * n2;
    let fields =
        (residual.par_chunks(size), previous.par_chunks(size), direction.par_chunks(size), image.par_chunks_mut(size));
    let nothing = vec![0.0; n2];
    let parts = fields.into_par_iter().enumerate().map(|(number, (residual, previous, direction, image))| {
        let mut gathering = weight.map(|weight| extension::gathering([n1, n2], number * part, weight));
        let mut totals = Totals::NONE;
        for (row, image) in image.chunks_exact_mut(n2).enumerate() {
            let [residual, previous, direction] = [residual, previous, direction].map(|field| &field[row * n2..][..n2]);
            let gathered = gathering.as_mut().map_or(&nothing[..], |gathering| &gathering.next()[0][..n2]);
            totals.add(vectorised!(simd => overlaps(simd, [residual, previous, direction, gathered], image)));
        }
        totals
    });
    let [sum, with_residual, before, sum_before, before_here, common, direction] = Totals::of(parts.collect()).sums;
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
    for at in (0..residual.len()).step_by(LANES) {
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
    let lanes = [sum, with_residual, before, sum_before, before_here, common, last_direction];
    let mut sums = [0.0; 7];
    for (sum, lanes) in sums.iter_mut().zip(lanes) {
        *sum = total(lanes);
    }
    Totals { sums, least: [] }
}

/// Rows of t ← z − mean + βt on the active set, 0 outside, by parts, from z in `image`; ⟨r, t⟩ in `descent`.
pub(super) fn turned<'a>(
    [n1, n2]: [usize; 2],
    [residual, image]: [&'a [f32]; 2],
    mean: f64,
    beta: f64,
    direction: &'a mut [f32],
    descent: &'a mut [Totals<1, 0>],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let size = part_of(n1) * n2;
    let parts = (residual.par_chunks(size), image.par_chunks(size), direction.par_chunks_mut(size), descent);
    parts.into_par_iter().map(move |(residual, image, direction, descent)| {
        let mut rows = residual.chunks_exact(n2).zip(image.chunks_exact(n2)).zip(direction.chunks_exact_mut(n2));
        move |row: &mut [f32]| {
            let ((residual, image), direction) = rows.next().expect("a part has its rows");
            descent.add(vectorised!(simd => turn(simd, [residual, image], mean, beta, direction, row)));
        }
    })
}

#[inline(always)]
fn turn<S: Simd>(
    simd: S,
    [residual, image]: [&[f32]; 2],
    mean: f64,
    beta: f64,
    direction: &mut [f32],
    row: &mut [f32],
) -> Totals<1, 0> {
    let zero = splat(simd, 0.0);
    let mut descent = zero;
    for at in (0..residual.len()).step_by(LANES) {
        let r = f32::group(simd, residual, at, 0.0);
        let z = f32::group(simd, image, at, 0.0) - mean;
        // What is left of the last step means nothing in a first one.
        let t = if beta > 0.0 { f32::group(simd, direction, at, 0.0).mul_add(splat(simd, beta), z) } else { z };
        let t = r.simd_eq(zero).select(zero, t);
        descent = r.mul_add(t, descent);
        Real::put(t, direction, at);
        Real::put(t, row, at);
    }
    Totals { sums: [total(descent)], least: [] }
}

/// Takes the rows of C t into `image`, by parts; ⟨t, C t⟩ in `curvature`.
pub(super) fn curved<'a>(
    [n1, n2]: [usize; 2],
    direction: &'a [f32],
    image: &'a mut [f32],
    curvature: &'a mut [Totals<1, 0>],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let size = part_of(n1) * n2;
    let parts = (direction.par_chunks(size), image.par_chunks_mut(size), curvature);
    parts.into_par_iter().map(move |(direction, image, curvature)| {
        let mut rows = direction.chunks_exact(n2).zip(image.chunks_exact_mut(n2));
        move |row: &mut [f32]| {
            let (direction, image) = rows.next().expect("a part has its rows");
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

/// p ← max(p + unit d, 0) with d = factor · t, shortened where p ends at zero; d is left in `step`. `image` is C t.
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
    for at in (0..p.len()).step_by(LANES) {
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
    for at in (0..p.len()).step_by(LANES) {
        let (end, d) = (f64::group(simd, p, at, 0.0), f32::group(simd, step, at, 0.0));
        let whole = rounded(simd, end.mul_add(splat(simd, (scale - 1.0) / unit), d));
        let before = end - d * unit;
        let zero = splat(simd, 0.0);
        Real::put((before.max(zero) + whole * unit).max(zero), p, at);
        Real::put(whole, step, at);
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
    [n1, n2]: [usize; 2],
    p: &'a [f64],
    [gap, step]: [&'a [f32]; 2],
    image: &'a mut [f32],
    sums: &'a mut [Totals<3, 0>],
) -> impl IndexedParallelIterator<Item: FnMut(&mut [f32])> + 'a {
    let size = part_of(n1) * n2;
    let parts = (p.par_chunks(size), gap.par_chunks(size), step.par_chunks(size), image.par_chunks_mut(size), sums);
    parts.into_par_iter().map(move |(p, gap, step, image, sums)| {
        let mut number = 0;
        move |row: &mut [f32]| {
            let at = number * n2..(number + 1) * n2;
            number += 1;
            image[at.clone()].copy_from_slice(row);
            let (p, gap, step) = (&p[at.clone()], &gap[at.clone()], &step[at]);
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
