//! `[load]`: the mean pressures, forces, penetrations or positions of a grip to solve for, one after another, or a pressure that is given.

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
pub(super) const STEPS: usize = 10_000;

pub(super) const SIGNED: Form = Form::Number(Range::Coordinate);
pub(super) const LOADS: Form = Form::List { of: &SIGNED, count: [1, STEPS] };
/// Which loads may be below 0.
const NOT_NEGATIVE: &str = "below 0 with [adhesion] alone";

section! {
    /// The section `[load]`: one of the keys, one value a load step.
    pub struct LoadSection = LOAD, rules one, absent is_in_time {
        /// the mean pressure p̄
        pub mean_pressure: Option<Steps> =
            Key::new(&[SIGNED, LOADS, Form::Table(&PRESSURES)], "[0.01, 0.06]").unit(Unit::Pressure).rule(NOT_NEGATIVE),
        /// the force P on one cell, or on an isolated contact, in the unit of pressure times that of length squared
        pub force: Option<Steps> = Key::new(&[SIGNED, LOADS, Form::Table(&FORCES)], "[5.0]")
            .unit(Unit::Force)
            .rule(NOT_NEGATIVE)
            .instead_of("mean_pressure"),
        /// the penetration δ from first touch
        pub penetration: Option<Steps> =
            Key::new(&[SIGNED, LOADS, Form::Table(&PENETRATIONS)], "[0.01, 0.05]")
                .unit(Unit::Length)
                .rule(NOT_NEGATIVE)
                .instead_of("force")
                .and_of(&["mean_pressure"]),
        /// the position of a grip that holds the counterbody by a spring, the penetration and what the force stretches it by, of surfaces that adhere
        pub grip: Option<Steps> = Key::new(&[SIGNED, LOADS, Form::Table(&PENETRATIONS)], "{ from = 0.01, to = -0.02, steps = 40 }")
            .unit(Unit::Length)
            .instead_of("penetration")
            .and_of(&["mean_pressure", "force"]),
        /// stiffness of the spring of `grip`, a force per length
        pub machine_stiffness: Option<f64> = Key::new(&[Form::Number(Range::Size)], "2.0")
            .unit(Unit::PressureTimesLength)
            .otherwise("a rigid machine"),
        /// a pressure on the body that is given, without anything that presses: uniform on discs, or a field from a file like that of a surface
        pub pressure: Option<GivenSection> =
            Key::new(&[Form::Table(&DISCS), Form::Text("the path of a file")], "{ disc = [[0.0, 0.0, 0.1]], value = 0.7 }")
                .instead_of("grip")
                .and_of(&["mean_pressure", "force", "penetration"]),
    }
    beside {
        /// Load of a pressure that is given: the force on an isolated window, else the mean pressure.
        pub given: Option<Load>,
        /// Whether the loads are those of `[time]`.
        pub in_time: bool,
    }
}

static PRESSURES: Keys = Keys::new(&measured_in::<5>(RANGE.all, Unit::Pressure));
static FORCES: Keys = Keys::new(&measured_in::<5>(RANGE.all, Unit::Force));
static PENETRATIONS: Keys = Keys::new(&measured_in::<5>(RANGE.all, Unit::Length));

