//! The place where a stress is largest.

#[cfg(feature = "serde")]
use crate::numeric::serialised;

/// A largest value and where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peak {
    /// The value, a pressure; infinite under a tip in contact.
    #[cfg_attr(feature = "serde", serde(flatten, with = "serialised::value"))]
    pub value: f64,
    /// Estimated error of the value by the grid; `None` where there is no coarser grid or no number. It covers the rivals:
    /// the largest value plus error of all places that were compared, less the value, and no less than the value's own error.
    pub error: Option<f64>,
    /// x, y, z; lengths.
    #[cfg_attr(feature = "serde", serde(flatten, with = "serialised::place"))]
    pub position: [f64; 3],
    /// Material, from 1; the substrate is layers + 1.
    pub material: usize,
    /// Direction along which σ₁ acts there, a unit vector: a crack opens across it.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "serialised::numbers"))]
    pub direction: [f64; 3],
    /// Another place where the stress may be largest within the errors; `None` where the place is decided or no error is
    /// known.
    pub rival: Option<Rival>,
}

/// A place whose value plus error exceeds what the largest value is at least: of several the one that may be the highest.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rival {
    /// The value there, in the unit of the largest one.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "serialised::number"))]
    pub value: f64,
    /// Estimated error of that value by the grid.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "serialised::number"))]
    pub error: f64,
    /// x, y, z; lengths.
    #[cfg_attr(feature = "serde", serde(flatten, with = "serialised::place"))]
    pub position: [f64; 3],
    /// Material, from 1.
    pub material: usize,
}

impl Peak {
    /// The larger of two, this one of equals; what is not a number is larger than any.
    pub fn higher(self, other: Self) -> Self {
        if self.value.is_nan() || other.value <= self.value { self } else { other }
    }

    /// The value where it is finite.
    pub fn finite(&self) -> Option<f64> {
        self.value.is_finite().then_some(self.value)
    }
}
