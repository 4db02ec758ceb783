//! Contenders: values that may be the largest one within their errors.
//!
//! The largest of values vᵢ with the errors eᵢ, v with the error e₀, is stated with the error
//!
//! e = max(vᵢ + eᵢ) − v ≥ e₀,
//!
//! and a value with vᵢ + eᵢ > v − e₀ at another place is a rival. So value plus error of a part, a face of a material, never
//! exceeds value plus error of the whole.

use super::constants::{
    CHANGE_SAFETY, DEEP_OPENING_ERROR, DEEP_SHEAR_ERROR, DEEP_TENSION_ERROR, EXACT_ERROR, SHALLOW, SHALLOW_ERROR,
};
use super::crest::Crest;
use super::field::StressField;
use super::measure::StressMeasure;
use super::peak::{Peak, Rival};
use super::tensor::StressState;
use crate::lattice::{Cell, Surroundings};
use std::f64::consts::PI;

/// Contenders for the maxima of several measures, each with its measure.
pub(super) type Contenders = Vec<(StressMeasure, Contender)>;

/// A value that may be the largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contender {
    /// Value, position and the value's own error.
    pub peak: Peak,
    /// The surface reading, where the value is the largest on the surface.
    pub crest: Option<Crest>,
    /// State at the position.
    pub state: StressState,
    /// √(Σσᵢⱼ²) of the stresses of the waves at the position, without mean and residual stresses, a pressure.
    pub size: f64,
    /// The largest size of these stresses on the border of the window of an isolated contact, on the planes where the value was looked for, a
    /// pressure; zero in a periodic cell.
    pub border: f64,
    /// Whether the value lies on that border.
    pub is_on_border: bool,
}

/// Part of a side of a window that counts as its border.
const BORDER: f64 = 0.05;

/// The stress field on the next coarser grid, from which errors are estimated.
#[derive(Debug)]
pub(super) struct CoarserField<'a> {
    field: &'a StressField,
    /// The largest values on its surface.
    highest: Vec<(StressMeasure, f64)>,
}

impl<'a> CoarserField<'a> {
    /// The field, and its largest values on the surface by some `measures`.
    pub fn new(field: &'a StressField, measures: &[StressMeasure]) -> Self {
        Self { field, highest: if measures.is_empty() { Vec::new() } else { field.highest_on_surface(measures) } }
    }

    /// Value of a measure on the coarser grid at the position of a contender; for the largest value on the surface the largest
    /// one on the coarser surface, where contact has an edge there.
    fn value(&self, contender: &Contender, measure: StressMeasure, near: f64) -> f64 {
        let highest = contender.crest.and_then(|_| self.highest.iter().find(|(of, _)| *of == measure));
        highest.map_or_else(|| self.field.value_beside(contender, measure, near), |&(_, value)| value)
    }
}

/// Region near the surface, in which stresses may ring.
#[derive(Debug, Clone, Copy)]
pub(super) struct NearSurface {
    /// Depth of the region, a length.
    pub depth: f64,
    /// Largest ringing of stresses in the region, a pressure.
    pub ringing: f64,
    /// Whether the waves of the pressure are known, so that below the region the samples leave nothing open.
    pub is_exact_below: bool,
}

impl NearSurface {
    /// Largest ringing of stresses at a depth, a pressure: waves that the grid lacks have (1 + qz)e^{−qz} of their
    /// pressure at most.
    fn ringing_at(&self, depth: f64) -> f64 {
        let s = PI * SHALLOW * depth / self.depth;
        self.ringing * (1.0 + s) * (-s).exp()
    }
}

impl Contender {
    /// The contender with the largest size of stresses on the `border` of a window in which it was looked for; none of a periodic cell.
    pub fn in_window(self, window: Cell, border: f64) -> Self {
        let [x, y, _] = self.peak.position;
        let is_on_border = || window.fractions([x, y]).iter().any(|s| !(BORDER..=1.0 - BORDER).contains(s));
        let is_alone = window.surroundings() == Surroundings::FreeSpace;
        Self { border, is_on_border: is_alone && is_on_border(), ..self }
    }

    /// Whether the value lies on the border of the last window, where the largest size of stresses is `border`, a pressure.
    pub fn is_still_on(&self, border: f64) -> bool {
        self.is_on_border && self.border == border
    }

