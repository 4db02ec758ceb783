//! Sums over pressure and gap, and what follows from them for a set of pressures 0 ≤ p ≤ H: the penetration δ, and the gap of the energy.
//!
//! **Penetration.** Under load control δ is the mean of w + f, with the weight p of a sample or, where samples are full, p(1 − p/H):
//! pressures that are about to reach a bound say nothing about δ.
//!
//! **Gap of the energy.** What a pressure p under a gap g exceeds the least work by, ⟨p, g⟩ − min ⟨s, g⟩ over the set, as `certificate` has
//! it. The share of a sample is Σ p g and, of what lies at a bound on the wrong side, H max(−g, 0) or H max(g, 0).

use super::bounds::{BoundLanes, Bounds, Parts};
use crate::numeric::lanes::{lowest, splat, total};
use crate::numeric::rows::Totals;
use crate::numeric::sums;
use fearless_simd::{f64x8, prelude::*};

/// Sum of a pressure below the largest one, and the number of samples at it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LoadSums {
    /// Σ p where p < H.
    pub free: f64,
    /// Number of samples where p = H.
    pub full: f64,
}

impl LoadSums {
    /// Σ p.
    pub fn total(self, bounds: Bounds) -> f64 {
        // Without hardness no sample is full, and ∞ · 0 is no number.
        if self.full > 0.0 { self.free + self.full * bounds.largest() } else { self.free }
    }
}

/// Sums from which δ follows: with p the weight of a sample, and with p(1 − p/H).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct WeightedSums {
    /// Σ p g where p < H.
    pub work: f64,
    /// Σ p(1 − p/H).
    pub weight: f64,
    /// Σ p(1 − p/H) g.
    pub weighted: f64,
}

impl WeightedSums {
    /// The mean of g by which δ moves: weighted with p or, where samples are full, with p(1 − p/H). `None` where no sample is free.
    pub fn mean(self, load: LoadSums) -> Option<f64> {
        match load.full {
            0.0 if load.free > 0.0 => Some(self.work / load.free),
            _ if self.weight > 0.0 => Some(self.weighted / self.weight),
            _ => None,
        }
    }
}

/// Sums and least values of a gap over the samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapSums {
    /// Σ p where p < H, and the number of samples where p = H.
    pub load: LoadSums,
    /// Σ p g where p < H.
    pub work: f64,
    /// Σ p|g|, with min(p, H − p) in the place of p where g < 0.
    pub complementarity: f64,
    /// Σ max(−g, 0) where p < H, and Σ max(g, 0) where p = H.
    pub beyond: f64,
    /// Σ max(g, 0) where p = H.
    pub open: f64,
    /// min g.
    pub least: f64,
    /// min g where p < H.
    pub below: f64,
    /// min g where p = 0.
    pub outside: f64,
}

impl GapSums {
    /// Sums of a pressure with these `load` sums and of a gap.
    pub fn of(load: LoadSums, gap: Totals<4, 3>) -> Self {
        let Totals { sums: [work, complementarity, beyond, open], least: [least, below, outside] } = gap;
        Self { load, work, complementarity, beyond, open, least, below, outside }
    }

    /// Sums of a gap in units of `length`, as lengths.
    pub fn times(self, length: f64) -> Self {
        let Self { load, work, complementarity, beyond, open, least, below, outside } = self;
        Self {
            load,
            work: length * work,
            complementarity: length * complementarity,
            beyond: length * beyond,
            open: length * open,
            least: length * least,
            below: length * below,
            outside: length * outside,
        }
    }

    /// Bound on ⟨p, g⟩ − min ⟨s, g⟩ over all pressures s of the set with the load of p or, unless that is prescribed, at most that.
    pub fn energy_gap(self, bounds: Bounds, load_control: bool) -> f64 {
        let Self { load, work, beyond, open, least, below, .. } = self;
        let most = bounds.largest();
        match load.full {
            0.0 if load_control => work - least * load.free,
            0.0 => work - least.min(0.0) * load.free,
            // θ = 0, or θ = min g where p < H with max(g − θ, 0) ≤ max(g, 0) − θ where p = H.
            _ => {
                let theta = below.min(0.0);
                let least = work - theta * load.free + most * (open - theta * load.full);
                (work + most * beyond).min(least)
            }
        }
    }
}

