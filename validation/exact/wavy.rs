//! Wavy surfaces with square and hexagonal symmetry: first touch, complete contact, and what lies next to them.
//!
//! Heights Δ·wave on a cell of area A₀ and side 1, E* = 1. One wavelength of wavenumber q gives p* = E*q/2 · Δ · max(−wave).
//!
//! - light load: Hertz at each of n crests of curvature 1/R, A = nπa²/A₀, a³ = 3(p̄A₀/n)R/(4E*), largest pressure
//!   3p̄/(2A); the next terms are smaller by (p̄/p*)^{2/3};
//! - near complete contact each hole is a crack that closes when its stress intensity vanishes:
//!   1 − A = c(1 − p̄/p*).
//!
//! Egg-box: Johnson, Greenwood & Higginson, Int. J. Mech. Sci. 27 (1985) 383: p* = √2πE*Δ/λ, c = 3/(2π). The hexagonal
//! ones follow by the same two arguments.

use percoat_core::lattice::{Cell, LatticeError};
use std::f64::consts::{PI, TAU};

/// K = 4π/(√3 l), the least wavenumber of the hexagonal cell of period l = 1.
const K: f64 = 4.0 * PI / 1.732_050_807_568_877_2;

/// A regular wavy surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wavy {
    /// cos 2πs · cos 2πt on the square cell: two crests in the cell.
    EggBox,
    /// cos 2πs + cos 2πt + cos 2π(s+t) on the hexagonal cell: one crest, two hollows.
    Peaks,
    /// [`Self::Peaks`] upside down: two crests, one hollow.
    Holes,
}

impl Wavy {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::EggBox, Self::Peaks, Self::Holes];

    /// Name for reports and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::EggBox => "egg-box",
            Self::Peaks => "triangular peaks",
            Self::Holes => "triangular holes",
        }
    }

    /// The cell, side 1.
    ///
    /// # Errors
    /// None in practice: the sides are fixed.
    pub fn cell(self) -> Result<Cell, LatticeError> {
        match self {
            Self::EggBox => Cell::square(1.0),
            Self::Peaks | Self::Holes => Cell::hexagonal(1.0),
        }
    }

    /// Height over Δ at the fractions s, t of the cell vectors.
    pub fn height(self, s: f64, t: f64) -> f64 {
        let cosines = || (TAU * s).cos() + (TAU * t).cos() + (TAU * (s + t)).cos();
        match self {
            Self::EggBox => (TAU * s).cos() * (TAU * t).cos(),
            Self::Peaks => cosines(),
            Self::Holes => -cosines(),
        }
    }

    /// Wavenumber of all its waves.
    pub fn wavenumber(self) -> f64 {
        match self {
            Self::EggBox => TAU * 2f64.sqrt(),
            Self::Peaks | Self::Holes => K,
        }
    }

    /// p*/(E*Δ): least mean pressure of complete contact.
    pub fn complete(self) -> f64 {
        match self {
            Self::EggBox => 2f64.sqrt() * PI,
            Self::Peaks => 0.75 * K,
            Self::Holes => 1.5 * K,
        }
    }

    /// Crests in the cell, and ΔR of each.
    fn crests(self) -> (f64, f64) {
        match self {
            Self::EggBox => (2.0, 1.0 / (TAU * TAU)),
            Self::Peaks => (1.0, 1.0 / (1.5 * K * K)),
            Self::Holes => (2.0, 1.0 / (0.75 * K * K)),
        }
    }

    /// Fraction in contact under p̄ = `fraction` · p* as `fraction` → 0.
    pub fn light(self, fraction: f64) -> f64 {
        let area = if self == Self::EggBox { 1.0 } else { 0.75f64.sqrt() };
        let (count, radius) = self.crests();
        // Δ cancels: p̄ grows and R falls with it.
        let cube = 0.75 * fraction * self.complete() * area / count * radius;
        count * PI * cube.powf(2.0 / 3.0) / area
    }

    /// Largest pressure over p* under p̄ = `fraction` · p* as `fraction` → 0.
    pub fn light_peak(self, fraction: f64) -> f64 {
        1.5 * fraction / self.light(fraction)
    }

    /// Fraction in contact under p̄ = `fraction` · p* as `fraction` → 1.
    pub fn nearly_complete(self, fraction: f64) -> f64 {
        let holes = match self {
            Self::EggBox => 1.5 / PI,
            Self::Peaks => 1.5 * 3f64.sqrt() / PI,
            Self::Holes => 0.75 * 3f64.sqrt() / PI,
        };
        1.0 - holes * (1.0 - fraction)
    }

    /// Fractions of the cell vectors at which neighbouring contacts first meet.
    pub fn saddle(self) -> [f64; 2] {
        match self {
            Self::EggBox => [0.25, 0.25],
            Self::Peaks | Self::Holes => [0.5, 0.0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_loads_have_the_printed_form() {
        // Johnson, Greenwood & Higginson (1985): A = π(3p̄/(8πp*))^{2/3}.
        for fraction in [1e-3, 0.01] {
            let printed = PI * (3.0 * fraction / (8.0 * PI)).powf(2.0 / 3.0);
            assert!((Wavy::EggBox.light(fraction) / printed - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn complete_contact_lowers_the_deepest_hollow_to_no_pressure() {
        for wavy in Wavy::ALL {
            let lowest = (0..144).map(|i| wavy.height(f64::from(i / 12) / 12.0, f64::from(i % 12) / 12.0));
            let lowest = lowest.fold(f64::INFINITY, f64::min);
            assert!((wavy.complete() + 0.5 * wavy.wavenumber() * lowest).abs() < 1e-13, "{wavy:?}");
        }
    }
}
