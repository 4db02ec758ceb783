//! A largest stress or strain with its position, its error and its rival.

use crate::body::MaterialId;
use crate::measured::Measured;
use crate::numeric::serialised;
use crate::quantity::{ErrorAt, Reads};
use serde::{Deserialize, Serialize};

/// A largest value and its position.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Peak {
    /// The value, a pressure or a strain; infinite under a tip in contact.
    #[serde(flatten, with = "serialised::value")]
    pub value: f64,
    /// Estimated discretisation error of the value; `None` without a coarser grid or for a value that is not a number. It covers
    /// the rivals: the largest value plus error of all positions compared, less the value, and no less than the value's own error.
    pub error: Option<f64>,
    /// Position x, y, z; lengths.
    #[serde(flatten, with = "serialised::place")]
    pub position: [f64; 3],
    /// Material of the position.
    #[serde(flatten)]
    pub material: MaterialId,
    /// Direction of σ₁ at the position, a unit vector: a crack opens across it.
    #[serde(deserialize_with = "serialised::numbers")]
    pub direction: [f64; 3],
    /// Another position where the stress may be largest within the errors; `None` where there is none, or no error is known.
    pub rival: Option<Rival>,
}

/// A position whose value plus error exceeds the largest value less its error; of several the one with the largest sum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rival {
    /// Value at the position, in the unit of the largest one.
    #[serde(deserialize_with = "serialised::number")]
    pub value: f64,
    /// Estimated discretisation error of the value.
    #[serde(deserialize_with = "serialised::number")]
    pub error: f64,
    /// Position x, y, z; lengths.
    #[serde(flatten, with = "serialised::place")]
    pub position: [f64; 3],
    /// Material of the position.
    #[serde(flatten)]
    pub material: MaterialId,
}

impl Peak {
    /// The larger of two, this one of equals; a value that is not a number counts as largest.
    pub fn higher(self, other: Self) -> Self {
        if self.value.is_nan() || other.value <= self.value { self } else { other }
    }

    /// The value; `None` unless it is finite.
    pub fn finite(&self) -> Option<f64> {
        self.value.is_finite().then_some(self.value)
    }
}

impl Reads for Peak {
    const ERROR: ErrorAt = ErrorAt::InPeak;

    fn measured(&self, _: Option<f64>) -> Option<Measured> {
        Some(Measured::new(self.value, self.error))
    }
}
