//! Part of a report: a sweep.

use super::ReportError;
use super::figures::{PictureText, figures};
use super::given::{listed, value, values};
use super::markup::{Markup, tag, with};
use super::part::{Part, by, case_to_copy, section, warnings};
use super::problem::problem;
use super::ranges::{are_limits, criteria, ranges, sentences};
use super::results::{Results, Swept};
use super::table::table;
use super::units::{case_of, measured_in, units_of};
use crate::output::UnitNames;
use crate::output::table::Table;
use crate::output::{percent_with_error, with_error};
use crate::sweep::{
    Description, Design, LimitValue, Row, Status, SweepResult, SweptKey, best_and_worst, shown_with, stated,
};
use percoat_case::units::Units;
use percoat_core::load::LoadQuantity;
use percoat_core::quantity::Kind;
use percoat_core::reading::{LEVEL, Verdict};
use percoat_core::run::OfStep;
use serde_json::json;
use std::collections::BTreeMap;

const PICTURES: [PictureText; 2] = [
    ("sweep", "Curves of the results over the values of the sweep", "The results over the values of the sweep."),
    (
        "uncertainty",
        "Distributions of the results, and bars of the indices of the uncertain keys",
        "How far the main results spread, and which of the uncertain keys makes it.",
    ),
];
/// Most rows of the table.
const ROWS: usize = 300;

/// The part of the page for a sweep, from `sweep.json` and `sweep.jsonl`.
pub(super) fn part(results: &Results, swept: &Swept) -> Result<Part, ReportError> {
    let Swept { description, rows } = swept;
    let Description { keys, case: text, title, .. } = description;
    let read = case_of(text, &results.folder);
    // The keys of a case that cannot be read are sorted alphabetically.
    let keys_of_case = read.as_ref().map(|case| json!(case)).or_else(|| toml::from_str(text).ok()).unwrap_or_default();
    let first = description.first_case(rows, &results.folder);
    let units = units_of(&UnitNames::default(), first.as_ref(), &keys_of_case);
    let quantity = rows.iter().flat_map(|row| &row.results).find_map(SweepResult::quantity);
    let units = quantity.map_or(units.clone(), |quantity| units.with_loads_in(quantity));
    let all_done = description.failed + description.not_converged == 0;
    let class = if all_done { "answer" } else { "answer doubt" };
    let mut answer = vec![with("p", &[("class", class)], done(description)), reasons(rows)];
    match &description.uncertain {
        Some(design) => answer.extend(uncertain(description, design, rows, &units)),
        None => {
            answer.insert(1, sentences(rows, keys, &units).into());
            let ranking = best_and_worst(rows, &units);
            answer.extend(ranking.map(|ranking| table(&sentence(&ranking.words), &ranking.table)));
            answer.extend([ranges(rows, keys, &units), table("Keys of the case and their values", &given(keys))]);
        }
    }
    let mut sections = vec![
        section("answer", "Answer", answer),
        section("pictures", "Pictures", vec![figures(results, "sweep.json", &PICTURES)?]),
        section("rows", "Combinations", vec![shown(rows, keys, units.quantity())]),
        warnings(),
    ];
    if !keys_of_case.is_null() {
        let words = tag("p", "The case of which the sweep changes the keys above:");
        let content = vec![words, problem(&keys_of_case), tag("p", measured_in(&units))];
        sections.insert(1, section("problem", "Problem", content));
    }
    let time = tag("p", format!("{:.2} s.", description.timing.wall));
    sections.push(section("time", "Time and version", vec![time, by(&description.percoat)]));
    sections.push(section("case", "Case", vec![case_to_copy(text, "sweep")]));
    Ok(Part { name: "sweep", kind: "Sweep", title: title.clone(), sections, warnings: description.warnings.clone() })
}

/// The table of the values that were given.
fn given(keys: &[SweptKey]) -> Table {
    let rows = keys.iter().map(|key| vec![key.key.clone(), key.values.len().to_string(), values(key)]);
    Table::new(&["key", "values", "which"], rows.collect(), 1)
}

/// Spread of the results over the uncertain keys, and the distributions of these keys.
fn uncertain(description: &Description, design: &Design, rows: &[Row], units: &Units) -> Vec<Markup> {
    let found = description.uncertainty(rows).and_then(|found| found.table(units));
    let missing = "Some combinations are not here: without them nothing is said of the uncertainty.";
    let told = match found {
        Some(told) => table(&sentence(&told.words), &told.table),
        None if rows.len() < design.count() => tag("p", missing),
        None if rows.iter().all(|row| row.results.is_empty()) => tag("p", "No combination has a result."),
        None => tag("p", "No main result depends on the uncertain keys."),
    };
    let keys = design.keys.iter().map(|varied| vec![varied.key.clone(), varied.distribution.to_string()]);
    let words = format!("Uncertain keys: {} samples, seed {}", design.samples, design.seed);
    vec![told, table(&words, &Table::new(&["key", "distribution"], keys.collect(), 2))]
}

/// How many combinations are solved, as a sentence.
fn done(description: &Description) -> String {
    let Description { done, of, not_converged, failed, combinations, .. } = *description;
    let more = |count: usize, what: &str| if count == 0 { String::new() } else { format!(", {count} {what}") };
    format!(
        "{done} of {of} combinations are solved{}{}{}.",
        more(not_converged, "not converged"),
        more(failed, "failed"),
        more(of.saturating_sub(combinations), "not among them: a part of the sweep")
    )
}

