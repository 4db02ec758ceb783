//! Hardness of a thin coating together with its substrate.
//!
//! An indentation that is deep beside the coating meets the substrate. With the hardness H_c of the coating, H_s of the substrate, the
//! thickness t and the depth δ of the indentation
//!
//! H = H_s + φ (H_c − H_s),
//!
//! by the **area law** φ = 2C t/δ − (C t/δ)², 1 up to δ = C t: the part of the area that the coating bears. C is about 1 for a coating that
//! deforms with the substrate and 0.5 for a hard one that cracks (B. Jönsson, S. Hogmark, Thin Solid Films 114 (1984) 257–269). By
//! **Korsunsky** φ = 1/(1 + k (δ/t)²), with a k that is fitted to measured hardness (A. M. Korsunsky et al., Surf. Coat. Technol. 99 (1998)
//! 171–183). Both come from pyramids under a load; here δ is the penetration of the counterbody.

use super::HalfSpace;
use serde::Serialize;
use std::fmt;

/// Law by which the hardness of a coating goes over to that of its substrate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum HardnessLaw {
    /// Law of the area that the coating bears, by Jönsson and Hogmark.
    Area,
    /// Law of the work of indentation, by Korsunsky and others.
    Korsunsky,
}

/// Hardness of a coating and its substrate together, over the depth of an indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompositeHardness {
    law: HardnessLaw,
    constant: f64,
    /// Hardness of the coating and of the substrate, pressures.
    hardness: [f64; 2],
    /// Thickness of the coating, a length.
    thickness: f64,
}

/// Why a body has no composite hardness.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CompositeError {
    /// The body has no layer, or several.
    #[error("the laws are those of one layer on a substrate, and the body has {0} layers")]
    Layers(usize),
    /// A hardness is not given.
    #[error("no hardness of the {0} is given")]
    Unknown(&'static str),
    /// A constant that is not positive.
    #[error("the constant of a law must be positive and finite, not {0}")]
    Constant(f64),
    /// The counterbody may yield before the coating or its substrate.
    #[error("the counterbody, of hardness {0}, is softer than the coating or its substrate and may yield first")]
    Counterbody(f64),
}

impl CompositeHardness {
    /// The hardness of the only layer of a body and its substrate by a law with its `constant`, C or k.
    ///
    /// # Errors
    /// [`CompositeError`] unless there is one layer, both have a hardness, and the constant is positive.
    pub fn of(body: &HalfSpace, law: HardnessLaw, constant: f64) -> Result<Self, CompositeError> {
        let [layer] = body.layers() else { return Err(CompositeError::Layers(body.layers().len())) };
        if !(constant > 0.0 && constant.is_finite()) {
            return Err(CompositeError::Constant(constant));
        }
        let coating = body.surface_durability().hardness.ok_or(CompositeError::Unknown("layer"))?;
        let substrate = body
            .durabilities()
            .nth(1)
            .and_then(|durability| durability.hardness)
            .ok_or(CompositeError::Unknown("substrate"))?;
        Ok(Self { law, constant, hardness: [coating, substrate], thickness: layer.thickness() })
    }

    /// The hardness that an indentation of a depth meets, a pressure.
    pub fn at(&self, depth: f64) -> f64 {
        let (relative, [coating, substrate]) = ((depth / self.thickness).max(0.0), self.hardness);
        let part = match self.law {
            HardnessLaw::Area => {
                let ratio = self.constant / relative.max(self.constant);
                ratio * (2.0 - ratio)
            }
            HardnessLaw::Korsunsky => 1.0 / (1.0 + self.constant * relative * relative),
        };
        substrate + part * (coating - substrate)
    }

    /// The largest hardness at any depth, a pressure.
    pub fn largest(&self) -> f64 {
        self.at(self.hardest_depth())
    }

    /// Error of the hardness at a depth that has an error, a pressure.
    pub fn error(&self, depth: f64, error: f64) -> f64 {
        [-error, error].map(|by| (self.at(depth + by) - self.at(depth)).abs()).into_iter().fold(0.0, f64::max)
    }

    /// The depth, a length, of the largest hardness: zero, or without end on a harder substrate.
    pub(crate) fn hardest_depth(&self) -> f64 {
        let [coating, substrate] = self.hardness;
        if coating < substrate { f64::INFINITY } else { 0.0 }
    }
}

impl fmt::Display for CompositeHardness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.law {
            HardnessLaw::Area => {
                write!(f, "composite hardness by the area law (Jönsson and Hogmark 1984), C = {}", self.constant)
            }
            HardnessLaw::Korsunsky => {
                write!(f, "composite hardness by Korsunsky and others (1998), k = {}", self.constant)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Durability, Interface, Layer, Material};

    fn hard(hardness: f64) -> Durability {
        Durability { hardness: Some(hardness), ..Durability::default() }
    }

    fn coated(count: usize) -> HalfSpace {
        let material = Material::from_young(1.0, 0.3).unwrap();
        let layer = Layer::new(material, 0.5, Interface::Bonded).unwrap().with_durability(hard(20.0), None).unwrap();
        HalfSpace::new(vec![layer; count], material).with_substrate_durability(hard(4.0)).unwrap()
    }

    /// Worked by hand: δ = 2t and C = 0.5 leave φ = 2·0.25 − 0.0625 = 0.4375; k = 0.25 leaves φ = 1/(1 + 0.25·4) = 0.5.
    #[test]
    fn the_laws_have_their_values() {
        let area = CompositeHardness::of(&coated(1), HardnessLaw::Area, 0.5).unwrap();
        assert_eq!([0.0, 0.25, 1.0].map(|depth| area.at(depth)), [20.0, 20.0, 4.0 + 0.4375 * 16.0]);
        let korsunsky = CompositeHardness::of(&coated(1), HardnessLaw::Korsunsky, 0.25).unwrap();
        assert_eq!([0.0, 1.0].map(|depth| korsunsky.at(depth)), [20.0, 12.0]);
        assert!((korsunsky.at(1e9) - 4.0).abs() < 1e-12 && (area.at(1e9) - 4.0).abs() < 1e-6);
        // The law is steeper towards the surface: at 0.75 φ = 1/(1 + 0.25·2.25) = 0.64.
        assert!((korsunsky.error(1.0, 0.25) - (4.0 + 0.64 * 16.0 - 12.0)).abs() < 1e-12);
        assert!(area.to_string().contains("C = 0.5"));
    }

    #[test]
    fn one_layer_with_both_hardnesses_is_needed() {
        let of = |body: &HalfSpace, constant: f64| CompositeHardness::of(body, HardnessLaw::Area, constant);
        assert_eq!(of(&coated(0), 1.0), Err(CompositeError::Layers(0)));
        assert_eq!(of(&coated(2), 1.0), Err(CompositeError::Layers(2)));
        assert_eq!(of(&coated(1).without_hardness(), 1.0), Err(CompositeError::Unknown("layer")));
        assert_eq!(of(&coated(1), 0.0), Err(CompositeError::Constant(0.0)));
    }
}
