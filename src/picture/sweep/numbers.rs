//! The numbers of a sweep's results that a picture shows.

use super::super::label::Label;
use super::first::First;
use crate::sweep::Row;
use crate::units::Units;
use serde_json::Value;

/// Name of the number that says what is taken up of a strength.
const UTILISATION: &str = "largest utilisation";

/// Where a number of a result stands.
type Place = Box<dyn Fn(&Value) -> Option<f64> + Sync>;

/// A number of a result.
pub struct Number {
    pub quantity: Label,
    pub value: Place,
    /// Name of the limit whose number it is.
    limit: Option<String>,
}

/// What is known where there is no number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// It is reached below the smallest load that the grid resolves.
    Below,
    /// It is not reached.
    Above,
    /// By its error it may be reached.
    Undecided,
}

impl Number {
    fn at(quantity: impl Into<Label>, pointer: &'static str) -> Self {
        Self {
            quantity: quantity.into(),
            value: Box::new(move |result| result.pointer(pointer)?.as_f64()),
            limit: None,
        }
    }

    /// The largest of a list.
    fn largest(quantity: impl Into<Label>, list: &'static str, pointer: &'static str) -> Self {
        let value = move |result: &Value| {
            let items = result.pointer(list)?.as_array()?.iter();
            items.filter_map(|item| item.pointer(pointer)?.as_f64()).reduce(f64::max)
        };
        Self { quantity: quantity.into(), value: Box::new(value), limit: None }
    }

    /// Whether it is a limit load.
    pub fn is_limit(&self) -> bool {
        self.limit.is_some()
    }

    /// Whether the errors leave open which criterion the number is of, or for the largest utilisation whether anything fails.
    pub fn is_undecided(&self, result: &Value) -> bool {
        match &self.limit {
            Some(limit) => limit == "first" && First::is_undecided(result),
            None if self.quantity.text() == UTILISATION => {
                result.pointer("/governing/state").and_then(Value::as_str) == Some("undecided")
            }
            None => false,
        }
    }

    /// What is known of a limit that has no number.
    pub fn bound(&self, result: &Value) -> Option<Bound> {
        let limit = result.get(self.limit.as_ref()?)?;
        if limit.get("reached").and_then(Value::as_str) == Some("undecided") {
            return Some(Bound::Undecided);
        }
        match (limit.get("below"), limit.get("up_to")) {
            (Some(_), _) => Some(Bound::Below),
            (None, Some(_)) => Some(Bound::Above),
            // The first of all, where nothing fails.
            (None, None) => limit.is_null().then_some(Bound::Above),
        }
    }
}

/// The numbers that the rows have.
pub fn numbers(units: &Units, rows: &[Row]) -> Vec<Number> {
    let limits = |result: &Value| -> Vec<String> {
        let names = result.as_object().into_iter().flatten().map(|(name, _)| name.clone());
        names.filter(|name| result.get("first").is_some() && name != "first").collect()
    };
    let limit = |words: &str, name: String| {
        let (quantity, own) = (units.pressure_of(&format!("{words}, mean pressure"), "p̄"), name.clone());
        let value = move |result: &Value| result.get(&own)?.get("mean_pressure")?.as_f64();
        Number { quantity, value: Box::new(value), limit: Some(name) }
    };
    let mut all = vec![
        limit("first limit", "first".to_owned()),
        Number::at(units.pressure_of("peak pressure", "p"), "/max_pressure"),
        Number::at(units.length_of("penetration", "δ"), "/penetration"),
        Number::at("fraction in contact", "/contact_fraction"),
        Number::largest(UTILISATION, "/strength", "/utilisation"),
        Number::largest(units.pressure_of("largest shear stress", "τ₁"), "/stress/materials", "/max_tau1/value"),
    ];
    for name in rows.iter().flat_map(|row| &row.results).next().map(limits).unwrap_or_default() {
        all.push(limit(&name.replace('_', " "), name));
    }
    let is_there = |number: &Number| {
        rows.iter().filter_map(|row| row.results.last()).any(|result| (number.value)(result).is_some())
    };
    all.retain(is_there);
    all
}
