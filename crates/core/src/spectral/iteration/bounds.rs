//! Bounds of the pressure of a sample, 0 ≤ p ≤ H, and what a gap g says at them.
//!
//! The pressure solves the contact where the gap has the sign of the bound that p is at:
//!
//! g ≥ 0 where p = 0,  g = 0 where 0 < p < H,  g ≤ 0 where p = H.
//!
//! A sample is **free** between the bounds and **full** at H: there the surface is pressed in for good, by −g. [`Bounds`] has one sample in
//! plain lines, [`BoundLanes`] the same for eight of them, without branches, as the fused loops use it.

use crate::numeric::lanes::splat;
use fearless_simd::{f64x8, mask64x8, prelude::*};

/// Part of the largest pressure beyond which a pressure is the largest one: what rounding takes off it is put back.
const AT_MOST: f64 = 1.0 - 1e-15;

/// Least and largest pressure of a sample, 0 ≤ p ≤ H with the hardness H.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// H, a pressure; infinite without hardness.
    most: f64,
    /// Pressure beyond which it is H.
    nearly: f64,
}

impl Default for Bounds {
    /// p ≥ 0.
    fn default() -> Self {
        Self::up_to(f64::INFINITY)
    }
}

impl Bounds {
    /// 0 ≤ p ≤ `most`, the hardness.
    pub fn up_to(most: f64) -> Self {
        Self { most, nearly: AT_MOST * most }
    }

    /// Whether there is a largest pressure.
    pub fn is_finite(self) -> bool {
        self.most.is_finite()
    }

    /// The largest pressure H, infinite without hardness.
    pub fn largest(self) -> f64 {
        self.most
    }

    /// Halfway from a pressure to the largest one.
    pub(super) fn halfway(self, pressure: f64) -> f64 {
        0.5 * (pressure + self.most)
    }

    /// Displacement under the largest pressure everywhere, a length, from that under a uniform pressure over the pressure; infinite
    /// without hardness.
    pub(super) fn largest_displacement(self, mean_compliance: f64) -> f64 {
        if self.is_finite() { mean_compliance * self.most } else { f64::INFINITY }
    }

    /// The nearest pressure within the bounds.
    #[inline]
    pub fn clamp(self, pressure: f64) -> f64 {
        pressure.max(0.0).min(self.most)
    }

    /// The nearest pressure within the bounds, H where rounding alone keeps it from there.
    #[inline]
    pub(super) fn project(self, pressure: f64) -> f64 {
        if self.is_nearly_full(pressure) { self.most } else { pressure.max(0.0) }
    }

    /// A pressure within the bounds `before` within these: H where it was the largest one.
    #[inline]
    pub fn follow(self, before: Self, pressure: f64) -> f64 {
        if before.is_full(pressure) { self.most } else { self.clamp(pressure) }
    }

    /// Whether p = H.
    #[inline]
    pub fn is_full(self, pressure: f64) -> bool {
        pressure >= self.most
    }

    /// Whether p is H, or rounding alone keeps it from there.
    #[inline]
    pub(super) fn is_nearly_full(self, pressure: f64) -> bool {
        pressure > self.nearly
    }

    /// Whether 0 < p < H.
    #[inline]
    pub(super) fn is_free(self, pressure: f64) -> bool {
        pressure > 0.0 && pressure < self.most
    }

    /// Whether p is at a bound on whose wrong side the gap is.
    #[inline]
    pub(super) fn is_violated(self, pressure: f64, gap: f64) -> bool {
        if pressure < self.most { pressure == 0.0 && gap < 0.0 } else { gap > 0.0 }
    }

    /// How far the gap is on the wrong side of zero for a pressure that may grow (p < H) or that may not, a length.
    #[inline]
    pub(super) fn violation(self, pressure: f64, gap: f64) -> f64 {
        if pressure < self.most { (-gap).max(0.0) } else { gap.max(0.0) }
    }

    /// Depth that the surface is pressed in for good, a length: −g where p = H.
    #[inline]
    pub fn indentation(self, pressure: f64, gap: f64) -> f64 {
        if self.is_full(pressure) { (-gap).max(0.0) } else { 0.0 }
    }

