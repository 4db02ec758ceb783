//! Isotropic elastic materials, coating layers and the half-space they form.
//!
//! E* = E/(1 − ν²) = 2G/(1 − ν); χ = G₁/G₂ = E₁(1 + ν₂)/(E₂(1 + ν₁)).

use crate::number::number;
use std::fmt;
use std::ops::RangeInclusive;

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
    /// Interface stiffness not positive.
    #[error("the stiffness of an interface must be positive, not {0}")]
    Stiffness(f64),
}

/// An isotropic linear elastic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    shear: f64,
    poisson: f64,
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
        Ok(Self { shear, poisson })
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

    /// Contact modulus E* = 2G/(1 − ν), a pressure.
    pub fn contact_modulus(&self) -> f64 {
        2.0 * self.shear / (1.0 - self.poisson)
    }
}

impl fmt::Display for Material {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [young, shear, contact] = [self.young(), self.shear, self.contact_modulus()].map(number);
        write!(f, "E {young}, ν {}, G {shear}, E* {contact}", self.poisson)
    }
}

/// How the lower face of a layer holds to what lies below it. Interfaces never open: tension is carried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Interface {
    /// Perfect adhesion, Eq. (3): tractions and displacements continuous.
    Bonded,
    /// Complete sliding: no shear traction, normal displacement continuous.
    Frictionless,
    /// Incomplete sliding: the displacements jump by σ_qz/k_t and p/k_n. `f64::INFINITY` is rigid.
    Spring {
        /// Tangential stiffness k_t, a pressure per length.
        tangential: f64,
        /// Normal stiffness k_n, a pressure per length.
        normal: f64,
    },
}

impl fmt::Display for Interface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bonded => write!(f, "bonded"),
            Self::Frictionless => write!(f, "frictionless"),
            Self::Spring { tangential, normal } => {
                let [tangential, normal] = [*tangential, *normal].map(number);
                write!(f, "spring, tangential stiffness {tangential}, normal stiffness {normal}")
            }
        }
    }
}

/// One layer of a coating.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    material: Material,
    thickness: f64,
    interface: Interface,
}

impl Layer {
    /// Layer of the given thickness (a length) with the given lower interface.
    ///
    /// # Errors
    /// [`MaterialError`] for a thickness or a stiffness that is not positive.
    pub fn new(material: Material, thickness: f64, interface: Interface) -> Result<Self, MaterialError> {
        if !(thickness.is_finite() && thickness > 0.0) {
            return Err(MaterialError::Thickness(thickness));
        }
        if let Interface::Spring { tangential, normal } = interface {
            for stiffness in [tangential, normal] {
                if stiffness.is_nan() || stiffness <= 0.0 {
                    return Err(MaterialError::Stiffness(stiffness));
                }
            }
        }
        Ok(Self { material, thickness, interface })
    }

    /// Material of the layer.
    pub fn material(&self) -> Material {
        self.material
    }

    /// Thickness h, a length.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Interface at the layer's lower face.
    pub fn interface(&self) -> Interface {
        self.interface
    }
}

/// A coated elastic half-space: layers from the surface down, then the substrate.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfSpace {
    layers: Vec<Layer>,
    substrate: Material,
}

impl HalfSpace {
    /// Half-space of `substrate` under `layers`, given from the surface down (none: uncoated).
    pub fn new(layers: Vec<Layer>, substrate: Material) -> Self {
        Self { layers, substrate }
    }

    /// Layers from the surface down.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Material of the substrate.
    pub fn substrate(&self) -> Material {
        self.substrate
    }

    /// Material at the surface: that of the first layer, or the substrate's.
    pub fn surface_material(&self) -> Material {
        self.layers.first().map_or(self.substrate, Layer::material)
    }

    /// Depths of the interfaces from the surface down, lengths.
    pub fn interface_depths(&self) -> Vec<f64> {
        self.layers
            .iter()
            .scan(0.0, |depth, layer| {
                *depth += layer.thickness;
                Some(*depth)
            })
            .collect()
    }
}

impl HalfSpace {
    /// Materials (from 1; the substrate is layers + 1) that the depth z ≥ 0 belongs to: on an interface, to rounding,
    /// both.
    pub fn sides(&self, z: f64) -> RangeInclusive<usize> {
        let faces = self.interface_depths();
        let tolerance = 1e-12;
        let above = faces.iter().filter(|&&face| face * (1.0 + tolerance) < z).count();
        let below = faces.iter().filter(|&&face| face * (1.0 - tolerance) <= z).count();
        above + 1..=below + 1
    }
}

impl fmt::Display for HalfSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, layer) in (1..).zip(&self.layers) {
            writeln!(
                f,
                "layer {index}: thickness {}, χ {}, {}, {}",
                number(layer.thickness),
                number(layer.material.shear / self.substrate.shear),
                layer.material,
                layer.interface
            )?;
        }
        write!(f, "substrate: {}", self.substrate)
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
    fn a_depth_on_an_interface_has_two_sides_whatever_the_rounding() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        let layers = [0.1, 0.2].map(|h| Layer::new(material, h, Interface::Bonded).unwrap());
        let half_space = HalfSpace::new(layers.to_vec(), material);
        let sides = [0.0, 0.1, 0.2, 0.3, 0.1 + 0.2, 5.0].map(|z| half_space.sides(z));
        assert_eq!(sides, [1..=1, 1..=2, 2..=2, 2..=3, 2..=3, 3..=3]);
    }

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(Material::from_young(-1.0, 0.3), Err(MaterialError::Modulus(-1.0)));
        assert_eq!(Material::from_young(1.0, 0.51), Err(MaterialError::Poisson(0.51)));
        let material = Material::from_shear(1.0, 0.5).unwrap();
        assert!(Layer::new(material, 0.0, Interface::Bonded).is_err());
        let interface = Interface::Spring { tangential: 0.0, normal: f64::INFINITY };
        assert_eq!(Layer::new(material, 1.0, interface), Err(MaterialError::Stiffness(0.0)));
    }
}
