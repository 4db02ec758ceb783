//! Hardness, wear and fatigue: what a material bears when it is pressed, rubbed and loaded again and again.
//!
//! - **Hardness** H: the pressure on a surface never exceeds that of the softer one, 0 ≤ p ≤ H.
//! - **Wear** (Archard): ∂h/∂s = k p, the depth h worn off along a path s of sliding by the pressure p, k in one over a pressure.
//! - **Fatigue** (Goryacheva & Torskaya, Wear 268 (2010) 1417): a range Δτ of the shear stress does the damage (1/N₀)(Δτ/τ₀)^m in
//!   each pass. Damage adds; at 1 the material fails.
//! - **Endurance** limits τ₋₁ in alternating torsion and σ₋₁ in alternating bending, below which it bears any number of passes: those of
//!   the criteria of Crossland and of Dang Van.

use super::{MaterialError, StrainLife};

/// Damage of a material or an interface by a range of the shear stress, pass by pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fatigue {
    amplitude: f64,
    passes: f64,
    exponent: f64,
}

impl Fatigue {
    /// Damage 1 after N₀ = `passes` of the range τ₀ = `amplitude` (a pressure), growing with the power m = `exponent` of the range.
    ///
    /// # Errors
    /// [`MaterialError::Fatigue`] for one that is not positive and finite.
    pub fn new(amplitude: f64, passes: f64, exponent: f64) -> Result<Self, MaterialError> {
        let wrong = [amplitude, passes, exponent].into_iter().find(|value| !is_size(*value));
        wrong.map_or(Ok(Self { amplitude, passes, exponent }), |value| Err(MaterialError::Fatigue(value)))
    }

    /// Range τ₀ of the shear stress, a pressure.
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// Passes N₀ to failure under the range τ₀.
    pub fn passes(&self) -> f64 {
        self.passes
    }

    /// Exponent m.
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// Damage in one pass, (1/N₀)(Δτ/τ₀)^m, by a range Δτ ≥ 0 of the shear stress, a pressure.
    pub fn damage(&self, range: f64) -> f64 {
        (range / self.amplitude).powf(self.exponent) / self.passes
    }
}

/// Endurance limits of a material, pressures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Endurance {
    torsion: f64,
    bending: f64,
}

impl Endurance {
    /// Limits of the amplitude: τ₋₁ of the shear stress in alternating `torsion`, and σ₋₁ of the stress in alternating `bending`.
    ///
    /// # Errors
    /// [`MaterialError::Strength`] for one that is not positive and finite, and [`MaterialError::Endurance`] for a limit of bending
    /// above √3 times that of torsion, from where on tension would do good in Crossland's criterion.
    pub fn new(torsion: f64, bending: f64) -> Result<Self, MaterialError> {
        if let Some(wrong) = [torsion, bending].into_iter().find(|value| !is_size(*value)) {
            return Err(MaterialError::Strength(wrong));
        }
        if bending > 3f64.sqrt() * torsion {
            Err(MaterialError::Endurance(bending / torsion))
        } else {
            Ok(Self { torsion, bending })
        }
    }

    /// τ₋₁ in alternating torsion, a pressure.
    pub fn torsion(&self) -> f64 {
        self.torsion
    }

    /// σ₋₁ in alternating bending, a pressure.
    pub fn bending(&self) -> f64 {
        self.bending
    }

    /// Utilisation of Crossland's criterion, [√J₂,a + (3τ₋₁/σ₋₁ − √3) σ_H,max]/τ₋₁, by the amplitude √J₂,a of the deviator and the
    /// largest hydrostatic stress (tension positive), pressures: 1 at the limit.
    pub fn crossland(&self, amplitude: f64, hydrostatic: f64) -> f64 {
        (amplitude + (3.0 * self.torsion / self.bending - 3f64.sqrt()) * hydrostatic) / self.torsion
    }

    /// Utilisation of Dang Van's criterion at one moment of the path, [τ_a + 3(τ₋₁/σ₋₁ − ½) σ_H]/τ₋₁, by the shear stress τ_a of the
    /// deviator about the centre of its path and the hydrostatic stress at that moment, pressures: 1 at the limit.
    pub fn dang_van(&self, shear: f64, hydrostatic: f64) -> f64 {
        (shear + 3.0 * (self.torsion / self.bending - 0.5) * hydrostatic) / self.torsion
    }
}

/// Hardness, wear and fatigue of a material. Limits that are not given are infinite, and without a coefficient nothing
/// wears.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Durability {
    /// Hardness H, a pressure.
    pub hardness: Option<f64>,
    /// Coefficient k of wear, one over a pressure.
    pub wear: Option<f64>,
    /// Damage by the range of the principal shear stress.
    pub fatigue: Option<Fatigue>,
    /// Endurance limits.
    pub endurance: Option<Endurance>,
    /// Passes to failure by the largest strain.
    pub strain_life: Option<StrainLife>,
}

impl Durability {
    pub(super) fn check(self) -> Result<Self, MaterialError> {
        match (self.hardness, self.wear) {
            (Some(hardness), _) if !is_size(hardness) => Err(MaterialError::Hardness(hardness)),
            (_, Some(wear)) if !(wear.is_finite() && wear >= 0.0) => Err(MaterialError::Wear(wear)),
            _ => Ok(self),
        }
    }
}

fn is_size(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damage_is_one_after_as_many_passes_as_the_law_states() {
        let law = Fatigue::new(0.4, 1e6, 8.0).unwrap();
        assert!((1e6 * law.damage(0.4) - 1.0).abs() < 1e-15);
        assert!((law.damage(0.8) / law.damage(0.4) / 256.0 - 1.0).abs() < 1e-13 && law.damage(0.0) == 0.0);
    }

    /// Alternating torsion has √J₂ = τ, alternating bending √J₂ = σ/√3, σ_H = σ/3 and the shear stress σ/2: at its own limit each
    /// utilisation is 1.
    #[test]
    fn the_tests_that_give_the_limits_are_at_them() {
        let (torsion, bending) = (0.29, 0.45);
        let endurance = Endurance::new(torsion, bending).unwrap();
        for found in [
            endurance.crossland(torsion, 0.0),
            endurance.crossland(bending / 3f64.sqrt(), bending / 3.0),
            endurance.dang_van(torsion, 0.0),
            endurance.dang_van(bending / 2.0, bending / 3.0),
        ] {
            assert!((found - 1.0).abs() < 1e-15, "{found}");
        }
    }

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(Fatigue::new(0.0, 1.0, 1.0), Err(MaterialError::Fatigue(0.0)));
        assert!(Fatigue::new(1.0, f64::INFINITY, 1.0).is_err() && Fatigue::new(1.0, 1.0, -2.0).is_err());
        assert_eq!(Endurance::new(1.0, 1.8), Err(MaterialError::Endurance(1.8)));
        let durability = Durability { hardness: Some(0.0), ..Durability::default() };
        assert_eq!(durability.check(), Err(MaterialError::Hardness(0.0)));
        let durability = Durability { wear: Some(-1.0), ..Durability::default() };
        assert_eq!(durability.check(), Err(MaterialError::Wear(-1.0)));
    }
}
