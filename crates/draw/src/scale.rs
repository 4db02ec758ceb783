//! The spacing of values along an axis.

/// The spacing of values along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Proportional to the value.
    Linear,
    /// Proportional to the logarithm; values that are not positive have no place.
    Log,
    /// Proportional to an angle in degrees, with numbers at parts of 360°.
    Degrees,
}

impl Scale {
    /// Value at a part of the axis between two values.
    pub fn between(self, first: f64, last: f64, part: f64) -> f64 {
        match self {
            Self::Linear | Self::Degrees => first + (last - first) * part,
            Self::Log => first * (last / first).powf(part),
        }
    }
}
