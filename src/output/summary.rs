//! `summary.json` and `curve.csv`: every scalar of a run.

use super::Timing;
use crate::case::Case;
use crate::run::StepRecord;
use serde_json::{Value, json};

/// A whole run as indented JSON; `accuracy`: the change between the two finest grids, where an accuracy was asked for.
/// Two runs of one case differ in `timing` and in the `seconds` of the steps alone.
pub fn summary(
    case: &Case,
    warnings: &[String],
    accuracy: Option<f64>,
    steps: &[StepRecord],
    timing: Timing,
) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let mut summary =
        json!({ "percoat": version, "title": case.title, "case": case, "units": units(case), "warnings": warnings });
    if let Some(accuracy) = accuracy {
        summary["accuracy"] = accuracy.into();
    }
    summary["steps"] = json!(steps);
    summary["timing"] = json!(timing);
    format!("{summary:#}\n")
}

/// The names of the units of all numbers, null where they have none.
pub(super) fn units(case: &Case) -> Value {
    let units = case.units();
    json!({ "length": units.length().name(), "pressure": units.pressure().name() })
}

/// The steps as a CSV table: one row a step, one column a scalar, nested names joined by dots (`levels.1.load`).
/// What a step does not have stays empty.
pub fn curve(steps: &[StepRecord]) -> String {
    let row = |step: &StepRecord| {
        let mut cells = Vec::new();
        flatten("", &json!(step), &mut cells);
        cells
    };
    let rows: Vec<Vec<(String, String)>> = steps.iter().map(row).collect();
    let mut names: Vec<&str> = Vec::new();
    // The step with most scalars has those of all others: only a step without contact lacks some.
    if let Some(longest) = rows.iter().max_by_key(|row| row.len()) {
        names.extend(longest.iter().map(|(name, _)| name.as_str()));
    }
    let mut text = names.join(",") + "\n";
    for row in &rows {
        let value = |name: &&str| row.iter().find(|(own, _)| own == name).map_or("", |(_, value)| value.as_str());
        text += &(names.iter().map(value).collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

/// Adds the scalars of a value to the cells, each with its name.
fn flatten(name: &str, value: &Value, cells: &mut Vec<(String, String)>) {
    let join = |key: &str| if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") };
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| flatten(&join(key), value, cells)),
        Value::Array(items) => {
            (1..).zip(items).for_each(|(number, value): (usize, _)| flatten(&join(&number.to_string()), value, cells));
        }
        Value::Null => cells.push((name.to_owned(), String::new())),
        Value::String(text) => cells.push((name.to_owned(), text.clone())),
        other => cells.push((name.to_owned(), other.to_string())),
    }
}
