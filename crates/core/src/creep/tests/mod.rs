//! Slow twins, and bodies to compare with.

mod contact;
mod stacks;

use crate::body::{ConstantModulus, Interface, Layer, Material, Relaxation};

pub const SPRING: Interface = Interface::Spring { tangential: 0.3, normal: 40.0 };

pub fn material(shear: f64, poisson: f64) -> Material {
    Material::from_shear(shear, poisson).unwrap()
}

pub fn layer(material: Material, thickness: f64, interface: Interface) -> Layer {
    Layer::new(material, thickness, interface).unwrap()
}

/// A material with one term τ = 1 by which its shear modulus relaxes to its present one from `ratio` times that.
pub fn one(material: Material, ratio: f64, constant: ConstantModulus) -> Material {
    let relaxation = Relaxation::new(&[material.shear() * (ratio - 1.0)], &[1.0]).unwrap();
    material.with_relaxation(Some(relaxation.with_constant(constant)))
}
