//! Values that contend for a maximum.
//!
//! Of values vᵢ with the errors eᵢ the largest one, v, is stated with the error
//!
//! e = max(vᵢ + eᵢ) − v ≥ its own,
//!
//! and whatever may be larger than v less its own error is a rival for the place. So what is stated of a part, a face of a
//! material, never exceeds what is stated of the whole.

use super::constants::{CHANGE_SAFETY, DEEP_OPENING_ERROR, DEEP_SHEAR_ERROR, DEEP_TENSION_ERROR, SHALLOW_ERROR};
use super::crest::Crest;
use super::field::StressField;
use super::measure::StressMeasure;
use super::peak::{Peak, Rival};
use super::tensor::StressState;

/// All that contends, each with its measure.
pub(super) type Contenders = Vec<(StressMeasure, Contender)>;

/// A value that may be the largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contender {
    /// Value and place; the error is its own.
    pub peak: Peak,
    /// Where it is the crest of the surface.
    pub crest: Option<Crest>,
    /// The state there, for interfaces.
    pub state: StressState,
    /// √(Σσᵢⱼ²) of what the waves cause there, without the mean and residual stresses.
    pub size: f64,
}

/// A coarser grid that errors are read from.
#[derive(Debug)]
pub(super) struct CoarserField<'a> {
    field: &'a StressField,
    crests: Vec<(StressMeasure, Crest)>,
}

impl<'a> CoarserField<'a> {
    pub fn new(field: &'a StressField) -> Self {
        Self { field, crests: field.crests() }
    }

    /// The value of a measure where a contender of the finer grid stands; where it is the crest of the surface, that of this
    /// surface, as long as contact ends anywhere.
    fn value(&self, contender: &Contender, measure: StressMeasure, near: f64) -> f64 {
        let crest = contender.crest.and_then(|_| self.crests.iter().find(|(of, _)| *of == measure));
        crest.map_or_else(|| self.field.value_beside(contender, measure, near), |(_, crest)| crest.peak.value)
    }
}

impl Contender {
    /// The estimated error of its value, from a coarser grid and by the samples of the smallest spot; `near`: the depth down
    /// to which the series converges slowly.
    pub fn error(&self, measure: StressMeasure, coarser: &CoarserField<'_>, resolution: f64, near: f64) -> f64 {
        let Peak { value, position, .. } = self.peak;
        let coarse = coarser.value(self, measure, near);
        if let Some(crest) = self.crest {
            return crest.scale * crest.error(Some(coarse));
        }
        let deep = match measure {
            StressMeasure::Tension => DEEP_TENSION_ERROR,
            StressMeasure::Opening => DEEP_OPENING_ERROR,
            _ => DEEP_SHEAR_ERROR,
        };
        let open = if position[2] < near { SHALLOW_ERROR / resolution } else { deep / resolution.powi(2) };
        CHANGE_SAFETY * (value - coarse).abs() + measure.rise(&self.state, open * self.size)
    }
}

/// The maximum of what contends; without errors where any has none. Places within `apart` are one.
pub(super) fn stated(contenders: &Contenders, measure: StressMeasure, apart: f64) -> Option<Peak> {
    let own = contenders.iter().filter(|(of, _)| *of == measure);
    let peaks: Vec<Peak> = own.map(|(_, contender)| contender.peak).collect();
    Peak::highest(&peaks, apart)
}

impl Peak {
    /// The largest of some values with its error and its rival. What has a rival of its own counts with it. Places within
    /// `apart` of each other are one.
    pub(crate) fn highest(peaks: &[Self], apart: f64) -> Option<Self> {
        let best = peaks.iter().copied().reduce(Self::higher)?;
        if peaks.iter().any(|peak| peak.value.is_finite() && peak.error.is_none()) {
            return Some(Self { error: None, rival: None, ..best });
        }
        let Some(own) = best.error.filter(|_| best.value.is_finite()) else { return Some(best) };
        // What is not a number may be anything.
        let top_of = |top: f64| if top.is_nan() { f64::INFINITY } else { top };
        let errors = peaks.iter().filter_map(|peak| Some((peak, top_of(peak.value + peak.error?))));
        let top = errors.clone().map(|(_, top)| top).fold(best.value + own, f64::max);
        let least = best.value - own;
        let others = errors.filter(|(peak, top)| *top > least && !peak.is_beside(&best, apart));
        let others = others.map(|(peak, _)| peak.rival_itself());
        let rival = others.chain(best.rival).reduce(|a, b| if b.top() > a.top() { b } else { a });
        let beyond = if best.value + own < top { top - best.value } else { own };
        // The sum is the top, rounding or not.
        let error = if best.value + beyond < top { beyond.next_up() } else { beyond };
        Some(Self { error: Some(error), rival, ..best })
    }

    /// As a rival: where it has one that may be higher still, that one.
    fn rival_itself(&self) -> Rival {
        let Self { value, position, material, .. } = *self;
        let own = Rival { value, error: self.error.unwrap_or(f64::INFINITY), position, material };
        self.rival.filter(|rival| rival.top() >= own.top() * (1.0 - 1e-9)).unwrap_or(own)
    }

    fn is_beside(&self, other: &Self, apart: f64) -> bool {
        let away = [0, 1, 2].map(|k| self.position[k] - other.position[k]);
        self.material == other.material && away[0].hypot(away[1]).hypot(away[2]) <= apart
    }
}

impl Rival {
    /// What its value may be at most.
    pub fn top(&self) -> f64 {
        self.value + self.error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn peak(value: f64, error: f64, z: f64) -> Peak {
        Peak {
            value,
            error: Some(error),
            position: [0.0, 0.0, z],
            material: 1,
            direction: [1.0, 0.0, 0.0],
            rival: None,
        }
    }

    #[test]
    fn the_error_of_the_largest_covers_what_may_be_larger() {
        let highest = |peaks: &[Peak]| Peak::highest(peaks, 0.1).unwrap();
        let decided = highest(&[peak(1.0, 0.01, 1.0), peak(0.9, 0.05, 0.0)]);
        assert_eq!((decided.value, decided.error, decided.rival), (1.0, Some(0.01), None));
        // It may be as high, not higher: the place is undecided, the error is the same.
        let near = highest(&[peak(1.0, 0.01, 1.0), peak(0.9, 0.095, 0.0)]);
        assert_eq!((near.error, near.rival.map(|rival| rival.position[2])), (Some(0.01), Some(0.0)));
        let undecided = highest(&[peak(0.9, 0.3, 0.0), peak(1.0, 0.01, 1.0)]);
        assert!((undecided.error.unwrap() - 0.2).abs() < 1e-12 && undecided.rival.unwrap().value == 0.9);
        // Another name of the same place is no rival, but counts.
        let same = highest(&[peak(0.9, 0.3, 0.95), peak(1.0, 0.01, 1.0)]);
        assert!((same.error.unwrap() - 0.2).abs() < 1e-12 && same.rival.is_none());
        let whole = highest(&[undecided, peak(0.95, 0.1, 3.0)]);
        assert_eq!(whole.rival.map(|rival| rival.value), Some(0.9));
    }
}
