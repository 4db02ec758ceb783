//! `sweep.csv` and `sweep.json`: the table of a sweep, and what was asked for.

use super::combinations::Combinations;
use super::row::{Row, Status};
use crate::output::columns::csv;
use crate::output::{checksum, digest};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// One row a combination and load step, by ascending combination.
pub fn table(rows: &[Row]) -> String {
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by_key(|row| row.combination);
    csv(|| sorted.iter().flat_map(|row| row.cells()))
}

/// What a whole sweep is, of which some rows may be a part.
#[derive(Debug, Clone, Copy)]
pub struct Asked<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The common case as TOML.
    pub case: &'a str,
    /// `solve` or `limit`.
    pub task: &'a str,
    /// Of the case and of all that it sets: equal only for parts of one sweep.
    pub fingerprint: &'a str,
    /// Number of its combinations.
    pub of: usize,
}

impl Asked<'_> {
    /// What every line of its log says: equal only for parts of one sweep by one version of percoat.
    pub fn identity(&self) -> String {
        let Self { title, case, task, fingerprint, of } = self;
        digest(&format!("{}\n{task} {of} {fingerprint}\n{title}\n{case}", env!("CARGO_PKG_VERSION")))
    }
}

/// A fingerprint of the common case, what all combinations set, and every combination.
pub fn fingerprint(case: &str, fixed: &[String], combinations: &Combinations) -> String {
    let each = combinations.all.iter().flat_map(|own| &own.values);
    let parts = [case].into_iter().chain(fixed.iter().chain(&combinations.keys).chain(each).map(String::as_str));
    let text = parts.collect::<Vec<_>>().join("\n");
    let (length, checksum) = checksum(&mut text.as_bytes()).expect("what is in memory can be read");
    format!("{length:x}-{checksum:016x}")
}

/// What was asked for and how it ended.
pub fn description(asked: Asked<'_>, rows: &[Row], seconds: f64) -> Value {
    let Asked { title, case, task, fingerprint, of } = asked;
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
        "fingerprint": fingerprint,
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
