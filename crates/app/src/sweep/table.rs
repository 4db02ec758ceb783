//! `sweep.csv` and `sweep.json`: the table of a sweep and its description.

use super::combinations::Combinations;
use super::design::Design;
use super::log::lines;
use super::row::{Row, Status};
use super::task::Task;
use super::uncertainty::Uncertainty;
use crate::output::columns::{Cells, csv, names};
use crate::output::{OutputError, SWEEP_LOG, checksum, digest, write_text};
use percoat_case::case::{Case, NamedKey, Source};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::{BTreeSet, HashMap};
use std::path::Path;

/// One row for each combination and load step, by ascending combination.
pub fn table(rows: &[Row]) -> String {
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by_key(|row| row.combination);
    csv(|| sorted.iter().flat_map(|row| row.cells()))
}

/// The columns of that table: names and scalars.
pub fn columns(rows: &[Row]) -> Vec<(String, Vec<Value>)> {
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by_key(|row| row.combination);
    columns_of(|| sorted.iter().flat_map(|row| row.cells()))
}

/// The columns of rows, which `rows` gives twice: names and scalars.
pub fn columns_of<I: Iterator<Item = Cells>>(rows: impl Fn() -> I) -> Vec<(String, Vec<Value>)> {
    let names = names(rows());
    let mut lines: Vec<HashMap<String, Value>> = rows().map(|line| line.into_iter().collect()).collect();
    let column = |name: String| {
        let cells = lines.iter_mut().map(|line| line.remove(&name).unwrap_or_default()).collect();
        (name, cells)
    };
    names.into_iter().map(column).collect()
}

/// Case, keys and task of a sweep, and how its combinations ended: `sweep.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// The version of percoat that wrote it.
    pub percoat: String,
    /// Title of the common case.
    pub title: String,
    /// The task for each combination.
    pub task: Task,
    /// The keys that change, with their values.
    pub keys: Vec<SweptKey>,
    /// The samples of uncertain keys; `None` of given values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertain: Option<Design>,
    /// Fingerprint of the common case and all combinations: equal only for parts of one sweep.
    pub fingerprint: String,
    /// Number of all combinations of the whole sweep.
    pub of: usize,
    /// Number of combinations here.
    pub combinations: usize,
    /// Number of finished combinations.
    pub done: usize,
    /// Number of combinations that did not converge.
    pub not_converged: usize,
    /// Number of combinations without results.
    pub failed: usize,
    /// Each warning of any combination.
    pub warnings: Vec<String>,
    /// The common case as TOML.
    pub case: String,
    /// Wall times, seconds.
    pub timing: Seconds,
}

/// A key of a sweep with its values as they were typed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SweptKey {
    /// The key as in the case file.
    pub key: String,
    /// Values of the key in the order of the combinations.
    pub values: Vec<String>,
}

/// Wall times of a sweep, seconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// Sum over all combinations.
    pub combinations: f64,
    /// The whole sweep; of joined parts, the sum.
    pub wall: f64,
}

impl Description {
    /// Description of a sweep that has not begun, with title and text of the common case and the number `of` all combinations.
    pub fn new(title: &str, case: &str, task: Task, fingerprint: String, of: usize) -> Self {
        Self {
            percoat: env!("CARGO_PKG_VERSION").to_owned(),
            title: title.to_owned(),
            task,
            keys: Vec::new(),
            uncertain: None,
            fingerprint,
            of,
            combinations: 0,
            done: 0,
            not_converged: 0,
            failed: 0,
            warnings: Vec::new(),
            case: case.to_owned(),
            timing: Seconds { combinations: 0.0, wall: 0.0 },
        }
    }

    /// Description of a sweep of all `combinations` that has not begun; `fixed` are the settings of all of them, `KEY=VALUE`.
    pub fn of(source: &Source, fixed: &[String], combinations: &Combinations, task: Task) -> Self {
        // Without the keys that vary the case may be refused: its text then stands for it.
        let whole = Case::read(source, fixed).ok();
        let text = whole.as_ref().map_or_else(|| source.text.clone(), Case::to_toml);
        let fingerprint = fingerprint(&text, fixed, combinations);
        let title = whole.map_or(String::new(), |case| case.title);
        let described = Self::new(&title, &text, task, fingerprint, combinations.all.len());
        Self { uncertain: combinations.design.clone(), ..described }
    }

    /// The description after these rows and a wall time in seconds.
    #[must_use]
    pub fn after(&self, rows: &[Row], wall: f64) -> Self {
        let keys = rows.first().map_or(&[][..], |row| &row.settings).iter().map(|(key, _)| {
            let all = rows.iter().flat_map(|row| &row.settings).filter(|(name, _)| name == key);
            SweptKey { key: key.clone(), values: distinct(all.map(|(_, value)| value)) }
        });
        let count = |status: Status| rows.iter().filter(|row| row.status == status).count();
        Self {
            keys: keys.collect(),
            combinations: rows.len(),
            done: count(Status::Done),
            not_converged: count(Status::NotConverged),
            failed: count(Status::Failed),
            warnings: distinct(rows.iter().flat_map(|row| &row.warnings)),
            timing: Seconds { combinations: rows.iter().map(|row| row.seconds).sum(), wall },
            ..self.clone()
        }
    }

