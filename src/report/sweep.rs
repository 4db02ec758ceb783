//! The part of a sweep.

use super::ReportError;
use super::asked::asked;
use super::figures::{Named, figures};
use super::finished::{Finished, Swept};
use super::markup::{Markup, tag, with};
use super::part::{Part, by, case_to_copy, section, title, version, warnings};
use super::table::table;
use super::units::{case_of, measured_in, units_of};
use crate::output::number;
use crate::output::table::{Table, percent_with_error};
use crate::sweep::column;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

const PICTURES: [Named; 1] =
    [("sweep", "Curves of the results over the values of the sweep", "The results over the values of the sweep.")];
/// Rows of the table that are shown.
const ROWS: usize = 300;
/// Scalars that are shown beside the keys, as the command line calls them; the table's file has them all.
const SCALARS: [(&str, &str); 10] = [
    ("first_criterion", "first"),
    ("first_material", "material"),
    ("first_mean_pressure", "first limit, mean pressure"),
    ("mean_pressure", "mean pressure"),
    ("penetration", "penetration"),
    ("contact_fraction", "contact"),
    ("max_pressure", "peak pressure"),
    ("stress_max_tau1_value", "largest τ₁"),
    ("stress_max_tension_value", "largest tension"),
    ("stress_max_mises_value", "largest von Mises"),
];

#[derive(Deserialize)]
struct Keys {
    keys: Vec<Key>,
    of: usize,
    combinations: usize,
    failed: usize,
    not_converged: usize,
}

#[derive(Deserialize)]
struct Key {
    key: String,
    values: Vec<Value>,
}

/// The part of `sweep.json` and `sweep.csv`.
pub(super) fn part(finished: &Finished, swept: &Swept) -> Result<Part, ReportError> {
    let file = &swept.file;
    let refused = |name: &str, reason: String| {
        let version = version(file).map(str::to_owned);
        ReportError::Version { path: finished.folder.join(name), version, reason }
    };
    let own = Keys::deserialize(file).map_err(|error| refused("sweep.json", error.to_string()))?;
    let rows = Rows::read(&swept.table).map_err(|reason| refused("sweep.csv", reason))?;
    let done = own.combinations.saturating_sub(own.failed + own.not_converged);
    let sentence = format!(
        "{done} of {} combinations are solved{}{}{}.",
        own.of,
        told(own.not_converged, "not converged"),
        told(own.failed, "failed"),
        told(own.of.saturating_sub(own.combinations), "not among them: a part of the sweep")
    );
    let values = own.keys.iter().map(|key| vec![key.key.clone(), key.values.len().to_string(), listed(&key.values)]);
    let head = ["key", "values", "which"].map(str::to_owned).to_vec();
    let keys = Table::new(&head, values.collect(), 1);
    let mut sections = vec![
        section(
            "answer",
            "Answer",
            vec![
                with(
                    "p",
                    &[("class", if own.failed + own.not_converged > 0 { "answer doubt" } else { "answer" })],
                    sentence,
                ),
                table("Keys of the case and their values", &keys),
                rows.reasons(),
            ],
        ),
        section("pictures", "Pictures", vec![figures(finished, "sweep.json", &PICTURES)?]),
        section("rows", "Combinations", vec![rows.shown(&own.keys)]),
        section("warnings", "Warnings", vec![warnings(file)]),
    ];
    let text = file["case"].as_str();
    if let Some(text) = text {
        let read = case_of(text, &finished.folder);
        // What cannot be read is told in the order of the alphabet.
        if let Some(case) = read.as_ref().map(|case| json!(case)).or_else(|| toml::from_str(text).ok()) {
            let units = units_of(file, read.as_ref());
            let words = tag("p", "The case of which the sweep changes the keys above:");
            let asked = vec![words, asked(&case), tag("p", measured_in(&units))];
            sections.insert(1, section("asked", "What was asked", asked));
        }
    }
    let time = file["timing"]["wall"].as_f64().map(|seconds| tag("p", format!("{seconds:.2} s.")));
    sections.push(section("time", "Time and version", time.into_iter().chain([by(file)]).collect()));
    if let Some(text) = text {
        sections.push(section("case", "Case", vec![case_to_copy(text, "sweep")]));
    }
    Ok(Part { name: "sweep", kind: "Sweep", title: title(file), sections })
}

fn told(count: usize, what: &str) -> String {
    if count == 0 { String::new() } else { format!(", {count} {what}") }
}

