//! Rate at which a wave of temperature decays with depth.
//!
//! A field e^{ik·x − sz} that is steady in the frame of a source which moves along +x with v is carried through the material with −v, so that
//! −v ∂T/∂x = κ∇²T gives
//!
//! s = √(k² − ik_x v/κ) = k√(1 − iP),  Re s > 0,  P = k_x v/(κk²),
//!
//! and with s² − k² = −iPk² the excess s − k = −iPk/(1 + √(1 − iP)) has no cancellation. H. S. Carslaw & J. C. Jaeger, *Conduction of Heat in
//! Solids*, 2nd ed. (1959), § 10.7 have the moving sources in space.

use crate::body::Conduction;
use rustfft::num_complex::Complex64;

/// Rate s of the decay with depth of a temperature e^{ik·x}, with what s and k have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ThermalRate {
    /// k = |**k**|, 1/length.
    pub wavenumber: f64,
    /// s with Re s ≥ k, 1/length.
    pub rate: Complex64,
    /// s − k with Re (s − k) ≥ 0, 1/length.
    pub excess: Complex64,
}

impl ThermalRate {
    /// Rate at the wavevector **k** ≠ 0 (1/length) in a material over which the source moves with `velocity`.
    pub fn new([kx, ky]: [f64; 2], velocity: f64, conduction: &Conduction) -> Self {
        let wavenumber = kx.hypot(ky);
        let transport = kx / wavenumber * velocity / (conduction.diffusivity() * wavenumber);
        let real = (0.5 * (1.0 + transport.hypot(1.0))).sqrt();
        let root = Complex64::new(real, -0.5 * transport / real);
        let excess = Complex64::new(0.0, -transport * wavenumber) / (root + 1.0);
        Self { wavenumber, rate: root * wavenumber, excess }
    }

    /// s + k, 1/length.
    pub fn sum(&self) -> Complex64 {
        self.rate + self.wavenumber
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_square_is_that_of_the_wavenumber_and_the_transport() {
        for (k, velocity) in [([0.3, -0.4], 0.0), ([0.3, 0.4], 2.0), ([-5.0, 1.0], 1e-9), ([1e-6, 0.0], 3e5)] {
            let conduction = Conduction::new(1.0, 0.7, 0.0).unwrap();
            let found = ThermalRate::new(k, velocity, &conduction);
            let square = Complex64::new(k[0] * k[0] + k[1] * k[1], -k[0] * velocity / 0.7);
            assert!((found.rate * found.rate - square).norm() < 4.0 * f64::EPSILON * square.norm());
            let difference = found.excess * found.sum() - Complex64::new(0.0, square.im);
            assert!(difference.norm() <= 4.0 * f64::EPSILON * square.im.abs());
            assert!(
                found.excess.re >= 0.0 && (found.rate - found.wavenumber - found.excess).norm() < 1e-15 * square.norm()
            );
        }
    }
}
