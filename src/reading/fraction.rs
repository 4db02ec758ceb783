//! Which reading of the area in contact is printed.
//!
//! The fraction of the cell in contact is read **between** the samples, from the boundaries of its spots and along lines of
//! samples ([`Boundary`](super::Boundary)); of a topography it is also counted and **corrected** by the perimeter
//! ([`RoughReading`](super::RoughReading)). The first converges faster, the second needs few samples: of surfaces whose spots
//! have a few samples across the first errs by −13 to +25 %, the second by a few per cent; of eight self-affine surfaces whose
//! shortest wave has 16 samples the first errs by 1.6 % on the average, the second by 0.6. Each states its own error, and of spots
//! narrower than ten samples, and of many spots without boundaries of their own, whose borders run in all directions, the reading
//! with the smaller error is the fraction in contact. Of others it is the first:
//! it states more than it errs on them, most of all on rings, where the correction by the perimeter errs more.

/// One reading of the fraction of the cell in contact, on one grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Fraction {
    /// The fraction.
    pub value: f64,
    /// What the reading says of its own error from the samples of this grid alone.
    pub uncertainty: f64,
}

/// Samples across the spots from which on the correction by the perimeter, PART · 4/width of the counted area, leaves more open
/// than the samples do.
const WIDE: f64 = 10.0;

/// The samples in contact counted and corrected by the perimeter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Corrected {
    /// The fraction.
    pub fraction: Fraction,
    /// Mean width of the spots in samples: four times the samples in contact over the pairs of neighbours at their border, π/2
    /// radii of a disc. 0 without contact, infinite without a border.
    pub width: f64,
}

/// The readings of one contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Fractions {
    /// From boundaries and lines between the samples.
    pub between: Fraction,
    /// Whether there are many spots, and boundaries of less than half of the contact.
    pub many: bool,
    /// Counted and corrected by the perimeter; `None` for indenters.
    pub corrected: Option<Corrected>,
}

impl Fractions {
    /// That between the samples, or the corrected one where its `error` is smaller and the spots are narrow or many;
    /// with its error.
    /// `error` takes the reading of this contact and how to find the same in another.
    pub fn best(&self, error: impl Fn(Fraction, fn(&Self) -> Option<Fraction>) -> f64) -> (Fraction, f64) {
        let between = (self.between, error(self.between, |own| Some(own.between)));
        let corrected = self.corrected.filter(|own| own.width < WIDE || self.many).map(|own| own.fraction);
        match corrected.map(|own| (own, error(own, |own| own.corrected.map(|own| own.fraction)))) {
            Some(corrected) if corrected.1 < between.1 => corrected,
            _ => between,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fraction_with_the_smaller_error_is_the_best_but_of_few_wide_spots() {
        let of = |value, uncertainty| Fraction { value, uncertainty };
        let corrected = |value, uncertainty, width| Some(Corrected { fraction: of(value, uncertainty), width });
        let best = |fractions: Fractions| fractions.best(|own, _| own.uncertainty);
        let (between, many) = (of(0.3, 0.02), false);
        assert_eq!(best(Fractions { between, many, corrected: None }), (between, 0.02));
        assert_eq!(best(Fractions { between, many, corrected: corrected(0.28, 0.02, 3.0) }).0, between);
        assert_eq!(best(Fractions { between, many, corrected: corrected(0.28, 0.01, 3.0) }), (of(0.28, 0.01), 0.01));
        assert_eq!(best(Fractions { between, many, corrected: corrected(0.28, 0.01, 12.0) }).0, between);
        let rough = Fractions { between, many: true, corrected: corrected(0.28, 0.01, 12.0) };
        assert_eq!(best(rough), (of(0.28, 0.01), 0.01));
    }
}
