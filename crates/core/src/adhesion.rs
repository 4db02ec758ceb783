//! Adhesion: the tension with which two surfaces pull each other across their gap.
//!
//! Two laws of the gap g, with the work of adhesion w = ∫ τ dg and the strength σ₀ = τ(0):
//!
//! - **Dugdale**: τ = σ₀ for g < g₀, 0 beyond; w = σ₀ g₀;
//! - **exponential**: τ = (w/ρ) e^{−g/ρ}.
//!
//! Between the limits of stiff surfaces that pull far (DMT) and of soft ones that pull near (JKR) Tabor's parameter decides,
//! μ = (R w²/E*² g₀³)^{1/3}, E* of the materials at the two surfaces. D. Maugis, J. Colloid Interface Sci. 150 (1992) 243.

use crate::notation::number;
use crate::numeric::search::golden_maximum;
use std::f64::consts::PI;
use std::fmt;

/// Law of the tension over the gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AdhesionLaw {
    /// A constant tension up to a gap.
    #[default]
    Dugdale,
    /// A tension that falls exponentially.
    Exponential,
}

/// Why adhesion cannot be built from its values.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum AdhesionError {
    /// A work of adhesion that is not above 0, or not finite.
    #[error("a work of adhesion must be finite and greater than 0, not {0}")]
    Work(f64),
    /// A range that is not above 0, or not finite.
    #[error("a range of adhesion must be finite and greater than 0, not {0}")]
    Range(f64),
    /// A pressure is given, and no surface pulls.
    #[error("adhesion needs a counterbody: a given pressure has no surface that pulls")]
    Given,
    /// A surface has a hardness.
    #[error("surfaces that adhere are elastic here: leave their hardness out")]
    Hardness,
    /// Friction that displaces the surfaces normally.
    #[error(
        "friction of surfaces that adhere is not coupled here: the traction μ times the contact pressure displaces nothing"
    )]
    Coupled,
}

/// Adhesion of two surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adhesion {
    work: f64,
    range: f64,
    law: AdhesionLaw,
}

/// Regime of adhesion by Tabor's parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// μ < 0.1: Derjaguin, Muller & Toporov.
    Dmt,
    /// Between both limits.
    Between,
    /// μ > 5: Johnson, Kendall & Roberts.
    Jkr,
}

impl Adhesion {
    /// Adhesion with the work w, a pressure times a length, and the range, a length: g₀ of Dugdale's law, ρ of the exponential one.
    ///
    /// # Errors
    /// [`AdhesionError`] for a work or a range out of range.
    pub fn new(work: f64, range: f64, law: AdhesionLaw) -> Result<Self, AdhesionError> {
        let is_size = |x: f64| x.is_finite() && x > 0.0;
        match (is_size(work), is_size(range)) {
            (false, _) => Err(AdhesionError::Work(work)),
            (_, false) => Err(AdhesionError::Range(range)),
            _ => Ok(Self { work, range, law }),
        }
    }

    /// Work of adhesion w of both surfaces, a pressure times a length.
    pub fn work(&self) -> f64 {
        self.work
    }

    /// Range g₀ or ρ, a length.
    pub fn range(&self) -> f64 {
        self.range
    }

    /// Law of the tension over the gap.
    pub fn law(&self) -> AdhesionLaw {
        self.law
    }

    /// Largest tension σ₀ = w/range, that of surfaces in contact, a pressure.
    pub fn strength(&self) -> f64 {
        self.work / self.range
    }

    /// Width ℓ = (π/4) E*w/σ₀² of the zone in which surfaces pull beside a contact, a length, with E* of the materials at the surfaces.
    pub fn cohesive_zone(&self, modulus: f64) -> f64 {
        0.25 * PI * modulus * self.work / self.strength().powi(2)
    }

    /// Tabor's parameter μ of an apex of some radius, with E* of the materials at the surfaces.
    pub fn tabor(&self, radius: f64, modulus: f64) -> f64 {
        (radius * (self.work / modulus).powi(2) / self.range.powi(3)).cbrt()
    }

    /// Maugis' parameter λ = 2σ₀ (R/πwK²)^{1/3} = 1.157 μ, K = 4E*/3, of an apex of some radius.
    pub fn maugis(&self, radius: f64, modulus: f64) -> f64 {
        2.0 * self.strength() * (radius / (PI * self.work * (4.0 / 3.0 * modulus).powi(2))).cbrt()
    }
}

impl Regime {
    /// The regime at a Tabor parameter.
    pub fn of(tabor: f64) -> Self {
        match tabor {
            _ if tabor < 0.1 => Self::Dmt,
            _ if tabor > 5.0 => Self::Jkr,
            _ => Self::Between,
        }
    }
}

impl fmt::Display for Regime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Dmt => "DMT",
            Self::Between => "between DMT and JKR",
            Self::Jkr => "JKR",
        })
    }
}

