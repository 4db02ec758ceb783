//! `[heat]`: frictional heat of a counterbody that slides; and conduction of a material.

use super::error::Refusal;
use super::keys::{Form, Key, Range};
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
pub(super) const CONDUCTIVITY: Key = Key::new(&[SIZE], "45.0").otherwise("not known");
pub(super) const DIFFUSIVITY: Key = Key::new(&[SIZE], "12.0").otherwise("not known").rule("with `conductivity`");
pub(super) const EXPANSION: Key =
    Key::new(&[Form::Number(Range::SizeOrZero)], "1.2e-5").otherwise("0").rule("with `conductivity`");
pub(super) const RESISTANCE: Key =
    Key::new(&[Form::Number(Range::SizeOrZero)], "0.01").default("0").omitted_as_nothing();

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
                .default("[0, 0]"),
        /// whether the bodies expand, so that the contact changes
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
        match value.node.value {
            Value::Text(_) => value.word().map(|_| Self::Solved),
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
        return if conducts && slides { heat_up(problem, Heating::default(), root, root) } else { Ok(problem) };
    };
    let heating = keys.heating().map_err(|error| refuse(table, &error))?;
    heat_up(problem, heating, table, root)
}

fn heat_up(problem: Problem, heating: Heating, section: &TableAt<'_>, root: &TableAt<'_>) -> Result<Problem, Refusal> {
    let expands = heating.expands()
        && problem
            .bodies()
            .each()
            .flat_map(|body| body.materials())
            .any(|material| material.conduction().is_some_and(|conduction| conduction.expansion() > 0.0));
    if expands && (root.section("stress")?.is_some() || !problem.bodies().each().all(is_silent)) {
        let message = "`heat`: stresses by heat are not computed, and strengths would miss them";
        return Err(Refusal::new(section.span, message, "thermal stresses").help(
            "leave [stress] and strengths out, set heat.expansion = false, or leave `expansion` of the materials out",
        ));
    }
    problem.heated(heating).map_err(|error| refuse(section, &error))
}

/// Whether a body has no strengths, fatigue or endurance, by which its stresses would be judged.
fn is_silent(body: &percoat_core::body::HalfSpace) -> bool {
    let bodies = percoat_core::body::Bodies::from(body);
    percoat_core::reading::Criterion::all(&bodies).is_empty() && !bodies.tire()
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