    /// The bounds for eight samples at a time.
    #[inline(always)]
    pub(super) fn lanes<S: Simd>(self, simd: S) -> BoundLanes<S> {
        let (zero, one) = (splat(simd, 0.0), splat(simd, 1.0));
        BoundLanes { simd, zero, one, most: splat(simd, self.most), nearly: splat(simd, self.nearly) }
    }
}

/// The plain lines of what the iteration asks of eight samples at a time, for its plain twin.
#[cfg(test)]
impl Bounds {
    /// Whether the sample is in the active set I = ({p > 0} ∪ {g < 0}) ∖ {p = H, g ≤ 0}.
    pub fn is_active(self, pressure: f64, gap: f64) -> bool {
        (pressure > 0.0 || gap < 0.0) && (pressure < self.most || gap > 0.0)
    }

    /// How far p is from the bound where the sign of the gap puts it: p, or min(p, H − p) where g ≤ 0.
    pub fn away(self, pressure: f64, gap: f64) -> f64 {
        if gap > 0.0 { pressure } else { pressure.min(self.most - pressure) }
    }

    /// p(1 − p/H), the weight of a sample in δ; p without hardness.
    pub fn weight(self, pressure: f64) -> f64 {
        pressure * (1.0 - pressure / self.most)
    }

    /// Share of the sample in the gap of the energy for a given θ: p(g − θ) + H max(θ − g, 0), H(max(g, 0) − θ) where p = H.
    pub fn energy_share(self, pressure: f64, gap: f64, theta: f64) -> f64 {
        match self.is_full(pressure) {
            false => pressure * (gap - theta) + self.most * (theta - gap).max(0.0),
            true => self.most * (gap.max(0.0) - theta),
        }
    }
}

/// [`Bounds`] for eight samples at a time.
#[derive(Clone, Copy)]
pub(super) struct BoundLanes<S: Simd> {
    simd: S,
    zero: f64x8<S>,
    one: f64x8<S>,
    most: f64x8<S>,
    nearly: f64x8<S>,
}

/// Parts of the pressure of eight samples.
#[derive(Clone, Copy)]
pub(super) struct Parts<S: Simd> {
    /// p where p < H, 0 elsewhere.
    pub free: f64x8<S>,
    /// 1 where p = H, 0 elsewhere.
    pub full: f64x8<S>,
}

/// A step of eight samples that ends within the bounds.
#[derive(Clone, Copy)]
pub(super) struct Bounded<S: Simd> {
    /// Pressure at its end.
    pub end: f64x8<S>,
    /// The step that was taken, shortened where it ends at a bound.
    pub step: f64x8<S>,
    /// Parts of the pressure at its end.
    pub parts: Parts<S>,
    /// −1 where it was shortened at a bound, 0 elsewhere. A full sample that stays full has no step.
    pub clipped: f64x8<S>,
}

impl<S: Simd> BoundLanes<S> {
    /// Nearest pressures within the bounds, as [`Bounds::clamp`].
    #[inline(always)]
    pub fn clamp(self, pressure: f64x8<S>) -> f64x8<S> {
        pressure.max(self.zero).min(self.most)
    }

    /// Nearest pressures within the bounds, as [`Bounds::project`].
    #[inline(always)]
    pub fn project(self, pressure: f64x8<S>) -> f64x8<S> {
        self.is_nearly_full(pressure).select(self.most, self.raise(pressure))
    }

    /// Pressures, at least the least one.
    #[inline(always)]
    pub fn raise(self, pressure: f64x8<S>) -> f64x8<S> {
        pressure.max(self.zero)
    }

    /// Lanes with p < H.
    #[inline(always)]
    pub fn is_below(self, pressure: f64x8<S>) -> mask64x8<S> {
        pressure.simd_lt(self.most)
    }

    /// Parts of the pressure.
    #[inline(always)]
    pub fn parts(self, pressure: f64x8<S>) -> Parts<S> {
        let below = self.is_below(pressure);
        Parts { free: below.select(pressure, self.zero), full: below.select(self.zero, self.one) }
    }

