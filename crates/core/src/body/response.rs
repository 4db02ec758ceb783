//! Response of a layered half-space to harmonic tractions on its surface, one wavenumber at a time.
//!
//! **Surface.** With complex amplitudes of e^{iqξ}, z into the body, q along the wavevector and t across it,
//!
//! ⎛û_z⎞   ⎛  C   −iK   0 ⎞ ⎛p̂  ⎞
//! ⎜û_q⎟ = ⎜ iK    L    0 ⎟ ⎜q̂_L⎟
//! ⎝û_t⎠   ⎝  0    0    S ⎠ ⎝q̂_T⎠
//!
//! for the pressure p and the shear tractions q_L, q_T on the body along and across the wavevector. By Betti's reciprocity
//! the matrix is Hermitian, and the one coupling K serves both ways; energy makes it positive: K² < CL. On a homogeneous
//! half-space C = L = (1−ν)/(Gq), K = (1−2ν)/(2Gq), S = 1/(Gq). With the minors of the plane of admissible states C, K, L
//! are C/N, B/N and A/N over Gq.
//!
//! **Compliance.** C = (1−ν₁)/(G₁q) · T(q) with the layer correction T of the surface material, T → 1 for qh → ∞. For one
//! bonded layer (x = qh, θ = e^{−2x}, χ = G₁/G₂):
//!
//! T = [1 + 4xκθ − λκθ²] / [1 − (λ+κ+4κx²)θ + λκθ²],  λ = 1 − 4(1−ν₁)/(1+χ(3−4ν₂)),  κ = (χ−1)/(χ+3−4ν₁),
//!
//! which the general recursion over minors reproduces. Measured against 120-digit arithmetic (`validation/kernel`), its
//! relative error stays below 1e-12 for shear ratios 1e-6…1e6, ν 0…0.5, qh 1e-8…1e3 and up to 20 layers with any
//! interfaces.
//!
//! **Loss.** A response is of real moduli, or of complex ones G = G′ + iG″ of viscoelastic materials under a load e^{iωt}
//! ([`Moduli`]): then C, K, L, S are complex with Im C, Im L, Im S ≤ 0 for G″ ≥ 0, and the matrix is no longer Hermitian but still
//! has the one K. All are analytic functions of the moduli: a modulus G + iε has Im C = ε ∂C/∂G, to rounding.
//!
//! **Interior.** Amplitudes of stress and displacement at any depth (`interior`, `across`).

use super::across::{self, Antiplane};
use super::interior::{self, Amplitudes, InPlane, Interior};
use super::minors::Minors;
use super::strata::Strata;
use super::{Depth, Layer, Material, Moduli, Substrate};
use crate::numeric::number::Number;
use rustfft::num_complex::Complex64;

/// Displacements of the surface per traction at one wavenumber, lengths per pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceResponse<N = f64> {
    /// C: u_z from the pressure.
    pub normal: N,
    /// K: u_q from the pressure a quarter wave ahead of it, and u_z from the shear traction a quarter wave behind it. It
    /// changes its sign on soft coatings.
    pub coupling: N,
    /// L: u_q from the shear traction along the wavevector.
    pub along: N,
    /// S: u_t from the shear traction across the wavevector.
    pub across: N,
}

impl SurfaceResponse {
    /// Rows u_z, u_q, u_t; columns p, q_L, q_T: complex amplitudes of e^{iqξ}.
    pub fn matrix(&self) -> [[Complex64; 3]; 3] {
        let (zero, coupling) = (Complex64::default(), Complex64::new(0.0, self.coupling));
        let [normal, along, across] = [self.normal, self.along, self.across].map(Complex64::from);
        [[normal, -coupling, zero], [coupling, along, zero], [zero, zero, across]]
    }
}

/// Response of a layered half-space to harmonic tractions. It belongs to its half-space
/// ([`HalfSpace::response`](super::HalfSpace::response)), which sets it up once; one of complex moduli is made by
/// [`HalfSpace::response_of`](super::HalfSpace::response_of).
#[derive(Debug, Clone, PartialEq)]
pub struct LayeredResponse<N = f64> {
    strata: Strata<N>,
}

impl<N: Number> LayeredResponse<N> {
    /// Response of `layers`, from the surface down, on a substrate, with the `moduli` of material number 1, 2, ….
    pub(super) fn new(
        layers: &[Layer],
        substrate: Substrate,
        moduli: impl FnMut(usize, Material) -> Moduli<N>,
    ) -> Self {
        Self { strata: Strata::new(layers, substrate, moduli) }
    }

    pub(super) fn strata(&self) -> &Strata<N> {
        &self.strata
    }

    /// Minors of the plane of admissible states at the surface.
    fn minors(&self, wavenumber: f64) -> Minors<N> {
        self.strata.surface_minors(wavenumber, |_| ())
    }