impl fmt::Display for Adhesion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [work, range, strength] = [self.work, self.range, self.strength()].map(number);
        write!(f, "adhesion, {}: work {work}, range {range}, strength {strength}", self.law)
    }
}

impl fmt::Display for AdhesionLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Dugdale => "dugdale",
            Self::Exponential => "exponential",
        })
    }
}

/// A sphere on a bare half-space by Maugis' theory of Dugdale's law, in his units: forces in πwR, radii in (πwR²/K)^{1/3}, penetrations in
/// (π²w²R/K²)^{1/3}, K = 4E*/3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaugisState {
    /// Contact radius.
    pub radius: f64,
    /// Outer radius of the zone that pulls, over the contact radius.
    pub ratio: f64,
    /// Force.
    pub force: f64,
    /// Penetration.
    pub penetration: f64,
}

impl MaugisState {
    /// The state with a contact radius at the parameter λ.
    pub fn at(radius: f64, lambda: f64) -> Self {
        // ∫ τ over the zone rises with its ratio: bisection for ½λa²[s + (m² − 2) arcsec m] + ⁴⁄₃λ²a[s arcsec m − m + 1] = 1, s = √(m² − 1).
        let parts = |m: f64| ((m * m - 1.0).sqrt(), (1.0 / m).acos());
        let excess = |m: f64| {
            let (s, arc) = parts(m);
            0.5 * lambda * radius * radius * (s + (m * m - 2.0) * arc)
                + 4.0 / 3.0 * lambda * lambda * radius * (s * arc - m + 1.0)
                - 1.0
        };
        let mut high = 2.0;
        while excess(high) < 0.0 {
            high *= 2.0;
        }
        let mut low = 1.0;
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if excess(middle) < 0.0 { low = middle } else { high = middle }
        }
        let ratio = 0.5 * (low + high);
        let (s, arc) = parts(ratio);
        Self {
            radius,
            ratio,
            force: radius.powi(3) - lambda * radius * radius * (s + ratio * ratio * arc),
            penetration: radius * radius - 4.0 / 3.0 * lambda * radius * s,
        }
    }

    /// The state of the least force, pull-off under a load, at the parameter λ.
    pub fn pull_off(lambda: f64) -> Self {
        let [radius, _] = golden_maximum([1e-3, 2.0], 1e-9, |a| -Self::at(a, lambda).force);
        Self::at(radius, lambda)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An independent program in arithmetic of 30 digits (pull-off: force, penetration, radius, ratio).
    #[test]
    fn pull_off_by_maugis_is_that_of_an_independent_program() {
        for (lambda, [force, penetration, radius, ratio]) in [
            (0.1, [-1.95059489, -0.43039486, 0.19919259, 17.727401]),
            (0.5, [-1.71824527, -0.53044484, 0.67887768, 2.407827]),
            (1.0, [-1.60073491, -0.48423656, 0.90376864, 1.471631]),
            (2.0, [-1.53460324, -0.45293027, 1.05137696, 1.144085]),
            (5.0, [-1.50634997, -0.43968740, 1.12624443, 1.025551]),
        ] {
            let found = MaugisState::pull_off(lambda);
            assert!((found.force - force).abs() < 2e-8, "{lambda}: {found:?}");
            for (a, b) in [(found.penetration, penetration), (found.radius, radius), (found.ratio, ratio)] {
                // The place of a minimum is as certain as the root of its value.
                assert!((a - b).abs() < 1e-5 * b.abs(), "{lambda}: {found:?}");
            }
        }
        let state = MaugisState::at(1.2, 2.0);
        assert!((state.force + 1.47557763332).abs() < 1e-10 && (state.penetration + 0.20239728667).abs() < 1e-10);
    }

    #[test]
    fn parameters_are_those_of_tabor_and_maugis() {
        // E* = R = 1, w = 4/3π: K = 4/3 and Maugis' units are 1, so that λ = 3σ₀/2.
        let adhesion = Adhesion::new(4.0 / (3.0 * PI), 0.5, AdhesionLaw::Dugdale).unwrap();
        let (lambda, tabor) = (adhesion.maugis(1.0, 1.0), adhesion.tabor(1.0, 1.0));
        assert!((lambda - 1.5 * adhesion.strength()).abs() < 1e-14);
        assert!((lambda / tabor - 2.0 * (9.0 / (16.0 * PI)).cbrt()).abs() < 1e-14);
        assert!((adhesion.cohesive_zone(1.0) - 0.75 / lambda.powi(2)).abs() < 1e-14);
        assert_eq!([0.05, 1.0, 6.0].map(Regime::of), [Regime::Dmt, Regime::Between, Regime::Jkr]);
        assert_eq!(Adhesion::new(-1.0, 1.0, AdhesionLaw::Dugdale), Err(AdhesionError::Work(-1.0)));
        assert_eq!(
            Adhesion::new(1.0, f64::NAN, AdhesionLaw::Dugdale).map_err(|error| error.to_string()).unwrap_err(),
            "a range of adhesion must be finite and greater than 0, not NaN"
        );
    }
}
