//! `[load]`: the nominal pressures or penetrations to solve for, one after another.

use serde::Serialize;

use super::error::Refusal;
use super::node::Value;
use super::reader::TableAt;
use super::value::ValueAt;
use crate::load::Load;

/// The section `[load]`: what is prescribed, one value a load step.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LoadSection {
    /// Nominal pressures p̄ ≥ 0, same unit as Young's modulus.
    MeanPressure(Vec<f64>),
    /// Penetrations δ ≥ 0 from first touch, measured from the mean plane of the deformed surface, lengths.
    Penetration(Vec<f64>),
}

impl LoadSection {
    pub(super) fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        section.only()?;
        match section.one_of(["mean_pressure", "penetration"])? {
            (0, pressure) => steps(&pressure).map(Self::MeanPressure),
            (_, penetration) => steps(&penetration).map(Self::Penetration),
        }
    }

    /// The prescribed values, one a load step.
    pub fn values(&self) -> &[f64] {
        match self {
            Self::MeanPressure(values) | Self::Penetration(values) => values,
        }
    }

    /// Name of what is prescribed, as in the case file.
    pub fn quantity(&self) -> &'static str {
        match self {
            Self::MeanPressure(_) => "mean_pressure",
            Self::Penetration(_) => "penetration",
        }
    }

    /// What each load step prescribes.
    pub fn loads(&self) -> Vec<Load> {
        let load = match self {
            Self::MeanPressure(_) => Load::MeanPressure,
            Self::Penetration(_) => Load::Penetration,
        };
        self.values().iter().map(|&value| load(value)).collect()
    }
}

fn steps(value: &ValueAt<'_>) -> Result<Vec<f64>, Refusal> {
    match &value.node.value {
        Value::List(_) => value.list()?.iter().map(ValueAt::number).collect(),
        Value::Table(_) => range(&value.table()?),
        _ => Ok(vec![value.number()?]),
    }
}

#[derive(Clone, Copy)]
enum Spacing {
    Linear,
    Log,
}

fn range(section: &TableAt<'_>) -> Result<Vec<f64>, Refusal> {
    section.only()?;
    let spacing = match section.value("spacing")?.word()? {
        "log" => Spacing::Log,
        _ => Spacing::Linear,
    };
    let value = |key| {
        let value = section.value(key)?;
        match (value.number()?, spacing) {
            (0.0, Spacing::Log) => {
                Err(value.refuse("a finite number greater than 0").help("spacing = \"log\" never reaches 0"))
            }
            (number, _) => Ok(number),
        }
    };
    let (from, to) = (value("from")?, value("to")?);
    let steps = section.value("steps")?.integer()?;
    Ok((0..steps)
        .map(|step| match (step, step as f64 / (steps - 1).max(1) as f64, spacing) {
            (0, ..) => from,
            (step, ..) if step + 1 == steps => to,
            (_, part, Spacing::Linear) => from + part * (to - from),
            (_, part, Spacing::Log) => from * (to / from).powf(part),
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::super::keys;
    use super::super::node::{Node, Table};
    use super::*;

    fn read(value: &str) -> Result<LoadSection, Refusal> {
        let table = Table::parse(&format!("mean_pressure = {value}")).unwrap();
        LoadSection::read(&TableAt::root(&table, &keys::LOAD, Node::parse("0", 0, 0).unwrap().place))
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
    fn a_number_is_a_list_of_one() {
        assert_eq!(read("0.5"), Ok(LoadSection::MeanPressure(vec![0.5])));
        assert_eq!(read("[0, 2]"), Ok(LoadSection::MeanPressure(vec![0.0, 2.0])));
    }
}
