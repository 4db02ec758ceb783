//! Response of the surface to tractions of one wavenumber: the 3 × 3 matrix of a layered half-space.
//!
//! With complex amplitudes of e^{iqξ}, z into the body, q along the wavevector and t across it,
//!
//! ⎛û_z⎞   ⎛  C   −iK   0 ⎞ ⎛p̂  ⎞
//! ⎜û_q⎟ = ⎜ iK    L    0 ⎟ ⎜q̂_L⎟
//! ⎝û_t⎠   ⎝  0    0    S ⎠ ⎝q̂_T⎠
//!
//! for the pressure p and the shear tractions q_L, q_T on the body along and across the wavevector. By Betti's reciprocity
//! the matrix is Hermitian, and the one coupling K serves both ways; energy makes it positive: K² < CL. On a homogeneous
//! half-space C = L = (1−ν)/(Gq), K = (1−2ν)/(2Gq), S = 1/(Gq). With the minors of the plane of admissible states C, K, L
//! are C/N, B/N and A/N over Gq.

use super::TransferFunction;
use rustfft::num_complex::Complex64;

/// Displacements of the surface per traction at one wavenumber, lengths per pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceResponse {
    /// C: u_z from the pressure.
    pub normal: f64,
    /// K: u_q from the pressure a quarter wave ahead of it, and u_z from the shear traction a quarter wave behind it. It
    /// changes its sign on soft coatings.
    pub coupling: f64,
    /// L: u_q from the shear traction along the wavevector.
    pub along: f64,
    /// S: u_t from the shear traction across the wavevector.
    pub across: f64,
}

impl SurfaceResponse {
    /// Rows u_z, u_q, u_t; columns p, q_L, q_T: complex amplitudes of e^{iqξ}.
    pub fn matrix(&self) -> [[Complex64; 3]; 3] {
        let (zero, coupling) = (Complex64::default(), Complex64::new(0.0, self.coupling));
        let [normal, along, across] = [self.normal, self.along, self.across].map(Complex64::from);
        [[normal, -coupling, zero], [coupling, along, zero], [zero, zero, across]]
    }
}

impl TransferFunction {
    /// Response of the surface at the wavenumber q > 0 (1/length).
    pub fn response(&self, wavenumber: f64) -> SurfaceResponse {
        let minors = self.surface(wavenumber, |_| ());
        let unit = 1.0 / (minors.n * self.surface_material().shear * wavenumber);
        SurfaceResponse {
            normal: minors.c * unit,
            coupling: minors.b * unit,
            along: minors.a * unit,
            across: self.antiplane_compliance(wavenumber),
        }
    }

    /// K/C at the wavenumber q > 0 (1/length).
    pub(super) fn coupling_ratio(&self, wavenumber: f64) -> f64 {
        let minors = self.surface(wavenumber, |_| ());
        minors.b / minors.c
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Depth, HalfSpace, InPlane, Interface, Interior, Layer, Material};

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
            let response = TransferFunction::new(&half_space).response(x);
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
                    let transfer = TransferFunction::new(&HalfSpace::new(vec![top, under], material(1.0, nu2)));
                    let response = transfer.response(1.0);
                    let at = |traction| Interior::under(traction, &transfer, 1.0).at(Depth::SURFACE);
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
}
