//! Ranges of the numbers of a key.

use std::ops::{Bound, RangeBounds};

use crate::units::CARRIED;
use percoat_common::plain::float;
use percoat_core::identification::Quantity;

/// Advice for a number beyond double precision.
const WHY: &str = "double precision carries the products of five such numbers, no others; choose other units";

/// The numbers that a key admits, all of them finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::case) enum Range {
    /// A length, a modulus or a pressure greater than 0, within [`CARRIED`].
    Size,
    /// 0, or a length, a modulus or a pressure greater than 0, within [`CARRIED`].
    SizeOrZero,
    /// A coordinate or a component of a vector, of at most the largest size of [`CARRIED`].
    Coordinate,
    /// A positive or negative number whose size is within [`CARRIED`].
    Factor,
    /// Between two bounds.
    Within(Bound<f64>, Bound<f64>),
}

/// Why a number is not admitted.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::case) struct Beyond {
    /// Admitted numbers, in words.
    pub(in crate::case) wanted: String,
    /// Advice, where the bound alone does not suffice.
    pub(in crate::case) help: Option<&'static str>,
}

impl Range {
    /// Numbers greater than 0, however large.
    pub(in crate::case) const POSITIVE: Self = Self::Within(Bound::Excluded(0.0), Bound::Unbounded);

    /// The range from one number to another, both included.
    pub(in crate::case) const fn between(low: f64, high: f64) -> Self {
        Self::Within(Bound::Included(low), Bound::Included(high))
    }

    /// The number, or the reason why it is not admitted.
    pub(in crate::case) fn admit(self, x: f64) -> Result<f64, Beyond> {
        if !x.is_finite() || !self.bounds().contains(&x) {
            return Err(Beyond { wanted: self.requirement(), help: None });
        }
        let carried = match self {
            Self::Size => CARRIED.contains(&x),
            Self::SizeOrZero => x == 0.0 || CARRIED.contains(&x),
            Self::Coordinate => x.abs() <= *CARRIED.end(),
            Self::Factor => CARRIED.contains(&x.abs()),
            Self::Within(..) => true,
        };
        let wanted = match self {
            Self::Coordinate => "a number between -1e60 and 1e60",
            Self::Factor => "a number other than 0, between 1e-60 and 1e60 or the negative of one",
            _ => "a number between 1e-60 and 1e60",
        };
        // No other unit helps for 0.
        let help = (x != 0.0).then_some(WHY);
        if carried { Ok(x) } else { Err(Beyond { wanted: wanted.to_owned(), help }) }
    }

    /// Way in which a fit searches for a number of the range: by its logarithm, or between two bounds.
    pub(in crate::case) fn quantity(self) -> Quantity {
        match self {
            Self::Within(Bound::Included(low), Bound::Included(high)) => Quantity::Bounded([low, high]),
            _ => Quantity::Positive,
        }
    }

    /// Bounds without those of double precision.
    fn bounds(self) -> (Bound<f64>, Bound<f64>) {
        match self {
            Self::Size => (Bound::Excluded(0.0), Bound::Unbounded),
            Self::SizeOrZero => (Bound::Included(0.0), Bound::Unbounded),
            Self::Coordinate | Self::Factor => (Bound::Unbounded, Bound::Unbounded),
            Self::Within(low, high) => (low, high),
        }
    }

    /// Bounds for the schema, which admit every number of the range and a few more.
    pub(super) fn outer(self) -> (Bound<f64>, Bound<f64>) {
        let most = *CARRIED.end();
        match self {
            Self::Size => (Bound::Included(*CARRIED.start()), Bound::Included(most)),
            Self::SizeOrZero => (Bound::Included(0.0), Bound::Included(most)),
            Self::Coordinate | Self::Factor => (Bound::Included(-most), Bound::Included(most)),
            Self::Within(low, high) => (low, high),
        }
    }

