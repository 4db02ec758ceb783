//! Which reading of the area in contact is printed.
//!
//! The fraction of the cell in contact is read **between** the samples, from the boundaries of its spots and along lines of
//! samples ([`Boundary`](super::Boundary)); of a topography it is also counted and **corrected** by the perimeter
//! ([`RoughReading`](super::RoughReading)). The first converges faster, the second needs few samples: of surfaces whose spots
//! have a few samples across the first errs by −13 to +25 %, the second by a few per cent. Each states its own error, and
//! the one with the smaller error is the fraction in contact.

/// One reading of the fraction of the cell in contact, on one grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Fraction {
    /// The fraction.
    pub value: f64,
    /// What the reading says of its own error from the samples of this grid alone.
    pub uncertainty: f64,
}

/// The readings of one contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Fractions {
    /// From boundaries and lines between the samples.
    pub between: Fraction,
    /// Counted and corrected by the perimeter; `None` for indenters.
    pub corrected: Option<Fraction>,
}

impl Fractions {
    /// Of both, the one whose `error` is smaller, with its error; where they are equal that between the samples. `error`
    /// has the reading of this contact and how to find the same in another.
    pub fn best(&self, error: impl Fn(Fraction, fn(&Self) -> Option<Fraction>) -> f64) -> (Fraction, f64) {
        let between = (self.between, error(self.between, |own| Some(own.between)));
        match self.corrected.map(|corrected| (corrected, error(corrected, |own| own.corrected))) {
            Some(corrected) if corrected.1 < between.1 => corrected,
            _ => between,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fraction_with_the_smaller_error_is_the_best() {
        let of = |value, uncertainty| Fraction { value, uncertainty };
        let best = |fractions: Fractions| fractions.best(|own, _| own.uncertainty);
        let between = of(0.3, 0.02);
        assert_eq!(best(Fractions { between, corrected: None }), (between, 0.02));
        assert_eq!(best(Fractions { between, corrected: Some(of(0.28, 0.02)) }).0, between);
        assert_eq!(best(Fractions { between, corrected: Some(of(0.28, 0.01)) }), (of(0.28, 0.01), 0.01));
    }
}
