//! The prescribed quantity of a load step: mean pressure or penetration.

use crate::notation::number;
use std::fmt;

/// The prescribed quantity of a load step and its value.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Load {
    /// Mean pressure p̄ ≥ 0 over the cell, in the unit of Young's modulus (load control).
    MeanPressure(f64),
    /// Penetration δ below first touch, a length; at most the mean of the initial gap, where contact is complete
    /// (displacement control).
    Penetration(f64),
}

impl Load {
    /// The prescribed value, a pressure or a length.
    pub fn value(self) -> f64 {
        match self {
            Self::MeanPressure(value) | Self::Penetration(value) => value,
        }
    }

    /// Whether the mean pressure is prescribed.
    pub fn is_mean_pressure(self) -> bool {
        matches!(self, Self::MeanPressure(_))
    }
}

impl fmt::Display for Load {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = if self.is_mean_pressure() { "mean pressure" } else { "penetration" };
        write!(f, "{name} {}", number(self.value()))
    }
}
