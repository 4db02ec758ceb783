//! How values are spread along an axis.

/// How values are spread along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    Linear,
    /// In proportion to the logarithm; values that are not positive have no place.
    Log,
    /// In proportion, with numbers at parts of a full turn.
    Degrees,
}

impl Scale {
    /// What stands at a part of the way from one value to another.
    pub(super) fn between(self, first: f64, last: f64, part: f64) -> f64 {
        match self {
            Self::Linear | Self::Degrees => first + (last - first) * part,
            Self::Log => first * (last / first).powf(part),
        }
    }
}
