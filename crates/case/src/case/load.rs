//! `[load]`: the mean pressures, forces or penetrations to solve for, one after another, or a pressure that is given.

use serde::{Serialize, Serializer};
use std::slice;

use super::error::Refusal;
use super::given::{DISCS, GivenSection};
use super::keys::{Form, Key, Keys, Range, Unit, measured_in};
use super::node::Value;
use super::reader::TableAt;
use super::section::{KeyValue, ReadTable, Words, demanded, section, words};
use super::source::Source;
use super::value::ValueAt;
use percoat_core::counterbody::LoadedBy;
use percoat_core::load::{Load, LoadQuantity};

/// Most load steps a case can have.
const STEPS: usize = 10_000;

const SIZE_OR_ZERO: Form = Form::Number(Range::SizeOrZero);
const LOADS: Form = Form::List { of: &SIZE_OR_ZERO, count: [1, STEPS] };

section! {
    /// The section `[load]`: one of the keys, one value a load step.
    pub struct LoadSection = LOAD, rules one {
        /// the mean pressure p̄
        pub mean_pressure: Option<Steps> =
            Key::new(&[SIZE_OR_ZERO, LOADS, Form::Table(&PRESSURES)], "[0.01, 0.06]").unit(Unit::Pressure),
        /// the force P on one cell, or on an isolated contact, in the unit of pressure times that of length squared
        pub force: Option<Steps> = Key::new(&[SIZE_OR_ZERO, LOADS, Form::Table(&FORCES)], "[5.0]")
            .unit(Unit::Force)
            .instead_of("mean_pressure"),
        /// the penetration δ from first touch
        pub penetration: Option<Steps> =
            Key::new(&[SIZE_OR_ZERO, LOADS, Form::Table(&PENETRATIONS)], "[0.01, 0.05]")
                .unit(Unit::Length)
                .instead_of("force")
                .and_of(&["mean_pressure"]),
        /// a pressure on the body that is given, without anything that presses: uniform on discs, or a field from a file like that of a surface
        pub pressure: Option<GivenSection> =
            Key::new(&[Form::Table(&DISCS), Form::Text("the path of a file")], "{ disc = [[0.0, 0.0, 0.1]], value = 0.7 }")
                .instead_of("penetration")
                .and_of(&["mean_pressure", "force"]),
    }
    beside {
        /// Load of a pressure that is given: the force on an isolated window, else the mean pressure.
        pub given: Option<Load>,
    }
}

static PRESSURES: Keys = Keys::new(&measured_in::<4>(RANGE.all, Unit::Pressure));
static FORCES: Keys = Keys::new(&measured_in::<4>(RANGE.all, Unit::Force));
static PENETRATIONS: Keys = Keys::new(&measured_in::<4>(RANGE.all, Unit::Length));

section! {
    /// A range of load steps.
    pub struct LoadRange = RANGE, rules positive_ends {
        /// the first value
        pub from: f64 = Key::new(&[SIZE_OR_ZERO], "1e-4").rule("greater than 0 with `spacing = \"log\"`"),
        /// the last value
        pub to: f64 = Key::new(&[SIZE_OR_ZERO], "0.06").rule("greater than 0 with `spacing = \"log\"`"),
        /// the number of values, both ends counted
        pub steps: usize = Key::new(&[Form::Integer(1, STEPS)], "20"),
        /// by equal amounts or by equal factors
        pub spacing: Spacing = Key::new(&[Form::Word(Spacing::WORDS)], "\"log\"").default("\"linear\""),
    }
}

words! {
    /// Spacing of the values of a range.
    pub enum Spacing {
        /// Equal differences.
        Linear = "linear",
        /// Equal factors.
        Log = "log",
    }
}

/// The values of the load steps, at least one.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps(Vec<f64>);

impl Serialize for Steps {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl KeyValue for Steps {
    /// Reads a number, a list, or a range.
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::List(_) => Vec::read(value),
            Value::Table(_) => LoadRange::read(value).map(|range| range.values()),
            _ => value.number().map(|load| vec![load]),
        }
        .map(Self)
    }
}

fn one(_: &LoadSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    section.one_of(["mean_pressure", "force", "penetration", "pressure"]).map(drop)
}

/// Reads `[load]` of a case with what loads its body: a counterbody, or a given pressure, whose load is kept.
pub(super) fn read(section: &TableAt<'_>, source: &Source, loaded_by: &LoadedBy) -> Result<LoadSection, Refusal> {
    let quantity = loaded_by.kind().load_quantity();
    if quantity == LoadQuantity::Force {
        of_isolated(section)?;
    }
    let load = LoadSection::read_table(section)?;
    let given = loaded_by.pressure().map(|given| quantity.of_force(given.force(), given.cell()));
    Ok(LoadSection { pressure: load.pressure.map(|given| given.located(source)), given, ..load })
}

