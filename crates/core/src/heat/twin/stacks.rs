//! Heated stacks on which the fast and the slow twin are compared, and the measure of their difference.

use crate::body::Conduction;
use crate::body::{HalfSpace, Interface, Layer, Material};
use crate::heat::HeatedBody;
use rustfft::num_complex::Complex64;

/// Stacks of 0 to 3 layers with all kinds of interfaces, on elastic substrates and on rigid bases, with and without thermal resistances.
pub fn stacks() -> Vec<(HalfSpace, Vec<Conduction>, Vec<f64>)> {
    const SPRING: Interface = Interface::Spring { tangential: 0.7, normal: 3.0 };
    let layer = |young, poisson, thickness, interface| {
        Layer::new(Material::from_young(young, poisson).unwrap(), thickness, interface).unwrap()
    };
    let base = Material::from_young(1.0, 0.3).unwrap();
    let conduction = |[conductivity, diffusivity, expansion]: [f64; 3]| {
        Conduction::new(conductivity, diffusivity, expansion).unwrap()
    };
    let all = [[2.0, 0.8, 0.5], [0.1, 0.3, 3.0], [9.0, 2.0, 0.2], [1.0, 1.0, 1.0]].map(conduction);
    let (steel, last) = (all[3], [all[0], all[3]]);
    let (stiff, soft) = (layer(8.0, 0.2, 0.3, Interface::Bonded), layer(0.2, 0.45, 0.15, Interface::Frictionless));
    let sprung = layer(3.0, 0.1, 0.5, SPRING);
    let foil = layer(30.0, 0.2, 0.05, Interface::Bonded);
    vec![
        (HalfSpace::new(vec![], base), vec![steel], vec![]),
        (HalfSpace::new(vec![foil], base), last.to_vec(), vec![0.02]),
        (HalfSpace::new(vec![stiff], base), last.to_vec(), vec![0.0]),
        (HalfSpace::new(vec![soft], base), vec![all[1], steel], vec![0.4]),
        (HalfSpace::new(vec![sprung], base), last.to_vec(), vec![f64::INFINITY]),
        (HalfSpace::new(vec![sprung, soft], base), vec![all[2], all[1], steel], vec![20.0, 0.0]),
        (HalfSpace::new(vec![soft, stiff, sprung], base), all.to_vec(), vec![0.0, 0.7, 0.1]),
        (HalfSpace::on_rigid_base(vec![stiff]).unwrap(), vec![all[0]], vec![0.0]),
        (HalfSpace::on_rigid_base(vec![stiff, sprung]).unwrap(), vec![all[2], all[0]], vec![0.3, 2.0]),
        (HalfSpace::on_rigid_base(vec![sprung, soft]).unwrap(), vec![all[0], all[1]], vec![1.0, f64::INFINITY]),
    ]
}

/// Stacks at rest and under a moving source, each with a wavevector.
pub fn cases() -> Vec<(HeatedBody, [f64; 2])> {
    let waves = [([1.0, 0.0], 0.0), ([0.6, -0.8], 7.0), ([-2.5, 1.0], 12.0), ([0.2, 0.1], 3.0)];
    let of = |(half_space, conductions, resistances): (HalfSpace, Vec<_>, Vec<_>)| {
        waves.map(|(wavevector, velocity)| {
            let body = HeatedBody::new(half_space.clone(), conductions.clone(), resistances.clone(), velocity);
            (body.unwrap(), wavevector)
        })
    };
    stacks().into_iter().flat_map(of).collect()
}

/// Largest of Young's moduli in a body over the smallest.
pub fn contrast(body: &HeatedBody) -> f64 {
    let moduli = body.half_space().materials().map(|material| material.young());
    let [most, least] = moduli.fold([0.0, f64::INFINITY], |[most, least]: [f64; 2], of| [most.max(of), least.min(of)]);
    most / least
}

/// Largest error of numbers against the twin's, over the largest of those.
pub fn error(pairs: impl IntoIterator<Item = [Complex64; 2]>) -> f64 {
    let [error, scale] = pairs
        .into_iter()
        .fold([0.0f64; 2], |[error, scale], [found, twin]| [error.max((found - twin).norm()), scale.max(twin.norm())]);
    if scale > 0.0 { error / scale } else { error }
}
