//! A value with its error.

/// A value with its estimated discretisation error, both in one unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The value; infinite under a tip.
    pub value: f64,
    /// Error of the value; `None` where it is not known.
    pub error: Option<f64>,
}

impl Measured {
    /// A value with its error.
    pub const fn new(value: f64, error: Option<f64>) -> Self {
        Self { value, error }
    }

    /// A value whose error is not known.
    pub const fn exact(value: f64) -> Self {
        Self { value, error: None }
    }

    /// The value where it is finite; `None` under a tip.
    pub fn finite(self) -> Option<Self> {
        Some(self).filter(|measured| measured.value.is_finite())
    }

    /// Value and error in another unit, `factor` times as large.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error.map(|error| error * factor) }
    }

    /// Error over the size of the value; `None` where it is not known, and of zero.
    pub fn relative(self) -> Option<f64> {
        self.error.filter(|_| self.value != 0.0).map(|error| error / self.value.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tip_has_no_finite_value_and_zero_no_relative_error() {
        let known = Measured::new(-4.0, Some(1.0));
        assert_eq!(
            (known.finite(), known.relative(), known.times(3.0)),
            (Some(known), Some(0.25), Measured::new(-12.0, Some(3.0)))
        );
        assert_eq!(Measured::exact(f64::INFINITY).finite(), None);
        assert_eq!([Measured::new(0.0, Some(1.0)), Measured::exact(2.0)].map(Measured::relative), [None; 2]);
    }
}
