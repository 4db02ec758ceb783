//! The residual: the gap on the active set, and what it says of the iterate.
//!
//! Sums are taken in double precision, whatever the fields are stored in, here and in the other sweeps.

use super::check::Residuals;
use crate::numeric::lanes::{LANES, Real, lowest, splat, total, vectorised};
use crate::numeric::rows::{Totals, sweep};
use crate::numeric::sums::BLOCK;
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