/// Refuses a section without a load of an isolated contact, which has no cell over which a pressure has a mean.
fn of_isolated(section: &TableAt<'_>) -> Result<(), Refusal> {
    section.only()?;
    if let Some(mean) = section.optional("mean_pressure") {
        let message = "`load.mean_pressure` has no meaning for an isolated contact, which has no cell to spread over";
        return Err(Refusal::new(mean.node.span, message, "not for an isolated contact")
            .help("prescribe load.force, in the unit of pressure times that of length squared, or load.penetration"));
    }
    section.one_of(["force", "penetration", "pressure"]).map(drop)
}

fn positive_ends(range: &LoadRange, section: &TableAt<'_>) -> Result<(), Refusal> {
    for (key, end) in [("from", range.from), ("to", range.to)] {
        if end == 0.0 && range.spacing == Spacing::Log {
            let refusal = section.value(key)?.refuse("a finite number greater than 0");
            return Err(refusal.help("spacing = \"log\" never reaches 0"));
        }
    }
    Ok(())
}

impl LoadSection {
    /// The quantity, the kind of load that it prescribes, and its values.
    fn prescribed(&self) -> (&'static str, fn(f64) -> Load, &[f64]) {
        match &self.given {
            Some(Load::Force(force)) => return ("force", Load::Force, slice::from_ref(force)),
            Some(Load::MeanPressure(mean)) => return ("mean_pressure", Load::MeanPressure, slice::from_ref(mean)),
            _ => {}
        }
        match (&self.mean_pressure, &self.force) {
            (Some(Steps(pressures)), _) => ("mean_pressure", Load::MeanPressure, pressures),
            (None, Some(Steps(forces))) => ("force", Load::Force, forces),
            (None, None) => ("penetration", Load::Penetration, &demanded(self.penetration.as_ref()).0),
        }
    }

    /// The prescribed values, one a load step.
    pub fn values(&self) -> &[f64] {
        self.prescribed().2
    }

    /// Name of the prescribed quantity, as in the case file; of a given pressure that of its load.
    pub fn quantity(&self) -> &'static str {
        self.prescribed().0
    }

    /// The prescribed load of each step.
    pub fn loads(&self) -> Vec<Load> {
        let (_, load, values) = self.prescribed();
        values.iter().map(|&value| load(value)).collect()
    }

    /// The mean pressures p̄ on a cell of this area; `None` where penetrations are prescribed.
    pub fn mean_pressures(&self, area: f64) -> Option<Vec<f64>> {
        match self.prescribed() {
            (_, load, values) if load(1.0) == Load::MeanPressure(1.0) => Some(values.to_vec()),
            (_, load, values) if load(1.0) == Load::Force(1.0) => {
                Some(values.iter().map(|force| force / area).collect())
            }
            _ => None,
        }
    }
}

impl LoadRange {
    fn values(&self) -> Vec<f64> {
        let &Self { from, to, steps, spacing } = self;
        (0..steps)
            .map(|step| match (step, step as f64 / (steps - 1).max(1) as f64, spacing) {
                (0, ..) => from,
                (step, ..) if step + 1 == steps => to,
                (_, part, Spacing::Linear) => from + part * (to - from),
                (_, part, Spacing::Log) => from * (to / from).powf(part),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::error::CaseError;
    use super::super::node::{Node, Table};
    use super::*;

    fn read(value: &str) -> Result<LoadSection, Refusal> {
        let table = Table::parse(&format!("mean_pressure = {value}")).unwrap();
        LoadSection::read_table(&TableAt::root(&table, &LOAD, Node::parse("0", 0, 0).unwrap().span))
    }

    #[test]
    fn ranges_keep_both_ends_exactly() {
        let values = |text| read(text).unwrap().values().to_vec();
        assert_eq!(values("{ from = 0.1, to = 0.7, steps = 4 }")[3], 0.7);
        assert_eq!(values("{ from = 1, to = 2, steps = 3, spacing = \"linear\" }"), [1.0, 1.5, 2.0]);
        assert_eq!(values("{ from = 0.3, to = 0.7, steps = 1 }"), [0.3]);
        let log = values("{ from = 1e-4, to = 1e-1, steps = 4, spacing = \"log\" }");
        assert_eq!((log[0], log[3]), (1e-4, 1e-1));
        assert!((log[1] / 1e-3 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn an_isolated_contact_has_a_force_or_a_penetration() {
        let refused = |text: &str| {
            let table = Table::parse(text).unwrap();
            let section = TableAt::root(&table, &LOAD, Node::parse("0", 0, 0).unwrap().span);
            Some(CaseError::new("a.toml", text, of_isolated(&section).err()?).message().to_owned())
        };
        assert_eq!(refused("force = 5"), None);
        assert_eq!(refused("penetration = 5"), None);
        assert!(refused("mean_pressure = \"much\"").unwrap().contains("no meaning for an isolated contact"));
        assert!(refused("forces = 5").unwrap().contains("unknown key"));
        let missing = refused("").unwrap();
        assert_eq!(missing, "`force`, `penetration` or `pressure` is missing");
    }

    #[test]
    fn a_number_is_a_list_of_one() {
        assert_eq!(read("0.5").unwrap().mean_pressures(1.0), Some(vec![0.5]));
        assert_eq!(read("[0, 2]").unwrap().mean_pressures(1.0), Some(vec![0.0, 2.0]));
    }
}
