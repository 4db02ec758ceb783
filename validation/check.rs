//! One quantity against its reference, with its verdict.

use std::fmt;

/// Tolerance of a value about its reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// |value − reference| ≤ tolerance · |reference|.
    Relative(f64),
    /// |value − reference| ≤ tolerance, in the unit of the value.
    Absolute(f64),
    /// An observed order of convergence: |value − reference| ≤ tolerance.
    Order(f64),
    /// value ≤ reference: the reference is itself the bound.
    AtMost,
    /// value ≥ reference.
    AtLeast,
}

/// Kind of a reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// Independent of the program: a closed form, a multiprecision table, another program.
    Reference,
    /// The program itself: another mesh, another of its methods, its orders and iterations.
    Refinement,
    /// An earlier result of the program about the paper, within the error of the mesh.
    Finding,
}

impl Evidence {
    /// All kinds, in the order of a report.
    pub const ALL: [Self; 3] = [Self::Reference, Self::Refinement, Self::Finding];
}

/// A quantity of a study, compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// Name of the quantity, equal in every run.
    pub quantity: String,
    /// Value of percoat.
    pub value: f64,
    /// Reference value.
    pub reference: f64,
    /// Tolerance about the reference.
    pub tolerance: Tolerance,
    /// Kind of the reference.
    pub evidence: Evidence,
}

impl Check {
    /// Compares `value` with an independent `reference`; bounds and orders count as the program's own.
    pub fn new(quantity: impl Into<String>, value: f64, reference: f64, tolerance: Tolerance) -> Self {
        let evidence = match tolerance {
            Tolerance::Relative(_) | Tolerance::Absolute(_) => Evidence::Reference,
            Tolerance::Order(_) | Tolerance::AtMost | Tolerance::AtLeast => Evidence::Refinement,
        };
        Self { quantity: quantity.into(), value, reference, tolerance, evidence }
    }

    /// The check with a reference from the program itself.
    #[must_use]
    pub fn of_refinement(self) -> Self {
        Self { evidence: Evidence::Refinement, ..self }
    }

    /// The check with an earlier result as the reference.
    #[must_use]
    pub fn as_finding(self) -> Self {
        Self { evidence: Evidence::Finding, ..self }
    }

    /// Within `tolerance` · |reference|.
    pub fn relative(quantity: impl Into<String>, value: f64, reference: f64, tolerance: f64) -> Self {
        Self::new(quantity, value, reference, Tolerance::Relative(tolerance))
    }

    /// Within `tolerance`, in the unit of the value.
    pub fn absolute(quantity: impl Into<String>, value: f64, reference: f64, tolerance: f64) -> Self {
        Self::new(quantity, value, reference, Tolerance::Absolute(tolerance))
    }

    /// An observed order of convergence, `expected` to within `slack`.
    pub fn order(quantity: impl Into<String>, value: f64, expected: f64, slack: f64) -> Self {
        Self::new(quantity, value, expected, Tolerance::Order(slack))
    }

    /// A value not above `bound`.
    pub fn at_most(quantity: impl Into<String>, value: f64, bound: f64) -> Self {
        Self::new(quantity, value, bound, Tolerance::AtMost)
    }

    /// A value not below `bound`.
    pub fn at_least(quantity: impl Into<String>, value: f64, bound: f64) -> Self {
        Self::new(quantity, value, bound, Tolerance::AtLeast)
    }

    /// The worst of many pairs (value, reference) under one tolerance; without any pair the check fails.
    pub fn worst(
        quantity: impl Into<String>,
        pairs: impl IntoIterator<Item = (f64, f64)>,
        tolerance: Tolerance,
    ) -> Self {
        let mut worst = Self::new(quantity, f64::NAN, f64::NAN, tolerance);
        let mut largest = f64::NEG_INFINITY;
        for (value, reference) in pairs {
            let error = Self::new("", value, reference, tolerance).badness();
            // A value that is not a number is the worst.
            if error > largest || error.is_nan() {
                (worst.value, worst.reference, largest) = (value, reference, error);
            }
            if error.is_nan() {
                break;
            }
        }
        worst
    }

    /// value − reference, over |reference| where the tolerance is relative.
    pub fn error(&self) -> f64 {
        let difference = self.value - self.reference;
        match self.tolerance {
            Tolerance::Relative(_) => difference / self.reference.abs(),
            _ => difference,
        }
    }

    /// The deviation that must not exceed the tolerance, or zero where the reference is a bound.
    fn badness(&self) -> f64 {
        match self.tolerance {
            Tolerance::Relative(_) | Tolerance::Absolute(_) | Tolerance::Order(_) => self.error().abs(),
            Tolerance::AtMost => self.error(),
            Tolerance::AtLeast => -self.error(),
        }
    }

