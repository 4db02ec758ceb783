//! How a material conducts heat and expands.
//!
//! Steady in the frame of a source that moves along x with the velocity v, the temperature T above that of the body far away obeys
//!
//! λ∇²T + (λv/κ) ∂T/∂x = 0,  q = −λ∇T,  ε = αT,
//!
//! H. S. Carslaw & J. C. Jaeger, *Conduction of Heat in Solids*, 2nd ed. (1959), § 1.7.

use crate::notation::number;
use std::fmt;

/// Why a conduction cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ConductionError {
    /// Conductivity not positive and finite.
    #[error("a thermal conductivity must be positive and finite, not {0}")]
    Conductivity(f64),
    /// Diffusivity not positive and finite.
    #[error("a thermal diffusivity must be positive and finite, not {0}")]
    Diffusivity(f64),
    /// Expansion negative or not finite.
    #[error("a coefficient of thermal expansion must be finite and not negative, not {0}")]
    Expansion(f64),
    /// Resistance of an interface negative or not a number.
    #[error("the thermal resistance of an interface must not be negative (infinite: it insulates), not {0}")]
    Resistance(f64),
}

/// Conduction of heat in a material, and its expansion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conduction {
    conductivity: f64,
    diffusivity: f64,
    expansion: f64,
}

impl Conduction {
    /// Conduction with the conductivity λ > 0 (a power per length and temperature), the diffusivity κ > 0 (an area per time) and the
    /// coefficient α ≥ 0 of linear expansion (one over a temperature).
    ///
    /// # Errors
    /// [`ConductionError`] for values out of range.
    pub fn new(conductivity: f64, diffusivity: f64, expansion: f64) -> Result<Self, ConductionError> {
        if !(conductivity.is_finite() && conductivity > 0.0) {
            return Err(ConductionError::Conductivity(conductivity));
        }
        if !(diffusivity.is_finite() && diffusivity > 0.0) {
            return Err(ConductionError::Diffusivity(diffusivity));
        }
        if !(expansion.is_finite() && expansion >= 0.0) {
            return Err(ConductionError::Expansion(expansion));
        }
        Ok(Self { conductivity, diffusivity, expansion })
    }

    /// Conductivity λ, a power per length and temperature.
    pub fn conductivity(&self) -> f64 {
        self.conductivity
    }

    /// Diffusivity κ, an area per time.
    pub fn diffusivity(&self) -> f64 {
        self.diffusivity
    }

    /// Coefficient α of linear thermal expansion, one over a temperature.
    pub fn expansion(&self) -> f64 {
        self.expansion
    }
}

impl fmt::Display for Conduction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [conductivity, diffusivity, expansion] = [self.conductivity, self.diffusivity, self.expansion].map(number);
        write!(f, "λ {conductivity}, κ {diffusivity}, α {expansion}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(Conduction::new(0.0, 1.0, 0.0), Err(ConductionError::Conductivity(0.0)));
        assert_eq!(Conduction::new(1.0, f64::INFINITY, 0.0), Err(ConductionError::Diffusivity(f64::INFINITY)));
        assert_eq!(Conduction::new(1.0, 1.0, -1e-6), Err(ConductionError::Expansion(-1e-6)));
        assert!(Conduction::new(50.0, 1.4e-5, f64::NAN).is_err());
        assert_eq!(Conduction::new(50.0, 1.4e-5, 0.0).map(|steel| steel.expansion()), Ok(0.0));
    }
}
