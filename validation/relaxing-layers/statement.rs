//! A statement of the literature, the numbers that it is judged by, and the verdict of this run.

use crate::{Check, Outcome, Tolerance};

/// A statement and its tests.
#[derive(Debug, Clone)]
pub struct Statement {
    /// Name of its checks.
    name: &'static str,
    tests: Vec<Check>,
    denied: Vec<Check>,
}

/// Verdict as a number: all tests hold, some, or none.
const HOLDS: f64 = 2.0;
const IN_PART: f64 = 1.0;
const FAILS: f64 = 0.0;

impl Statement {
    pub fn new(name: &'static str) -> Self {
        Self { name, tests: Vec::new(), denied: Vec::new() }
    }

    /// A test of the statement.
    #[must_use]
    pub fn says(mut self, test: Check) -> Self {
        self.tests.push(Check { quantity: format!("{}: {}", self.name, test.quantity), ..test });
        self
    }

    /// A test of the statement that was found not to hold: what is checked is that it still does not.
    #[must_use]
    pub fn denied(mut self, test: Check) -> Self {
        self.denied.push(Check { quantity: format!("{}, not so: {}", self.name, test.quantity), ..test });
        self
    }

    /// The verdict: 2 holds, 1 in part, 0 does not hold.
    pub fn verdict(&self) -> f64 {
        let held = self.tests.iter().chain(&self.denied).filter(|test| test.holds()).count();
        match held {
            0 => FAILS,
            _ if held == self.tests.len() + self.denied.len() => HOLDS,
            _ => IN_PART,
        }
    }

    /// Adds the tests, and in the whole study the verdict.
    pub fn judge(self, outcome: &mut Outcome, quick: bool) {
        if !quick {
            let found = match (self.tests.is_empty(), self.denied.is_empty()) {
                (_, true) => HOLDS,
                (true, false) => FAILS,
                (false, false) => IN_PART,
            };
            let name = format!("{}: verdict", self.name);
            outcome.checks.push(Check::absolute(name, self.verdict(), found, 0.0).as_finding());
        }
        outcome.checks.extend(self.tests);
        outcome.checks.extend(self.denied.into_iter().map(opposite));
    }
}

/// The check that a bound is not kept.
fn opposite(test: Check) -> Check {
    let tolerance = if test.tolerance == Tolerance::AtMost { Tolerance::AtLeast } else { Tolerance::AtMost };
    Check { tolerance, ..test }.as_finding()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_statement_holds_in_part_where_one_of_its_tests_does_not() {
        let whole = Statement::new("x").says(Check::at_most("a", 1.0, 2.0));
        assert_eq!(whole.verdict(), HOLDS);
        let part = whole.denied(Check::at_most("b", 3.0, 2.0));
        assert_eq!(part.verdict(), IN_PART);
        let mut outcome = Outcome::default();
        part.judge(&mut outcome, false);
        assert!(outcome.checks.len() == 3 && outcome.holds());
        let mut outcome = Outcome::default();
        Statement::new("x").says(Check::at_most("a", 3.0, 2.0)).judge(&mut outcome, false);
        assert!(outcome.checks.iter().all(|check| !check.holds()));
    }
}
