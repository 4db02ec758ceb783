//! The layered body that a heat source moves over.

use crate::body::{Conduction, HalfSpace, Layer};
use crate::notation::number;
use std::fmt;

/// Why a heated body cannot be built from its values.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum HeatError {
    /// Resistance of an interface negative or not a number.
    #[error("the thermal resistance of an interface must not be negative (infinite: it insulates), not {0}")]
    Resistance(f64),
    /// Velocity of the source not finite.
    #[error("the velocity of a heat source must be finite, not {0}")]
    Velocity(f64),
    /// Another number of conducting materials than the body has.
    #[error("heat needs the conduction of each of the {needed} materials of the body, not of {given}")]
    Materials {
        /// Materials of which the conduction is given.
        given: usize,
        /// Materials of the body.
        needed: usize,
    },
    /// Another number of thermal resistances than the body has interfaces.
    #[error("heat needs the resistance of each of the {needed} interfaces of the body, not of {given}")]
    Interfaces {
        /// Interfaces of which the resistance is given.
        given: usize,
        /// Interfaces of the body.
        needed: usize,
    },
}

/// A layered half-space with the conduction of its materials, the thermal resistances of its interfaces, and the velocity of the heat
/// source over it.
///
/// Temperatures count from that of the body far below, its bulk temperature. A rigid base is held at the bulk temperature: it conducts all
/// heat that reaches it.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatedBody {
    half_space: HalfSpace,
    conductions: Vec<Conduction>,
    resistances: Vec<f64>,
    velocity: f64,
}

impl HeatedBody {
    /// Heated body of a half-space with one conduction per material, from the surface down, one thermal resistance ≥ 0 per layer, of its
    /// lower face (a temperature per power and area; infinite: the interface insulates), and the velocity v of the heat source over the
    /// body along +x (a length per time; 0 for a body that rests in the frame of the source).
    ///
    /// # Errors
    /// [`HeatError`] for a value out of range, and for another number of materials or interfaces.
    pub fn new(
        half_space: HalfSpace,
        conductions: Vec<Conduction>,
        resistances: Vec<f64>,
        velocity: f64,
    ) -> Result<Self, HeatError> {
        let (given, needed) = (conductions.len(), half_space.material_count());
        if given != needed {
            return Err(HeatError::Materials { given, needed });
        }
        let (given, needed) = (resistances.len(), half_space.layers().len());
        if given != needed {
            return Err(HeatError::Interfaces { given, needed });
        }
        if let Some(&resistance) = resistances.iter().find(|resistance| resistance.is_nan() || **resistance < 0.0) {
            return Err(HeatError::Resistance(resistance));
        }
        if !velocity.is_finite() {
            return Err(HeatError::Velocity(velocity));
        }
        Ok(Self { half_space, conductions, resistances, velocity })
    }

    /// Heated body of a half-space, with the conductions of its materials and the resistances of its interfaces, below a source of this
    /// velocity; `None` where a material has no conduction.
    pub fn of(half_space: &HalfSpace, velocity: f64) -> Option<Self> {
        let conductions = half_space.materials().map(|material| material.conduction()).collect::<Option<Vec<_>>>()?;
        let resistances = half_space.layers().iter().map(Layer::thermal_resistance).collect();
        Self::new(half_space.clone(), conductions, resistances, velocity).ok()
    }

    /// Layered half-space, of relaxed moduli.
    pub fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// Conductions of all materials, from the surface down.
    pub fn conductions(&self) -> &[Conduction] {
        &self.conductions
    }

    /// Thermal resistances of the lower faces of all layers, from the surface down, temperatures per power and area.
    pub fn resistances(&self) -> &[f64] {
        &self.resistances
    }

    /// Velocity v of the heat source over the body along +x, a length per time.
    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Whether any of its materials expands.
    pub fn expands(&self) -> bool {
        self.conductions.iter().any(|conduction| conduction.expansion() > 0.0)
    }

    /// Stress σ_xx = σ_yy = −EαT/(1−ν) of a material, from 1 at the surface down, that is warmer by a uniform `rise` T than it was when free
    /// of stress, and is held laterally; a pressure, positive in tension. This is the part k = 0 of the thermal stress.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn confined_stress(&self, material: usize, rise: f64) -> f64 {
        let elastic = self.half_space.material(material);
        -elastic.young() * self.conductions[material - 1].expansion() * rise / (1.0 - elastic.poisson())
    }
}

impl fmt::Display for HeatedBody {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (material, conduction) in (1..).zip(&self.conductions) {
            write!(f, "material {material}: {conduction}")?;
            match self.resistances.get(material - 1) {
                Some(&resistance) => writeln!(f, ", resistance below {}", number(resistance))?,
                None => writeln!(f)?,
            }
        }
        write!(f, "heat source: velocity {}", number(self.velocity))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, Layer, Material};

    #[test]
    fn each_material_and_each_interface_has_its_value() {
        let steel = Material::from_young(210e9, 0.3).unwrap();
        let half_space = HalfSpace::new(vec![Layer::new(steel, 1e-6, Interface::Bonded).unwrap()], steel);
        let conduction = Conduction::new(50.0, 1.4e-5, 12e-6).unwrap();
        let body = |materials: usize, resistances: &[f64], velocity: f64| {
            HeatedBody::new(half_space.clone(), vec![conduction; materials], resistances.to_vec(), velocity)
        };
        assert_eq!(body(1, &[0.0], 1.0), Err(HeatError::Materials { given: 1, needed: 2 }));
        assert_eq!(body(2, &[], 1.0), Err(HeatError::Interfaces { given: 0, needed: 1 }));
        assert_eq!(body(2, &[-1.0], 1.0), Err(HeatError::Resistance(-1.0)));
        assert_eq!(body(2, &[0.0], f64::INFINITY), Err(HeatError::Velocity(f64::INFINITY)));
        // Eα/(1−ν) = 3.6 MPa/K of steel.
        let stress = body(2, &[f64::INFINITY], 1.0).unwrap().confined_stress(1, 100.0);
        assert!((stress / -360e6 - 1.0).abs() < 1e-15);
    }
}
