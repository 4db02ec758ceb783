//! Projection of a pressure onto the admissible ones: between the bounds and, under load control, of the prescribed mean.

use super::admissible::AdmissibleSet;
use super::bounds::Bounds;
use super::duality::LoadSums;
use crate::load::Control;
use crate::numeric::lanes::{LANES, all_zero, vectorised};
use crate::numeric::rows::{self, Totals};
use crate::numeric::sums::{self, BLOCK};
use fearless_simd::prelude::*;
use rayon::prelude::*;

/// Part of a load that rounding of its sum leaves.
const ROUNDING: f64 = 1e-12;

impl AdmissibleSet<'_> {
    /// Clips a pressure at its bounds and, under load control, scales it to the mean; where nothing is left to scale, what is missing is
    /// uniform on the samples below H where contact may occur.
    pub(super) fn project(self, pressure: &mut [f64], load: Control) {
        self.restrict(pressure);
        let sums = bounded(pressure, self.bounds());
        let Control::MeanPressure(mean) = load else { return };
        let total = mean * pressure.len() as f64;
        if !scaled(pressure, sums, total, self.bounds()) {
            self.fill(pressure, mean);
        }
    }

    /// Gives a pressure that is zero or H everywhere the given mean over all samples: uniform where contact may occur and p < H, which is
    /// exactly the mean where that is everywhere.
    fn fill(self, pressure: &mut [f64], mean: f64) {
        let (samples, bounds) = (pressure.len() as f64, self.bounds());
        let full = pressure.iter().filter(|p| bounds.is_full(**p)).count() as f64;
        let borne = LoadSums { free: 0.0, full }.total(bounds);
        let missing = mean * samples - borne;
        if full > 0.0 && missing <= ROUNDING * borne {
            return;
        }
        let size = self.size(pressure.len()) as f64 - full;
        let level = if full > 0.0 { missing / size } else { mean * (samples / size) };
        pressure.iter_mut().filter(|p| !bounds.is_full(**p)).for_each(|p| *p = level);
        self.restrict(pressure);
    }
}

/// Scales a pressure with these sums to a total; false where nothing is left to scale. What is below H is scaled, cut where it exceeds H,
/// and scaled again until nothing does; where H alone exceeds the total, all of it is scaled.
fn scaled(pressure: &mut [f64], mut sums: LoadSums, total: f64, bounds: Bounds) -> bool {
    loop {
        let rest = if sums.full > 0.0 { total - sums.full * bounds.largest() } else { total };
        let [free, full] = match (rest > 0.0, sums.free > 0.0) {
            (true, true) => [rest / sums.free, 1.0],
            (false, _) if sums.full > 0.0 => [total / sums.total(bounds); 2],
            _ => return false,
        };
        sums::update(pressure, |_, p| if bounds.is_full(p) { full * p } else { free * p });
        if !bounds.is_finite() {
            return true;
        }
        let before = std::mem::replace(&mut sums, bounded(pressure, bounds));
        if sums.full <= before.full {
            return true;
        }
    }
}

/// p ← min(max(p, 0), H), and the sums of it.
fn bounded(pressure: &mut [f64], bounds: Bounds) -> LoadSums {
    let Totals { sums: [free, full], least: [] } =
        rows::row_totals(BLOCK, pressure.par_chunks_mut(BLOCK), |_, p| vectorised!(simd => clipped(simd, p, bounds)));
    LoadSums { free, full }
}

/// p ← min(max(p, 0), H); Σ p where p < H, and the number of samples where p = H.
#[inline(always)]
fn clipped<S: Simd>(simd: S, p: &mut [f64], bounds: Bounds) -> Totals<2, 0> {
    let (mut sum, mut full) = (0.0, 0.0);
    for group in p.chunks_mut(LANES) {
        if all_zero(simd, group) {
            continue;
        }
        for p in group {
            let is_full = bounds.is_nearly_full(*p);
            *p = bounds.project(*p);
            if is_full {
                full += 1.0;
            } else {
                sum += *p;
            }
        }
    }
    Totals { sums: [sum, full], least: [] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1120 of 1600 samples at H = 0.1 bear a mean of 0.07 but for rounding.
    #[test]
    fn what_full_samples_do_not_bear_lies_on_the_others() {
        let set = AdmissibleSet::default().within(Bounds::up_to(0.1));
        let mut pressure = vec![0.0; 1600];
        pressure[..1120].fill(0.1);
        let before = pressure.clone();
        set.fill(&mut pressure, 0.07);
        assert_eq!(pressure, before);
        set.fill(&mut pressure, 0.08);
        assert!(pressure[..1120] == before[..1120]);
        assert!(pressure[1120..].iter().all(|p| (p - 16.0 / 480.0).abs() < 1e-15));
        set.fill(&mut pressure[1120..], 0.05);
        assert!(pressure[1120..].iter().all(|p| *p == 0.05));
    }
}
