//! Numbers with a unit, as in `force = "20 N"`: converted to the units of the case before the reader sees them.

use super::error::Refusal;
use super::keys::{Form, Key, Keys, Unit};
use super::node::{Node, Table, Value};
use super::span::Span;
use crate::units::Units;
use percoat_common::measure::{Measure, split};
use percoat_core::load::LoadQuantity;

/// Known units, for error messages.
const KNOWN: &str = "m, N, Pa and J with their prefixes (µm, mN, GPa), cm, Å, in, mil, daN, kgf, lbf, bar, atm, psi, ksi, their powers, products and \
                     quotients, as in \"N/mm²\", \"GPa/µm\" and \"mm³/(N·m)\"";

/// The units of a case; `None` where they have no name that is known.
#[derive(Debug, Clone, Copy)]
struct CaseUnits {
    length: Option<Measure>,
    pressure: Option<Measure>,
}

/// Converts the numbers with a unit in a tree with these `keys` to the units that its section `[units]` names.
///
/// # Errors
/// A [`Refusal`] of a unit that is not known, that measures something else than the key, or that the case's units do not reach.
pub(super) fn convert(tree: &mut Table, keys: &'static Keys) -> Result<(), Refusal> {
    let name = |key: &str| match &tree.get("units")?.node.value {
        Value::Table(units) => match &units.get(key)?.node.value {
            Value::Text(name) => Some(name.as_str()),
            _ => None,
        },
        _ => None,
    };
    let units = CaseUnits::of(&Units::unknown().named(name("length"), name("pressure")));
    units.table(tree, keys, "")
}

/// The error for a text that is no load.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("\"{text}\" is no load: {reason}")]
pub struct NoLoad {
    text: String,
    reason: String,
}

/// The load of a text such as "20 N" in the quantity and the units of a case; a number alone is in these units.
///
/// # Errors
/// [`NoLoad`] for what is no number above 0, with a unit or without, and for a unit of something else.
pub(super) fn load(text: &str, units: &Units) -> Result<f64, NoLoad> {
    let of = match units.quantity() {
        LoadQuantity::Force => Unit::Force,
        LoadQuantity::MeanPressure => Unit::Pressure,
    };
    let no_load = |reason: String| NoLoad { text: text.to_owned(), reason };
    let load = match (text.trim().parse::<f64>(), split(text)) {
        (Ok(load), _) => load,
        (Err(_), Some(measure)) => CaseUnits::of(units).in_case(measure, of).map_err(|fault| no_load(fault.message))?,
        (Err(_), None) => return Err(no_load("needed is a number, with a unit or without".to_owned())),
    };
    if load > 0.0 && load.is_finite() { Ok(load) } else { Err(no_load("it must be above 0".to_owned())) }
}

/// Why a number with a unit is not one of the case.
#[derive(Debug)]
struct UnitFault {
    message: String,
    label: &'static str,
    help: String,
}

impl UnitFault {
    fn refusal(self, path: &str, span: Span) -> Refusal {
        Refusal::new(span, format!("`{path}`: {}", self.message), self.label).help(self.help)
    }
}

/// Whether a text is a number with a word behind it, as for a unit.
pub(super) fn is_measure(text: &str) -> bool {
    split(text).is_some_and(|(_, unit)| unit.starts_with(char::is_alphabetic))
}

impl CaseUnits {
    fn of(units: &Units) -> Self {
        let [length, pressure] = units.measures();
        Self { length, pressure }
    }

    fn table(&self, table: &mut Table, keys: &'static Keys, path: &str) -> Result<(), Refusal> {
        for entry in &mut table.entries {
            let Some(key) = keys.all.iter().find(|key| key.name == entry.key) else { continue };
            let path = if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
            self.value(&mut entry.node, key, key.forms, &path)?;
        }
        Ok(())
    }

    fn value(&self, node: &mut Node, key: &Key, forms: &'static [Form], path: &str) -> Result<(), Refusal> {
        let span = node.span;
        match &mut node.value {
            Value::Text(text) => {
                let takes_text = |form: &Form| matches!(form, Form::Text(_) | Form::Name(..));
                let takes_number = forms.iter().any(|form| matches!(form, Form::Number(_)));
                if takes_number
                    && !forms.iter().any(takes_text)
                    && let Some((number, unit)) = split(text)
                {
                    let number = self.in_case((number, unit), key.unit).map_err(|fault| fault.refusal(path, span))?;
                    node.value = Value::Float(number);
                }
            }
            Value::List(items) => {
                let count = items.len();
                for (index, item) in items.iter_mut().enumerate() {
                    let path = format!("{path}[{index}]");
                    match forms.iter().find_map(|form| item_of(form, index, count)) {
                        Some(Item::Table(keys)) => {
                            if let Value::Table(table) = &mut item.value {
                                self.table(table, keys, &path)?;
                            }
                        }
                        Some(Item::Forms(forms)) => self.value(item, key, forms, &path)?,
                        None => {}
                    }
                }
            }
            Value::Table(table) => {
                if let Some(keys) = forms.iter().find_map(Form::keys) {
                    self.table(table, keys, path)?;
                }
            }
            Value::Integer(_) | Value::Float(_) | Value::Boolean(_) | Value::Date(_) => {}
        }
        Ok(())
    }

