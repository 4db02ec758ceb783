//! The readings of the area in contact, and the choice of the printed one.
//!
//! The fraction of the cell in contact is read **between** the samples, from the boundaries of its spots and along lines of
//! samples ([`Boundary`](super::Boundary)); of a topography it is also counted and **corrected** by the perimeter
//! ([`RoughReading`](super::RoughReading)). The first converges faster, the second needs few samples: of surfaces whose spots
//! have a few samples across the first errs by −13 to +25 %, the second by a few per cent; of eight self-affine surfaces whose
//! shortest wave has 16 samples the first errs by 1.6 % on the average, the second by 0.6. Each states its own error, and of spots
//! narrower than ten samples, and of many spots without boundaries of their own, whose borders run in all directions, the reading
//! with the smaller error is the fraction in contact. Of other spots it is always the first: there its
//! uncertainty exceeds its error, most of all on rings, where the correction by the perimeter errs more.

use super::counted::CountedArea;
use super::fraction::Fraction;

/// Mean width of spots, in samples, from which on the correction by the perimeter, Yastrebov's factor times 4/width of the counted
/// area, is less certain than the reading between the samples.
const WIDE: f64 = 10.0;

/// The readings of the fraction in contact of one contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Fractions {
    /// Fraction from boundaries and lines between the samples.
    pub between: Fraction,
    /// Whether there are many spots, and located boundaries around less than half of the area in contact.
    pub many: bool,
    /// Area counted by samples; `None` for indenters.
    pub counted: Option<CountedArea>,
}

impl Fractions {
    /// A fraction without uncertainty: that of a given pressure on discs.
    pub fn known(value: f64) -> Self {
        Self { between: Fraction { value, uncertainty: 0.0 }, many: false, counted: None }
    }

    /// The fraction between the samples, or the corrected one where its error is smaller and the spots are narrow or many; with
    /// its error. `error` takes the reading of this contact and how to find that of another one.
    pub fn best(&self, error: impl Fn(Fraction, fn(&Self) -> Option<Fraction>) -> f64) -> (Fraction, f64) {
        let between = (self.between, error(self.between, |fractions| Some(fractions.between)));
        let corrected =
            self.counted.filter(|counted| counted.width < WIDE || self.many).map(|counted| counted.corrected);
        match corrected.map(|fraction| (fraction, error(fraction, Self::corrected))) {
            Some(corrected) if corrected.1 < between.1 => corrected,
            _ => between,
        }
    }

    /// The fraction corrected by the perimeter; `None` for indenters.
    pub fn corrected(&self) -> Option<Fraction> {
        self.counted.map(|counted| counted.corrected)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fraction_with_the_smaller_error_is_the_best_but_of_few_wide_spots() {
        let of = |value, uncertainty| Fraction { value, uncertainty };
        let counted = |value, uncertainty, width| {
            Some(CountedArea { corrected: of(value, uncertainty), width, ..CountedArea::default() })
        };
        let best = |fractions: Fractions| fractions.best(|fraction, _| fraction.uncertainty);
        let (between, many) = (of(0.3, 0.02), false);
        assert_eq!(best(Fractions { between, many, counted: None }), (between, 0.02));
        assert_eq!(best(Fractions { between, many, counted: counted(0.28, 0.02, 3.0) }).0, between);
        assert_eq!(best(Fractions { between, many, counted: counted(0.28, 0.01, 3.0) }), (of(0.28, 0.01), 0.01));
        assert_eq!(best(Fractions { between, many, counted: counted(0.28, 0.01, 12.0) }).0, between);
        let rough = Fractions { between, many: true, counted: counted(0.28, 0.01, 12.0) };
        assert_eq!(best(rough), (of(0.28, 0.01), 0.01));
    }
}
