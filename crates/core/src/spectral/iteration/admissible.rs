//! The pressures among which the methods search.

use crate::load::Control;

/// Part of the largest pressure beyond which a pressure is the largest one: what rounding takes off it is put back.
const AT_MOST: f64 = 1.0 - 1e-15;
/// Part of a load that rounding of its sum leaves.
const ROUNDING: f64 = 1e-12;

/// Admissible pressures: 0 ≤ p ≤ H with the hardness H where contact may occur, p = 0 elsewhere.
///
/// A sample is **free** where 0 < p < H, **full** where p = H: there the surface is pressed in for good, and the gap is −(what is pressed
/// in).
#[derive(Debug, Clone, Copy)]
pub struct AdmissibleSet<'a> {
    /// Whether contact may occur, one value per sample; `None`: everywhere.
    mask: Option<&'a [bool]>,
    /// H, a pressure; infinite without hardness.
    most: f64,
}

impl Default for AdmissibleSet<'_> {
    /// p ≥ 0 on all samples.
    fn default() -> Self {
        Self::new(None)
    }
}

/// The bound p ≤ H as the loops over samples use it.
#[derive(Debug, Clone, Copy)]
pub(super) struct UpperBound {
    /// H.
    pub most: f64,
    /// A pressure beyond it is H.
    pub nearly: f64,
}

/// Sum of a pressure below the bound, and the number of samples at it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LoadSums {
    /// Σ p where p < H.
    pub free: f64,
    /// Number of samples where p = H.
    pub full: f64,
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
    /// The mean of g by which δ moves: weighted with p or, where samples are full, with p(1 − p/H), as pressures that are about to reach a
    /// bound say nothing about δ. `None` where no sample is free.
    pub fn mean(self, load: LoadSums) -> Option<f64> {
        match load.full {
            0.0 if load.free > 0.0 => Some(self.work / load.free),
            _ if self.weight > 0.0 => Some(self.weighted / self.weight),
            _ => None,
        }
    }
}

/// The middle between the largest gap where p = H and the least where p = 0, given as `samples` of pressure and gap: where no sample is
/// free any δ between them solves the contact. 0 without a full sample.
pub(super) fn between(samples: impl Iterator<Item = (f64, f64)>, most: f64) -> f64 {
    let (closed, open) = samples.fold((f64::NEG_INFINITY, f64::INFINITY), |(closed, open), (p, gap)| {
        if p >= most { (closed.max(gap), open) } else { (closed, open.min(gap)) }
    });
    match (closed.is_finite(), open.is_finite()) {
        (true, true) => 0.5 * (closed + open),
        (true, false) => closed,
        _ => 0.0,
    }
}

impl UpperBound {
    /// Whether there is one.
    pub fn is_finite(self) -> bool {
        self.most.is_finite()
    }
}

impl LoadSums {
    /// Σ p.
    pub fn total(self, most: f64) -> f64 {
        // Without hardness no sample is full, and ∞ · 0 is no number.
        if self.full > 0.0 { self.free + self.full * most } else { self.free }
    }
}

impl<'a> AdmissibleSet<'a> {
    /// Pressures p ≥ 0 on the samples of a mask; on all samples without one.
    pub fn new(mask: Option<&'a [bool]>) -> Self {
        Self { mask, most: f64::INFINITY }
    }

    /// The set with the bound p ≤ `most`, the hardness.
    #[must_use]
    pub fn at_most(self, most: f64) -> Self {
        Self { most, ..self }
    }

    /// The bound p ≤ H.
    pub(super) fn bound(self) -> UpperBound {
        UpperBound { most: self.most, nearly: AT_MOST * self.most }
    }

    /// Whether contact may occur everywhere.
    pub fn is_everywhere(self) -> bool {
        self.mask.is_none()
    }

    /// Whether no pressure of the set on `samples` samples bears a load: its mean is not below H, over the samples where contact may
    /// occur.
    pub(super) fn is_exceeded_by(self, load: Control, samples: usize) -> bool {
        let Control::MeanPressure(mean) = load else { return false };
        mean * samples as f64 >= self.most * (samples - self.closed().count()) as f64
    }

    /// Whether the pressure is H wherever contact may occur.
    pub(super) fn is_filled(self, pressure: &[f64]) -> bool {
        let (most, mask) = (self.bound().nearly, self.mask);
        self.most.is_finite()
            && pressure.iter().enumerate().all(|(i, &p)| p > most || mask.is_some_and(|mask| !mask[i]))
    }

    /// p ← 0 where contact may not occur.
    pub(super) fn restrict(self, pressure: &mut [f64]) {
        self.closed().for_each(|i| pressure[i] = 0.0);
    }

