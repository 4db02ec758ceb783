//! Isotropic elastic materials.
//!
//! E* = E/(1 − ν²) = 2G/(1 − ν); χ = G₁/G₂ = E₁(1 + ν₂)/(E₂(1 + ν₁)).

use super::{Conduction, Name, Relaxation};
use crate::notation::number;
use std::fmt;

/// Why a material or a layer cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MaterialError {
    /// Shear or Young's modulus not positive and finite.
    #[error("a modulus must be positive and finite, not {0}")]
    Modulus(f64),
    /// Poisson's ratio outside [0, 0.5].
    #[error("Poisson's ratio must lie between 0 and 0.5, not {0}")]
    Poisson(f64),
    /// Thickness not positive and finite.
    #[error("the thickness of a layer must be positive and finite, not {0}")]
    Thickness(f64),
    /// Strength not positive and finite.
    #[error("a strength must be positive and finite, not {0}")]
    Strength(f64),
    /// Friction of an interface negative or not finite.
    #[error("the friction of an interface must be finite and not negative, not {0}")]
    Friction(f64),
    /// Hardness not positive and finite.
    #[error("a hardness must be positive and finite, not {0}")]
    Hardness(f64),
    /// Coefficient of wear negative or not finite.
    #[error("a coefficient of wear must be finite and not negative, not {0}")]
    Wear(f64),
    /// Number of a law of fatigue not positive and finite.
    #[error("amplitude, passes and exponent of fatigue must be positive and finite, not {0}")]
    Fatigue(f64),
    /// Number of a law of life by strain not positive and finite.
    #[error("strain, passes and exponent of a life by strain must be positive and finite, not {0}")]
    StrainLife(f64),
    /// Endurance limit of bending too far above that of torsion.
    #[error(
        "an endurance limit of bending must be at most √3 = 1.73 times that of torsion, not {0:.3}: tension would do good"
    )]
    Endurance(f64),
    /// Residual stress not finite.
    #[error("a residual stress must be finite, not {0}")]
    Residual(f64),
    /// Nothing lies on a rigid base.
    #[error("a rigid base needs layers: without one nothing is elastic")]
    NoLayers,
    /// Interface stiffness not positive.
    #[error("the stiffness of an interface must be positive, not {0}")]
    Stiffness(f64),
}

/// An isotropic linear material, elastic or, with a relaxation, viscoelastic: then its moduli are the relaxed ones. With a name if it was given
/// one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    shear: f64,
    poisson: f64,
    relaxation: Option<Relaxation>,
    conduction: Option<Conduction>,
    name: Option<Name>,
}

impl Material {
    /// Material with the shear modulus `shear` (a pressure) and Poisson's ratio `poisson` in [0, 0.5].
    ///
    /// # Errors
    /// [`MaterialError`] for values out of range.
    pub fn from_shear(shear: f64, poisson: f64) -> Result<Self, MaterialError> {
        if !(shear.is_finite() && shear > 0.0) {
            return Err(MaterialError::Modulus(shear));
        }
        if !(0.0..=0.5).contains(&poisson) {
            return Err(MaterialError::Poisson(poisson));
        }
        Ok(Self { shear, poisson, relaxation: None, conduction: None, name: None })
    }

    /// Material with Young's modulus `young` (a pressure) and Poisson's ratio `poisson` in [0, 0.5].
    ///
    /// # Errors
    /// [`MaterialError`] for values out of range.
    pub fn from_young(young: f64, poisson: f64) -> Result<Self, MaterialError> {
        if !(young.is_finite() && young > 0.0) {
            return Err(MaterialError::Modulus(young));
        }
        Self::from_shear(young / (2.0 * (1.0 + poisson)), poisson)
    }

    /// Material with this name.
    pub fn with_name(self, name: Option<Name>) -> Self {
        Self { name, ..self }
    }

    /// Material whose shear modulus relaxes to its present one.
    #[must_use]
    pub fn with_relaxation(self, relaxation: Option<Relaxation>) -> Self {
        Self { relaxation, ..self }
    }

    /// Relaxation of the shear modulus; `None` of an elastic material.
    pub fn relaxation(&self) -> Option<Relaxation> {
        self.relaxation
    }

    /// Material that conducts heat and expands.
    #[must_use]
    pub fn with_conduction(self, conduction: Option<Conduction>) -> Self {
        Self { conduction, ..self }
    }

    /// Conduction of heat; `None` where it is not known.
    pub fn conduction(&self) -> Option<Conduction> {
        self.conduction
    }

    /// Name of the material; `None` where it was given none.
    pub fn name(&self) -> Option<Name> {
        self.name
    }

    /// Name of the material in parentheses with a space before; empty where it was given none.
    pub fn name_behind(&self) -> String {
        self.name.map_or(String::new(), |name| format!(" ({name})"))
    }

    /// Shear modulus G, a pressure.
    pub fn shear(&self) -> f64 {
        self.shear
    }

    /// Poisson's ratio ν.
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// Young's modulus E = 2G(1 + ν), a pressure.
    pub fn young(&self) -> f64 {
        2.0 * self.shear * (1.0 + self.poisson)
    }

    /// Compliance without lateral strain, 1/M = (1 − 2ν)/(2G(1 − ν)) with the oedometric modulus M; one over a pressure. Zero
    /// for an incompressible material.
    pub fn oedometric_compliance(&self) -> f64 {
        (1.0 - 2.0 * self.poisson) / (2.0 * self.shear * (1.0 - self.poisson))
    }

    /// Contact modulus E* = 2G/(1 − ν), a pressure.
    pub fn contact_modulus(&self) -> f64 {
        2.0 * self.shear / (1.0 - self.poisson)
    }
}

impl fmt::Display for Material {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [young, shear, contact] = [self.young(), self.shear, self.contact_modulus()].map(number);
        // ν as it was given, without what rounding has left between the ends of a graded layer.
        let poisson = (1e9 * self.poisson).round() / 1e9;
        write!(f, "E {young}, ν {poisson}, G {shear}, E* {contact}")?;
        self.relaxation.iter().try_for_each(|relaxation| write!(f, ", {relaxation}"))?;
        self.conduction.iter().try_for_each(|conduction| write!(f, ", {conduction}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moduli_agree_with_each_other() {
        let steel = Material::from_young(210e9, 0.3).unwrap();
        assert!((steel.young() / 210e9 - 1.0).abs() < 1e-15);
        assert!((steel.contact_modulus() / (210e9 / 0.91) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(Material::from_young(-1.0, 0.3), Err(MaterialError::Modulus(-1.0)));
        assert_eq!(Material::from_young(1.0, 0.51), Err(MaterialError::Poisson(0.51)));
    }
}
