//! Laws of life by strain, the transfer functions by which layers of pavements are designed: N = N₀ (ε₀/ε)^n passes of a load that makes
//! the strain ε.

use super::MaterialError;
use serde::{Deserialize, Serialize};

/// The strain by which a material is worn out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StrainDirection {
    /// The largest extension of the horizontal directions: asphalt cracks from its bottom.
    Tension,
    /// The largest compression along z, −ε_zz: a subgrade ruts from its top.
    Compression,
}

/// Passes to failure of a material by its largest strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainLife {
    strain: f64,
    passes: f64,
    exponent: f64,
    direction: StrainDirection,
}

impl StrainLife {
    /// Failure after N₀ = `passes` of the strain ε₀ = `strain`, fewer with the power n = `exponent` of a larger one.
    ///
    /// # Errors
    /// [`MaterialError::StrainLife`] for a number that is not positive and finite.
    pub fn new(strain: f64, passes: f64, exponent: f64, direction: StrainDirection) -> Result<Self, MaterialError> {
        let is_size = |value: f64| value.is_finite() && value > 0.0;
        let wrong = [strain, passes, exponent].into_iter().find(|value| !is_size(*value));
        wrong.map_or(Ok(Self { strain, passes, exponent, direction }), |value| Err(MaterialError::StrainLife(value)))
    }

    /// Strain ε₀.
    pub fn strain(&self) -> f64 {
        self.strain
    }

    /// Passes N₀ to failure under the strain ε₀.
    pub fn passes(&self) -> f64 {
        self.passes
    }

    /// Exponent n.
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// The strain that counts.
    pub fn direction(&self) -> StrainDirection {
        self.direction
    }

    /// Damage in one pass, (1/N₀)(ε/ε₀)^n, by a strain ε ≥ 0.
    pub fn damage(&self, strain: f64) -> f64 {
        (strain / self.strain).powf(self.exponent) / self.passes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tenth_more_strain_costs_the_power_of_it_in_passes() {
        let law = StrainLife::new(2e-4, 1e6, 3.291, StrainDirection::Tension).unwrap();
        assert!((1e6 * law.damage(2e-4) - 1.0).abs() < 1e-15 && law.damage(0.0) == 0.0);
        assert!((law.damage(2.2e-4) / law.damage(2e-4) / 1.1f64.powf(3.291) - 1.0).abs() < 1e-13);
        let refused = StrainLife::new(2e-4, 0.0, 3.0, StrainDirection::Compression);
        assert_eq!(refused, Err(MaterialError::StrainLife(0.0)));
    }
}
