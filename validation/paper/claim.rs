//! A statement of the paper, the numbers it is judged by, and the verdict they give.
//!
//! A statement is judged by [`Test`]s: of the model as printed first, then of other readings (a misprint, another
//! meaning of a word). It holds as printed if all printed tests hold; else under the first reading whose tests hold;
//! else it does not hold. Its numbers are **pinned** where they were found, to the error of the mesh and not across the
//! bound of the test: a run that finds otherwise fails its check, so that no verdict changes in silence. A number that
//! is compared with an independent solution anyway, or that follows from the printed parameters alone, needs no pin.

use crate::Check;

/// Bound or value that a number must have for a statement to hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// Greater than this.
    Above(f64),
    /// Less than this.
    Below(f64),
    /// Equal to the printed number to within half a unit of its last digit.
    Printed {
        /// The number.
        value: f64,
        /// One unit of its last digit.
        unit: f64,
    },
}

/// One number against what the statement makes of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// Words for the measured quantity.
    pub what: String,
    /// The number.
    pub value: f64,
    /// Rule that the number must follow.
    pub rule: Rule,
    /// Number found before, and the error of the mesh in it.
    pin: Option<[f64; 2]>,
}

impl Test {
    /// `what` must be greater than `bound`.
    pub fn above(what: impl Into<String>, value: f64, bound: f64) -> Self {
        Self { what: what.into(), value, rule: Rule::Above(bound), pin: None }
    }

    /// `what` must be less than `bound`.
    pub fn below(what: impl Into<String>, value: f64, bound: f64) -> Self {
        Self { what: what.into(), value, rule: Rule::Below(bound), pin: None }
    }

    /// `what` must be the printed number, one unit of whose last digit is `unit`.
    pub fn printed(what: impl Into<String>, value: f64, printed: f64, unit: f64) -> Self {
        Self { what: what.into(), value, rule: Rule::Printed { value: printed, unit }, pin: None }
    }

    /// The number was `found`, on a mesh that errs by `error`, both in its unit.
    #[must_use]
    pub fn pinned(self, found: f64, error: f64) -> Self {
        Self { pin: Some([found, error]), ..self }
    }

    /// Whether the number is what the statement makes of it.
    pub fn holds(&self) -> bool {
        match self.rule {
            Rule::Above(bound) => self.value > bound,
            Rule::Below(bound) => self.value < bound,
            Rule::Printed { value, unit } => (self.value - value).abs() <= 0.5 * unit,
        }
    }

    /// The number as the table has it: what is zero up to the error of the mesh is told by that error, as its own digits
    /// are those of the solver's tolerance.
    fn told(&self) -> String {
        match self.pin {
            Some([0.0, error]) if self.value.abs() < error && (1e-8..1e-2).contains(&error) => {
                format!("below {error:.0e}").replace('-', "−")
            }
            _ => digits(self.value),
        }
    }

    /// The check that a pinned number is where it was found, and on that side of its bound.
    fn check(&self, label: &str) -> Option<Check> {
        let [found, error] = self.pin?;
        let to_bound = match self.rule {
            Rule::Above(bound) | Rule::Below(bound) => (found - bound).abs(),
            Rule::Printed { value, unit } => ((found - value).abs() - 0.5 * unit).abs(),
        };
        let quantity = format!("{label}: {}", self.what);
        Some(Check::absolute(quantity, self.value, found, error.min(to_bound)).as_finding())
    }
}