    /// Lanes with p = H, but for rounding.
    #[inline(always)]
    pub fn is_nearly_full(self, pressure: f64x8<S>) -> mask64x8<S> {
        pressure.simd_gt(self.nearly)
    }

    /// Lanes with 0 < p < H.
    #[inline(always)]
    pub fn is_free(self, pressure: f64x8<S>) -> mask64x8<S> {
        pressure.simd_gt(self.zero) & pressure.simd_lt(self.most)
    }

    /// Lanes with p above the least one, p > 0.
    #[inline(always)]
    pub fn is_pressed(self, pressure: f64x8<S>) -> mask64x8<S> {
        pressure.simd_gt(self.zero)
    }

    /// 1 where p is the least one, 0 elsewhere.
    #[inline(always)]
    pub fn unpressed(self, pressure: f64x8<S>) -> f64x8<S> {
        self.is_pressed(pressure).select(self.zero, self.one)
    }

    /// Pressures after a step d in units of `unit`, as the bounds let them end.
    #[inline(always)]
    pub fn stepped(self, pressure: f64x8<S>, step: f64x8<S>, unit: f64) -> Bounded<S> {
        let end = step.mul_add(splat(self.simd, unit), pressure);
        let (short, full) = (end.simd_lt(self.zero), self.is_nearly_full(end));
        let step = short.select(pressure * (-1.0 / unit), step);
        let step = full.select((self.most - pressure) * (1.0 / unit), step);
        let clipped = short | (full & pressure.simd_lt(self.most));
        let clipped = clipped.select(-self.one, self.zero);
        let end = full.select(self.most, self.raise(end));
        let parts = Parts { free: full.select(self.zero, end), full: full.select(self.one, self.zero) };
        Bounded { end, step, parts, clipped }
    }

    /// χ of the active set I = ({p > 0} ∪ {g < 0}) ∖ {p = H, g ≤ 0}, and the residual r = χ g, which is never exactly zero on it.
    #[inline(always)]
    pub fn on_active(self, pressure: f64x8<S>, gap: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
        let Self { simd, zero, one, most, .. } = self;
        let tiny = splat(simd, f64::from(f32::MIN_POSITIVE));
        let active = (pressure.simd_gt(zero) | gap.simd_lt(zero)) & (pressure.simd_lt(most) | gap.simd_gt(zero));
        let residual = active.select(gap.abs().simd_lt(tiny).select(tiny, gap), zero);
        (active.select(one, zero), residual)
    }

    /// 1 where a mask is set, 0 elsewhere.
    #[inline(always)]
    pub fn count(self, mask: mask64x8<S>) -> f64x8<S> {
        mask.select(self.one, self.zero)
    }

    /// The values where a mask is not set, 0 elsewhere.
    #[inline(always)]
    pub fn unless(self, mask: mask64x8<S>, values: f64x8<S>) -> f64x8<S> {
        mask.select(self.zero, values)
    }

    /// How far p is from the bound where the sign of the gap puts it: p, or min(p, H − p) where g ≤ 0.
    #[inline(always)]
    pub fn away(self, pressure: f64x8<S>, gap: f64x8<S>) -> f64x8<S> {
        gap.simd_gt(self.zero).select(pressure, pressure.min(self.most - pressure))
    }

    /// Violation of samples that are `below` H or not, as [`Bounds::violation`], and max(g, 0) where they are not, else 0.
    #[inline(always)]
    pub fn violation(self, below: mask64x8<S>, gap: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
        let open = gap.max(self.zero);
        (below.select((-gap).max(self.zero), open), below.select(self.zero, open))
    }