impl Bounds {
    /// Energy gap, beside Σ p|d|, of an exact solution p under a gap that errs by a change d, of which |d| is given sample by sample with
    /// its `largest` value: as no pressure is H, max |d| Σp, else H |d| of the samples in contact.
    pub(super) fn gap_of_change(
        self,
        pressure: &[f64],
        change: impl Fn(usize) -> f64 + Sync + Send,
        largest: f64,
        load: f64,
    ) -> f64 {
        if !pressure.iter().any(|&p| self.is_full(p)) {
            return largest * load;
        }
        let share = |i: usize| if pressure[i] > 0.0 { self.largest() * change(i) } else { 0.0 };
        let [gap] = sums::of(pressure.len(), |i| [share(i)]);
        gap
    }

    /// The middle between the largest gap where p = H and the least where p = 0, given as `samples` of pressure and gap: where no sample
    /// is free any δ between them solves the contact. 0 without a full sample.
    pub(super) fn between(self, samples: impl Iterator<Item = (f64, f64)>) -> f64 {
        let (closed, open) = samples.fold((f64::NEG_INFINITY, f64::INFINITY), |(closed, open), (p, gap)| {
            if self.is_full(p) { (closed.max(gap), open) } else { (closed, open.min(gap)) }
        });
        match (closed.is_finite(), open.is_finite()) {
            (true, true) => 0.5 * (closed + open),
            (true, false) => closed,
            _ => 0.0,
        }
    }
}

/// Sums of [`LoadSums`] and [`WeightedSums`], eight samples at a time.
#[derive(Clone, Copy)]
pub(super) struct LoadLanes<S: Simd> {
    bounds: BoundLanes<S>,
    free: f64x8<S>,
    full: f64x8<S>,
    work: f64x8<S>,
    weight: f64x8<S>,
    weighted: f64x8<S>,
}

impl<S: Simd> LoadLanes<S> {
    /// Sums of no samples.
    #[inline(always)]
    pub fn new(simd: S, bounds: BoundLanes<S>) -> Self {
        let zero = splat(simd, 0.0);
        Self { bounds, free: zero, full: zero, work: zero, weight: zero, weighted: zero }
    }

    /// Adds samples, the parts of whose pressure are given too.
    #[inline(always)]
    pub fn add(&mut self, Parts { free, full }: Parts<S>, pressure: f64x8<S>, gap: f64x8<S>) {
        self.free += free;
        self.full += full;
        self.work = free.mul_add(gap, self.work);
        let weight = self.bounds.weight(pressure);
        self.weight += weight;
        self.weighted = weight.mul_add(gap, self.weighted);
    }

    /// Σ p where p < H, number of samples where p = H, Σ p g where p < H, Σ p(1 − p/H), Σ p(1 − p/H) g.
    #[inline(always)]
    pub fn totals(self) -> [f64; 5] {
        [self.free, self.full, self.work, self.weight, self.weighted].map(total)
    }
}

/// Sums of [`GapSums`], eight samples at a time.
#[derive(Clone, Copy)]
pub(super) struct GapLanes<S: Simd> {
    bounds: BoundLanes<S>,
    far: f64x8<S>,
    work: f64x8<S>,
    complementarity: f64x8<S>,
    beyond: f64x8<S>,
    open: f64x8<S>,
    least: f64x8<S>,
    below: f64x8<S>,
    outside: f64x8<S>,
}

impl<S: Simd> GapLanes<S> {
    /// Sums of no samples.
    #[inline(always)]
    pub fn new(simd: S, bounds: BoundLanes<S>) -> Self {
        let (zero, far) = (splat(simd, 0.0), splat(simd, f64::INFINITY));
        let (work, complementarity, beyond, open) = (zero, zero, zero, zero);
        Self { bounds, far, work, complementarity, beyond, open, least: far, below: far, outside: far }
    }

