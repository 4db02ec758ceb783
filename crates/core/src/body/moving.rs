//! Compliance of the surfaces of bodies that a load passes steadily.
//!
//! In the frame of the load, which moves with the velocity **v** over the body, the wave e^{i**k**·**x**} has in the material of the body the
//! frequency ω = −**k**·**v**; the counterbody rests in this frame and is relaxed. Under the pressure, and under a traction **t** p that goes
//! with it,
//!
//! K̂(**k**) = C₁(k, ω) + C₂(k) − i (**k**·**t**/k) [K₁(k, ω) − K₂(k)],  K̂(−**k**) = K̂*(**k**),
//!
//! C and K of the [`SurfaceResponse`](super::SurfaceResponse). A body stores energy where Re C > 0, and loses energy
//! where Im C has the sign of **k**·**v**; a body that relaxes does both. Without motion, or along a wave's crests, a body responds with its relaxed moduli.

use super::{Bodies, HalfSpace};
use rustfft::num_complex::Complex64;

impl Bodies {
    /// K̂ at a wavevector **k** ≠ 0 (1/length) of a load that moves with the `velocity` over the body, with the `traction` over the pressure
    /// that goes with it: a length per pressure.
    pub fn moving_compliance(&self, wavevector: [f64; 2], velocity: [f64; 2], traction: [f64; 2]) -> Complex64 {
        let dot = |a: [f64; 2]| a[0] * wavevector[0] + a[1] * wavevector[1];
        let wavenumber = wavevector[0].hypot(wavevector[1]);
        let turned = Complex64::new(0.0, -dot(traction) / wavenumber);
        let [normal, coupling] = passed(self.body(), wavenumber, -dot(velocity), turned.im != 0.0);
        let resting = self.counterbody().map_or([0.0; 2], |above| {
            let above = above.response().surface(wavenumber);
            [above.normal, above.coupling]
        });
        normal + resting[0] + turned * (coupling - resting[1])
    }
}

/// C and K of a body whose material has the frequency ω; K is 0 where it is not asked for.
fn passed(body: &HalfSpace, wavenumber: f64, frequency: f64, with_coupling: bool) -> [Complex64; 2] {
    if frequency == 0.0 || !body.relaxes() {
        let surface = body.response().surface(wavenumber);
        return [surface.normal, surface.coupling].map(Complex64::from);
    }
    let response = body.response_at(Complex64::new(0.0, frequency));
    if with_coupling {
        let surface = response.surface(wavenumber);
        [surface.normal, surface.coupling]
    } else {
        [response.compliance(wavenumber), Complex64::default()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{ConstantModulus, Interface, Layer, Material, Relaxation};

    fn relaxing(shear: f64, poisson: f64, ratio: f64, constant: ConstantModulus) -> Material {
        let terms = [0.7, 0.3].map(|part| part * (ratio - 1.0) * shear);
        let relaxation = Relaxation::new(&terms, &[1.0, 0.02]).unwrap().with_constant(constant);
        Material::from_shear(shear, poisson).unwrap().with_relaxation(Some(relaxation))
    }

    fn bodies() -> impl Iterator<Item = Bodies> {
        let layer = |material, h, interface| Layer::new(material, h, interface).unwrap();
        let elastic = Material::from_shear(1.0, 0.3).unwrap();
        let spring = Interface::Spring { tangential: 0.3, normal: 40.0 };
        [ConstantModulus::Bulk, ConstantModulus::Poisson].into_iter().flat_map(move |constant| {
            let stacks = [1e-4, 1e-2, 1.0, 1e3].into_iter().flat_map(move |chi| {
                [Interface::Bonded, Interface::Frictionless, spring].into_iter().flat_map(move |interface| {
                    let soft = relaxing(chi, 0.45, 30.0, constant);
                    let under = HalfSpace::new(vec![layer(soft, 0.1, interface)], elastic);
                    let on = HalfSpace::new(vec![layer(elastic, 0.1, interface)], soft);
                    let base = HalfSpace::on_rigid_base(vec![layer(soft, 0.3, interface)]).unwrap();
                    [under, on, base]
                })
            });
            let pairs = stacks.map(move |body| Bodies::elastic(body, HalfSpace::new(vec![], elastic)));
            pairs.chain([Bodies::from(HalfSpace::new(vec![], relaxing(1.0, 0.5, 1e3, constant)))])
        })
    }

    /// Re C > 0, and Im C has the sign of **k**·**v**; the wave −**k** has the conjugate.
    #[test]
    fn energy_is_stored_and_lost() {
        for bodies in bodies() {
            for velocity in [1e-3, 0.1, 7.0] {
                for [x, y] in [[3.0, 0.0], [0.2, -40.0], [-5.0, 1.0], [1e-3, 1e-3], [-300.0, 200.0]] {
                    let k = bodies.moving_compliance([x, y], [velocity, 0.0], [0.0; 2]);
                    let scale = 1e-10 * k.norm();
                    assert!(k.re > 0.0 && k.im * x > -scale * x.abs(), "{bodies}, v {velocity}: {k}");
                    let opposite = bodies.moving_compliance([-x, -y], [velocity, 0.0], [0.4, 0.1]);
                    let with_traction = bodies.moving_compliance([x, y], [velocity, 0.0], [0.4, 0.1]);
                    assert!((opposite - with_traction.conj()).norm() < 1e-10 * with_traction.norm());
                }
            }
        }
    }

    /// A bare half-space of constant ν has the compliance (1 − ν)/(Gk) of its complex modulus.
    #[test]
    fn a_half_space_has_its_complex_modulus() {
        let rubber = relaxing(2.0, 0.4, 10.0, ConstantModulus::Poisson);
        let bodies = Bodies::from(HalfSpace::new(vec![], rubber));
        for ([x, y], v) in [([3.0f64, 4.0], 0.3), ([-0.5, 0.1], 20.0)] {
            let omega = -x * v;
            let term = |g: f64, tau: f64| Complex64::new(0.0, omega * tau) * g / Complex64::new(1.0, omega * tau);
            let shear = 2.0 + term(12.6, 1.0) + term(5.4, 0.02);
            let known = 0.6 / (shear * x.hypot(y));
            assert!((bodies.moving_compliance([x, y], [v, 0.0], [0.0; 2]) - known).norm() < 1e-14 * known.norm());
        }
    }

    #[test]
    fn slow_motion_is_relaxed_and_waves_along_the_track_are_at_any_velocity() {
        for bodies in bodies() {
            let relaxed = bodies.compliance(5.0);
            let slow = bodies.moving_compliance([3.0, 4.0], [1e-9, 0.0], [0.0; 2]);
            assert!((slow - relaxed).norm() < 1e-5 * relaxed, "{bodies}: {slow} {relaxed}");
            assert!((bodies.moving_compliance([0.0, 5.0], [1e9, 0.0], [0.0; 2]) - relaxed).norm() < 1e-12 * relaxed);
        }
    }
}