    /// p(1 − p/H), the weight of a sample in δ: p without hardness, 0 where p = H.
    #[inline(always)]
    pub fn weight(self, pressure: f64x8<S>) -> f64x8<S> {
        pressure - pressure * (pressure / self.most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::lanes::{LANES, Real, vectorised};

    /// Values of eight samples.
    fn eight<S: Simd>(values: f64x8<S>) -> [f64; LANES] {
        std::array::from_fn(|i| values.as_slice()[i])
    }

    #[inline(always)]
    fn check<S: Simd>(simd: S, bounds: Bounds, p: &[f64; LANES], g: f64) {
        let lanes = bounds.lanes(simd);
        let (pressure, gap) = (f64::group(simd, p, 0, 0.0), splat(simd, g));
        let truth = |is: bool| f64::from(u8::from(is));
        let (active, residual) = lanes.on_active(pressure, gap);
        let Parts { free, full } = lanes.parts(pressure);
        let (violation, open) = lanes.violation(lanes.is_below(pressure), gap);
        let found = [
            lanes.clamp(pressure),
            lanes.project(pressure),
            active,
            residual,
            lanes.away(pressure, gap),
            free,
            full,
            lanes.count(lanes.is_free(pressure)),
            lanes.unpressed(pressure),
            violation,
            open,
        ]
        .map(eight);
        for (i, &p) in p.iter().enumerate() {
            let (is_active, is_full) = (bounds.is_active(p, g), bounds.is_full(p));
            let expected = [
                bounds.clamp(p),
                bounds.project(p),
                truth(is_active),
                if is_active { if g == 0.0 { f64::from(f32::MIN_POSITIVE) } else { g } } else { 0.0 },
                bounds.away(p, g),
                if is_full { 0.0 } else { p },
                truth(is_full),
                truth(bounds.is_free(p)),
                truth(p <= 0.0),
                bounds.violation(p, g),
                if is_full { g.max(0.0) } else { 0.0 },
            ];
            assert_eq!(found.map(|values| values[i]), expected, "{p} under {g}: {bounds:?}");
            let weight = eight(lanes.weight(pressure))[i];
            assert!((weight - bounds.weight(p)).abs() <= 1e-15 * p.abs(), "{p}: {weight}");
        }
    }

    #[test]
    fn eight_samples_are_as_one_in_plain_lines() {
        let h = 0.3;
        for bounds in [Bounds::default(), Bounds::up_to(h)] {
            for g in [-1.0, -1e-3, 0.0, 1e-3, 1.0] {
                let p = [-0.1, 0.0, 1e-300, 0.1, h * (1.0 - 1e-12), h * (1.0 - 2e-16), h, 0.5];
                vectorised!(simd => check(simd, bounds, &p, g));
            }
        }
    }

    /// Steps from a pressure between the bounds, and from either, beyond both and to none.
    #[test]
    fn a_step_ends_at_the_bound_that_it_would_pass() {
        #[inline(always)]
        fn stepped<S: Simd>(simd: S, [p, d]: [&[f64; LANES]; 2]) -> [[f64; LANES]; 4] {
            let lanes = Bounds::up_to(2.0).lanes(simd);
            let [p, d] = [p, d].map(|values| f64::group(simd, values, 0, 0.0));
            let Bounded { end, step, parts, clipped } = lanes.stepped(p, d, 0.5);
            [end, step, parts.full, clipped].map(eight)
        }
        let p = [1.0, 1.0, 1.0, 0.0, 0.0, 2.0, 2.0, 2.0];
        let d = [1.0, -4.0, 4.0, -1.0, 1.0, 1.0, -1.0, -8.0];
        let [end, step, full, clipped] = vectorised!(simd => stepped(simd, [&p, &d]));
        assert_eq!(end, [1.5, 0.0, 2.0, 0.0, 0.5, 2.0, 1.5, 0.0]);
        assert_eq!(step, [1.0, -2.0, 2.0, 0.0, 1.0, 0.0, -1.0, -4.0]);
        assert_eq!(full, [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        assert_eq!(clipped, [0.0, -1.0, -1.0, -1.0, 0.0, 0.0, 0.0, -1.0]);
    }

    #[test]
    fn a_pressure_at_the_hardness_follows_it() {
        let (before, after) = (Bounds::up_to(2.0), Bounds::up_to(3.0));
        assert_eq!([0.0, 1.0, 2.0].map(|p| after.follow(before, p)), [0.0, 1.0, 3.0]);
        assert_eq!([0.0, 2.5, 3.0].map(|p| before.follow(after, p)), [0.0, 2.0, 2.0]);
        assert_eq!([before.indentation(2.0, -0.1), before.indentation(1.0, -0.1)], [0.1, 0.0]);
    }
}
