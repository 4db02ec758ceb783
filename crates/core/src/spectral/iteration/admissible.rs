//! The pressures among which the methods search. Whatever they ask of the set is answered in four files, and nothing else knows its bounds:
//!
//! ```text
//! bounds       one sample, or eight: least and largest pressure, free or full, whether a gap is on the wrong side, how far, what it weighs
//! admissible   all samples: where contact may occur, which load the set bears, its pressure of least work
//! projection   the pressure of the set that is near to any, with a mean
//! duality      what bounds and gap say of penetration and energy
//! ```

use super::bounds::Bounds;
use crate::load::Control;

/// Admissible pressures: between their [`Bounds`], 0 ≤ p ≤ H with the hardness H, where contact may occur, p = 0 elsewhere.
#[derive(Debug, Clone, Copy, Default)]
pub struct AdmissibleSet<'a> {
    /// Whether contact may occur, one value per sample; `None`: everywhere.
    mask: Option<&'a [bool]>,
    bounds: Bounds,
}

impl<'a> AdmissibleSet<'a> {
    /// Pressures p ≥ 0 on the samples of a mask; on all samples without one.
    pub fn new(mask: Option<&'a [bool]>) -> Self {
        Self { mask, bounds: Bounds::default() }
    }

    /// The set of pressures between other bounds.
    #[must_use]
    pub fn within(self, bounds: Bounds) -> Self {
        Self { bounds, ..self }
    }

    /// Bounds of the pressure where contact may occur.
    pub(super) fn bounds(self) -> Bounds {
        self.bounds
    }

    /// Whether contact may occur everywhere.
    pub fn is_everywhere(self) -> bool {
        self.mask.is_none()
    }

    /// Whether contact may occur at a sample.
    pub fn may_touch(self, sample: usize) -> bool {
        self.mask.is_none_or(|mask| mask[sample])
    }

    /// Whether contact may occur at any sample.
    pub fn is_anywhere(self) -> bool {
        self.mask.is_none_or(|mask| mask.contains(&true))
    }

    /// Whether no pressure of the set on `samples` samples bears a load: its mean is not below H, over the samples where contact may
    /// occur.
    pub(super) fn is_exceeded_by(self, load: Control, samples: usize) -> bool {
        let Control::MeanPressure(mean) = load else { return false };
        mean * samples as f64 >= self.bounds.largest() * self.size(samples) as f64
    }

    /// Whether the pressure is H wherever contact may occur.
    pub(super) fn is_filled(self, pressure: &[f64]) -> bool {
        let is_filled = |(i, &p): (usize, &f64)| self.bounds.is_nearly_full(p) || !self.may_touch(i);
        self.bounds.is_finite() && pressure.iter().enumerate().all(is_filled)
    }

    /// p ← 0 where contact may not occur.
    pub(super) fn restrict(self, pressure: &mut [f64]) {
        self.closed().for_each(|i| pressure[i] = 0.0);
    }

    /// Number of samples among `samples` where contact may occur.
    pub(super) fn size(self, samples: usize) -> usize {
        samples - self.closed().count()
    }

    /// g ← `far` where contact may not occur: such a sample never joins the active set.
    pub(super) fn open(self, gap: &mut [f64], far: f64) {
        self.closed().for_each(|i| gap[i] = far);
    }

    /// Pressure and gap of the samples where contact may occur.
    pub(super) fn samples(self, pressure: &[f64], gap: &[f64]) -> impl Iterator<Item = (f64, f64)> {
        (0..gap.len()).filter(move |i| self.may_touch(*i)).map(|i| (pressure[i], gap[i]))
    }

    /// The sums that depend on samples without pressure, over those where contact may occur: min g, min g where p < H, min g where
    /// p = 0, and Σ max(−g, 0) where p < H with Σ max(g, 0) where p = H.
    pub(super) fn least_gaps(self, pressure: &[f64], gap: &[f64]) -> [f64; 4] {
        let start = [f64::INFINITY, f64::INFINITY, f64::INFINITY, 0.0];
        self.samples(pressure, gap).fold(start, |[least, below, outside, beyond], (p, gap)| {
            let outside = if p > 0.0 { outside } else { outside.min(gap) };
            let below = if self.bounds.is_full(p) { below } else { below.min(gap) };
            [least.min(gap), below, outside, beyond + self.bounds.violation(p, gap)]
        })
    }

    /// The pressure of the set with the sum `total` that does the least work ⟨gap, p⟩; of equal gaps the first ones bear it.
    pub(super) fn least_work(self, gap: &[f64], total: f64) -> Vec<f64> {
        let most = self.bounds.largest();
        let full = (total / most).floor();
        let mut field = gap.to_vec();
        self.open(&mut field, f64::INFINITY);
        // A load just below what all bear leaves no sample for the rest.
        let rank = (full as usize).min(field.len() - 1);
        let (_, &mut limit, _) = field.select_nth_unstable_by(rank, f64::total_cmp);
        field.copy_from_slice(gap);
        self.open(&mut field, f64::INFINITY);
        let mut left = total - most * field.iter().filter(|gap| **gap < limit).count() as f64;
        for value in &mut field {
            *value = if *value < limit {
                most
            } else if *value == limit {
                let borne = self.bounds.clamp(left);
                left -= borne;
                borne
            } else {
                0.0
            };
        }
        field
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
    fn a_set_is_filled_where_every_sample_of_its_mask_is_at_the_hardness() {
        let mask = [true, true, false];
        let set = AdmissibleSet::new(Some(&mask)).within(Bounds::up_to(3.0));
        assert!(set.is_filled(&[3.0, 3.0, 0.0]) && !set.is_filled(&[3.0, 2.0, 3.0]));
        assert!(!AdmissibleSet::default().is_filled(&[3.0; 3]));
    }

    #[test]
    fn a_load_is_exceeded_where_the_mask_leaves_too_few_samples() {
        let mask = [true, true, false, false];
        let set = AdmissibleSet::new(Some(&mask)).within(Bounds::up_to(3.0));
        assert!(
            !set.is_exceeded_by(Control::MeanPressure(1.4), 4) && set.is_exceeded_by(Control::MeanPressure(1.5), 4)
        );
        assert!(!set.is_exceeded_by(Control::Penetration(9.0), 4));
        assert!(!AdmissibleSet::default().is_exceeded_by(Control::MeanPressure(1e9), 4));
    }
    #[test]
    fn the_least_gaps_bear_the_load() {
        let gap = [3.0, 1.0, 2.0, 2.0, 0.0];
        let bounds = Bounds::up_to(2.0);
        let set = AdmissibleSet::default().within(bounds);
        assert_eq!(set.least_work(&gap, 5.0), [0.0, 2.0, 1.0, 0.0, 2.0]);
        assert_eq!(set.least_work(&gap, 7.0), [0.0, 2.0, 2.0, 1.0, 2.0]);
        assert_eq!(set.least_work(&gap, 9.5), [1.5, 2.0, 2.0, 2.0, 2.0]);
        let mask = [true, false, true, true, true];
        assert_eq!(AdmissibleSet::new(Some(&mask)).within(bounds).least_work(&gap, 5.0), [0.0, 0.0, 2.0, 1.0, 2.0]);
    }
}
