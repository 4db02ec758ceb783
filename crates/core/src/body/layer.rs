//! One layer of a coating, and how it is joined to what lies below it.

use super::{ConductionError, Durability, Fatigue, InterfaceStrength, Material, MaterialError, Strength};
use crate::notation::number;
use crate::numeric::number::Number;
use std::fmt;

/// Kind of the interface below a layer. Interfaces never open: tension is carried.
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

impl Interface {
    /// Jumps of displacement that a unit of tangential and of normal traction makes, in the units of the layer above:
    /// Gq/k_t and Gq/k_n for its shear modulus times the wavenumber, `stiffness`; zero unless it is a spring.
    pub(super) fn jumps<N: Number>(self, stiffness: N) -> [N; 2] {
        match self {
            Self::Spring { tangential, normal } => [stiffness / tangential, stiffness / normal],
            Self::Bonded | Self::Frictionless => [N::from(0.0); 2],
        }
    }
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
    residual: f64,
    strength: Strength,
    interface_strength: InterfaceStrength,
    durability: Durability,
    interface_fatigue: Option<Fatigue>,
    thermal_resistance: f64,
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
        Ok(Self {
            material,
            thickness,
            interface,
            residual: 0.0,
            strength: Strength::default(),
            interface_strength: InterfaceStrength::default(),
            durability: Durability::default(),
            interface_fatigue: None,
            thermal_resistance: 0.0,
        })
    }

    /// Layer with an equi-biaxial residual stress σ_r, a pressure, positive in tension: deposited with the layer, it adds to
    /// σ_xx and σ_yy everywhere in it and does not change the contact.
    ///
    /// # Errors
    /// [`MaterialError::Residual`] for a stress that is not finite.
    pub fn with_residual_stress(self, residual: f64) -> Result<Self, MaterialError> {
        if residual.is_finite() { Ok(Self { residual, ..self }) } else { Err(MaterialError::Residual(residual)) }
    }

    /// Layer with strengths of its material and its lower interface.
    ///
    /// # Errors
    /// [`MaterialError::Strength`] for one that is not positive.
    pub fn with_strengths(self, strength: Strength, interface: InterfaceStrength) -> Result<Self, MaterialError> {
        Ok(Self { strength: strength.check()?, interface_strength: interface.check()?, ..self })
    }

    /// Layer with the durability of its material, and with the fatigue of its lower interface by the range of the shear that it transmits.
    ///
    /// # Errors
    /// [`MaterialError`] for a hardness that is not positive, and for a coefficient of wear below zero.
    pub fn with_durability(self, durability: Durability, interface: Option<Fatigue>) -> Result<Self, MaterialError> {
        Ok(Self { durability: durability.check()?, interface_fatigue: interface, ..self })
    }

    /// Layer with a thermal resistance of its lower interface, a temperature per power and area; infinite: the interface insulates.
    ///
    /// # Errors
    /// [`ConductionError::Resistance`] for one below zero.
    pub fn with_thermal_resistance(self, resistance: f64) -> Result<Self, ConductionError> {
        if resistance >= 0.0 {
            Ok(Self { thermal_resistance: resistance, ..self })
        } else {
            Err(ConductionError::Resistance(resistance))
        }
    }

    /// Thermal resistance of its lower interface, a temperature per power and area.
    pub fn thermal_resistance(&self) -> f64 {
        self.thermal_resistance
    }

    /// Durability of its material.
    pub fn durability(&self) -> Durability {
        self.durability
    }

    /// Fatigue of its lower interface.
    pub fn interface_fatigue(&self) -> Option<Fatigue> {
        self.interface_fatigue
    }

    /// The layer with another hardness, a pressure, or without one.
    pub(super) fn of_hardness(&self, hardness: Option<f64>) -> Self {
        Self { durability: Durability { hardness, ..self.durability }, ..*self }
    }

    /// The layer with another thickness, a length above zero.
    pub(super) fn thinned(&self, thickness: f64) -> Self {
        Self { thickness, ..*self }
    }

    /// Strengths of its material.
    pub fn strength(&self) -> Strength {
        self.strength
    }

    /// Strengths of its lower interface.
    pub fn interface_strength(&self) -> InterfaceStrength {
        self.interface_strength
    }

    /// Equi-biaxial residual stress σ_r, a pressure, positive in tension.
    pub fn residual_stress(&self) -> f64 {
        self.residual
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_out_of_range_are_refused() {
        let material = Material::from_shear(1.0, 0.5).unwrap();
        assert!(Layer::new(material, 0.0, Interface::Bonded).is_err());
        let interface = Interface::Spring { tangential: 0.0, normal: f64::INFINITY };
        assert_eq!(Layer::new(material, 1.0, interface), Err(MaterialError::Stiffness(0.0)));
    }
}
