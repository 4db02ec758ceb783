//! The two moduli of an isotropic material as numbers of any kind.
//!
//! Under a load e^{iωt} a viscoelastic material is an elastic one of the complex moduli G(iω) and ν(iω) (correspondence principle):
//! G = G′ + iG″ with the storage modulus G′ and the loss modulus G″ ≥ 0. With a real bulk modulus K, ν = (3K − 2G)/(6K + 2G).

use super::{ConstantModulus, Material, Relaxation};
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

impl<N: Number> Moduli<N> {
    /// Moduli of a relaxed `material` whose shear modulus is larger by `stiffening`, a pressure, with the constant modulus of its relaxation.
    fn stiffened(material: Material, relaxation: Relaxation, stiffening: N) -> Self {
        let shear = N::from(material.shear()) + stiffening;
        let poisson = match relaxation.constant() {
            ConstantModulus::Poisson => N::from(material.poisson()),
            ConstantModulus::Bulk => {
                // ν = (3 − 2G/K)/(6 + 2G/K); 1/K = 0 of an incompressible material.
                let ratio = shear * bulk_compliance(material);
                (N::from(3.0) - ratio * 2.0).over(N::from(6.0) + ratio * 2.0)
            }
        };
        Self { shear, poisson }
    }
}

impl Material {
    /// Moduli at the Laplace variable s, one over a time, s = iω under a load e^{iωt}; the relaxed ones of a material that does not relax.
    pub fn moduli_at<N: Number>(self, s: N) -> Moduli<N> {
        let of = |relaxation: Relaxation| Moduli::stiffened(self, relaxation, relaxation.stiffening(s));
        self.relaxation().map_or_else(|| self.into(), of)
    }

    /// Moduli at once after a strain, s → ∞; the relaxed ones of a material that does not relax.
    pub fn glassy(self) -> Moduli {
        let of = |relaxation: Relaxation| Moduli::stiffened(self, relaxation, relaxation.instantaneous());
        self.relaxation().map_or_else(|| self.into(), of)
    }
}

impl Material {
    /// G₀/G and K₀/K of the relaxed moduli over those at the Laplace variable s, one over a time.
    pub(crate) fn relaxed_over<N: Number>(self, s: N) -> [N; 2] {
        let Some(relaxation) = self.relaxation() else { return [N::from(1.0); 2] };
        let shear = N::from(self.shear()).over(self.moduli_at(s).shear);
        let bulk = match relaxation.constant() {
            ConstantModulus::Bulk => N::from(1.0),
            ConstantModulus::Poisson => shear,
        };
        [shear, bulk]
    }
}