    /// The admitted numbers, as in "a number greater than 0 and at most 0.1".
    pub(in crate::case) fn requirement(self) -> String {
        match self.bounds() {
            (Bound::Included(low), Bound::Included(high)) => {
                format!("a number between {} and {}", float(low), float(high))
            }
            (Bound::Unbounded, Bound::Unbounded) if self == Self::Factor => "a finite number other than 0".to_owned(),
            (Bound::Unbounded, Bound::Unbounded) => "a finite number".to_owned(),
            (Bound::Included(low), Bound::Unbounded) => format!("a finite number of at least {}", float(low)),
            (low, Bound::Unbounded) => format!("a finite number {}", lower(low)),
            (Bound::Unbounded, high) => format!("a finite number {}", upper(high)),
            (low, high) => format!("a number {} and {}", lower(low), upper(high)),
        }
    }

    /// The admitted numbers, with the limits of double precision.
    pub(super) fn full(self) -> String {
        match self {
            Self::Size => "greater than 0 (1e-60 to 1e60)".to_owned(),
            Self::SizeOrZero => "0 or greater (to 1e60)".to_owned(),
            Self::Coordinate => "any (-1e60 to 1e60)".to_owned(),
            Self::Factor => "any but 0 (1e-60 to 1e60, or negative)".to_owned(),
            Self::Within(..) => self.short(),
        }
    }

    /// The bounds, as in "> 0", "0 to 0.5", "> 0, ≤ 0.1"; empty without bounds.
    pub(super) fn short(self) -> String {
        let bound = |bound, included, excluded| match bound {
            Bound::Included(x) => Some(format!("{included} {}", float(x))),
            Bound::Excluded(x) => Some(format!("{excluded} {}", float(x))),
            Bound::Unbounded => None,
        };
        match self.bounds() {
            _ if self == Self::Factor => "≠ 0".to_owned(),
            (Bound::Included(low), Bound::Included(high)) => format!("{} to {}", float(low), float(high)),
            (low, high) => {
                [bound(low, "≥", ">"), bound(high, "≤", "<")].into_iter().flatten().collect::<Vec<_>>().join(", ")
            }
        }
    }
}

fn lower(bound: Bound<f64>) -> String {
    match bound {
        Bound::Included(x) => format!("at least {}", float(x)),
        Bound::Excluded(x) => format!("greater than {}", float(x)),
        Bound::Unbounded => String::new(),
    }
}

fn upper(bound: Bound<f64>) -> String {
    match bound {
        Bound::Included(x) => format!("at most {}", float(x)),
        Bound::Excluded(x) => format!("less than {}", float(x)),
        Bound::Unbounded => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_read_like_sentences() {
        let accuracy = Range::Within(Bound::Excluded(0.0), Bound::Included(0.1));
        for (range, told, short) in [
            (Range::Size, "a finite number greater than 0", "> 0"),
            (Range::SizeOrZero, "a finite number of at least 0", "≥ 0"),
            (Range::Coordinate, "a finite number", ""),
            (Range::between(0.0, 0.5), "a number between 0 and 0.5", "0 to 0.5"),
            (accuracy, "a number greater than 0 and at most 0.1", "> 0, ≤ 0.1"),
        ] {
            assert_eq!((&range.requirement()[..], &range.short()[..]), (told, short));
        }
    }

    #[test]
    fn what_is_not_carried_is_told_why() {
        let refused = |range: Range, x| range.admit(x).unwrap_err();
        assert_eq!(refused(Range::Size, 0.0).help, None);
        assert_eq!(refused(Range::SizeOrZero, 1e-70).wanted, "a number between 1e-60 and 1e60");
        assert!(refused(Range::Coordinate, -1e61).help.is_some() && Range::Coordinate.admit(1e-70).is_ok());
        assert!(refused(Range::Factor, 0.0).wanted.contains("other than 0") && Range::Factor.admit(-2.0).is_ok());
        for range in [Range::Size, Range::SizeOrZero, Range::Coordinate, Range::Factor, Range::between(0.0, 1.0)] {
            assert!([f64::NAN, f64::INFINITY].iter().all(|x| range.admit(*x).is_err()));
        }
    }
}
