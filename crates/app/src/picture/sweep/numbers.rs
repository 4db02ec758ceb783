//! The numbers of a sweep's results that a picture shows.

use crate::picture::labels::Labels;
use crate::sweep::{Kind, LimitValue, Measured, Row, SCALARS, Scalar, SweepResult};
use percoat_case::units::Units;
use percoat_core::reading::{Criterion, Verdict};
use percoat_draw::label::Label;

/// A number of a result.
pub struct Number {
    pub quantity: Label,
    of: Of,
}

/// Quantity of a number.
enum Of {
    /// One of the main scalars of a load step.
    Scalar(&'static Scalar),
    /// The largest utilisation of a load step.
    Utilisation,
    /// The first limit load, or that of a criterion.
    Limit(Option<Criterion>),
}

/// Bound of a limit without a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// It is reached below the smallest load that the grid resolves.
    Below,
    /// It is not reached.
    Above,
    /// Within its error it may be reached.
    Undecided,
}

impl Number {
    /// The one of [`SCALARS`] with this name.
    fn scalar(quantity: impl Into<Label>, name: &str) -> Self {
        let scalar = SCALARS.iter().find(|scalar| scalar.name == name).expect("the name of a scalar");
        Self { quantity: quantity.into(), of: Of::Scalar(scalar) }
    }

    /// Its value; `None` where the result does not have it, or it is infinite.
    pub fn value(&self, result: &SweepResult) -> Option<f64> {
        self.measured(result).map(|(value, _)| value)
    }

    /// Its value and error; `None` where the result does not have it, or it is infinite.
    pub fn measured(&self, result: &SweepResult) -> Option<Measured> {
        match self.of {
            Of::Scalar(scalar) => (scalar.of)(result.step()?),
            Of::Utilisation => result.largest_utilisation(),
            Of::Limit(of) => result.limit_value(of)?.measured(),
        }
    }

    /// Whether it is a number of passes, which a power of the stresses spreads.
    pub fn is_passes(&self) -> bool {
        matches!(self.of, Of::Scalar(scalar) if scalar.kind == Kind::Passes)
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
            Of::Scalar(_) => false,
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
    let mut all = vec![
        limit("first limit", None),
        Number::scalar(units.pressure_of("peak pressure", "p"), "peak pressure"),
        Number::scalar(units.length_of("penetration", "δ"), "penetration"),
        Number::scalar("passes until the first damage", "passes to damage"),
        Number::scalar("fraction in contact", "contact"),
        Number::scalar(units.area_of("area of contact", "A"), "contact area"),
        Number { quantity: "largest utilisation".into(), of: Of::Utilisation },
        Number::scalar(units.pressure_of("largest shear stress", "τ₁"), "largest τ₁"),
    ];
    let criteria = SweepResult::criteria(rows.iter().flat_map(|row| &row.results));
    all.extend(criteria.into_iter().map(|own| limit(&own.to_string(), Some(own))));
    let last = || rows.iter().filter_map(|row| row.results.last());
    all.retain(|number| last().any(|result| number.value(result).is_some()));
    all
}
