//! Tension over the gap as a grid holds it: Dugdale's law with a soft end.
//!
//! τ = σ₀ for g < g₀(1 − η/2), then σ₀[1 − x²(3 − 2x)] with x from 0 to 1 up to g₀(1 + η/2). The work of adhesion is w for every η. A sharp end
//! (η = 0) locks the border of the zone that pulls on the samples; η = min(1, 6Δ/ℓ) does not, with the spacing Δ and the width ℓ of that zone.
//! The exponential law needs none.

use crate::adhesion::{Adhesion, AdhesionLaw};
use std::f64::consts::LN_10;

/// Width of the soft end over g₀, times the samples of the zone that pulls.
const SOFT_END: f64 = 6.0;

/// Width η of the soft end over the range, with so many samples across the zone that pulls beside contact.
pub fn soft_end(samples: f64) -> f64 {
    (SOFT_END / samples).min(1.0)
}

/// Tension between two surfaces over their gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::spectral) struct Tension {
    adhesion: Adhesion,
    /// η of Dugdale's law.
    end: f64,
}

impl Tension {
    /// The tension on a grid with some spacing, between surfaces whose materials have E* = `modulus`.
    pub fn on_grid(adhesion: Adhesion, modulus: f64, spacing: f64) -> Self {
        Self { adhesion, end: soft_end(adhesion.cohesive_zone(modulus) / spacing) }
    }

    /// σ₀, a pressure.
    pub fn strength(&self) -> f64 {
        self.adhesion.strength()
    }

    /// Range g₀ or ρ, a length.
    pub fn range(&self) -> f64 {
        self.adhesion.range()
    }

    /// Gap beyond which nothing pulls, or a part of 10⁻¹² of the strength, a length.
    pub fn reach(&self) -> f64 {
        match self.adhesion.law() {
            AdhesionLaw::Dugdale => self.adhesion.range() * (1.0 + 0.5 * self.end),
            AdhesionLaw::Exponential => self.adhesion.range() * 12.0 * LN_10,
        }
    }

    /// τ(g), a pressure.
    pub fn at(&self, gap: f64) -> f64 {
        let strength = self.strength();
        match (self.adhesion.law(), self.part(gap)) {
            (AdhesionLaw::Exponential, _) => strength * (-gap / self.adhesion.range()).exp(),
            (AdhesionLaw::Dugdale, x) => strength * (1.0 - x * x * (3.0 - 2.0 * x)),
        }
    }

    /// −dτ/dg ≥ 0, a pressure per length.
    pub fn softening(&self, gap: f64) -> f64 {
        let (strength, range) = (self.strength(), self.adhesion.range());
        match (self.adhesion.law(), self.part(gap)) {
            (AdhesionLaw::Exponential, _) => strength / range * (-gap / range).exp(),
            (AdhesionLaw::Dugdale, x) => strength * 6.0 * x * (1.0 - x) / (range * self.end),
        }
    }

    /// Energy φ(g) = −∫ τ from g on, a pressure times a length; −w in contact.
    pub fn energy(&self, gap: f64) -> f64 {
        let (strength, range) = (self.strength(), self.adhesion.range());
        match (self.adhesion.law(), self.part(gap)) {
            (AdhesionLaw::Exponential, _) => -self.adhesion.work() * (-gap / range).exp(),
            (AdhesionLaw::Dugdale, 0.0) => strength * gap - self.adhesion.work(),
            (AdhesionLaw::Dugdale, x) => -strength * range * self.end * (0.5 - x + x.powi(3) - 0.5 * x.powi(4)),
        }
    }

    /// Place x within the soft end of Dugdale's law, from 0 to 1.
    fn part(&self, gap: f64) -> f64 {
        ((gap / self.adhesion.range() - 1.0) / self.end + 0.5).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Differences of φ are τ, those of τ the softening; φ(0) = −w whatever the spacing.
    #[test]
    fn tension_and_softening_are_derivatives_of_the_energy() {
        for law in [AdhesionLaw::Dugdale, AdhesionLaw::Exponential] {
            let adhesion = Adhesion::new(0.03, 0.2, law).unwrap();
            for spacing in [1e-3, 0.05, 10.0] {
                let tension = Tension::on_grid(adhesion, 1.0, spacing);
                assert!((tension.energy(0.0) + 0.03).abs() < 1e-16 && tension.at(0.0) == tension.strength());
                let h = 1e-6;
                for k in 1..60 {
                    let gap = 0.0101 * f64::from(k);
                    let slope = |of: &dyn Fn(f64) -> f64| (of(gap + h) - of(gap - h)) / (2.0 * h);
                    let [tau, softening] = [slope(&|g| tension.energy(g)), -slope(&|g| tension.at(g))];
                    assert!((tau - tension.at(gap)).abs() < 1e-8, "{law}, {spacing}, {gap}: {tau}");
                    assert!((softening - tension.softening(gap)).abs() < 1e-4, "{law}, {spacing}, {gap}: {softening}");
                }
            }
        }
    }
}