/// A list of values; of a long one its ends.
fn listed(values: &[Value]) -> String {
    let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    let texts: Vec<String> = values.iter().map(text).collect();
    match &texts[..] {
        [first, second, .., last] if texts.len() > 12 => format!("{first}, {second}, … {last}"),
        _ => texts.join(", "),
    }
}

/// The table of a sweep.
struct Rows<'a> {
    names: Vec<String>,
    rows: Vec<Vec<&'a str>>,
}

impl<'a> Rows<'a> {
    fn read(text: &'a str) -> Result<Self, String> {
        let mut lines = text.lines();
        let names: Vec<String> =
            lines.next().unwrap_or_default().split(',').map(|name| name.trim().replace('.', "_")).collect();
        for wanted in ["combination", "status", "step"] {
            if !names.iter().any(|name| name == wanted) {
                return Err(format!("it has no column {wanted}"));
            }
        }
        let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
        match (2..).zip(&rows).find(|(_, row)| row.len() != names.len()) {
            Some((line, row)) => Err(format!("line {line} has {} cells, the head {}", row.len(), names.len())),
            None => Ok(Self { names, rows }),
        }
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|own| own == name)
    }

    /// Why combinations are not solved, with their numbers; empty where all are.
    fn reasons(&self) -> Markup {
        let [combination, status, reason] = ["combination", "status", "reason"].map(|name| self.column(name));
        let cell =
            |row: &[&str], column: Option<usize>| column.map_or(String::new(), |index| row[index].trim().to_owned());
        let mut reasons: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
        for row in self.rows.iter().filter(|row| cell(row, status) != "done") {
            let of = reasons.entry((cell(row, status).replace('_', " "), cell(row, reason))).or_default();
            let number = cell(row, combination);
            if of.last() != Some(&number) {
                of.push(number);
            }
        }
        if reasons.is_empty() {
            return Markup::default();
        }
        let row = |((status, reason), numbers): (&(String, String), &Vec<String>)| {
            let numbers: Vec<Value> = numbers.iter().map(|number| Value::from(number.as_str())).collect();
            let reason = if reason.is_empty() { "–" } else { reason };
            vec![status.clone(), reason.to_owned(), listed(&numbers), numbers.len().to_string()]
        };
        let head = ["status", "reason", "combinations", "how many"].map(str::to_owned).to_vec();
        table("Combinations that are not solved, and why", &Table::new(&head, reasons.iter().map(row).collect(), 3))
    }

    /// The first rows with the keys and the main scalars, and what is left out.
    fn shown(&self, keys: &[Key]) -> Markup {
        let own = |name: &str| (name.to_owned(), name.to_owned());
        let mut named = vec![own("combination")];
        named.extend(keys.iter().map(|key| (column(&key.key), key.key.clone())));
        named.extend(["status", "step"].map(own));
        named.extend(SCALARS.map(|(name, words)| (name.to_owned(), words.to_owned())));
        named.extend(self.names.iter().filter_map(|name| {
            let level = name.strip_prefix("levels_")?.strip_suffix("_load_share")?;
            level.parse::<usize>().ok()?;
            Some((name.clone(), format!("share {level}")))
        }));
        let columns: Vec<(usize, String)> =
            named.into_iter().filter_map(|(name, words)| Some((self.column(&name)?, words))).collect();
        let given = |name: &str| keys.iter().any(|key| column(&key.key) == name);
        let cell = |row: &[&str], column: usize| {
            let (text, name) = (row[column].trim(), self.names[column].as_str());
            match text.parse::<f64>() {
                Ok(x) if name.ends_with("_share") || name == "contact_fraction" => percent_with_error(x, None),
                // Values stand as they were given, what counts stays a count.
                Ok(x) if !given(name) && text.contains(['.', 'e']) => number(x),
                _ if text.is_empty() => "–".to_owned(),
                _ if name == "status" => text.replace('_', " "),
                _ => text.to_owned(),
            }
        };
        let rows = self.rows.iter().take(ROWS);
        let rows = rows.map(|row| columns.iter().map(|(column, _)| cell(row, *column)).collect()).collect();
        let head: Vec<String> = columns.into_iter().map(|(_, words)| words).collect();
        let shown = table("One row a combination and load step", &Table::new(&head, rows, 0));
        let more = self.rows.len().saturating_sub(ROWS);
        let more = if more > 0 { format!("{more} further rows and all") } else { "All".to_owned() };
        vec![shown, tag("p", format!("{more} {} columns stand in sweep.csv.", self.names.len()))].into()
    }
}
