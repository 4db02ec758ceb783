//! Where coating and substrate are stressed most: the largest principal shear stress τ₁ and the largest tension σ₁ in
//! each material and on each of its faces.
//!
//! They are searched plane by plane and refined; on the surface itself, where the series converges slowly, the largest
//! tension is that of the [`Crest`].

use super::crest::Crest;
use super::peak::Peak;
use super::quantity::Quantity;

/// Maxima over a material or a face.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Extremes {
    /// Largest principal shear stress τ₁.
    #[cfg_attr(feature = "serde", serde(rename = "max_tau1"))]
    pub tau1: Peak,
    /// Largest principal stress σ₁; negative where nothing is in tension.
    #[cfg_attr(feature = "serde", serde(rename = "max_tension"))]
    pub tension: Peak,
}

impl Extremes {
    pub(super) fn of(peak: impl Fn(Quantity) -> Peak) -> Self {
        Self { tau1: peak(Quantity::Tau1), tension: peak(Quantity::Tension) }
    }

    pub(super) fn get(&self, quantity: Quantity) -> Peak {
        match quantity {
            Quantity::Tau1 => self.tau1,
            Quantity::Tension => self.tension,
        }
    }
}

/// All maxima of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Maxima {
    /// Over each material, faces included, from the surface down.
    pub materials: Vec<Extremes>,
    /// Over each face: the surface, then both sides of each interface.
    pub faces: Vec<Extremes>,
    /// The largest tension on the surface with its uncertainty; `None` where contact has no edge.
    pub crest: Option<Crest>,
    /// Samples along the radius of a disc as large as the smallest contact spot.
    pub resolution: f64,
    /// Distance between neighbouring samples, a length.
    pub spacing: f64,
}

impl Maxima {
    /// The largest τ₁ of all.
    pub fn tau1(&self) -> Peak {
        self.largest(Quantity::Tau1)
    }

    /// The largest tension of all.
    pub fn tension(&self) -> Peak {
        self.largest(Quantity::Tension)
    }

    /// Estimated relative error of the largest tension on the surface, also from the next `coarser` grid where there is
    /// one; 0 where contact has no edge.
    pub fn surface_error(&self, coarser: Option<&Self>) -> f64 {
        // Where the coarser grid sees no edge, its largest tension is that of a sample.
        let tension = coarser.and_then(|coarser| coarser.faces.first()).map(|surface| surface.tension.value);
        self.crest.map_or(0.0, |crest| crest.error(tension))
    }

    /// Estimated errors of the largest τ₁ and the largest tension, pressures: twice the change from the next `coarser`
    /// grid, which at second order is three times the error, and what n samples along the radius of the smallest spot
    /// leave open: 0.03 n⁻² of τ₁, 0.1 n⁻² of a tension or the usual one, within two samples of the surface 0.2 n⁻¹.
    /// For a tension on the surface, what its [`Crest`] says of itself. Read off fifty random contacts; that they hold in
    /// 95 % of fifty others is tested.
    pub fn errors(&self, coarser: &Self) -> [f64; 2] {
        let error = |quantity: Quantity, deep: f64, scale: f64| {
            let (fine, coarse) = (self.largest(quantity), coarser.largest(quantity));
            let open = if fine.position[2] < NEAR * self.spacing {
                SHALLOW / self.resolution
            } else {
                deep / self.resolution.powi(2)
            };
            SAFETY * (fine.value - coarse.value).abs() + open * scale.max(fine.value.abs())
        };
        let tension = match self.crest {
            Some(crest) if crest.peak == self.tension() => crest.scale * self.surface_error(Some(coarser)),
            crest => error(Quantity::Tension, DEEP[1], crest.map_or(0.0, |crest| crest.scale)),
        };
        [error(Quantity::Tau1, DEEP[0], 0.0), tension]
    }

    fn largest(&self, quantity: Quantity) -> Peak {
        // There is always a substrate.
        let none =
            Peak { value: f64::NEG_INFINITY, position: [0.0; 3], material: self.materials.len(), direction: [0.0; 3] };
        self.materials.iter().map(|extremes| extremes.get(quantity)).fold(none, Peak::higher)
    }
}

/// By how much a change from the next coarser grid is multiplied.
const SAFETY: f64 = 2.0;
/// Depth in spacings down to which the series converges slowly.
pub(super) const NEAR: f64 = 2.0;
/// The error of a stress under spots of n samples per radius is at least this over n of it near the surface, …
const SHALLOW: f64 = 0.2;
/// … and this over n² below: of τ₁ and of tensions.
const DEEP: [f64; 2] = [0.03, 0.1];
