//! Stresses and displacements by heat at any depth of a layered body with a free surface.
//!
//! In each material the stress function is the sum of that of Goodier's potential and of a solution of (D² − 1)²F = 0, x = kz, which has
//! four numbers in a layer and two in the substrate (`expanding_material`). They follow from what holds at the free surface and at the
//! interfaces (`conditions`). At rest a homogeneous body has no stress in the plane of **k** and z.
//!
//! The wave **k** = 0, a uniform rise of temperature in each material, is [`HeatedBody::confined_stress`].

use super::HeatedBody;
use super::conditions::Conditions;
use super::expanding_material::ExpandingMaterial;
use super::temperature_wave::TemperatureWave;
use crate::body::{Amplitudes, Depth, Moduli};
use rustfft::num_complex::Complex64;

/// Thermal stress in a layered body for one wave of the flux into its surface.
///
/// **Phase.** Under the flux q̂e^{ikξ}, ξ along **k**, with the complex [`Amplitudes`] over q̂,
///
/// (σ_zz, σ_qq, σ_tt, u_z) = (szz, sqq, stt, uz) q̂e^{ikξ},  (σ_qz, u_q) = −i (sqz, uq) q̂e^{ikξ}:
///
/// where the amplitudes are real and the flux is cos kξ, the former are of cos kξ and the latter of sin kξ, as under a pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct ThermalStress {
    temperature: TemperatureWave,
    materials: Vec<ExpandingMaterial>,
    /// Four numbers of the stress function of each material without Goodier's part; c = d = 0 in the substrate.
    coefficients: Vec<[Complex64; 4]>,
}

impl HeatedBody {
    /// Stresses and displacements by a flux of the wavevector **k** ≠ 0 (1/length) at all depths.
    pub fn thermal_stress(&self, wavevector: [f64; 2]) -> ThermalStress {
        let temperature = self.temperature_wave(wavevector);
        let materials: Vec<_> = std::iter::zip(temperature.materials(), self.conductions())
            .zip(self.half_space().materials())
            .map(|((&heat, conduction), material)| {
                let elastic: Moduli = material.into();
                let stiffness = 2.0 * elastic.shear * (1.0 + elastic.poisson) / (1.0 - elastic.poisson);
                ExpandingMaterial { heat, elastic, modulus: stiffness * conduction.expansion() }
            })
            .collect();
        let interfaces: Vec<_> = self.half_space().layers().iter().map(|layer| layer.interface()).collect();
        let coefficients = Conditions::of(&materials, &interfaces).solution();
        ThermalStress { temperature, materials, coefficients }
    }
}

impl ThermalStress {
    /// Wave of temperature that causes the stresses.
    pub fn temperature(&self) -> &TemperatureWave {
        &self.temperature
    }

    /// Amplitudes at a depth over the flux into the surface, in the phases of [`ThermalStress`]: stresses in pressures, displacements in
    /// lengths per power and area. Depths outside their material are brought back to its faces.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn at(&self, depth: Depth) -> Amplitudes<Complex64> {
        let material = &self.materials[depth.material - 1];
        material.amplitudes(&self.coefficients[depth.material - 1], material.heat.below(depth))
    }
}

#[cfg(test)]
mod tests {
    use super::super::twin::collocation::Collocation;
    use super::super::twin::stacks::{cases, contrast, error};
    use super::*;
    use crate::body::Conduction;
    use crate::body::{HalfSpace, Interface, Layer, Material};

    type Amplitude = fn(Amplitudes<Complex64>) -> Complex64;
    const STRESSES: [Amplitude; 4] = [|of| of.szz, |of| of.sqz, |of| of.sqq, |of| of.stt];
    const DISPLACEMENTS: [Amplitude; 2] = [|of| of.uz, |of| of.uq];
    const WAVE: [f64; 2] = [0.6, 0.8];
    /// Thicknesses over 1/k on both sides of where a form changes.
    const THICKNESSES: [f64; 9] = [1e-8, 1e-6, 1e-4, 1e-2, 0.3, 0.99, 1.01, 10.0, 1e3];
    const VELOCITIES: [f64; 4] = [0.0, 1e-3, 3.0, 1e3];
    /// Stiffnesses over that of the substrate.
    const STIFFNESSES: [f64; 6] = [1e-6, 1e-3, 0.5, 30.0, 1e3, 1e6];

    fn conduction([conductivity, diffusivity, expansion]: [f64; 3]) -> Conduction {
        Conduction::new(conductivity, diffusivity, expansion).unwrap()
    }

    fn layer(young: f64, poisson: f64, thickness: f64, interface: Interface) -> Layer {
        Layer::new(Material::from_young(young, poisson).unwrap(), thickness, interface).unwrap()
    }

