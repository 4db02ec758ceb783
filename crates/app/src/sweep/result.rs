//! A result of a combination: a load step, or the limit loads; and its numbers for tables, pictures and the report.

use crate::output::columns::{Cells, scalars};
use crate::output::{FirstLimit, number, with_error};
use percoat_core::load::LoadQuantity;
use percoat_core::measured::Measured;
use percoat_core::reading::{
    Criterion, HYSTERESIS, LIFE, READING, TEMPERATURE, UTILISATION, Utilisation, Verdict, within_the_errors,
};
use percoat_core::run::{At, Limit, OfStep, StepRecord, first, rivals};
use percoat_core::stress::maxima::EXTREMES;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt;

/// A result of a combination.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SweepResult {
    /// One of its load steps, without the time of its solution.
    Step(Box<StepRecord>),
    /// The limit load of each criterion.
    Limits(Vec<Limit>),
}

/// The first criterion that is reached in a search for limit loads, or the governing one under a load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Foremost {
    /// A criterion.
    Criterion(Criterion),
    /// No criterion is reached, and some may be within the errors.
    Undecided,
    /// No criterion is reached.
    Nothing,
}

/// A limit, or a bound of it; loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LimitValue {
    /// The limit and its error.
    At(f64, Option<f64>),
    /// The limit is below this load, the smallest one that the grid resolves.
    Below(f64),
    /// The limit is not reached up to this load.
    Above(f64),
    /// The limit may be reached within its error.
    Undecided,
}

/// The main quantities of a load step: the load in both of its quantities, and either extent of contact.
pub static SHOWN: [&dyn OfStep; 12] = [
    &READING.mean_pressure,
    &READING.force,
    &READING.penetration,
    &READING.contact_fraction,
    &READING.contact_area,
    &READING.max_pressure,
    &HYSTERESIS.friction_coefficient,
    &TEMPERATURE.max,
    &EXTREMES.tau1,
    &EXTREMES.tension,
    &EXTREMES.mises,
    &LIFE.passes,
];

/// The main quantities, with the load in this one alone.
pub fn shown_with(quantity: LoadQuantity) -> impl Iterator<Item = &'static dyn OfStep> {
    let other = match quantity {
        LoadQuantity::MeanPressure => &READING.force,
        LoadQuantity::Force => &READING.mean_pressure,
    };
    SHOWN.into_iter().filter(move |shown| *shown.named() != other.named)
}

/// A quantity of a load step in a sweep; `None` where the step has none, or an infinite one, and of the area of contact where the step has
/// its fraction.
pub fn stated(quantity: &dyn OfStep, step: &StepRecord) -> Option<Measured> {
    let is_stated = *quantity.named() != READING.contact_area.named || step.reading.contact_fraction.is_none();
    quantity.of_step(step).filter(|_| is_stated).and_then(Measured::finite)
}

impl SweepResult {
    /// The load step; `None` for limits.
    pub fn step(&self) -> Option<&StepRecord> {
        if let Self::Step(step) = self { Some(step) } else { None }
    }

    /// The limit of each criterion; `None` for a load step.
    pub fn limits(&self) -> Option<&[Limit]> {
        if let Self::Limits(limits) = self { Some(limits) } else { None }
    }

    /// The quantity of its loads; `None` for a load step that has both.
    pub fn quantity(&self) -> Option<LoadQuantity> {
        match self {
            Self::Step(step) => Some(step.kind().load_quantity()).filter(|quantity| *quantity == LoadQuantity::Force),
            Self::Limits(limits) => limits.first().map(|limit| limit.quantity),
        }
    }

    /// The first limit, or that of a criterion; `None` for a load step, and where none is reached first.
    pub fn limit(&self, of: Option<Criterion>) -> Option<&Limit> {
        let limits = self.limits()?;
        match of {
            None => first(limits),
            Some(criterion) => limits.iter().find(|limit| limit.criterion == criterion),
        }
    }