    /// The number of a `unit` in that of the case.
    fn in_case(&self, (number, unit): (f64, &str), of: Unit) -> Result<f64, UnitFault> {
        let fault = |message: String, label, help: String| UnitFault { message, label, help };
        let Some(written) = Measure::of(unit) else {
            let help = format!("known are {KNOWN}; without a unit a number is in those of the case");
            return Err(fault(format!("\"{unit}\" is no unit that is known"), "which unit?", help));
        };
        let missing = match of {
            Unit::Pure | Unit::LengthToOneMinusN | Unit::AreaCoefficient | Unit::Degree => {
                let help = "write the number alone".to_owned();
                return Err(fault(format!("it has no unit, and {unit} is written behind it"), "a unit", help));
            }
            Unit::Time | Unit::Velocity => {
                let help = "write the number alone, in the unit that units.time names".to_owned();
                return Err(fault("times and velocities are not converted".to_owned(), "a unit", help));
            }
            Unit::Other(_) => {
                let help = "write the number alone, in the units of the case; [units] time and temperature name them"
                    .to_owned();
                return Err(fault("numbers of heat are not converted".to_owned(), "a unit", help));
            }
            Unit::Length => "units.length",
            Unit::Pressure | Unit::PerPressure => "units.pressure",
            Unit::Force | Unit::PressurePerLength | Unit::PressureTimesLength => "units.length and units.pressure",
        };
        let Some(wanted) = self.unit(of) else {
            let help = format!("add [units] with length = \"µm\" and pressure = \"GPa\", or others; known are {KNOWN}");
            let message = format!("{unit} cannot be converted: {missing} must name a unit that is known");
            return Err(fault(message, "to be converted to what?", help));
        };
        written.convert(number, wanted).ok_or_else(|| {
            let message = format!("it must be a {}, and {unit} is no unit of one", of.quantity());
            fault(message, "another quantity", format!("known are {KNOWN}"))
        })
    }

    /// The unit of the numbers of a key; `None` of a pure number, and where the case does not name units that are known.
    fn unit(self, of: Unit) -> Option<Measure> {
        let Self { length, pressure } = self;
        match of {
            Unit::Pure | Unit::LengthToOneMinusN | Unit::AreaCoefficient | Unit::Degree => None,
            Unit::Time | Unit::Velocity | Unit::Other(_) => None,
            Unit::Length => length,
            Unit::Pressure => pressure,
            Unit::Force => Some(pressure?.by(length?, 2)),
            Unit::PerPressure => Some(Measure::ONE.over(pressure?)),
            Unit::PressurePerLength => Some(pressure?.over(length?)),
            Unit::PressureTimesLength => Some(pressure?.by(length?, 1)),
        }
    }
}

/// The keys or forms of an item of a list.
enum Item {
    Table(&'static Keys),
    Forms(&'static [Form]),
}

/// The item number `index` of `count` in a value of a form; `None` where the form is no such list.
fn item_of(form: &'static Form, index: usize, count: usize) -> Option<Item> {
    match form {
        Form::Sections(keys, _) => Some(Item::Table(keys)),
        Form::List { of, .. } => Some(Item::Forms(std::slice::from_ref(*of))),
        Form::Tuple(_, items) if items.len() == count => Some(Item::Forms(&items[index..=index])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::Case;
    use super::super::embedded;

    fn read(set: &[&str]) -> Result<Case, String> {
        let set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
        Case::read(&embedded::source("ball-on-disc").unwrap(), &set).map_err(|error| error.render(false))
    }

    /// The case is in µm and GPa, so that forces are in mN.
    #[test]
    fn a_number_with_a_unit_is_that_of_the_case() {
        let plain =
            read(&["load.force=20000", "layers.0.thickness=2.5", "levels.0.radius=6350", "layers.0.young=0.21e3"])
                .unwrap();
        let measured = read(&[
            "load.force=20 N",
            "layers[0].thickness=\"2500nm\"",
            "levels.0.radius=6.35 mm",
            "layers.0.young=210e9 Pa",
        ]);
        assert_eq!(measured.unwrap(), plain);
        let several = read(&["load.force=[\"1 N\", 2000, \"3e-3 kN\"]"]).unwrap();
        assert_eq!(several, read(&["load.force=[1000, 2000, 3000]"]).unwrap());
        let spread = read(&["load.force={from=\"1 N\", to=\"2 N\", steps=3}"]).unwrap();
        assert_eq!(spread, read(&["load.force={from=1000, to=2000, steps=3}"]).unwrap());
    }

    /// A load for an option: the case has forces in mN, another one mean pressures without a unit.
    #[test]
    fn a_load_is_read_in_the_quantity_of_the_case() {
        let case = read(&[]).unwrap();
        assert_eq!(["20N", "20e3", " 0.02 kN "].map(|text| case.load_of(text).unwrap()), [20e3; 3]);
        for (text, words) in
            [("20 µm", "must be a force"), ("twenty", "needed is a number"), ("-1 N", "above 0"), ("nan", "above 0")]
        {
            let told = case.load_of(text).unwrap_err().to_string();
            assert!(told.contains(words) && told.contains(text), "{told}");
        }
        let plain = Case::read(&embedded::source("fig2").unwrap(), &[]).unwrap();
        assert_eq!(plain.load_of("0.02").unwrap(), 0.02);
        assert!(plain.load_of("2 MPa").unwrap_err().to_string().contains("units.pressure must name"));
    }

    #[test]
    fn a_unit_that_does_not_fit_is_refused_where_it_stands() {
        for (set, words) in [
            (&["load.force=20 µm"][..], "`load.force`: it must be a force, and µm is no unit of one"),
            (&["load.force=\"20 Nmm\""], "\"Nmm\" is no unit that is known"),
            (&["load.force=20 Nmm"], "\"Nmm\" is no unit that is known"),
            (&["layers.0.poisson=0.3 m"], "it has no unit, and m is written behind it"),
            (&["units.length=widget", "layers.0.thickness=3 µm"], "units.length must name a unit"),
        ] {
            let told = read(set).unwrap_err();
            assert!(told.contains(words), "{told}");
        }
    }
}