    /// Gives a pressure that is zero or H everywhere the given mean over all samples: uniform where contact may occur and p < H, which is
    /// exactly the mean where that is everywhere.
    pub(super) fn fill(self, pressure: &mut [f64], mean: f64) {
        let samples = pressure.len() as f64;
        let full = pressure.iter().filter(|p| **p >= self.most).count() as f64;
        let borne = if full > 0.0 { full * self.most } else { 0.0 };
        let missing = mean * samples - borne;
        if full > 0.0 && missing <= ROUNDING * borne {
            return;
        }
        let size = samples - full - self.closed().count() as f64;
        let level = if full > 0.0 { missing / size } else { mean * (samples / size) };
        pressure.iter_mut().filter(|p| **p < self.most).for_each(|p| *p = level);
        self.restrict(pressure);
    }

    /// g ← `far` where contact may not occur: such a sample never joins the active set.
    pub(super) fn open(self, gap: &mut [f64], far: f64) {
        self.closed().for_each(|i| gap[i] = far);
    }

    /// Pressure and gap of the samples where contact may occur.
    pub(super) fn samples(self, pressure: &[f64], gap: &[f64]) -> impl Iterator<Item = (f64, f64)> {
        let admissible = move |i: &usize| self.mask.is_none_or(|mask| mask[*i]);
        (0..gap.len()).filter(admissible).map(|i| (pressure[i], gap[i]))
    }

    /// The sums that depend on samples without pressure, over those where contact may occur: min g, min g where p < H, min g where
    /// p = 0, and Σ max(−g, 0) where p < H with Σ max(g, 0) where p = H.
    pub(super) fn least_gaps(self, pressure: &[f64], gap: &[f64]) -> [f64; 4] {
        let admissible = |i: &usize| self.mask.is_none_or(|mask| mask[*i]);
        let start = [f64::INFINITY, f64::INFINITY, f64::INFINITY, 0.0];
        (0..gap.len()).filter(admissible).fold(start, |[least, below, outside, beyond], i| {
            let outside = if pressure[i] > 0.0 { outside } else { outside.min(gap[i]) };
            let is_below = pressure[i] < self.most;
            let (wrong, below) = if is_below { (-gap[i], below.min(gap[i])) } else { (gap[i], below) };
            [least.min(gap[i]), below, outside, beyond + wrong.max(0.0)]
        })
    }

    /// Samples where contact may not occur.
    fn closed(self) -> impl Iterator<Item = usize> + use<'a> {
        self.mask.unwrap_or_default().iter().enumerate().filter(|(_, admissible)| !**admissible).map(|(i, _)| i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_samples_bear_their_part_of_the_load_and_say_nothing_about_the_penetration() {
        let sums = LoadSums { free: 3.0, full: 2.0 };
        assert_eq!([sums.total(2.0), LoadSums { full: 0.0, ..sums }.total(f64::INFINITY)], [7.0, 3.0]);
        let own = WeightedSums { work: 6.0, weight: 0.5, weighted: 2.0 };
        assert_eq!([own.mean(sums), own.mean(LoadSums { full: 0.0, ..sums })], [Some(4.0), Some(2.0)]);
        assert_eq!(WeightedSums::default().mean(LoadSums { free: 0.0, full: 2.0 }), None);
    }

    /// 1120 of 1600 samples at H = 0.1 bear a mean of 0.07 but for rounding.
    #[test]
    fn what_full_samples_do_not_bear_lies_on_the_others() {
        let set = AdmissibleSet::default().at_most(0.1);
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

    #[test]
    fn a_set_is_filled_where_every_sample_of_its_mask_is_at_the_hardness() {
        let mask = [true, true, false];
        let set = AdmissibleSet::new(Some(&mask)).at_most(3.0);
        assert!(set.is_filled(&[3.0, 3.0, 0.0]) && !set.is_filled(&[3.0, 2.0, 3.0]));
        assert!(!AdmissibleSet::default().is_filled(&[3.0; 3]));
    }

    #[test]
    fn a_load_is_exceeded_where_the_mask_leaves_too_few_samples() {
        let mask = [true, true, false, false];
        let set = AdmissibleSet::new(Some(&mask)).at_most(3.0);
        assert!(
            !set.is_exceeded_by(Control::MeanPressure(1.4), 4) && set.is_exceeded_by(Control::MeanPressure(1.5), 4)
        );
        assert!(!set.is_exceeded_by(Control::Penetration(9.0), 4));
        assert!(!AdmissibleSet::default().is_exceeded_by(Control::MeanPressure(1e9), 4));
    }
}