    /// Compliance C = ŵ/p̂ at the wavenumber q > 0 (1/length): a length per pressure.
    pub fn compliance(&self, wavenumber: f64) -> N {
        let Minors { c, n, .. } = self.minors(wavenumber);
        c.over(n).over(self.strata.surface_material().shear * wavenumber)
    }

    /// Layer correction T = compliance · G₁q/(1−ν₁) at the wavenumber q > 0 (1/length); 1 for an uncoated half-space.
    pub fn correction(&self, wavenumber: f64) -> N {
        let Minors { c, n, .. } = self.minors(wavenumber);
        c.over(n).over(N::from(1.0) - self.strata.surface_material().poisson)
    }

    /// Compliance at the wavenumber q > 0 (1/length) with the given layer correction T.
    pub(super) fn compliance_of(&self, correction: N, wavenumber: f64) -> N {
        let material = self.strata.surface_material();
        ((N::from(1.0) - material.poisson) * correction).over(material.shear * wavenumber)
    }

    /// K/C at the wavenumber q > 0 (1/length).
    pub(super) fn coupling_ratio(&self, wavenumber: f64) -> N {
        let Minors { b, c, .. } = self.minors(wavenumber);
        b.over(c)
    }

    /// Displacements of the surface under all three tractions at the wavenumber q > 0 (1/length).
    pub fn surface(&self, wavenumber: f64) -> SurfaceResponse<N> {
        let minors = self.minors(wavenumber);
        let unit = N::from(1.0).over(minors.n * self.strata.surface_material().shear * wavenumber);
        SurfaceResponse {
            normal: minors.c * unit,
            coupling: minors.b * unit,
            along: minors.a * unit,
            across: across::compliance(&self.strata, wavenumber),
        }
    }

    /// Interior under a traction of the wavenumber q > 0 (1/length), for amplitudes at many depths.
    pub fn interior(&self, traction: InPlane, wavenumber: f64) -> Interior<N> {
        Interior::new(&self.strata, traction, wavenumber)
    }

    /// Amplitudes at a depth under a pressure or a shear traction along the wavevector, of the wavenumber q > 0 (1/length).
    ///
    /// # Panics
    /// When there is no such material.
    pub fn amplitudes(&self, traction: InPlane, wavenumber: f64, depth: Depth) -> Amplitudes<N> {
        interior::amplitudes(&self.strata, traction, wavenumber, depth)
    }

    /// Amplitudes at a depth under a shear traction across the wavevector, of the wavenumber q > 0 (1/length). Depths outside
    /// their material are brought back to its faces.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn antiplane(&self, wavenumber: f64, depth: Depth) -> Antiplane<N> {
        across::amplitudes(&self.strata, wavenumber, depth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Depth, HalfSpace, Interface, Layer, Material};
    use std::sync::Arc;

    /// T_c, T_l, T_t of one bonded layer at x = qh, computed by two independent programs (twelve digits).
    #[test]
    fn one_bonded_layer_has_its_known_values() {
        let known = [
            ([2.0, 0.2, 0.3], 0.1, [1.277278155820, 1.463897852880, 1.750692060811]),
            ([2.0, 0.2, 0.3], 0.5, [1.413150886307, 1.127790561441, 1.279530844389]),
            ([2.0, 0.2, 0.3], 1.0, [1.460084378451, 1.088554505852, 1.094485949748]),
            ([2.0, 0.2, 0.3], 2.0, [1.205689866993, 1.048650182070, 1.012285431099]),
            ([0.5, 0.45, 0.3], 0.5, [0.501121907560, 0.944833168395, 0.781536454854]),
            ([0.5, 0.45, 0.3], 1.0, [-0.268057141760, 0.948516036561, 0.913670934040]),
            ([0.5, 0.45, 0.3], 2.0, [0.158820859371, 0.953032119770, 0.987863668960]),
        ];
        for ([chi, nu1, nu2], x, [coupling, along, across]) in known {
            let layer = Layer::new(Material::from_shear(chi, nu1).unwrap(), 1.0, Interface::Bonded).unwrap();
            let half_space = HalfSpace::new(vec![layer], Material::from_shear(1.0, nu2).unwrap());
            let response = half_space.response().surface(x);
            let unit = chi * x;
            let found = [
                response.coupling * 2.0 * unit / (1.0 - 2.0 * nu1),
                response.along * unit / (1.0 - nu1),
                response.across * unit,
            ];
            for (found, known) in found.into_iter().zip([coupling, along, across]) {
                assert!((found - known).abs() < 1e-12, "χ {chi}, x {x}: {found}, {known}");
            }
        }
    }