    /// Adds samples.
    #[inline(always)]
    pub fn add(&mut self, pressure: f64x8<S>, gap: f64x8<S>) {
        let (bounds, far) = (self.bounds, self.far);
        let below = bounds.is_below(pressure);
        let (violation, open) = bounds.violation(below, gap);
        self.work = bounds.parts(pressure).free.mul_add(gap, self.work);
        self.complementarity = bounds.away(pressure, gap).mul_add(gap.abs(), self.complementarity);
        self.beyond += violation;
        self.open += open;
        self.least = self.least.min(gap);
        self.below = self.below.min(below.select(gap, far));
        self.outside = self.outside.min(bounds.is_pressed(pressure).select(far, gap));
    }

    /// The sums work, complementarity, beyond and open, and the least values in all, below H and outside contact.
    #[inline(always)]
    pub fn totals(self) -> Totals<4, 3> {
        Totals {
            sums: [self.work, self.complementarity, self.beyond, self.open].map(total),
            least: [self.least, self.below, self.outside].map(lowest),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_samples_bear_their_part_of_the_load_and_say_nothing_about_the_penetration() {
        let sums = LoadSums { free: 3.0, full: 2.0 };
        let without = LoadSums { full: 0.0, ..sums };
        assert_eq!([sums.total(Bounds::up_to(2.0)), without.total(Bounds::default())], [7.0, 3.0]);
        let weighted = WeightedSums { work: 6.0, weight: 0.5, weighted: 2.0 };
        assert_eq!([weighted.mean(sums), weighted.mean(without)], [Some(4.0), Some(2.0)]);
        assert_eq!(WeightedSums::default().mean(LoadSums { free: 0.0, full: 2.0 }), None);
    }

    /// The bound against the least work of all pressures of the set with the load of p, found by filling the least gaps.
    #[test]
    fn the_gap_of_the_energy_bounds_what_the_least_work_leaves() {
        let pressure = [2.0, 1.0, 0.0, 2.0, 0.5];
        for gap in [[-0.3, 0.0, 0.2, -0.1, 0.0], [0.1, -0.2, -0.4, 0.3, 0.0], [-1.0, 0.5, 0.5, -1.0, 0.5]] {
            for most in [2.0, f64::INFINITY] {
                let bounds = Bounds::up_to(most);
                let sums = gap_sums(&pressure, &gap, bounds);
                let done: f64 = pressure.iter().zip(gap).map(|(p, g)| p * g).sum();
                let mut gaps = gap.to_vec();
                gaps.sort_by(f64::total_cmp);
                let (mut left, mut least) = (pressure.iter().sum::<f64>(), 0.0);
                for g in gaps {
                    let p = bounds.clamp(left);
                    least += p * g;
                    left -= p;
                }
                let found = sums.energy_gap(bounds, true);
                assert!(found >= done - least - 1e-14, "{gap:?} up to {most}: {found} of {}", done - least);
                // Sharp where nothing is full.
                assert!(most.is_finite() || (found - (done - least)).abs() < 1e-14, "{gap:?}: {found}");
            }
        }
    }

    /// The sums of a few samples, one after the other.
    fn gap_sums(pressure: &[f64], gap: &[f64], bounds: Bounds) -> GapSums {
        let samples = || pressure.iter().copied().zip(gap.iter().copied());
        let full = samples().filter(|(p, _)| bounds.is_full(*p));
        let of = |of: &dyn Fn(f64, f64) -> f64| samples().map(|(p, g)| of(p, g)).sum::<f64>();
        let least =
            |is: &dyn Fn(f64) -> bool| samples().filter(|(p, _)| is(*p)).fold(f64::INFINITY, |l, (_, g)| l.min(g));
        let below = |p: f64| !bounds.is_full(p);
        let load = LoadSums { free: of(&|p, _| if below(p) { p } else { 0.0 }), full: full.clone().count() as f64 };
        let sums = [
            of(&|p, g| if below(p) { p * g } else { 0.0 }),
            of(&|p, g| bounds.away(p, g) * g.abs()),
            of(&|p, g| bounds.violation(p, g)),
            full.map(|(_, g)| g.max(0.0)).sum(),
        ];
        GapSums::of(load, Totals { sums, least: [least(&|_| true), least(&below), least(&|p| p == 0.0)] })
    }
}
