//! The part of a sweep.

use super::ReportError;
use super::asked::asked;
use super::figures::{Named, figures};
use super::finished::{Finished, Swept};
use super::given::{Key, listed};
use super::markup::{Markup, tag, with};
use super::part::{Part, by, case_to_copy, section, title, warnings};
use super::ranges::{ranges, sentences};
use super::rows::{Limit, Line, Rows};
use super::table::table;
use super::units::{case_of, measured_in, units_of};
use crate::output::table::{Table, percent_with_error};
use crate::output::with_error;
use serde::Deserialize;
use serde_json::json;
use std::collections::BTreeMap;

const PICTURES: [Named; 1] =
    [("sweep", "Curves of the results over the values of the sweep", "The results over the values of the sweep.")];
/// Rows of the table that are shown.
const ROWS: usize = 300;
/// Scalars that are shown beside the keys, as the command line calls them; the table's file has them all.
const SCALARS: [(&str, &str); 7] = [
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

/// The part of `sweep.json` and `sweep.csv`.
pub(super) fn part(finished: &Finished, swept: &Swept) -> Result<Part, ReportError> {
    let file = &swept.file;
    let refused = |name: &str, reason: String| ReportError::version(&finished.folder.join(name), file, reason);
    let own = Keys::deserialize(file).map_err(|error| refused("sweep.json", error.to_string()))?;
    let rows = Rows::read(&swept.table).map_err(|reason| refused("sweep.csv", reason))?;
    counted(&own, &rows).map_err(|reason| refused("sweep.csv", reason))?;
    let doubted = warnings(file).map_err(|reason| refused("sweep.json", reason))?;
    let done = own.combinations.saturating_sub(own.failed + own.not_converged);
    let sentence = format!(
        "{done} of {} combinations are solved{}{}{}.",
        own.of,
        told(own.not_converged, "not converged"),
        told(own.failed, "failed"),
        told(own.of.saturating_sub(own.combinations), "not among them: a part of the sweep")
    );
    let text = file["case"].as_str();
    let read = text.and_then(|text| case_of(text, &finished.folder));
    let units = units_of(file, read.as_ref());
    let values = own.keys.iter().map(|key| vec![key.key.clone(), key.count().to_string(), key.values()]);
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
                sentences(&rows, &own.keys, &units).into(),
                reasons(&rows),
                ranges(&rows, &own.keys, &units),
                table("Keys of the case and their values", &keys),
            ],
        ),
        section("pictures", "Pictures", vec![figures(finished, "sweep.json", &PICTURES)?]),
        section("rows", "Combinations", vec![shown(&rows, &own.keys)]),
        section("warnings", "Warnings", vec![doubted]),
    ];
    if let Some(text) = text {
        // What cannot be read is told in the order of the alphabet.
        if let Some(case) = read.as_ref().map(|case| json!(case)).or_else(|| toml::from_str(text).ok()) {
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

/// Refuses a table that has not the combinations that the description counts.
fn counted(own: &Keys, rows: &Rows<'_>) -> Result<(), String> {
    let mut statuses: BTreeMap<&str, &str> = BTreeMap::new();
    for line in rows.lines() {
        statuses.insert(line.text("combination").unwrap_or_default(), line.text("status").unwrap_or_default());
    }
    let count = |status: &str| statuses.values().filter(|own| **own == status).count();
    for (what, found, wanted) in [
        ("combinations", statuses.len(), own.combinations),
        ("of them failed", count("failed"), own.failed),
        ("of them not converged", count("not_converged"), own.not_converged),
    ] {
        if found != wanted {
            return Err(format!("it has {found} {what}, and sweep.json beside it tells of {wanted}"));
        }
    }
    Ok(())
}

fn told(count: usize, what: &str) -> String {
    if count == 0 { String::new() } else { format!(", {count} {what}") }
}

/// Why combinations are not solved, with their numbers; empty where all are.
fn reasons(rows: &Rows<'_>) -> Markup {
    let mut reasons: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
    let cell = |line: Line<'_>, name: &str| line.text(name).unwrap_or_default().to_owned();
    for line in rows.lines().filter(|line| line.text("status") != Some("done")) {
        let of = reasons.entry((cell(line, "status").replace('_', " "), cell(line, "reason"))).or_default();
        let number = cell(line, "combination");
        if of.last() != Some(&number) {
            of.push(number);
        }
    }
    if reasons.is_empty() {
        return Markup::default();
    }
    let row = |((status, reason), numbers): (&(String, String), &Vec<String>)| {
        let reason = if reason.is_empty() { "–" } else { reason };
        vec![status.clone(), reason.to_owned(), listed(numbers), numbers.len().to_string()]
    };
    let head = ["status", "reason", "combinations", "how many"].map(str::to_owned).to_vec();
    table("Combinations that are not solved, and why", &Table::new(&head, reasons.iter().map(row).collect(), 3))
}

/// What stands in a column of the table.
type Cell<'a> = Box<dyn Fn(Line<'_>) -> Option<String> + 'a>;

/// The first rows with the keys and the main scalars, and what is left out.
fn shown(rows: &Rows<'_>, keys: &[Key]) -> Markup {
    let mut columns: Vec<(String, Cell<'_>)> = Vec::new();
    let plain = |name: &'static str| -> Cell<'_> { Box::new(|line| Some(line.text(name)?.replace('_', " "))) };
    columns.push(("combination".to_owned(), plain("combination")));
    columns.extend(keys.iter().map(|key| -> (String, Cell<'_>) { (key.key.clone(), Box::new(|line| key.of(line))) }));
    columns.push(("status".to_owned(), plain("status")));
    let limits = rows.limits();
    if limits.is_empty() {
        columns.push(("step".to_owned(), plain("step")));
        if rows.has("governing_criterion") {
            columns.push(("what governs".to_owned(), Box::new(|line| line.with_rivals("governing"))));
            columns.push(("does it fail".to_owned(), plain("governing_state")));
        }
    } else {
        columns.push(("fails first".to_owned(), Box::new(|line| line.with_rivals("first"))));
        let limit = |name: &str| -> Cell<'_> {
            let name = name.to_owned();
            Box::new(move |line| line.limit(&name).map(Limit::told))
        };
        columns.push(("first limit".to_owned(), limit("first")));
        columns.extend(limits.into_iter().map(|name| (name.replace('_', " "), limit(name))));
    }
    let measured = |name: String, words: String| -> Option<(String, Cell<'_>)> {
        let is_part = name.ends_with("_share") || name == "contact_fraction";
        let told = if is_part { percent_with_error } else { with_error };
        rows.has(&name).then(|| {
            let cell: Cell<'_> = Box::new(move |line| line.measured(&name).map(|(x, error)| told(x, error)));
            (words, cell)
        })
    };
    columns.extend(SCALARS.iter().filter_map(|(name, words)| measured((*name).to_owned(), (*words).to_owned())));
    columns.extend(rows.names().iter().filter_map(|name| {
        let level = name.strip_prefix("levels_")?.strip_suffix("_load_share")?;
        level.parse::<usize>().ok()?;
        measured(name.clone(), format!("share {level}"))
    }));
    let cells = |line: Line<'_>| columns.iter().map(|(_, cell)| cell(line).unwrap_or("–".to_owned())).collect();
    let head: Vec<&String> = columns.iter().map(|(words, _)| words).collect();
    let caption = match rows.limits()[..] {
        [] => "One row a combination and load step; ± is the estimated error of the grid",
        _ => "One row a combination: the mean pressure of each limit; ± is the estimated error of the grid",
    };
    let shown = table(caption, &Table::new(&head, rows.lines().take(ROWS).map(cells).collect(), 0));
    let more = rows.lines().len().saturating_sub(ROWS);
    let more = if more > 0 { format!("{more} further rows and all") } else { "All".to_owned() };
    vec![shown, tag("p", format!("{more} {} columns stand in sweep.csv.", rows.names().len()))].into()
}