    fn substrate() -> Material {
        Material::from_young(1.0, 0.3).unwrap()
    }

    /// Largest differences of stresses and of displacements, each over the largest of its kind.
    fn errors(pairs: &[[Amplitudes<Complex64>; 2]]) -> [f64; 2] {
        let of = |list: &[Amplitude]| error(list.iter().flat_map(|of| pairs.iter().map(move |pair| pair.map(of))));
        [of(&STRESSES), of(&DISPLACEMENTS)]
    }

    #[test]
    fn stresses_and_displacements_are_those_of_collocation() {
        for (body, k) in cases() {
            let (stress, nodes) = (body.thermal_stress(k), Collocation::new(&body, k).solution());
            let pairs: Vec<_> = nodes.iter().map(|node| [stress.at(node.depth), node.amplitudes]).collect();
            // Second derivatives at 21 points lose 21⁴ε = 4e-11, and strains of a stiff layer under a soft one their contrast.
            let bound = 1e-10 * contrast(&body);
            let found = errors(&pairs);
            assert!(found.iter().all(|error| *error < bound), "{}, {k:?}: {found:?}", body.half_space());
        }
    }

    /// F = M k²(e^{−kz} − e^{−sz})/(s² − k²) − M k²z e^{−kz}/(s + k), σ_tt by the trace: whatever is called a layer. At rest, s = k, F = 0.
    #[test]
    fn a_homogeneous_half_space_has_its_closed_form() {
        let (e, nu, k, alpha, lambda, kappa) = (1.3, 0.4, 0.5, 3.0, 2.0, 0.7);
        for velocity in [0.0, 0.05, 5.0, 3e4] {
            let square = Complex64::new(k * k, -0.3 * velocity / kappa);
            let (s, surface) = (square.sqrt(), alpha * e / (lambda * square.sqrt()));
            let closed = |z: f64| {
                let (slow, fast) = ((-k * z).exp(), (-s * z).exp());
                let edge = surface / (1.0 - nu) / (s + k) * slow;
                let [f, slope, second] = if velocity == 0.0 {
                    [Complex64::default(); 3]
                } else {
                    let unit = surface / (1.0 - nu) / (square - k * k);
                    [
                        unit * k * k * (slow - fast) - edge * k * k * z,
                        unit * k * (s * fast - k * slow) - edge * k * (1.0 - k * z),
                        unit * (k * k * slow - square * fast) - edge * k * (k * z - 2.0),
                    ]
                };
                [-f, slope, second, nu * (second - f) - surface * fast]
            };
            for h in [2e-8, 1e-6, 1e-3, 0.7, 3.0, 60.0, 2e3] {
                for thicknesses in [vec![], vec![h], vec![h, 2.0 * h], vec![1.7, h], vec![h; 20]] {
                    let layers: Vec<_> = thicknesses.iter().map(|&h| layer(e, nu, h, Interface::Bonded)).collect();
                    let resistances = vec![0.0; layers.len()];
                    let conductions = vec![conduction([lambda, kappa, alpha]); layers.len() + 1];
                    let half_space = HalfSpace::new(layers, Material::from_young(e, nu).unwrap());
                    let depths: Vec<_> =
                        [0.0, 0.3 * h, h, 2.0 * h, 3.0 * h, 1.7, 2.0].map(|z| half_space.depths(z)).concat();
                    let body = HeatedBody::new(half_space, conductions, resistances, velocity).unwrap();
                    let stress = body.thermal_stress([0.3, 0.4]);
                    for depth in depths {
                        let found = STRESSES.map(|of| of(stress.at(depth)));
                        let worst =
                            std::iter::zip(found, closed(depth.z)).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
                        // Rounding of each material; the closed form cancels to (s − k)/k = 0.04 where v = 0.05.
                        let bound = 1e-14 * (1 + thicknesses.len()) as f64 * surface.norm();
                        assert!(worst < bound, "v {velocity}, {thicknesses:?}, {depth:?}: {worst:e}");
                    }
                }
            }
        }
    }