section! {
    /// A range of load steps.
    pub struct LoadRange = RANGE, rules range {
        /// the first value
        pub from: f64 = Key::new(&[SIGNED], "1e-4").rule("greater than 0 with `spacing = \"log\"`"),
        /// the last value
        pub to: f64 = Key::new(&[SIGNED], "0.06").rule("greater than 0 with `spacing = \"log\"`"),
        /// the number of values, both ends counted
        pub steps: usize = Key::new(&[Form::Integer(1, STEPS)], "20"),
        /// by equal amounts or by equal factors
        pub spacing: Spacing = Key::new(&[Form::Word(Spacing::WORDS)], "\"log\"").default("\"linear\""),
        /// whether the values go back to the first one
        pub back: bool = Key::new(&[Form::Boolean], "true").default("false"),
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

impl Steps {
    /// Values of load steps, at least one.
    pub(super) fn of(values: Vec<f64>) -> Self {
        Self(values)
    }

    /// The values.
    pub fn values(&self) -> &[f64] {
        &self.0
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
    section.one_of(["mean_pressure", "force", "penetration", "grip", "pressure"]).map(drop)
}

fn is_in_time(load: &LoadSection) -> bool {
    load.in_time
}

/// Reads `[load]` of a case with what loads its body: a counterbody, whose surface may adhere, or a given pressure, whose load is kept.
pub(super) fn read(
    section: &TableAt<'_>,
    source: &Source,
    loaded_by: &LoadedBy,
    adheres: bool,
) -> Result<LoadSection, Refusal> {
    let quantity = loaded_by.kind().load_quantity();
    if quantity == LoadQuantity::Force {
        of_isolated(section)?;
    }
    let load = LoadSection::read_table(section)?;
    load.of_surfaces(section, adheres)?;
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
    section.one_of(["force", "penetration", "grip", "pressure"]).map(drop)
}

fn range(range: &LoadRange, section: &TableAt<'_>) -> Result<(), Refusal> {
    if range.back && 2 * range.steps - 1 > STEPS {
        let most = STEPS.div_ceil(2);
        let refusal = section.value("steps")?.refuse(format!("an integer from 1 to {most}"));
        return Err(refusal.help(format!("there and back are twice as many steps, and {STEPS} at most")));
    }
    for (key, end) in [("from", range.from), ("to", range.to)] {
        if end <= 0.0 && range.spacing == Spacing::Log {
            let refusal = section.value(key)?.refuse("a finite number greater than 0");
            return Err(refusal.help("spacing = \"log\" never reaches 0"));
        }
    }
    Ok(())
}

impl LoadSection {
    /// Loads of `[time]`, still without values.
    pub(super) fn in_time() -> Self {
        let (mean_pressure, force, penetration, grip) = (None, None, None, None);
        let (machine_stiffness, pressure, given) = (None, None, None);
        Self { mean_pressure, force, penetration, grip, machine_stiffness, pressure, given, in_time: true }
    }

    /// Refuses loads below 0 and a grip of surfaces that do not adhere, and a stiffness without a grip.
    fn of_surfaces(&self, section: &TableAt<'_>, adheres: bool) -> Result<(), Refusal> {
        if self.machine_stiffness.is_some() && self.grip.is_none() {
            let value = section.value("machine_stiffness")?;
            let message = "`load.machine_stiffness` is that of a machine that holds a grip";
            return Err(Refusal::new(value.node.span, message, "without `grip`").help("prescribe load.grip"));
        }
        if adheres || self.pressure.is_some() {
            return Ok(());
        }
        let value = section.value(self.quantity())?;
        if self.grip.is_some() {
            let message = "`load.grip` is for surfaces that adhere";
            return Err(Refusal::new(value.node.span, message, "without [adhesion]")
                .help("prescribe load.penetration, or add [adhesion]"));
        }
        let Some(index) = self.values().iter().position(|value| *value < 0.0) else { return Ok(()) };
        let refused = |value: &ValueAt<'_>| value.refuse("a finite number not less than 0");
        let refusal = match &value.node.value {
            Value::List(_) => value.each(&[SIGNED]).nth(index).map_or_else(|| refused(&value), |item| refused(&item)),
            _ => refused(&value),
        };
        Err(refusal.help("a load below 0 draws apart surfaces that adhere: add [adhesion]"))
    }

    /// The quantity, a load of it, and the prescribed values.
    fn prescribed(&self) -> (&'static str, Load, &[f64]) {
        match &self.given {
            Some(Load::Force(force)) => return ("force", Load::Force(0.0), slice::from_ref(force)),
            Some(Load::MeanPressure(mean)) => return ("mean_pressure", Load::MeanPressure(0.0), slice::from_ref(mean)),
            _ => {}
        }
        let stiffness = self.machine_stiffness.unwrap_or(f64::INFINITY);
        match (&self.mean_pressure, &self.force, &self.grip) {
            (Some(Steps(pressures)), ..) => ("mean_pressure", Load::MeanPressure(0.0), pressures),
            (None, Some(Steps(forces)), _) => ("force", Load::Force(0.0), forces),
            (None, None, Some(Steps(positions))) => ("grip", Load::Grip { position: 0.0, stiffness }, positions),
            (None, None, None) => ("penetration", Load::Penetration(0.0), &demanded(self.penetration.as_ref()).0),
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
        values.iter().map(|&value| load.with_value(value)).collect()
    }

    /// The mean pressures p̄ on a cell of this area; `None` where penetrations or positions of a grip are prescribed.
    pub fn mean_pressures(&self, area: f64) -> Option<Vec<f64>> {
        match self.prescribed() {
            (_, Load::MeanPressure(_), values) => Some(values.to_vec()),
            (_, Load::Force(_), values) => Some(values.iter().map(|force| force / area).collect()),
            _ => None,
        }
    }
}

impl LoadRange {
    fn values(&self) -> Vec<f64> {
        let &Self { from, to, steps, spacing, back } = self;
        let mut values: Vec<f64> = (0..steps)
            .map(|step| match (step, step as f64 / (steps - 1).max(1) as f64, spacing) {
                (0, ..) => from,
                (step, ..) if step + 1 == steps => to,
                (_, part, Spacing::Linear) => from + part * (to - from),
                (_, part, Spacing::Log) => from * (to / from).powf(part),
            })
            .collect();
        if back {
            values.extend_from_within(..steps - 1);
            values[steps..].reverse();
        }
        values
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
        assert_eq!(values("{ from = 1, to = 3, steps = 3, back = true }"), [1.0, 2.0, 3.0, 2.0, 1.0]);
        assert_eq!(values("{ from = 1, to = 3, steps = 5000, back = true }").len(), 9999);
        assert!(read("{ from = 1, to = 3, steps = 5001, back = true }").is_err());
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
        assert_eq!(missing, "`force`, `penetration`, `grip` or `pressure` is missing");
    }

    #[test]
    fn a_number_is_a_list_of_one() {
        assert_eq!(read("0.5").unwrap().mean_pressures(1.0), Some(vec![0.5]));
        assert_eq!(read("[0, 2]").unwrap().mean_pressures(1.0), Some(vec![0.0, 2.0]));
    }
}
