//! Slow twins, and bodies to compare with.

mod contact;
mod stacks;

use super::{Constant, Relaxation};
use crate::body::{Interface, Layer, Material};

pub const SPRING: Interface = Interface::Spring { tangential: 0.3, normal: 40.0 };

pub fn material(shear: f64, poisson: f64) -> Material {
    Material::from_shear(shear, poisson).unwrap()
}

pub fn layer(shear: f64, poisson: f64, thickness: f64, interface: Interface) -> Layer {
    Layer::new(material(shear, poisson), thickness, interface).unwrap()
}

/// One term τ = 1 by which a shear modulus relaxes to `relaxed` from `ratio` times that.
pub fn one(relaxed: f64, ratio: f64, constant: Constant) -> Relaxation {
    Relaxation { terms: vec![[relaxed * (ratio - 1.0), 1.0]], constant }
}