    /// The criteria of the limits of several results, see [`Criterion::distinct`].
    pub fn criteria<'a>(results: impl Iterator<Item = &'a Self>) -> Vec<Criterion> {
        Criterion::distinct(results.filter_map(Self::limits).flatten().map(|limit| limit.criterion))
    }

    /// Value or bound of the first limit, or of that of a criterion. Where no limit comes first: undecided if one may within the
    /// errors, else `None`.
    pub fn limit_value(&self, of: Option<Criterion>) -> Option<LimitValue> {
        match self.limit(of) {
            Some(limit) => Some(limit.into()),
            None => (of.is_none() && self.foremost()? == Foremost::Undecided).then_some(LimitValue::Undecided),
        }
    }

    /// The largest utilisation of a load step and its error; `None` of one without strengths, and of limits.
    pub fn largest_utilisation(&self) -> Option<Measured> {
        let finite = self.step()?.strength.iter().filter_map(|taken| UTILISATION.value.finite(taken));
        finite.max_by(|a, b| a.value.total_cmp(&b.value))
    }

    /// Whether every criterion holds by more than its error; false where one fails by more than its error, `None` where that is open, of a
    /// load step without strengths, and of limits.
    pub fn holds(&self) -> Option<bool> {
        let strength = &self.step()?.strength;
        let is = |verdict: Verdict| move |taken: &Utilisation| taken.verdict == verdict;
        let fails = strength.iter().any(is(Verdict::Fails));
        (fails || !strength.is_empty() && strength.iter().all(is(Verdict::Holds))).then_some(!fails)
    }

    /// The criterion that comes first; `None` of a load step without strengths.
    pub fn foremost(&self) -> Option<Foremost> {
        match self {
            Self::Step(step) => step.governing.as_ref().map(|governing| Foremost::Criterion(governing.criterion)),
            Self::Limits(limits) => Some(match first(limits) {
                Some(first) => Foremost::Criterion(first.criterion),
                None if rivals(limits).is_empty() => Foremost::Nothing,
                None => Foremost::Undecided,
            }),
        }
    }

    /// The criteria that may be foremost within the errors instead.
    pub fn rivals(&self) -> Vec<Criterion> {
        match self {
            Self::Step(step) => step.governing.as_ref().map_or(Vec::new(), |governing| governing.rivals.clone()),
            Self::Limits(limits) => rivals(limits),
        }
    }

    /// The foremost criterion with its rivals in words; `None` for a load step without strengths.
    pub fn foremost_in_words(&self) -> Option<String> {
        let Foremost::Criterion(criterion) = self.foremost()? else { return None };
        Some(format!("{criterion}{}", within_the_errors(&self.rivals())))
    }

    /// Cells of a result in `sweep.csv`: scalars of a step, or the first limit under `first` and each under its name.
    pub(super) fn cells(&self) -> Cells {
        let limits = match self {
            Self::Step(step) => return scalars(&json!(step)),
            Self::Limits(limits) => limits,
        };
        let rivals = rivals(limits);
        let first = match first(limits) {
            Some(limit) => json!(FirstLimit { limit: *limit, rivals }),
            None if rivals.is_empty() => json!(null),
            None => {
                let rivals: Vec<String> = rivals.into_iter().map(Criterion::code_with_name).collect();
                json!({ "criterion": null, "reached": "undecided", "rivals": rivals })
            }
        };
        let named = limits.iter().map(|limit| {
            let mut keys = json!(limit);
            if let Some(keys) = keys.as_object_mut() {
                // The names of the columns have them.
                ["criterion", "material", "interface", "name"].iter().for_each(|key| drop(keys.shift_remove(*key)));
            }
            json!({ limit.criterion.code().replace(' ', "_"): keys })
        });
        [json!({ "first": first })].into_iter().chain(named).flat_map(|value| scalars(&value)).collect()
    }
}

impl Foremost {
    /// Counts of what comes first in each of the results; the most frequent first.
    pub fn counted<'a>(results: impl Iterator<Item = &'a SweepResult>) -> Vec<(Self, usize)> {
        let all: Vec<Self> = results.filter_map(SweepResult::foremost).collect();
        let criterion =
            |foremost: &Self| if let Self::Criterion(criterion) = foremost { Some(*criterion) } else { None };
        let named = Criterion::distinct(all.iter().filter_map(criterion)).into_iter().map(Self::Criterion);
        let mut counts: BTreeMap<Self, usize> = named.map(|foremost| (foremost, 0)).collect();
        all.into_iter().for_each(|foremost| *counts.entry(foremost).or_default() += 1);
        let mut counted: Vec<(Self, usize)> = counts.into_iter().collect();
        counted.sort_by_key(|(_, count)| usize::MAX - count);
        counted
    }
}

impl fmt::Display for Foremost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Criterion(criterion) => criterion.fmt(f),
            Self::Undecided => f.write_str("undecided"),
            Self::Nothing => f.write_str("nothing fails"),
        }
    }
}

impl LimitValue {
    /// The limit and its error; `None` of a bound.
    pub fn measured(self) -> Option<Measured> {
        if let Self::At(load, error) = self { Some(Measured::new(load, error)) } else { None }
    }
}

impl From<&Limit> for LimitValue {
    fn from(limit: &Limit) -> Self {
        match limit.at {
            At::Rest | At::Tip { .. } => Self::At(0.0, Some(0.0)),
            At::Load { load, error, .. } => Self::At(load, error),
            At::Below { load, .. } => Self::Below(load),
            At::Never { up_to, .. } => Self::Above(up_to),
            At::Undecided { .. } => Self::Undecided,
        }
    }
}