/// Words that begin with a capital letter.
fn sentence(words: &str) -> String {
    let (first, rest) = words.split_at(words.chars().next().map_or(0, char::len_utf8));
    format!("{}{rest}", first.to_uppercase())
}

/// Why combinations are not solved, with their numbers; empty where all are.
fn reasons(rows: &[Row]) -> Markup {
    let mut reasons: BTreeMap<(String, &str), Vec<String>> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.status != Status::Done) {
        let reason = row.reason.as_deref().filter(|reason| !reason.is_empty()).unwrap_or("–");
        reasons.entry((row.status.name().replace('_', " "), reason)).or_default().push(row.combination.to_string());
    }
    if reasons.is_empty() {
        return Markup::default();
    }
    let row = |((status, reason), numbers): (&(String, &str), &Vec<String>)| {
        vec![status.clone(), (*reason).to_owned(), listed(numbers), numbers.len().to_string()]
    };
    let head = ["status", "reason", "combinations", "how many"].map(str::to_owned).to_vec();
    table("Combinations that are not solved, and why", &Table::new(&head, reasons.iter().map(row).collect(), 3))
}

/// A row of the table: a combination and one of its results, with its number from 1.
#[derive(Clone, Copy)]
struct Shown<'a> {
    row: &'a Row,
    number: usize,
    result: Option<&'a SweepResult>,
}

/// The content of a cell of a column; `None` where the row has none.
type Cell<'a> = Box<dyn Fn(Shown<'_>) -> Option<String> + 'a>;

/// The first rows with the keys and the main scalars, and a sentence on what is left out.
fn shown(rows: &[Row], keys: &[SweptKey], quantity: LoadQuantity) -> Markup {
    let all = rows.iter().flat_map(|row| {
        let none = row.results.is_empty().then_some(None);
        let results = (1..).zip(row.results.iter().map(Some).chain(none));
        results.map(move |(number, result)| Shown { row, number, result })
    });
    let all: Vec<Shown<'_>> = all.collect();
    let columns = columns(rows, keys, quantity);
    let cells = |shown: &Shown<'_>| columns.iter().map(|(_, cell)| cell(*shown).unwrap_or("–".to_owned())).collect();
    let head: Vec<&String> = columns.iter().map(|(words, _)| words).collect();
    let what = if are_limits(rows) {
        format!("One row a combination: the {} of each limit", quantity.name())
    } else {
        "One row a combination and load step".to_owned()
    };
    let caption = format!("{what}; ± is the estimated error of the grid");
    let shown = table(&caption, &Table::new(&head, all.iter().take(ROWS).map(cells).collect(), 0));
    let more = all.len().saturating_sub(ROWS);
    let more = if more > 0 { format!("{more} further rows and all") } else { "All".to_owned() };
    vec![shown, tag("p", format!("{more} columns are in sweep.csv."))].into()
}

fn columns<'a>(rows: &'a [Row], keys: &'a [SweptKey], quantity: LoadQuantity) -> Vec<(String, Cell<'a>)> {
    let mut columns: Vec<(String, Cell<'a>)> = Vec::new();
    let mut add = |name: String, cell: Cell<'a>| columns.push((name, cell));
    add("combination".to_owned(), Box::new(|shown| Some(shown.row.combination.to_string())));
    for key in keys {
        add(key.key.clone(), Box::new(|shown| value(key, shown.row)));
    }
    add("status".to_owned(), Box::new(|shown| Some(shown.row.status.name().replace('_', " "))));
    let criteria = criteria(rows);
    let steps = || rows.iter().flat_map(|row| &row.results).filter_map(SweepResult::step);
    if criteria.is_empty() {
        add("step".to_owned(), Box::new(|shown| shown.result.map(|_| shown.number.to_string())));
        if steps().any(|step| step.governing.is_some()) {
            add("what governs".to_owned(), Box::new(|shown| shown.result?.foremost_in_words()));
            let verdict = |shown: Shown<'_>| Some(shown.result?.step()?.governing.as_ref()?.verdict);
            add("does it fail".to_owned(), Box::new(move |shown| verdict(shown).as_ref().map(Verdict::to_string)));
        }
    } else {
        add("fails first".to_owned(), Box::new(|shown| shown.result?.foremost_in_words()));
    }
    for criterion in criteria {
        let name = criterion.map_or("first limit".to_owned(), |criterion| criterion.to_string());
        let limit = move |shown: Shown<'_>| shown.result?.limit_value(criterion).as_ref().map(LimitValue::to_string);
        add(name, Box::new(limit));
    }
    for quantity in shown_with(quantity).filter(|quantity| steps().any(|step| stated(*quantity, step).is_some())) {
        add(quantity.named().name.to_owned(), Box::new(move |shown| quantity_text(quantity, shown)));
    }
    let levels = steps().map(|step| step.reading.levels.len()).max().unwrap_or(0);
    // A single level has the whole load.
    for index in (0..levels).filter(|_| levels > 1) {
        let share = move |shown: Shown<'_>| {
            LEVEL.load_share.of(shown.result?.step()?.reading.levels.get(index)?).map(percent_with_error)
        };
        add(format!("{} {}", LEVEL.load_share.named.short, index + 1), Box::new(share));
    }
    columns
}

/// A quantity of a step with its error, in the unit of the case.
fn quantity_text(quantity: &dyn OfStep, shown: Shown<'_>) -> Option<String> {
    let measured = stated(quantity, shown.result?.step()?)?;
    let is_part = quantity.named().kind == Kind::Fraction;
    Some(if is_part { percent_with_error(measured) } else { with_error(measured.value, measured.error) })
}
