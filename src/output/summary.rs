//! `summary.json` and `curve.csv`: every scalar of a run.

use crate::run::StepRecord;
use serde::Serialize;
use serde_json::Value;

/// A whole run as it stands in `summary.json`.
#[derive(Debug, Serialize)]
pub struct Summary<'a, C: Serialize> {
    /// Version of the program.
    pub percoat: &'static str,
    /// Title of the case.
    pub title: &'a str,
    /// The case as run.
    pub case: &'a C,
    /// What a reader should know before trusting the numbers.
    pub warnings: &'a [String],
    /// Change of what is read off between the two finest grids, where an accuracy was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<f64>,
    /// The load steps.
    pub steps: &'a [StepRecord],
}

impl<C: Serialize> Summary<'_, C> {
    /// As indented JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a case and its steps are numbers and texts under names") + "\n"
    }
}

/// The steps as a CSV table: one row a step, one column a scalar, nested names joined by dots (`levels.1.load`).
/// What a step does not have stays empty.
pub fn curve(steps: &[StepRecord]) -> String {
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

/// Names and values of a step's scalars.
pub fn row(step: &StepRecord) -> Vec<(String, String)> {
    let mut cells = Vec::new();
    flatten("", &serde_json::to_value(step).expect("a step is numbers and texts under names"), &mut cells);
    cells
}

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
