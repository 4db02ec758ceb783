//! Where coating and substrate are stressed most: the largest principal shear stress τ₁, the largest tension σ₁ and the
//! largest stress of von Mises in each material and on each of its faces, and the largest tension and shear that each
//! interface carries.
//!
//! They are searched plane by plane and refined; on the surface itself, where the series converges slowly, the largest
//! tension is that of the [`Crest`], and under a counterbody that slides τ₁ and von Mises too.

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
    /// Largest stress of von Mises.
    #[cfg_attr(feature = "serde", serde(rename = "max_mises"))]
    pub mises: Peak,
}

/// What an interface carries at most.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Carried {
    /// The interface, from 1: the lower face of that layer.
    pub interface: usize,
    /// Largest σ_zz; negative where nothing opens it.
    #[cfg_attr(feature = "serde", serde(rename = "max_normal"))]
    pub normal: Peak,
    /// Largest shear √(σ_xz² + σ_yz²).
    #[cfg_attr(feature = "serde", serde(rename = "max_shear"))]
    pub shear: Peak,
    /// Largest part that it bears of what it can, where a strength is given; the value is no pressure but a number.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub delamination: Option<Peak>,
}

/// All maxima of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Maxima {
    /// Over each material, faces included, from the surface down.
    pub materials: Vec<Extremes>,
    /// Over each face: the surface, then both sides of each interface.
    pub faces: Vec<Extremes>,
    /// What each interface carries, from the surface down.
    pub interfaces: Vec<Carried>,
    /// The largest tension on the surface with its uncertainty; `None` where contact has no edge.
    pub crest: Option<Crest>,
    /// The same of τ₁ and von Mises under a counterbody that slides.
    pub(super) others: [Option<Crest>; 2],
    /// Samples along the radius of a disc as large as the smallest contact spot.
    pub resolution: f64,
    /// Distance between neighbouring samples, a length.
    pub spacing: f64,
}

impl Extremes {
    fn each(&mut self) -> [(Quantity, &mut Peak); 3] {
        let Self { tau1, tension, mises } = self;
        [(Quantity::Tau1, tau1), (Quantity::Tension, tension), (Quantity::Mises, mises)]
    }
}

impl Maxima {
    /// Estimated relative error of the largest tension on the surface, also from the next `coarser` grid where there is
    /// one; 0 where contact has no edge.
    pub fn surface_error(&self, coarser: Option<&Self>) -> f64 {
        // Where the coarser grid sees no edge, its largest tension is that of a sample.
        let tension = coarser.and_then(|coarser| coarser.faces.first()).map(|surface| surface.tension.value);
        self.crest.map_or(0.0, |crest| crest.error(tension))
    }

    /// The same with the estimated error of each: twice the change from the next `coarser`
    /// grid, which at second order is three times the error, and what n samples along the radius of the smallest spot
    /// leave open: 0.03 n⁻² of τ₁, von Mises and shears, 0.1 n⁻² of a tension or the usual one, within two samples of the
    /// surface 0.2 n⁻¹.
    /// For a stress on the surface that is that of its [`Crest`], what that says of itself. Read off fifty random contacts;
    /// that those of the largest τ₁ and the largest tension hold in 95 % of fifty others is tested.
    #[must_use]
    pub fn with_errors(mut self, coarser: &Self) -> Self {
        let [crest, resolution, near] =
            [self.crest.map_or(0.0, |crest| crest.scale), self.resolution, NEAR * self.spacing];
        let crests =
            [(Quantity::Tension, self.crest), (Quantity::Tau1, self.others[0]), (Quantity::Mises, self.others[1])];
        let estimate = |quantity: Quantity, fine: &mut Peak, coarse: &Peak| {
            let own =
                crests.iter().find(|(of, crest)| *of == quantity && crest.is_some_and(|crest| crest.peak == *fine));
            if let Some((_, Some(crest))) = own {
                fine.error = Some(crest.scale * crest.error(Some(coarse.value)));
                return;
            }
            let (deep, least) = match quantity {
                Quantity::Tension | Quantity::Opening => (DEEP[1], crest),
                _ => (DEEP[0], 0.0),
            };
            let open = if fine.position[2] < near { SHALLOW / resolution } else { deep / resolution.powi(2) };
            // Beside a strength the usual tension is no measure.
            let least = if matches!(quantity, Quantity::Delamination(_)) { 0.0 } else { least };
            fine.error = Some(SAFETY * (fine.value - coarse.value).abs() + open * least.max(fine.value.abs()));
        };
        for (fine, coarse) in [(&mut self.materials, &coarser.materials), (&mut self.faces, &coarser.faces)] {
            for (fine, coarse) in fine.iter_mut().zip(coarse) {
                let mut coarse = *coarse;
                for ((quantity, fine), (_, coarse)) in fine.each().into_iter().zip(coarse.each()) {
                    estimate(quantity, fine, coarse);
                }
            }
        }
        for (fine, coarse) in self.interfaces.iter_mut().zip(&coarser.interfaces) {
            estimate(Quantity::Opening, &mut fine.normal, &coarse.normal);
            estimate(Quantity::Shear, &mut fine.shear, &coarse.shear);
            if let Some((fine, coarse)) = fine.delamination.as_mut().zip(coarse.delamination.as_ref()) {
                estimate(Quantity::Delamination(Default::default()), fine, coarse);
            }
        }
        self
    }
}

/// By how much a change from the next coarser grid is multiplied.
const SAFETY: f64 = 2.0;
/// Depth in spacings down to which the series converges slowly.
pub(super) const NEAR: f64 = 2.0;
/// The error of a stress under spots of n samples per radius is at least this over n of it near the surface, …
const SHALLOW: f64 = 0.2;
/// … and this over n² below: of shears and of tensions.
const DEEP: [f64; 2] = [0.03, 0.1];