    /// u_q under a pressure and u_z under a shear traction, each by its own functional, are the one K; the matrix is
    /// Hermitian and positive.
    #[test]
    fn the_response_is_reciprocal_and_positive() {
        let material = |shear, poisson| Material::from_shear(shear, poisson).unwrap();
        let spring = Interface::Spring { tangential: 0.3, normal: 40.0 };
        for interface in [Interface::Bonded, Interface::Frictionless, spring] {
            for (chi, nu1, nu2) in [(1e-6, 0.5, 0.3), (0.05, 0.45, 0.0), (3.0, 0.0, 0.5), (1e6, 0.3, 0.3)] {
                for h in [1e-4, 0.03, 0.7, 5.0] {
                    let top = Layer::new(material(chi, nu1), h, interface).unwrap();
                    let under = Layer::new(material(2.0, 0.1), 0.2, Interface::Bonded).unwrap();
                    let half_space = HalfSpace::new(vec![top, under], material(1.0, nu2));
                    let response = half_space.response().surface(1.0);
                    let at = |traction| half_space.response().interior(traction, 1.0).at(Depth::SURFACE);
                    let (normal, along) = (at(InPlane::Normal), at(InPlane::Along));
                    // The real parts of iK e^{iqξ} and −iK e^{iqξ} are −K sin and K sin.
                    let scale = (response.normal * response.along).sqrt();
                    assert!((normal.uq + response.coupling).abs() < 1e-12 * scale, "{interface}, χ {chi}, h {h}");
                    assert!((along.uz - response.coupling).abs() < 1e-12 * scale, "{interface}, χ {chi}, h {h}");
                    assert!((along.uq / response.along - 1.0).abs() < 1e-12, "{interface}, χ {chi}, h {h}");
                    let matrix = response.matrix();
                    assert!((0..9).all(|k| matrix[k / 3][k % 3] == matrix[k % 3][k / 3].conj()));
                    assert!(response.coupling.abs() < scale && response.across > 0.0);
                }
            }
        }
    }

    fn one_layer(chi: f64, nu1: f64, nu2: f64, interface: Interface) -> Arc<LayeredResponse> {
        let layer = Layer::new(Material::from_shear(chi, nu1).unwrap(), 1.0, interface).unwrap();
        Arc::clone(HalfSpace::new(vec![layer], Material::from_shear(1.0, nu2).unwrap()).response())
    }

    /// T of the module's head.
    fn closed_form(chi: f64, nu1: f64, nu2: f64, x: f64) -> f64 {
        let theta = (-2.0 * x).exp();
        let lambda = 1.0 - 4.0 * (1.0 - nu1) / (1.0 + chi * (3.0 - 4.0 * nu2));
        let kappa = (chi - 1.0) / (chi + 3.0 - 4.0 * nu1);
        (1.0 + 4.0 * x * kappa * theta - lambda * kappa * theta * theta)
            / (1.0 - (lambda + kappa + 4.0 * kappa * x * x) * theta + lambda * kappa * theta * theta)
    }

    #[test]
    fn an_uncoated_half_space_has_no_correction() {
        let bare = HalfSpace::new(vec![], Material::from_shear(2.0, 0.3).unwrap());
        assert_eq!(bare.response().correction(3.0), 1.0);
        assert!((bare.response().compliance(3.0) - 0.7 / 6.0).abs() < 1e-16);
    }

    #[test]
    fn one_bonded_layer_has_its_closed_form() {
        for chi in [0.1, 0.5, 2.0, 9.0] {
            for (nu1, nu2) in [(0.2, 0.3), (0.45, 0.3), (0.0, 0.5), (0.5, 0.5)] {
                for x in [0.3, 0.9, 1.1, 3.0, 10.0, 40.0] {
                    let general = one_layer(chi, nu1, nu2, Interface::Bonded).correction(x);
                    let closed = closed_form(chi, nu1, nu2, x);
                    assert!(
                        (general / closed - 1.0).abs() < 1e-13,
                        "χ {chi}, ν {nu1}/{nu2}, x {x}: {general} {closed}"
                    );
                }
            }
        }
    }

    #[test]
    fn springs_lie_between_bonded_and_frictionless() {
        let spring =
            |tangential, normal| one_layer(2.0, 0.2, 0.3, Interface::Spring { tangential, normal }).correction(1.0);
        let bonded = one_layer(2.0, 0.2, 0.3, Interface::Bonded).correction(1.0);
        let frictionless = one_layer(2.0, 0.2, 0.3, Interface::Frictionless).correction(1.0);
        assert_eq!(spring(f64::INFINITY, f64::INFINITY), bonded);
        assert!((spring(1e-13, f64::INFINITY) / frictionless - 1.0).abs() < 1e-12);
        let values = [1e3, 10.0, 1.0, 0.1, 1e-3].map(|k| spring(k, f64::INFINITY));
        assert!(values.windows(2).all(|pair| bonded < pair[0] && pair[0] < pair[1] && pair[1] < frictionless));
    }
}
