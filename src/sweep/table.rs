//! `sweep.csv` and `sweep.json`: the table of a sweep, and what was asked for.

use super::row::{Row, Status};
use crate::output::columns::{Cells, csv};
use serde_json::{Value, json};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

/// One row a combination and load step, by ascending combination.
pub fn table(rows: &[Row]) -> String {
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by_key(|row| row.combination);
    let cells: Vec<Cells> = sorted.into_iter().flat_map(Row::cells).collect();
    csv(&cells)
}

/// Rows of several parts, one a combination, by ascending number.
///
/// # Errors
/// What two parts say differently of one combination.
pub fn join<'a>(parts: impl Iterator<Item = &'a Vec<Row>>) -> Result<Vec<Row>, String> {
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    for row in parts.flatten() {
        match rows.entry(row.combination) {
            Entry::Vacant(place) => drop(place.insert(row.clone())),
            Entry::Occupied(there)
                if there.get().fingerprint != row.fingerprint || there.get().settings != row.settings =>
            {
                return Err(format!("two parts have different {}: they are not of one sweep", row.named()));
            }
            // What was solved twice is the same, unless one of them failed.
            Entry::Occupied(mut there) if there.get().results.is_empty() => drop(there.insert(row.clone())),
            Entry::Occupied(_) => {}
        }
    }
    Ok(rows.into_values().collect())
}

/// What was asked for and how it ended; `case` is the common case as TOML, `of` the number of combinations of the whole
/// sweep, of which these rows may be a part.
pub fn description(title: &str, case: &str, task: &str, of: usize, rows: &[Row], seconds: f64) -> Value {
    let keys: Vec<&String> = rows.first().map_or(Vec::new(), |row| row.settings.iter().map(|(key, _)| key).collect());
    let values = |key: &String| -> Vec<&String> {
        let (mut seen, all) = (BTreeSet::new(), rows.iter().flat_map(|row| &row.settings));
        all.filter(|(own, value)| own == key && seen.insert(value)).map(|(_, value)| value).collect()
    };
    let count = |status: Status| rows.iter().filter(|row| row.status == status).count();
    let (mut seen, all) = (BTreeSet::new(), rows.iter().flat_map(|row| &row.warnings));
    let warnings: Vec<&String> = all.filter(|warning| seen.insert(*warning)).collect();
    json!({
        "percoat": env!("CARGO_PKG_VERSION"),
        "title": title,
        "task": task,
        "keys": keys.iter().map(|key| json!({"key": key, "values": values(key)})).collect::<Value>(),
        "of": of,
        "combinations": rows.len(),
        "done": count(Status::Done),
        "not_converged": count(Status::NotConverged),
        "failed": count(Status::Failed),
        "warnings": warnings,
        "case": case,
        "timing": { "combinations": rows.iter().map(|row| row.seconds).sum::<f64>(), "wall": seconds },
    })
}
