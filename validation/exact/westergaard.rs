//! A wave Δ cos(2πx/λ) pressed into a half-space (Westergaard, J. Appl. Mech. 6 (1939) A49).
//!
//! Contact is complete at p* = πE*Δ/λ. Below it, ψ = πx/λ from a crest, the contact reaches to ψ_a with
//! sin²ψ_a = p̄/p*, and p = 2p̄ cos ψ/sin²ψ_a √(sin²ψ_a − sin²ψ); the largest pressure is 2√(p̄p*).

use std::f64::consts::PI;

/// A wave on a half-space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// Amplitude Δ, a length.
    pub amplitude: f64,
    /// Wavelength λ, a length.
    pub wavelength: f64,
    /// Contact modulus E*, a pressure.
    pub modulus: f64,
}

impl Wave {
    /// Mean pressure p* of complete contact.
    pub fn complete(&self) -> f64 {
        PI * self.modulus * self.amplitude / self.wavelength
    }

    /// Fraction of the surface in contact under p̄ = `fraction` · p*, `fraction` up to 1.
    pub fn contact_fraction(&self, fraction: f64) -> f64 {
        2.0 / PI * fraction.sqrt().asin()
    }

    /// Largest pressure under p̄ = `fraction` · p*.
    pub fn peak(&self, fraction: f64) -> f64 {
        2.0 * fraction.sqrt() * self.complete()
    }

    /// Pressure at the distance x from a crest under p̄ = `fraction` · p*.
    pub fn pressure(&self, fraction: f64, x: f64) -> f64 {
        let psi = PI * x / self.wavelength;
        let inside = (fraction - psi.sin().powi(2)).max(0.0);
        2.0 * self.complete() * psi.cos().abs() * inside.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pressure_has_its_mean_and_its_peak() {
        let wave = Wave { amplitude: 0.02, wavelength: 0.7, modulus: 3.0 };
        for fraction in [0.1, 0.5, 1.0] {
            let steps = 20_000;
            let place = |i: i32| (f64::from(i) + 0.5) / f64::from(steps) * wave.wavelength;
            let mean = (0..steps).map(|i| wave.pressure(fraction, place(i))).sum::<f64>() / f64::from(steps);
            assert!((mean / (fraction * wave.complete()) - 1.0).abs() < 1e-5, "{mean}");
            assert!((wave.pressure(fraction, 0.0) / wave.peak(fraction) - 1.0).abs() < 1e-14);
        }
    }
}
