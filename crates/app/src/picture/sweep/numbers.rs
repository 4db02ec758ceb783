//! The numbers of a sweep's results that a picture shows.

use crate::picture::labels::Labels;
use crate::sweep::{LimitValue, Row, SweepResult, stated};
use percoat_case::units::Units;
use percoat_core::measured::Measured;
use percoat_core::quantity::Kind;
use percoat_core::reading::{Criterion, HYSTERESIS, LIFE, READING, TEMPERATURE, UTILISATION, Verdict};
use percoat_core::run::OfStep;
use percoat_core::stress::maxima::EXTREMES;
use percoat_draw::label::Label;

/// A number of a result.
pub struct Number {
    pub quantity: Label,
    of: Of,
}

/// Source of a number of a combination.
enum Of {
    /// One of the main quantities of a load step.
    Step(&'static dyn OfStep),
    /// The largest utilisation of a load step.
    Utilisation,
    /// The first limit load, or that of a criterion.
    Limit(Option<Criterion>),
}

/// Bound of a limit without a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// A limit below the smallest load that the grid resolves.
    Below,
    /// A limit that is not reached.
    Above,
    /// A limit that may be reached within the errors.
    Undecided,
}

impl Number {
    fn of_step(units: &Units, quantity: &'static dyn OfStep) -> Self {
        Self { quantity: units.label(quantity.named()), of: Of::Step(quantity) }
    }

    /// Value of the number; `None` where the result does not have it, or it is infinite.
    pub fn value(&self, result: &SweepResult) -> Option<f64> {
        self.measured(result).map(|found| found.value)
    }

    /// Value and error of the number; `None` where the result does not have it, or it is infinite.
    pub fn measured(&self, result: &SweepResult) -> Option<Measured> {
        match self.of {
            Of::Step(quantity) => stated(quantity, result.step()?),
            Of::Utilisation => result.largest_utilisation(),
            Of::Limit(of) => result.limit_value(of)?.measured(),
        }
    }

    /// Whether it is a number of passes, which a power of the stresses spreads.
    pub fn is_passes(&self) -> bool {
        matches!(self.of, Of::Step(quantity) if quantity.named().kind == Kind::Passes)
    }

    /// Whether it is a limit load.
    pub fn is_limit(&self) -> bool {
        matches!(self.of, Of::Limit(_))
    }

    /// Whether the errors leave open which criterion the number is of, or for the largest utilisation whether anything fails.
    pub fn is_undecided(&self, result: &SweepResult) -> bool {
        match self.of {
            Of::Limit(of) => of.is_none() && !result.rivals().is_empty(),
            Of::Utilisation => {
                let governing = result.step().and_then(|step| step.governing.as_ref());
                governing.is_some_and(|governing| governing.verdict == Verdict::Undecided)
            }
            Of::Step(_) => false,
        }
    }

    /// Bound of a limit without a number; `None` for other numbers.
    pub fn bound(&self, result: &SweepResult) -> Option<Bound> {
        let Of::Limit(of) = self.of else { return None };
        result.limits()?;
        match result.limit_value(of) {
            Some(LimitValue::At(..)) => None,
            Some(LimitValue::Undecided) => Some(Bound::Undecided),
            Some(LimitValue::Below(_)) => Some(Bound::Below),
            Some(LimitValue::Above(_)) => Some(Bound::Above),
            // Nothing comes first; or the case has no such criterion.
            None => of.is_none().then_some(Bound::Above),
        }
    }
}

/// The numbers that the rows have.
pub fn numbers(units: &Units, rows: &[Row]) -> Vec<Number> {
    let limit = |words: &str, of: Option<Criterion>| Number { quantity: units.load_of(words), of: Of::Limit(of) };
    let of_step = |quantity: &'static dyn OfStep| Number::of_step(units, quantity);
    let mut all = vec![
        limit("first limit", None),
        of_step(&READING.max_pressure),
        of_step(&READING.penetration),
        of_step(&LIFE.passes),
        of_step(&READING.contact_fraction),
        of_step(&READING.contact_area),
        Number { quantity: format!("largest {}", UTILISATION.value.named.name).into(), of: Of::Utilisation },
        of_step(&HYSTERESIS.friction_coefficient),
        of_step(&TEMPERATURE.max),
        of_step(&EXTREMES.tau1),
    ];
    let criteria = SweepResult::criteria(rows.iter().flat_map(|row| &row.results));
    all.extend(criteria.into_iter().map(|criterion| limit(&criterion.to_string(), Some(criterion))));
    let last = || rows.iter().filter_map(|row| row.results.last());
    all.retain(|number| last().any(|result| number.value(result).is_some()));
    all
}
