//! One wave of temperature in one material.
//!
//! In a layer of the thickness h, y above its lower face,
//!
//! T = [a cosh(sy) + b sinh(sy)]/cosh(sh) = A e^{−s(h−y)} + B e^{−sy},  A = (a + b)/(1 + e^{−2sh}),  B = (a − b)e^{−sh}/(1 + e^{−2sh}),
//!
//! and the flux into the depth is λ ∂T/∂y. The first form has no cancellation in thin layers, and neither grows in thick ones. In the
//! substrate T = A e^{−sz} from its upper face.

use super::exponentials::{decay, loss};
use super::thermal_rate::ThermalRate;
use crate::body::Depth;
use crate::numeric::number::Number;
use rustfft::num_complex::Complex64;

/// |s|h below which the exponentials of a layer would cancel.
const THIN: f64 = 1.0;

/// Wave of temperature in one material, over the amplitude of the flux into the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ConductingMaterial {
    pub rate: ThermalRate,
    /// λ, a power per length and temperature.
    pub conductivity: f64,
    /// Depths of the upper and the lower face, lengths; the lower one of the substrate is infinite.
    pub faces: [f64; 2],
    /// h, a length; infinite in the substrate.
    pub thickness: f64,
    /// a and b, temperatures per flux: at the lower face the temperature and the flux over λs, both times cosh sh. In the substrate
    /// both are the temperature of its upper face.
    pub lower: [Complex64; 2],
}

impl ConductingMaterial {
    /// Distance below the upper face, a length between 0 and h: exact at both faces.
    pub fn below(&self, depth: Depth) -> f64 {
        let [top, bottom] = self.faces;
        let [below, above] = [depth.z - top, bottom - depth.z].map(|distance| distance.clamp(0.0, self.thickness));
        if below < above { below } else { self.thickness - above }
    }

    /// Whether the layer is thin against the decay of its temperature.
    pub fn is_thin(&self) -> bool {
        self.rate.rate.norm() * self.thickness < THIN
    }

    /// A and B.
    pub fn exponentials(&self) -> [Complex64; 2] {
        let [a, b] = self.lower;
        if self.thickness.is_infinite() {
            return [a, Complex64::default()];
        }
        let once = decay(self.rate.rate * self.thickness);
        let unit = (once * once + 1.0).inv();
        [(a + b) * unit, (a - b) * once * unit]
    }

    /// T at a distance below the upper face, and the flux into the depth over λs.
    fn state(&self, below: f64) -> [Complex64; 2] {
        let ([a, b], rate) = (self.lower, self.rate.rate);
        if self.thickness.is_infinite() {
            let part = a * decay(rate * below);
            return [part; 2];
        }
        let twice = rate * (2.0 * (self.thickness - below));
        let unit = decay(rate * below).over(decay(rate * (2.0 * self.thickness)) + 1.0);
        let [cosh, sinh] = [decay(twice) + 1.0, loss(twice)].map(|part| part * unit);
        [a * cosh + b * sinh, a * sinh + b * cosh]
    }

    /// T at a distance below the upper face, a temperature per flux.
    pub fn temperature(&self, below: f64) -> Complex64 {
        self.state(below)[0]
    }

    /// Flux into the depth at a distance below the upper face, over that into the surface.
    pub fn flux(&self, below: f64) -> Complex64 {
        self.state(below)[1] * self.rate.rate * self.conductivity
    }
}
