//! The two moduli of an isotropic material as numbers of any kind.
//!
//! Under a load e^{iωt} a viscoelastic material is an elastic one of the complex moduli G(iω) and ν(iω) (correspondence principle):
//! G = G′ + iG″ with the storage modulus G′ and the loss modulus G″ ≥ 0. With a real bulk modulus K, ν = (3K − 2G)/(6K + 2G).

use super::Material;
use crate::numeric::number::Number;

/// Moduli of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moduli<N = f64> {
    /// Shear modulus G, a pressure.
    pub shear: N,
    /// Poisson's ratio ν.
    pub poisson: N,
}

impl<N: Number> From<Material> for Moduli<N> {
    fn from(material: Material) -> Self {
        Self { shear: material.shear().into(), poisson: material.poisson().into() }
    }
}
