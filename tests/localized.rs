//! The localized method: its kernels, its contacts and what its circles leave out.

mod common;
#[path = "localized/contact.rs"]
mod contact;
#[path = "localized/exterior.rs"]
mod exterior;
#[path = "localized/kernel.rs"]
mod kernel;
#[path = "localized/stress.rs"]
mod stress;

use percoat::localized::{CircleRadius, Setup};
use percoat::{HalfSpace, Interface, Layer, Material};

/// A hard film on a soft interlayer on which it slides.
fn two_layers() -> HalfSpace {
    let substrate = Material::from_young(1.0, 0.3).unwrap();
    let layer = |shear, nu, h, interface| Layer::new(Material::from_shear(shear, nu).unwrap(), h, interface).unwrap();
    HalfSpace::new(
        vec![layer(1.2, 0.2, 0.3, Interface::Bonded), layer(0.2, 0.4, 0.4, Interface::Frictionless)],
        substrate,
    )
}

/// Uncoated half-space with E* = 1.
fn homogeneous() -> HalfSpace {
    HalfSpace::new(vec![], Material::from_young(1.0, 0.0).unwrap())
}

fn setup(indenters: usize, elements: usize) -> Setup {
    Setup { indenters, elements, rule: CircleRadius::LoadBalanced, mutual_effect: true }
}

fn alone(elements: usize) -> Setup {
    Setup { mutual_effect: false, ..setup(1, elements) }
}