/// 1/K = 3(1 − 2ν)/(2G(1 + ν)).
fn bulk_compliance(material: Material) -> f64 {
    let (shear, nu) = (material.shear(), material.poisson());
    3.0 * (1.0 - 2.0 * nu) / (2.0 * shear * (1.0 + nu))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Amplitudes, Antiplane, Depth, HalfSpace, InPlane, Interface, Layer, LayeredResponse};
    use rustfft::num_complex::Complex64;

    const I: Complex64 = Complex64::I;
    const INTERFACES: [Interface; 5] = [
        Interface::Bonded,
        Interface::Frictionless,
        Interface::Spring { tangential: 0.3, normal: 40.0 },
        Interface::Spring { tangential: f64::INFINITY, normal: 2.0 },
        Interface::Spring { tangential: 0.01, normal: f64::INFINITY },
    ];
    /// Wavenumbers times the thickness of the first layer between which formulas change: the series of exponentials, shielding, and
    /// the largest exponent.
    const CHANGES: [f64; 3] = [1.0, 45.0, 800.0];

    fn layer(shear: f64, poisson: f64, thickness: f64, interface: Interface) -> Layer {
        Layer::new(Material::from_shear(shear, poisson).unwrap(), thickness, interface).unwrap()
    }

    /// A layer of a shear modulus, a Poisson's ratio and a thickness, alone and above another one, on an elastic and on a rigid base.
    fn bodies(interface: Interface, [chi, poisson, thickness]: [f64; 3]) -> [HalfSpace; 4] {
        let top = layer(chi, poisson, thickness, interface);
        let under = |interface| layer(2.0, 0.1, 0.2, interface);
        let substrate = Material::from_shear(1.0, 0.3).unwrap();
        [
            HalfSpace::new(vec![top], substrate),
            HalfSpace::new(vec![top, under(Interface::Bonded)], substrate),
            HalfSpace::on_rigid_base(vec![top]).unwrap(),
            HalfSpace::on_rigid_base(vec![top, under(interface)]).unwrap(),
        ]
    }

    fn is_spring(layer: &Layer) -> bool {
        matches!(layer.interface(), Interface::Spring { .. })
    }

    fn all_bodies() -> impl Iterator<Item = HalfSpace> {
        let materials = [[1e-6, 0.5], [0.05, 0.45], [1.0, 0.3], [3.0, 0.0], [7.0, 0.5], [1e6, 0.3]];
        let layers = materials.into_iter().flat_map(|[chi, nu]| [1e-4, 0.03, 5.0].map(|h| [chi, nu, h]));
        let coated = INTERFACES.into_iter().flat_map(move |kind| layers.clone().flat_map(move |of| bodies(kind, of)));
        let bare = [0.0, 0.3, 0.5].map(|nu| HalfSpace::new(vec![], Material::from_shear(2.0, nu).unwrap()));
        bare.into_iter().chain(coated)
    }

    /// Wavenumbers from 1e-8 to 1e8 over the thickness of the first layer, and beside each change of a formula.
    fn wavenumbers(body: &HalfSpace) -> Vec<f64> {
        let decades = (-16..=16).map(|k| 10f64.powf(0.5 * f64::from(k)));
        let beside = CHANGES.into_iter().flat_map(|x| [x.next_down(), x, x.next_up(), 1.01 * x]);
        let thickness = body.layers().first().map_or(1.0, Layer::thickness);
        decades.chain(beside).map(|x| x / thickness).collect()
    }

    /// Depths at the faces of each material and between them.
    fn depths(body: &HalfSpace) -> Vec<Depth> {
        let inside = |material: usize| {
            let (top, bottom) = body.faces(material);
            let bottom = if bottom.is_finite() { bottom } else { top + 2.0 };
            [0.0, 0.3, 1.0].map(|part| Depth { z: top + part * (bottom - top), material })
        };
        (1..=body.material_count()).flat_map(inside).collect()
    }

    /// Everything that a response tells at a wavenumber, quantities of one scale together.
    fn answers<N: Number>(response: &LayeredResponse<N>, q: f64, depths: &[Depth]) -> Vec<Vec<N>> {
        let surface = response.surface(q);
        let correction = response.correction(q);
        let compliances = vec![response.compliance(q), response.compliance_of(correction, q), surface.normal];
        let mut all = vec![compliances, vec![surface.along], vec![surface.across], vec![correction]];
        all.push(vec![surface.coupling, surface.normal, surface.along]);
        for &depth in depths {
            for traction in [InPlane::Normal, InPlane::Along] {
                let interior = response.interior(traction, q);
                for Amplitudes { szz, sqz, sqq, stt, uz, uq } in
                    [interior.at(depth), response.amplitudes(traction, q, depth)]
                {
                    all.extend([vec![szz, sqz, sqq, stt], vec![uz, uq]]);
                }
            }
            let Antiplane { stz, sqt, ut } = response.antiplane(q, depth);
            all.extend([vec![stz, sqt], vec![ut]]);
        }
        all
    }

    /// At the surface and at any depth, with every kind of interface and base.
    #[test]
    fn moduli_without_loss_give_the_bits_of_real_ones() {
        for body in all_bodies() {
            let complex = body.response_of(|_, material| Moduli::<Complex64>::from(material));
            let depths = depths(&body);
            for q in wavenumbers(&body) {
                assert_eq!(complex.coupling_ratio(q), body.response().coupling_ratio(q).into(), "{body}, q {q}");
                let (found, real) = (answers(&complex, q, &depths), answers(body.response(), q, &depths));
                for (number, (found, real)) in found.concat().into_iter().zip(real.concat()).enumerate() {
                    // Equal numbers have the same bits; zero may have another sign.
                    assert_eq!(found, Complex64::from(real), "{body}, q {q}, answer {number}");
                }
            }
        }
    }

    /// Moduli of which that of one material is changed by a factor or a summand.
    fn changed<N: Number>(body: &HalfSpace, at: usize, [factor, summand]: [N; 2]) -> LayeredResponse<N> {
        body.response_of(|number, material| {
            let Moduli { shear, poisson } = Moduli::<N>::from(material);
            if number == at {
                Moduli { shear: shear * factor, poisson: poisson + summand }
            } else {
                Moduli { shear, poisson }
            }
        })
    }

    /// Im C(G(1 + iε))/ε = ∂C/∂ln G without a difference, and the like for ν, against difference quotients of the fourth order.
    #[test]
    fn an_imaginary_step_gives_the_derivative_by_a_modulus() {
        const TINY: f64 = 1e-30;
        const STEP: f64 = 1e-3;
        const QUOTIENT: [(f64, f64); 4] = [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)];
        let one = Complex64::from(1.0);
        for (body, at) in all_bodies().flat_map(|body| (1..=body.material_count()).map(move |at| (body.clone(), at))) {
            let depths = depths(&body);
            for by in [[1.0, 0.0], [0.0, 1.0]] {
                let complex = changed(&body, at, [one + I * TINY * by[0], I * TINY * by[1]]);
                let beside = QUOTIENT.map(|(k, _)| changed(&body, at, [1.0 + k * STEP * by[0], k * STEP * by[1]]));
                for q in wavenumbers(&body).into_iter().step_by(5) {
                    let beside = beside.each_ref().map(|response| answers(response, q, &depths));
                    let values = answers(body.response(), q, &depths);
                    for (group, found) in answers(&complex, q, &depths).into_iter().enumerate() {
                        let found: Vec<f64> = found.into_iter().map(|value| value.im / TINY).collect();
                        // Nothing of a wave is left at a great depth.
                        let scale = values[group].iter().chain(&found).fold(1e-200, |most: f64, x| most.max(x.abs()));
                        for (k, found) in found.into_iter().enumerate() {
                            let parts = QUOTIENT.iter().zip(&beside).map(|((_, weight), all)| weight * all[group][k]);
                            let quotient = parts.sum::<f64>() / (12.0 * STEP);
                            let error = (found - quotient).abs() / scale;
                            assert!(error < 4e-9, "{body}, material {at}, q {q}: {found} and {quotient} of {scale}");
                        }
                    }
                }
            }
        }
    }

    /// Moduli of a material with the loss tan δ, of a constant Poisson's ratio or a constant, lossless bulk modulus.
    fn lossy(material: Material, tan: f64, keeps_bulk: bool) -> Moduli<Complex64> {
        let shear = material.shear() * (1.0 + I * tan);
        if !keeps_bulk {
            return Moduli { shear, poisson: material.poisson().into() };
        }
        // 1/K, which may be zero: ν = (3 − 2G/K)/(6 + 2G/K).
        let ratio =
            shear * 3.0 * (1.0 - 2.0 * material.poisson()) / (2.0 * material.shear() * (1.0 + material.poisson()));
        Moduli { shear, poisson: (3.0 - 2.0 * ratio) / (6.0 + 2.0 * ratio) }
    }

    /// A body with loss lags behind its tractions, pressure and shear, at every wavenumber: work is lost in each period. So does one
    /// with springs, or whose first layer alone has loss: to rounding, as long waves hardly feel a thin layer. Under the conjugate
    /// moduli, those of −ω, the response is the conjugate one.
    #[test]
    fn a_body_with_loss_takes_up_work_at_every_wavenumber() {
        let losses = [1e-3, 1.0, 30.0].into_iter().flat_map(|tan| [false, true].map(|keeps| (tan, keeps)));
        let losses: Vec<_> = losses.flat_map(|(tan, keeps)| [1, 9].map(|last| (tan, keeps, last))).collect();
        for (body, &(tan, keeps_bulk, last)) in
            all_bodies().flat_map(|body| losses.iter().map(move |of| (body.clone(), of)))
        {
            let moduli = |number, material: Material| match number <= last {
                true => lossy(material, tan, keeps_bulk),
                false => material.into(),
            };
            let response = body.response_of(moduli);
            let backward = body.response_of(|number, material| {
                let Moduli { shear, poisson } = moduli(number, material);
                Moduli { shear: shear.conj(), poisson: poisson.conj() }
            });
            let is_all = last > 1 && !body.layers().iter().any(is_spring);
            let rounding = if is_all { 0.0 } else { 1e-15 * tan.min(1.0) };
            for q in wavenumbers(&body) {
                let [found, mirrored] = [&response, &backward].map(|of| of.surface(q));
                for value in [found.normal, found.along, found.across] {
                    let lags = value.re > 0.0 && value.im < rounding * value.re;
                    assert!(lags, "{body}, q {q}, {last} with tan δ {tan}, {keeps_bulk}: {found:?}");
                }
                assert_eq!(found.normal.conj(), mirrored.normal);
                assert_eq!(found.coupling.conj(), mirrored.coupling);
            }
        }
    }

    /// A common complex factor of all moduli divides all compliances, whatever the layers, where no spring has a stiffness of its own.
    #[test]
    fn compliances_are_over_the_common_factor_of_all_moduli() {
        let factor = 0.7 * (1.0 + 5.0 * I);
        let mut worst = 0.0f64;
        for body in all_bodies().filter(|body| !body.layers().iter().any(is_spring)) {
            let response = body.response_of(|_, material| Moduli {
                shear: material.shear() * factor,
                poisson: material.poisson().into(),
            });
            for q in wavenumbers(&body) {
                let (found, real) = (response.surface(q), body.response().surface(q));
                let all = [(found.normal, real.normal), (found.along, real.along), (found.across, real.across)];
                for (found, real) in all {
                    worst = worst.max((found * factor / real - 1.0).norm());
                }
            }
        }
        assert!(worst < 2e-15, "{worst:e}");
    }

    /// T of one bonded layer by the closed form at the head of `response`, and (χ + tanh x)/(1 + χ tanh x) across the wavevector.
    #[test]
    fn a_bonded_layer_with_loss_has_its_closed_form() {
        let substrate = Material::from_shear(1.0, 0.3).unwrap();
        for (chi, poisson) in [(0.1, 0.2), (0.5, 0.45), (2.0, 0.5), (9.0, 0.0)] {
            let body = HalfSpace::new(vec![layer(chi, poisson, 1.0, Interface::Bonded)], substrate);
            for (tan, base_tan) in [(0.1, 0.0), (4.0, 0.0), (0.0, 0.7), (20.0, 3.0)] {
                let moduli = |number, material| lossy(material, if number == 1 { tan } else { base_tan }, number == 1);
                let [top, base] = [1, 2].map(|number| moduli(number, body.material(number)));
                let response = body.response_of(moduli);
                let chi = top.shear / base.shear;
                for x in [0.3, 0.9, 1.1, 3.0, 10.0, 40.0f64] {
                    let theta = (-2.0 * x).exp();
                    let lambda = 1.0 - 4.0 * (1.0 - top.poisson) / (1.0 + chi * (3.0 - 4.0 * base.poisson));
                    let kappa = (chi - 1.0) / (chi + 3.0 - 4.0 * top.poisson);
                    let closed = (1.0 + 4.0 * x * kappa * theta - lambda * kappa * theta * theta)
                        / (1.0 - (lambda + kappa + 4.0 * kappa * x * x) * theta + lambda * kappa * theta * theta);
                    let across = (chi + x.tanh()) / (1.0 + chi * x.tanh()) / (top.shear * x);
                    let errors = [response.correction(x) / closed, response.surface(x).across / across]
                        .map(|ratio| (ratio - 1.0).norm());
                    assert!(errors.iter().all(|error| *error < 1e-13), "χ {chi}, x {x}: {errors:?}");
                }
            }
        }
    }

    /// A layer on a rigid base under a long wave is a column of the complex oedometric modulus M, C = h/M, and where it is
    /// incompressible it is squeezed, C = q²h³/(3G).
    #[test]
    fn thin_layers_with_loss_are_columns() {
        let (h, x) = (0.25, 1e-6);
        for (poisson, tan, keeps_bulk) in
            [(0.3, 0.5, false), (0.3, 0.5, true), (0.0, 7.0, true), (0.5, 2.0, true), (0.5, 9.0, false)]
        {
            let body = HalfSpace::on_rigid_base(vec![layer(3.0, poisson, h, Interface::Bonded)]).unwrap();
            let moduli = lossy(body.material(1), tan, keeps_bulk);
            let column = match poisson {
                0.5 => x * x * h / (3.0 * moduli.shear),
                _ => h * (1.0 - 2.0 * moduli.poisson) / (2.0 * moduli.shear * (1.0 - moduli.poisson)),
            };
            let error = (body.response_of(|_, _| moduli).compliance(x / h) / column - 1.0).norm();
            assert!(error < 1e-11, "ν {poisson}, tan δ {tan}: {error:e}");
        }
    }
}