    /// Estimated error of the value, from the coarser grid and the `resolution`, the samples along the radius of the smallest
    /// spot; near the `surface` the series converges slowly, and may ring.
    pub fn error(
        &self,
        measure: StressMeasure,
        coarser: &CoarserField<'_>,
        resolution: f64,
        surface: NearSurface,
    ) -> f64 {
        let Peak { value, position, .. } = self.peak;
        let coarse = coarser.value(self, measure, surface.depth);
        if let Some(crest) = self.crest {
            return crest.scale * crest.error(Some(coarse));
        }
        let deep = match measure {
            StressMeasure::Tension => DEEP_TENSION_ERROR,
            StressMeasure::Strain(_) | StressMeasure::HorizontalStrain(_) | StressMeasure::Compression(_) => {
                DEEP_TENSION_ERROR
            }
            StressMeasure::Opening => DEEP_OPENING_ERROR,
            _ => DEEP_SHEAR_ERROR,
        };
        let is_near = position[2] < surface.depth;
        let open = match is_near {
            true => SHALLOW_ERROR / resolution,
            false if surface.is_exact_below => EXACT_ERROR,
            false => deep / resolution.powi(2),
        };
        let ringing = if is_near { surface.ringing_at(position[2]) } else { 0.0 };
        CHANGE_SAFETY * (value - coarse).abs() + measure.rise(&self.state, open * self.size + ringing)
    }
}

/// The largest contender of a measure with its error; without error where any contender has none. Positions within the
/// distance `apart` count as one.
pub(super) fn stated(contenders: &Contenders, measure: StressMeasure, apart: f64) -> Option<Peak> {
    let of_measure = contenders.iter().filter(|(of, _)| *of == measure);
    let peaks: Vec<Peak> = of_measure.map(|(_, contender)| contender.peak).collect();
    Peak::highest(&peaks, apart)
}

impl Peak {
    /// The largest of some values with its error and its rival, rivals of the values included. Positions within the distance
    /// `apart` of each other count as one.
    pub(crate) fn highest(peaks: &[Self], apart: f64) -> Option<Self> {
        let best = peaks.iter().copied().reduce(Self::higher)?;
        if peaks.iter().any(|peak| peak.value.is_finite() && peak.error.is_none()) {
            return Some(Self { error: None, rival: None, ..best });
        }
        let Some(error) = best.error.filter(|_| best.value.is_finite()) else { return Some(best) };
        // A value that is not a number may be arbitrarily large.
        let top_of = |top: f64| if top.is_nan() { f64::INFINITY } else { top };
        let errors = peaks.iter().filter_map(|peak| Some((peak, top_of(peak.value + peak.error?))));
        let top = errors.clone().map(|(_, top)| top).fold(best.value + error, f64::max);
        let least = best.value - error;
        let others = errors.filter(|(peak, top)| *top > least && !peak.is_beside(&best, apart));
        let others = others.map(|(peak, _)| peak.rival_itself());
        let rival = others.chain(best.rival).reduce(|a, b| if b.top() > a.top() { b } else { a });
        let beyond = if best.value + error < top { top - best.value } else { error };
        // Value plus error is no less than the top, whatever the rounding.
        let error = if best.value + beyond < top { beyond.next_up() } else { beyond };
        Some(Self { error: Some(error), rival, ..best })
    }

    /// The value as a rival, or its own rival where that may be larger.
    fn rival_itself(&self) -> Rival {
        let Self { value, position, material, .. } = *self;
        let itself = Rival { value, error: self.error.unwrap_or(f64::INFINITY), position, material };
        self.rival.filter(|rival| rival.top() >= itself.top() * (1.0 - 1e-9)).unwrap_or(itself)
    }

    fn is_beside(&self, other: &Self, apart: f64) -> bool {
        let away = [0, 1, 2].map(|k| self.position[k] - other.position[k]);
        self.material == other.material && away[0].hypot(away[1]).hypot(away[2]) <= apart
    }
}

impl Rival {
    /// Value plus error.
    pub fn top(&self) -> f64 {
        self.value + self.error
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::MaterialId;

    fn peak(value: f64, error: f64, z: f64) -> Peak {
        Peak {
            value,
            error: Some(error),
            position: [0.0, 0.0, z],
            material: MaterialId::numbered(1),
            direction: [1.0, 0.0, 0.0],
            rival: None,
        }
    }

    #[test]
    fn the_error_of_the_largest_covers_what_may_be_larger() {
        let highest = |peaks: &[Peak]| Peak::highest(peaks, 0.1).unwrap();
        let decided = highest(&[peak(1.0, 0.01, 1.0), peak(0.9, 0.05, 0.0)]);
        assert_eq!((decided.value, decided.error, decided.rival), (1.0, Some(0.01), None));
        // The second peak with its error, 0.995, is within the first, 1 ± 0.01, and not above it: it is a rival, and the error stays 0.01.
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