    /// The surface is free, and moves as the reciprocal theorem has it.
    #[test]
    fn the_surface_moves_as_by_reciprocity() {
        let interfaces =
            [Interface::Bonded, Interface::Frictionless, Interface::Spring { tangential: 0.7, normal: 3.0 }];
        let conductions = [[2.0, 0.8, 0.5], [0.1, 0.3, 3.0], [1.0, 1.0, 1.0]].map(conduction);
        for (h, chi) in THICKNESSES.into_iter().flat_map(|h| STIFFNESSES.map(|chi| (h, chi))) {
            for (interface, velocity) in interfaces.into_iter().flat_map(|of| VELOCITIES.map(|v| (of, v))) {
                let layers = vec![layer(chi, 0.2, h, interface), layer(2.0, 0.5, 0.4, interface)];
                let elastic = (HalfSpace::new(layers.clone(), substrate()), conductions.to_vec());
                let rigid = (HalfSpace::on_rigid_base(layers).unwrap(), conductions[..2].to_vec());
                for (half_space, conductions) in [elastic, rigid] {
                    let body = HeatedBody::new(half_space, conductions, vec![0.0, 0.5], velocity).unwrap();
                    let (stress, swelling) = (body.thermal_stress(WAVE), body.swelling(WAVE));
                    let Amplitudes { szz, sqz, uz, .. } = stress.at(Depth { z: 0.0, material: 1 });
                    let moved = (uz / swelling - 1.0).norm();
                    let modulus = stress.materials.iter().map(|of| of.modulus).fold(0.0, f64::max);
                    let free = szz.norm().max(sqz.norm()) / (modulus * stress.temperature().surface().norm());
                    let bound = 1e-13 + 4.0 * f64::EPSILON * chi.max(1.0 / chi);
                    assert!(moved < bound && free < 1e-15, "kh {h}, χ {chi}, v {velocity}: {moved:e}, {free:e}");
                }
            }
        }
    }

    /// A layer between two materials in two parts is the same layer at all depths, to the rounding that stresses of the stiffer and
    /// displacements of the softer material have in the other one: ε times their contrast.
    #[test]
    fn a_layer_in_two_parts_is_the_same_layer() {
        let conductions = [[0.1, 0.3, 3.0], [2.0, 0.8, 0.5], [1.0, 1.0, 1.0]].map(conduction);
        let of = |parts: &[f64], h: f64, chi: f64, velocity: f64| {
            let mut layers = vec![layer(2.0, 0.45, 0.4, Interface::Bonded)];
            layers.extend(parts.iter().map(|part| layer(chi, 0.2, part * h, Interface::Bonded)));
            let (mut all, mut resistances) = (conductions.to_vec(), vec![0.0; layers.len()]);
            all.splice(1..2, vec![conductions[1]; parts.len()]);
            resistances[parts.len()] = 0.5;
            HeatedBody::new(HalfSpace::new(layers, substrate()), all, resistances, velocity)
                .unwrap()
                .thermal_stress(WAVE)
        };
        for (h, chi) in THICKNESSES.into_iter().flat_map(|h| STIFFNESSES.map(|chi| (h, chi))) {
            for (part, velocity) in [0.4, 1e-3].into_iter().flat_map(|part| VELOCITIES.map(|v| (part, v))) {
                let (whole, split) = (of(&[1.0], h, chi, velocity), of(&[part, 1.0 - part], h, chi, velocity));
                let (top, middle, bottom) = (0.4, 0.4 + part * h, 0.4 + h);
                let places = [(1, 1, 0.0), (1, 1, 0.2), (1, 1, top), (2, 2, top), (2, 2, middle), (2, 3, middle)];
                let places = places.into_iter().chain([(2, 3, bottom), (3, 4, bottom), (3, 4, 1.0 + h)]);
                let pairs: Vec<_> = places
                    .map(|(one, other, z)| {
                        [whole.at(Depth { z, material: one }), split.at(Depth { z, material: other })]
                    })
                    .collect();
                let found = errors(&pairs);
                let bound = 1e-13 + 4.0 * f64::EPSILON * chi.max(1.0 / chi);
                assert!(found.iter().all(|error| *error < bound), "kh {h}, χ {chi}, v {velocity}, {part}: {found:?}");
            }
        }
    }

    /// A thin warm layer that keeps its size on what does not expand: σ_qq = σ_tt = −EαT/(1−ν), to the order kh.
    #[test]
    fn a_thin_layer_on_what_does_not_expand_is_confined() {
        let h = 1e-7;
        let half_space = HalfSpace::new(vec![layer(2.0, 0.25, h, Interface::Bonded)], substrate());
        let conductions = vec![conduction([1.0, 1.0, 0.7]), conduction([1.0, 1.0, 0.0])];
        let stress = HeatedBody::new(half_space, conductions, vec![0.0], 4.0).unwrap();
        let confined = stress.surface_temperature(WAVE) * stress.confined_stress(1, 1.0);
        let Amplitudes { sqq, stt, .. } = stress.thermal_stress(WAVE).at(Depth { z: 0.0, material: 1 });
        // The substrate gives way by 2kh times the ratio of stiffnesses.
        assert!([sqq, stt].iter().all(|stress| (stress / confined - 1.0).norm() < 4.0 * h));
    }
}