/// How a statement fares.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// Holds with the parameters and words as they stand.
    AsPrinted,
    /// Holds with another reading.
    Otherwise(&'static str),
    /// Holds with no reading that was tried.
    Fails,
    /// Not in any sense of its words, but this would have given what is printed.
    Explained(&'static str),
}

/// One statement of the paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Place of the statement in the paper.
    pub place: &'static str,
    /// A few words of the statement.
    pub quote: &'static str,
    /// Name for its checks.
    label: &'static str,
    printed: Vec<Test>,
    readings: Vec<(&'static str, Vec<Test>)>,
    explanation: Option<(&'static str, Vec<Test>)>,
    remark: &'static str,
}

impl Claim {
    /// A statement judged by the model as printed. `label`: a name of its own for its checks.
    pub fn new(place: &'static str, quote: &'static str, label: &'static str, printed: Vec<Test>) -> Self {
        Self { place, quote, label, printed, readings: Vec::new(), explanation: None, remark: "" }
    }

    /// Another reading and its tests.
    #[must_use]
    pub fn or(mut self, reading: &'static str, tests: Vec<Test>) -> Self {
        self.readings.push((reading, tests));
        self
    }

    /// Something else that would have given what is printed, and its tests.
    #[must_use]
    pub fn explained_by(self, what: &'static str, tests: Vec<Test>) -> Self {
        Self { explanation: Some((what, tests)), ..self }
    }

    /// The claim with a remark.
    #[must_use]
    pub fn remark(self, remark: &'static str) -> Self {
        Self { remark, ..self }
    }

    /// The verdict of this run.
    pub fn verdict(&self) -> Verdict {
        let all = |tests: &[Test]| !tests.is_empty() && tests.iter().all(Test::holds);
        if all(&self.printed) {
            return Verdict::AsPrinted;
        }
        if let Some((name, _)) = self.readings.iter().find(|(_, tests)| all(tests)) {
            return Verdict::Otherwise(name);
        }
        match &self.explanation {
            Some((name, tests)) if all(tests) => Verdict::Explained(name),
            _ => Verdict::Fails,
        }
    }

    /// One check a pinned number.
    pub fn checks(&self) -> Vec<Check> {
        let printed = self.printed.iter().filter_map(|test| test.check(self.label));
        let readings = self.readings.iter().chain(&self.explanation).flat_map(|(name, tests)| {
            let label = format!("{} ({name})", self.label);
            tests.iter().filter_map(move |test| test.check(&label))
        });
        printed.chain(readings).collect()
    }

    /// Row of the table: place, quote, measured numbers, verdict, command.
    pub fn row(&self, study: &str) -> String {
        let list = |tests: &[Test]| {
            let one = |test: &Test| format!("{}: {}", test.what, test.told());
            tests.iter().map(one).collect::<Vec<_>>().join("; ")
        };
        let mut measured = list(&self.printed);
        for (name, tests) in self.readings.iter().chain(&self.explanation) {
            measured += &format!("<br>*{name}* – {}", list(tests));
        }
        if !self.remark.is_empty() {
            measured += &format!("<br>({})", self.remark);
        }
        let verdict = match self.verdict() {
            Verdict::AsPrinted => "**holds as printed**".to_owned(),
            Verdict::Otherwise(reading) => format!("**holds under another reading:** {reading}"),
            Verdict::Fails => "**does not hold**".to_owned(),
            Verdict::Explained(cause) => format!("**does not hold;** explained by {cause}"),
        };
        format!("| {} | “{}” | {measured} | {verdict} | `percoat validate {study}` |", self.place, self.quote)
    }
}

/// Tests with the numbers `found` and the `errors` of the mesh in them.
pub fn pinned<const N: usize>(tests: [Test; N], found: [f64; N], errors: [f64; N]) -> Vec<Test> {
    let pins = found.into_iter().zip(errors);
    tests.into_iter().zip(pins).map(|(test, (found, error))| test.pinned(found, error)).collect()
}

/// A number with three significant digits, a true minus sign, an exponent only where a reader needs one; what is left
/// of zero after rounding is zero.
fn digits(x: f64) -> String {
    let magnitude = if x.abs() < 1e-9 { return "0".to_owned() } else { x.abs().log10().floor() as i32 };
    let text = match magnitude {
        -5..=2 => format!("{x:.*}", usize::try_from(2 - magnitude).unwrap_or(0)),
        _ => format!("{x:.2e}"),
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(value: f64) -> Claim {
        Claim::new("§3", "it rises", "rise", vec![Test::above("rise", value, 0.0).pinned(1.0, 0.2)])
            .or("it falls", vec![Test::below("rise", value, 0.0)])
    }

    #[test]
    fn the_verdict_follows_the_numbers_and_the_checks_what_was_found() {
        assert_eq!(claim(1.0).verdict(), Verdict::AsPrinted);
        assert!(claim(1.1).checks().iter().all(Check::holds));
        assert_eq!(claim(1.5).verdict(), Verdict::AsPrinted);
        assert!(claim(1.5).checks().iter().all(|check| !check.holds()), "a pin holds on both sides");
        assert_eq!(claim(-1.0).verdict(), Verdict::Otherwise("it falls"));
        assert!(claim(-1.0).checks().iter().all(|check| !check.holds()));
        assert_eq!(claim(f64::NAN).verdict(), Verdict::Fails);
        assert!(claim(f64::NAN).checks().iter().all(|check| !check.holds()));
        let explained = claim(0.0).explained_by("nothing", vec![Test::below("rise", 0.0, 1.0).pinned(0.0, 0.1)]);
        assert_eq!(explained.verdict(), Verdict::Explained("nothing"));
        assert_eq!(explained.checks().len(), 2, "only what is pinned is a check");
    }

    #[test]
    fn a_pin_does_not_reach_across_the_bound_of_its_test() {
        let near = |value| Test::above("rise", value, 0.0).pinned(0.1, 0.5).check("x").unwrap();
        assert!(near(0.01).holds() && !near(-0.01).holds());
        let outside = |value| Test::printed("p", value, 0.07, 0.01).pinned(0.08, 0.02).check("x").unwrap();
        assert!(outside(0.076).holds() && !outside(0.0749).holds());
    }

    #[test]
    fn a_printed_number_counts_to_half_its_last_digit() {
        let test = |value| Test::printed("p", value, 0.07, 0.01);
        assert!(test(0.0651).holds() && !test(0.0649).holds());
    }

    #[test]
    fn numbers_have_three_digits() {
        assert_eq!(
            [0.365281, -12.3456, 0.00012345, 1.5e-7, 3e-14, 2.0].map(digits),
            ["0.365", "−12.3", "0.000123", "1.50e−7", "0", "2.00"]
        );
    }
}