    /// The identity in every line of its log: equal only for parts of one sweep by one version of percoat.
    pub fn identity(&self) -> String {
        let Self { percoat, title, case, task, fingerprint, of, .. } = self;
        digest(&format!("{percoat}\n{} {of} {fingerprint}\n{title}\n{case}", task.name()))
    }

    /// The common case, as its first combination with results among these has it: what a setting has put in the place of a key of the
    /// file is the setting's. `None` where it cannot be read; paths in it are relative to the `folder`.
    pub fn first_case(&self, rows: &[Row], folder: &Path) -> Option<Case> {
        let (name, text) = ("the common case".to_owned(), self.case.clone());
        let source = Source { name, text, folder: folder.to_owned(), ..Source::default() };
        let first = rows.iter().find(|row| !row.results.is_empty());
        let set = |row: &Row| row.settings.iter().map(|(key, value)| format!("{key}={value}")).collect::<Vec<_>>();
        let case = first.and_then(|row| Case::read(&source, &set(row)).ok());
        case.or_else(|| Case::read(&source, &[]).ok())
    }

    /// The keys that change, in words: with the names of the materials of the common case as these rows have it, unless they change.
    pub fn named_keys(&self, rows: &[Row], folder: &Path) -> Vec<NamedKey> {
        let case = self.first_case(rows, folder);
        let keys: Vec<&str> =
            rows.first().map_or(Vec::new(), |row| row.settings.iter().map(|(key, _)| &key[..]).collect());
        let material = |section: &str| {
            let index: usize = section.strip_prefix("layers.")?.parse().ok()?;
            let changes = ["name", "material"].iter().any(|key| keys.contains(&format!("{section}.{key}").as_str()));
            let layer = case.as_ref()?.layers.get(index).filter(|_| !changes)?;
            layer.name.clone().or_else(|| layer.material.clone())
        };
        keys.iter().map(|key| NamedKey::new(key, material)).collect()
    }

    /// The uncertainty of the results of all rows; `None` of a sweep over given values, and where rows are missing.
    pub fn uncertainty(&self, rows: &[Row]) -> Option<Uncertainty> {
        Uncertainty::of(self.uncertain.as_ref()?, rows)
    }

    /// The content of `sweep.json`.
    pub fn to_json(&self) -> String {
        self.json_with(None)
    }

    /// The content of `sweep.json` with an uncertainty: a list of results with the columns of `uncertainty.csv`, null where one is infinite
    /// or not known.
    fn json_with(&self, uncertainty: Option<&Uncertainty>) -> String {
        let uncertainty = uncertainty
            .map(|found| found.cells().into_iter().map(|cells| cells.into_iter().collect::<Map<_, _>>()).collect());
        let whole = Whole { description: self, uncertainty };
        serde_json::to_string_pretty(&whole).expect("a description is numbers and texts under names") + "\n"
    }
}

/// A description with the uncertainty of its results.
#[derive(Serialize)]
struct Whole<'a> {
    #[serde(flatten)]
    description: &'a Description,
    #[serde(skip_serializing_if = "Option::is_none")]
    uncertainty: Option<Vec<Map<String, Value>>>,
}

/// Content of a file of a sweep, by the rows and their description; `None` where there is no such file.
type Content = fn(&[Row], &Description, Option<&Uncertainty>) -> Option<String>;

/// The files of a sweep, by their names. The log of a sweep that was solved here had the order in which combinations ended.
const FILES: [(&str, Content); 4] = [
    (SWEEP_LOG, |rows, description, _| (!rows.is_empty()).then(|| lines(&description.identity(), rows))),
    ("sweep.csv", |rows, _, _| Some(table(rows))),
    ("sweep.json", |_, description, uncertainty| Some(description.json_with(uncertainty))),
    ("uncertainty.csv", |_, _, uncertainty| uncertainty.map(|found| csv(|| found.cells().into_iter()))),
];

/// Names of the files that [`write()`] writes.
pub fn files() -> impl Iterator<Item = String> {
    FILES.iter().map(|(name, _)| (*name).to_owned())
}

/// Writes the rows, by ascending combination, with their description and their uncertainty into a folder: `sweep.jsonl`, `sweep.csv`,
/// `sweep.json` and, with an uncertainty, `uncertainty.csv`.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn write(
    folder: &Path,
    rows: &[Row],
    description: &Description,
    uncertainty: Option<&Uncertainty>,
) -> Result<(), OutputError> {
    let texts = FILES.iter().filter_map(|(name, content)| Some((name, content(rows, description, uncertainty)?)));
    texts.into_iter().try_for_each(|(name, text)| write_text(&folder.join(name), &text))
}

/// Each text once, in the order of first occurrence.
fn distinct<'a>(texts: impl Iterator<Item = &'a String>) -> Vec<String> {
    let mut seen = BTreeSet::new();
    texts.filter(|text| seen.insert(*text)).cloned().collect()
}

/// A fingerprint of the common case, the settings of all combinations, and every combination.
pub fn fingerprint(case: &str, fixed: &[String], combinations: &Combinations) -> String {
    let each = combinations.all.iter().flat_map(|combination| &combination.values);
    let parts = [case].into_iter().chain(fixed.iter().chain(&combinations.keys).chain(each).map(String::as_str));
    let text = parts.collect::<Vec<_>>().join("\n");
    let (length, checksum) = checksum(&mut text.as_bytes()).expect("what is in memory can be read");
    format!("{length:x}-{checksum:016x}")
}
