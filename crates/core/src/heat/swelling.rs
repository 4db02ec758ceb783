//! Displacement of the free surface by heat.
//!
//! By the reciprocal theorem a temperature T, in a body whose surface is free, displaces the surface into the body by (V. M. Maysel, 1951)
//!
//! ŵ = ∫ αT̂ σ̂_kk dz,  σ̂_kk = (1 + ν)(F″ − F),
//!
//! with the trace σ_kk of the stresses under a unit pressure of the same wavenumber on the same body without heat, F its stress function:
//! no further elastic problem is solved. The trace is harmonic, so that in a layer of the thickness h it follows from its values at both
//! faces, σ_kk = Φ₀ sinh k(h−z)/sinh kh + Φ₁ sinh kz/sinh kh, and in the substrate Φ₀e^{−kz}. On a
//! homogeneous half-space ŵ = −2(1 + ν)α/(λs(s + k)): a body that swells rises, ŵ < 0.
//!
//! The integral over a layer has a form without cancellation in each of three cases:
//!
//! - kh ≥ 1: T = Ae^{−sz} + Be^{−s(h−z)} and σ_kk by exponentials too, with ∫e^{−sz}e^{−kz}dz = h m((s+k)h) and
//!   ∫e^{−sz}e^{−k(h−z)}dz = h e^{−kh} m((s−k)h), m(x) = (1 − e^{−x})/x entire: s may be k;
//! - kh < 1, |s|h ≥ 2: T by exponentials, and as both factors obey their equations ∫Tφ dz = (T′φ − Tφ′)/(s² − k²) between the faces:
//!   s is far from k;
//! - kh < 1, |s|h < 2: Gauss' rule of ten points, exact to rounding for functions as slow as these.

use super::HeatedBody;
use super::conducting_material::ConductingMaterial;
use super::exponentials::{decay, mean_decay};
use crate::body::InPlane;
use crate::numeric::quadrature::gauss;
use rustfft::num_complex::Complex64;
use std::sync::LazyLock;

/// kh below which σ_kk is not split into exponentials.
const THIN: f64 = 1.0;
/// |s|h below which a thin layer is integrated by Gauss' rule.
const SLOW: f64 = 2.0;
/// Points of that rule: on an interval of half-length |s + k|h/2 < 1.5 its error is below 2²¹(10!)⁴/(21(20!)³)·1.5²⁰ = 4e-21.
const POINTS: usize = 10;
static RULE: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| gauss(POINTS));

impl HeatedBody {
    /// Displacement of the free surface into the body over the flux into it at the wavevector **k** ≠ 0 (1/length): a length per power and
    /// area, negative where the surface swells under the flux.
    pub fn swelling(&self, wavevector: [f64; 2]) -> Complex64 {
        let wavenumber = wavevector[0].hypot(wavevector[1]);
        let interior = self.half_space().response().interior(InPlane::Normal, wavenumber);
        let wave = self.temperature_wave(wavevector);
        let materials = wave.materials().iter().zip(self.conductions()).zip(self.half_space().materials());
        let parts = materials.enumerate().map(|(number, ((heat, conduction), elastic))| {
            let poisson = elastic.poisson();
            let trace = |x: f64| {
                let [f0, _, f2, _] = interior.derivatives(number, x);
                (1.0 + poisson) * (f2 - f0)
            };
            let thickness = interior.thickness(number);
            let lower = if thickness.is_finite() { trace(thickness) } else { 0.0 };
            overlap(heat, [trace(0.0), lower]) * conduction.expansion()
        });
        parts.sum()
    }
}

/// ∫T φ dz over a material, φ harmonic with the given values at its upper and lower face.
fn overlap(material: &ConductingMaterial, [upper, lower]: [f64; 2]) -> Complex64 {
    let (k, s, h) = (material.rate.wavenumber, material.rate.rate, material.thickness);
    if h.is_infinite() {
        return material.exponentials()[0] * upper / material.rate.sum();
    }
    if k * h >= THIN {
        let once = (-k * h).exp();
        let [p, q] = [upper - lower * once, lower - upper * once].map(|part| part / (1.0 - once * once));
        let [a, b] = material.exponentials();
        let [along, against] = [mean_decay(material.rate.sum() * h), mean_decay(material.rate.excess * h) * once];
        return ((a * p + b * q) * along + (a * q + b * p) * against) * h;
    }
    // sinh x/sinh kh and cosh kh for the values of both faces.
    let (sinh, cosh) = ((k * h).sinh(), (k * h).cosh());
    if (s * h).norm() >= SLOW {
        let once = decay(s * h);
        let [near, far] = [s - k * cosh / sinh + once * (k / sinh), (1.0 - once * cosh) * (k / sinh) - once * s];
        let [a, b] = material.exponentials();
        let all = (a * upper + b * lower) * near + (a * lower + b * upper) * far;
        return all / (material.rate.excess * material.rate.sum());
    }
    let point = |&[x, weight]: &[f64; 2]| {
        let below = 0.5 * h * (1.0 + x);
        let trace = (upper * (k * (h - below)).sinh() + lower * (k * below).sinh()) / sinh;
        material.temperature(below) * (0.5 * h * weight * trace)
    };
    RULE.iter().map(point).sum()
}