    /// The verdict; false for a value that is not a number.
    pub fn holds(&self) -> bool {
        let allowed = match self.tolerance {
            Tolerance::Relative(tolerance) | Tolerance::Absolute(tolerance) | Tolerance::Order(tolerance) => tolerance,
            Tolerance::AtMost | Tolerance::AtLeast => 0.0,
        };
        self.badness() <= allowed
    }

    /// The verdict as a word.
    pub fn verdict(&self) -> &'static str {
        if self.holds() { "holds" } else { "fails" }
    }
}

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Reference => "independent",
            Self::Refinement => "refinement",
            Self::Finding => "finding",
        })
    }
}

impl fmt::Display for Tolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Relative(tolerance) => write!(f, "{:e} relative", without_rounding(*tolerance)),
            Self::Absolute(tolerance) => write!(f, "{:e}", without_rounding(*tolerance)),
            Self::Order(slack) => write!(f, "order, ±{slack}"),
            Self::AtMost => write!(f, "at most"),
            Self::AtLeast => write!(f, "at least"),
        }
    }
}

/// A number without the rounding of the product that made it: to twelve digits.
fn without_rounding(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_follow_their_tolerance() {
        assert!(Check::relative("x", 101.0, 100.0, 0.011).holds());
        assert!(!Check::relative("x", 98.0, 100.0, 0.011).holds());
        assert!(Check::relative("x", -1.005, -1.0, 0.01).holds());
        assert!(!Check::absolute("x", 0.3, 0.0, 0.2).holds());
        assert!(Check::order("x", 2.1, 2.0, 0.2).holds());
        assert!(!Check::order("x", 1.7, 2.0, 0.2).holds() && !Check::order("x", 2.5, 2.0, 0.2).holds());
        assert!(Check::at_most("x", 20.0, 20.0).holds() && !Check::at_most("x", 21.0, 20.0).holds());
        assert!(Check::at_least("x", 20.0, 20.0).holds() && !Check::at_least("x", 19.0, 20.0).holds());
    }

    #[test]
    fn tolerances_are_printed_as_they_are() {
        let printed = [Tolerance::Relative(1.5e-2), Tolerance::Absolute(2.5e-7), Tolerance::Order(0.25)];
        assert_eq!(printed.map(|tolerance| tolerance.to_string()), ["1.5e-2 relative", "2.5e-7", "order, ±0.25"]);
        assert_eq!(Tolerance::Absolute(0.06 * 1.48).to_string(), "8.88e-2");
    }

    #[test]
    fn bounds_and_orders_are_the_programs_own_and_other_references_independent() {
        assert_eq!(Check::relative("x", 1.0, 1.0, 0.1).evidence, Evidence::Reference);
        assert_eq!(Check::worst("x", [(1.0, 1.0)], Tolerance::Absolute(0.1)).evidence, Evidence::Reference);
        for check in [Check::order("x", 2.0, 2.0, 0.1), Check::at_most("x", 1.0, 2.0), Check::at_least("x", 2.0, 1.0)] {
            assert_eq!(check.evidence, Evidence::Refinement);
        }
        assert_eq!(Check::relative("x", 1.0, 1.0, 0.1).of_refinement().evidence, Evidence::Refinement);
        assert_eq!(Check::absolute("x", 1.0, 1.0, 0.1).as_finding().evidence, Evidence::Finding);
    }

    #[test]
    fn what_is_not_a_number_fails() {
        for tolerance in [
            Tolerance::Relative(1.0),
            Tolerance::Absolute(1.0),
            Tolerance::Order(1.0),
            Tolerance::AtMost,
            Tolerance::AtLeast,
        ] {
            assert!(!Check::new("x", f64::NAN, 1.0, tolerance).holds());
            assert!(!Check::new("x", 1.0, f64::NAN, tolerance).holds());
            assert!(!Check::worst("x", [(1.0, 1.0), (f64::NAN, 1.0), (2.0, 1.0)], tolerance).holds());
            assert!(!Check::worst("x", [], tolerance).holds());
        }
    }

    #[test]
    fn the_worst_pair_stands_for_all() {
        let check = Check::worst("x", [(1.0, 1.1), (5.0, 4.0), (9.0, 9.0)], Tolerance::Absolute(2.0));
        assert_eq!((check.value, check.reference), (5.0, 4.0));
        let iterations = Check::worst("x", [(9.0, 20.0), (18.0, 20.0), (1.0, 20.0)], Tolerance::AtMost);
        assert_eq!(iterations.value, 18.0);
    }
}
