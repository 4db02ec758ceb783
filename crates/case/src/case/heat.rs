//! `[heat]`: frictional heat of a counterbody that slides; and conduction of a material.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::node::Value;
use super::reader::TableAt;
use super::section::{KeyValue, section};
use super::value::ValueAt;
use percoat_core::body::{Conduction, ConductionError};
use percoat_core::heating::{Heating, HeatingError, Partition};
use percoat_core::problem::Problem;
use serde::Serialize;

const SIZE: Form = Form::Number(Range::Size);
const SHARE: Form = Form::Number(Range::between(0.0, 1.0));
const SOLVED: &[&str] = &["solved"];

// Keys of layers, of the substrate and of the counterbody, in any consistent units of heat: a power is a force times a velocity.
pub(super) const CONDUCTIVITY: Key = Key::new(&[SIZE], "45.0")
    .unit(Unit::Other("power per length and temperature; a power is a force times a velocity"))
    .otherwise("not known");
pub(super) const DIFFUSIVITY: Key = Key::new(&[SIZE], "12.0")
    .unit(Unit::Other("length squared per time"))
    .otherwise("not known")
    .rule("with `conductivity`");
pub(super) const EXPANSION: Key = Key::new(&[Form::Number(Range::SizeOrZero)], "1.2e-5")
    .unit(Unit::Other("one over a temperature"))
    .otherwise("0")
    .rule("with `conductivity`");
pub(super) const RESISTANCE: Key = Key::new(&[Form::Number(Range::SizeOrZero)], "0.01")
    .unit(Unit::Other("temperature per power and area"))
    .default("0")
    .omitted_as_nothing();

section! {
    /// The section `[heat]`.
    #[derive(Copy)]
    pub struct HeatSection = HEAT {
        /// partition of the heat: temperatures that are equal where the surfaces touch, or the share of the body, from 0 to 1
        pub partition: PartitionValue =
            Key::new(&[Form::Word(SOLVED), SHARE], "0.5").default("\"solved\""),
        /// bulk temperatures of the body and of the counterbody
        pub bulk: [f64; 2] =
            Key::new(&[Form::Tuple("two temperatures [body, counterbody]", &[Form::Number(Range::Coordinate); 2])], "[20.0, 20.0]")
                .unit(Unit::Other("temperature; units.temperature names it"))
                .default("[0, 0]"),
        /// whether the bodies expand, so that the contact changes and stresses by heat add to those of the load
        pub expansion: bool = Key::new(&[Form::Boolean], "false").default("true"),
    }
}

/// How the heat is shared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum PartitionValue {
    /// The share of the body.
    Share(f64),
    /// One temperature in contact.
    #[serde(serialize_with = "solved")]
    Solved,
}

fn solved<S: serde::Serializer>(serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(SOLVED[0])
}

impl KeyValue for PartitionValue {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::Text(word) if word == SOLVED[0] => Ok(Self::Solved),
            Value::Text(_) => Err(value.refuse("\"solved\" or a number between 0 and 1")),
            _ => value.number().map(Self::Share),
        }
    }
}

impl HeatSection {
    /// The heat.
    ///
    /// # Errors
    /// [`HeatingError`] for values out of range.
    fn heating(&self) -> Result<Heating, HeatingError> {
        let partition = match self.partition {
            PartitionValue::Solved => Partition::Solved,
            PartitionValue::Share(share) => Partition::Share(share),
        };
        let heating = Heating::new(partition, self.bulk)?;
        Ok(if self.expansion { heating } else { heating.without_expansion() })
    }
}

/// The problem with the heat of the section, or, where it slides with friction over bodies that all conduct, with the default one.
pub(super) fn heated(
    section: Option<(&TableAt<'_>, HeatSection)>,
    root: &TableAt<'_>,
    problem: Problem,
) -> Result<Problem, Refusal> {
    let conducts = problem.bodies().each().all(|body| body.conducts());
    let slides = problem.motion().is_some() && problem.friction().is_some_and(|friction| friction.coefficient() > 0.0);
    let Some((table, keys)) = section else {
        return if conducts && slides { heat_up(problem, Heating::default(), root) } else { Ok(problem) };
    };
    let heating = keys.heating().map_err(|error| refuse(table, &error))?;
    if problem.bodies().counterbody().is_none() {
        let alone = |key: &str| {
            table.optional(key).map(|value| {
                Refusal::new(
                    value.node.span,
                    format!("`heat.{key}` needs an elastic counterbody: a rigid one takes no heat"),
                    "takes no heat",
                )
            })
        };
        let bulk = alone("bulk").filter(|_| keys.bulk[1] != 0.0);
        if let Some(refusal) = alone("partition").or(bulk) {
            return Err(refusal.help("give [counterbody] with `conductivity` and `diffusivity`, or leave the key out"));
        }
    }
    heat_up(problem, heating, table)
}

fn heat_up(problem: Problem, heating: Heating, section: &TableAt<'_>) -> Result<Problem, Refusal> {
    problem.heated(heating).map_err(|error| refuse(section, &error))
}

fn refuse(section: &TableAt<'_>, error: &HeatingError) -> Refusal {
    let help = match error {
        HeatingError::Rest => "add [motion] with a velocity",
        HeatingError::Smooth => "add [friction] with a coefficient above 0",
        HeatingError::Material(_) => {
            "give `conductivity` and `diffusivity` to each layer, the substrate and the counterbody"
        }
        HeatingError::Share(_) | HeatingError::Bulk(_) => "give another value",
    };
    Refusal::new(section.span, format!("`heat`: {error}"), "heat of friction").help(help)
}

/// Refuses a conduction of a material with one of its numbers alone.
pub(super) fn consistent(section: &TableAt<'_>) -> Result<(), Refusal> {
    let [conductivity, diffusivity, expansion] =
        ["conductivity", "diffusivity", "expansion"].map(|key| section.optional(key));
    match (conductivity, diffusivity, expansion) {
        (Some(_), Some(_), _) | (None, None, None) => Ok(()),
        (Some(_), None, _) => Err(section.missing("diffusivity")),
        (None, ..) => Err(section.missing("conductivity")),
    }
}

/// Conduction by the keys of a material; `None` where it is not known.
///
/// # Errors
/// [`ConductionError`] for values out of range.
pub(super) fn conduction(
    [conductivity, diffusivity, expansion]: [Option<f64>; 3],
) -> Result<Option<Conduction>, ConductionError> {
    conductivity
        .zip(diffusivity)
        .map(|(conductivity, diffusivity)| Conduction::new(conductivity, diffusivity, expansion.unwrap_or(0.0)))
        .transpose()
}