#[cfg(test)]
mod tests {
    use super::super::twin::collocation::Collocation;
    use super::super::twin::stacks::{cases, contrast, error};
    use super::*;
    use crate::body::Conduction;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use std::f64::consts::PI;

    const ROUNDING: f64 = 1e-14;

    fn homogeneous(thicknesses: &[f64], velocity: f64) -> HeatedBody {
        let material = Material::from_young(1.3, 0.4).unwrap();
        let layers = thicknesses.iter().map(|&h| Layer::new(material, h, Interface::Bonded).unwrap()).collect();
        let conduction = Conduction::new(2.0, 0.7, 3.0).unwrap();
        let (conductions, resistances) = (vec![conduction; thicknesses.len() + 1], vec![0.0; thicknesses.len()]);
        HeatedBody::new(HalfSpace::new(layers, material), conductions, resistances, velocity).unwrap()
    }

    /// −2(1+ν)α/(λs(s+k)), whatever is called a layer, down to 10⁻⁸ and up to 10³ over k.
    #[test]
    fn a_homogeneous_half_space_has_its_closed_form() {
        let mut worst = 0.0f64;
        for (k, velocity) in
            [([0.3, 0.4], 0.0), ([0.3, 0.4], 1e-5), ([0.4, 0.3], 5.0), ([-0.5, 0.0], 3e4), ([0.0, 0.5], 9.0)]
        {
            let s = Complex64::new(k[0] * k[0] + k[1] * k[1], -k[0] * velocity / 0.7).sqrt();
            let closed = -2.0 * 1.4 * 3.0 / (2.0 * s * (s + 0.5));
            assert!(homogeneous(&[], velocity).swelling(k).re < 0.0);
            for h in [2e-8, 2e-6, 1e-3, 0.05, 0.7, 1.9, 2.1, 3.0, 60.0, 2e3] {
                for thicknesses in [vec![], vec![h], vec![h, 2.0 * h], vec![1.7, h], vec![h; 20]] {
                    let error = (homogeneous(&thicknesses, velocity).swelling(k) / closed - 1.0).norm();
                    worst = worst.max(error);
                    // The trace errs by the rounding of the elastic recursion, 10⁻¹³ at the most.
                    assert!(error < 1e-13, "k {k:?}, v {velocity}, layers {thicknesses:?}: {error:e}");
                }
            }
        }
    }

    /// ∫T φ dz in each of its forms, on both sides of where they change, against Gauss' rule on many panels.
    #[test]
    fn integrals_over_a_layer_are_those_by_quadrature() {
        let material = Material::from_young(1.0, 0.3).unwrap();
        let rule = gauss(20);
        let mut worst = 0.0f64;
        for (h, velocity) in [0.02, 0.5, 0.999, 1.001, 1.9, 2.1, 7.0]
            .into_iter()
            .flat_map(|h| [0.0, 0.1, 3.9, 4.1, 40.0].map(|v| (h, v)))
        {
            for resistance in [0.0, 1.0, f64::INFINITY] {
                let layer = Layer::new(material, h, Interface::Bonded).unwrap();
                let conductions = vec![Conduction::new(1.0, 1.0, 1.0).unwrap()];
                let body = HeatedBody::new(
                    HalfSpace::on_rigid_base(vec![layer]).unwrap(),
                    conductions,
                    vec![resistance],
                    velocity,
                );
                let wave = body.unwrap().temperature_wave([1.0, 0.0]);
                let heat = &wave.materials()[0];
                for [upper, lower] in [[1.0, 1.0], [1.0, -1.0], [0.2, 3.0]] {
                    let [mut sum, mut size] = [Complex64::default(); 2];
                    for panel in 0..16 {
                        for [x, weight] in &rule {
                            let z = h / 16.0 * (f64::from(panel) + 0.5 * (1.0 + x));
                            let phi = (upper * (h - z).sinh() + lower * z.sinh()) / h.sinh();
                            let part = heat.temperature(z) * (phi * weight * h / 32.0);
                            sum += part;
                            size += part.norm();
                        }
                    }
                    let error = (overlap(heat, [upper, lower]) - sum).norm() / size.norm();
                    worst = worst.max(error);
                    assert!(error < ROUNDING, "h {h}, v {velocity}, R {resistance}, {upper}, {lower}: {error:e}");
                }
            }
        }
    }