/// The value as in tables: 0.007 ± 0.003, < 0.01 or > 2.
impl fmt::Display for LimitValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::At(0.0, _) => f.write_str("0"),
            Self::At(load, error) => f.write_str(&with_error(load, error)),
            Self::Below(load) => write!(f, "< {}", number(load)),
            Self::Above(load) => write!(f, "> {}", number(load)),
            Self::Undecided => f.write_str("undecided"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::{below, never, reached};
    use super::*;
    use percoat_core::body::{MaterialId, Name};
    use percoat_core::load::LoadQuantity;

    #[test]
    fn a_limit_is_found_whatever_the_name_of_its_material() {
        let named =
            |name: &str| Criterion::Yield(MaterialId { name: Some(Name::new(name)), ..MaterialId::numbered(2) });
        let results = [("TiN", 0.2), ("CrN", 0.4)]
            .map(|(name, load)| SweepResult::Limits(vec![reached(named(name), load, 0.01)]));
        let criteria = SweepResult::criteria(results.iter());
        assert_eq!(criteria.iter().map(Criterion::to_string).collect::<Vec<_>>(), ["yield of material 2"]);
        assert!(results.iter().all(|result| matches!(result.limit_value(Some(criteria[0])), Some(LimitValue::At(..)))));
        let counted = Foremost::counted(results.iter());
        assert_eq!((counted.len(), counted[0].1, counted[0].0.to_string()), (1, 2, "yield of material 2".to_owned()));
        assert_eq!(results[0].limit_value(Some(Criterion::cracking_of(2))), None);
    }

    #[test]
    fn an_isolated_contact_has_a_force_and_an_area_in_the_place_of_means() {
        let periodic = super::super::examples::step(2.0, None, 0.5);
        let isolated = super::super::examples::isolated(3.0, 2.0);
        let values = |step: &StepRecord, quantity: LoadQuantity| -> Vec<(&str, f64)> {
            shown_with(quantity).filter_map(|shown| Some((shown.named().name, stated(shown, step)?.value))).collect()
        };
        let peak = ("peak pressure", 2.0);
        let expected = [("force", 3.0), ("penetration", 2.0), ("contact area", 1.5), peak];
        assert_eq!(values(&isolated, LoadQuantity::Force), expected);
        assert_eq!(values(&isolated, LoadQuantity::MeanPressure), expected[1..]);
        let expected = [("mean pressure", 0.1), ("penetration", 2.0), ("fraction in contact", 0.5), peak];
        assert_eq!(values(&periodic, LoadQuantity::MeanPressure), expected);
        assert_eq!(values(&periodic, LoadQuantity::Force)[0], ("force", 0.1));
    }

    #[test]
    fn limits_are_shown_with_their_errors_or_a_bound() {
        let [yields, parts] = [Criterion::yield_of(2), Criterion::delamination_of(2)];
        let told = |limits: Vec<Limit>, of: Option<Criterion>| {
            SweepResult::Limits(limits).limit_value(of).map(|value| value.to_string())
        };
        let text = |text: &str| Some(text.to_owned());
        assert_eq!(told(vec![reached(parts, 0.006_646_1, 0.0025), never(yields, 3.5)], None), text("0.0041 to 0.0092"));
        assert_eq!(told(vec![below(parts, 0.0012)], None), text("< 0.0012000"));
        assert_eq!(told(vec![never(yields, 3.5)], Some(yields)), text("> 3.5000"));
        assert_eq!(
            told(vec![Limit { criterion: yields, quantity: LoadQuantity::default(), at: At::Rest }], Some(yields)),
            text("0")
        );
        assert_eq!(told(vec![never(yields, 3.5)], None), None);
    }

    #[test]
    fn the_cells_of_limits_are_the_first_and_each_under_its_name() {
        let [yields, parts] = [Criterion::yield_of(2), Criterion::delamination_of(1)];
        let cells = SweepResult::Limits(vec![reached(yields, 0.2, 0.05), reached(parts, 0.24, 0.01)]).cells();
        let cell = |name: &str| cells.iter().find(|(column, _)| column == name).map(|(_, cell)| cell.clone());
        for (name, value) in [
            ("first_criterion", json!("yield")),
            ("first_material", json!(2)),
            ("first_mean_pressure", json!(0.2)),
            ("first_reached", json!("under_load")),
            ("first_rivals", json!("delamination of interface 1")),
            ("yield_of_material_2_mean_pressure", json!(0.2)),
            ("delamination_of_interface_1_error", json!(0.01)),
        ] {
            assert_eq!(cell(name), Some(value), "{name}");
        }
        assert_eq!(cell("yield_of_material_2_criterion"), None, "it stands in the name");
    }
}