    /// Confined between its sides a thin layer rises by (1+ν)/(1−ν) α∫T dz, T = (h−z)/λ above a cold base and T = 1/(λs²h) = const above
    /// one that insulates: to the order (kh)².
    #[test]
    fn thin_layers_on_a_rigid_base_rise_as_columns() {
        let mut worst = 0.0f64;
        for (poisson, velocity) in [0.0, 0.3, 0.5].into_iter().flat_map(|poisson| [0.0, 20.0].map(|v| (poisson, v))) {
            let square = Complex64::new(1.0, -0.6 * velocity / 0.7);
            for h in [1e-3, 1e-6, 1e-9] {
                let layer = Layer::new(Material::from_young(1.3, poisson).unwrap(), h, Interface::Bonded).unwrap();
                let rise = |resistance: f64| {
                    let conduction = Conduction::new(2.0, 0.7, 3.0).unwrap();
                    let half_space = HalfSpace::on_rigid_base(vec![layer]).unwrap();
                    let body = HeatedBody::new(half_space, vec![conduction], vec![resistance], velocity);
                    body.unwrap().swelling([0.6, 0.8]) * (1.0 - poisson) / (-3.0 * (1.0 + poisson))
                };
                let [cold, insulated] =
                    [rise(0.0) / (h * h / 4.0), rise(f64::INFINITY) * square * 2.0].map(|of| (of - 1.0).norm());
                worst = if h < 1e-8 { worst.max(cold).max(insulated) } else { worst };
                let order = square.norm() * h * h;
                assert!(
                    cold < 3.0 * order + ROUNDING && insulated < 3.0 * order + ROUNDING,
                    "ν {poisson}, h {h}: {cold:e}, {insulated:e}"
                );
            }
        }
    }

    #[test]
    fn swelling_is_that_of_collocation() {
        let mut worst = 0.0f64;
        for (body, k) in cases() {
            let twin = Collocation::new(&body, k).solution()[0].amplitudes.uz;
            let error = error([[body.swelling(k), twin]]);
            worst = worst.max(error);
            // Second derivatives at 21 points lose 21⁴ε = 4e-11, and strains of a stiff layer their contrast.
            assert!(error < 1e-10 * contrast(&body), "{}, k {k:?}: {error:e}", body.half_space());
        }
    }

    /// Steady sliding at μ and v has K̂ + μvŴ in the place of K̂ = 2(1−ν²)/(Ek): its real part is zero at v = 2λk(1−ν)/(μαE) for stationary
    /// heat, R. A. Burton, V. Nerlikar & S. R. Kilaparti, Wear 24, 177 (1973), and for moving heat too, by the waves across the motion.
    #[test]
    fn the_critical_velocity_is_burton_s() {
        let material = Material::from_young(1.0, 0.3).unwrap();
        let half_space = HalfSpace::new(vec![], material);
        let real = |velocity: f64, over_body: f64, k: [f64; 2]| {
            let conduction = Conduction::new(1.0, 1.0, 1.0).unwrap();
            let body = HeatedBody::new(half_space.clone(), vec![conduction], vec![], over_body).unwrap();
            half_space.response().compliance(k[0].hypot(k[1])) + 0.5 * velocity * body.swelling(k).re
        };
        let critical = 2.0 * 2.0 * PI * 0.7 / 0.5;
        assert!((critical - 17.592919f64).abs() < 5e-7);
        let at_rest = |velocity: f64| real(velocity, 0.0, [2.0 * PI, 0.0]);
        assert!(at_rest(0.99 * critical) > 0.0 && at_rest(1.01 * critical) < 0.0);
        assert!(at_rest(critical).abs() < 4.0 * f64::EPSILON * at_rest(0.0));
        assert_eq!(real(critical, critical, [0.0, 2.0 * PI]), at_rest(critical));
        // The wave along the motion has more room: its heat is carried away.
        assert!(real(critical, critical, [2.0 * PI, 0.0]) > 0.1 * at_rest(0.0));
    }
}
