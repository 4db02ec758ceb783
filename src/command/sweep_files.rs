//! The result of a sweep, or of its parts joined: its files, picture and printed lines.

use super::ending::{Ending, Failure};
use super::pictures::PictureOptions;
use super::results::Results;
use super::terminal;
use percoat_app::output::{Plan, Writer};
use percoat_app::picture;
use percoat_app::sweep::{self, Description, Row, Status, SweepResult};
use percoat_case::units::Units;
use std::collections::HashSet;
use std::path::Path;

/// Names of the pictures: of given values, and of uncertain keys.
const PICTURES: [&str; 2] = ["sweep", "uncertainty"];

/// Files of the result, without those of single combinations.
pub fn may_write(writer: Writer, pictures: &PictureOptions) -> Plan {
    let drawn = PICTURES.iter().flat_map(|name| pictures.files(name));
    Plan { names: sweep::files().chain(drawn).collect(), ..Plan::new(writer) }
}

/// Writes, publishes and prints the result with `rows` by ascending combination.
pub fn finish(
    results: Results,
    rows: &[Row],
    description: &Description,
    pictures: &PictureOptions,
) -> Result<Ending, Failure> {
    let (staging, saying) = (results.staging(), results.saying);
    let uncertainty = description.uncertainty(rows);
    sweep::write(&staging, rows, description, uncertainty.as_ref())?;
    let units = description.first_case(rows, Path::new("")).map_or_else(Units::unknown, |case| case.units());
    let quantity = rows.iter().flat_map(|row| &row.results).find_map(SweepResult::quantity);
    let loads = units.clone().with_loads_in(quantity.unwrap_or(units.quantity()));
    let keys = description.named_keys(rows, Path::new(""));
    let [of_values, of_uncertain] = PICTURES;
    match &uncertainty {
        Some(found) => {
            pictures
                .write(&staging, of_uncertain, || picture::uncertainty(&description.title, &units, &keys, found))?;
        }
        // A part of uncertain samples has neither.
        None if description.uncertain.is_some() => {}
        None => pictures.write(&staging, of_values, || picture::sweep(&description.title, &units, &keys, rows))?,
    }
    let warnings = if saying.json { Vec::new() } else { [warnings(rows), failures(rows)].concat() };
    let tables = || {
        let table = match &uncertainty {
            Some(found) => found.table(&loads),
            None => sweep::best_and_worst(rows, &loads).filter(|_| description.uncertain.is_none()),
        };
        table.map_or(String::new(), |told| format!("{}\n{}\n\n", told.words, told.table))
    };
    results.finish("sweep.json", tables, || counts(description), &warnings)?;
    Ok(Ending::of(description.done == rows.len()))
}

/// Numbers of combinations by how they ended, and the wall time.
fn counts(description: &Description) -> String {
    let Description { done, combinations, not_converged, failed, timing, .. } = description;
    let mut words = format!("{done} of {combinations} combinations done");
    for (count, what) in [(not_converged, "not converged"), (failed, "failed")] {
        if *count > 0 {
            words += &format!(", {count} {what}");
        }
    }
    format!("{words}; {:.2} s", timing.wall)
}

/// The reasons of combinations that failed or did not converge.
fn failures(rows: &[Row]) -> Vec<String> {
    let open = rows.iter().filter(|row| row.status != Status::Done);
    let reason = |row: &Row| format!("{}: {}", row.named(), row.reason.as_deref().unwrap_or("not converged"));
    terminal::first_five(open.map(reason).collect(), ", see the column `reason` of sweep.csv")
}

/// Each warning once, whatever its numbers, with the number of combinations that have it.
fn warnings(rows: &[Row]) -> Vec<String> {
    let mut counted: Vec<(String, &str, HashSet<usize>)> = Vec::new();
    for (row, warning) in rows.iter().flat_map(|row| row.warnings.iter().map(move |warning| (row, warning))) {
        let words = without_numbers(warning);
        let at = counted.iter().position(|(known, ..)| *known == words).unwrap_or(counted.len());
        if at == counted.len() {
            counted.push((words, warning, HashSet::new()));
        }
        counted[at].2.insert(row.combination);
    }
    let of = rows.len();
    let told = counted.iter().map(|(_, first, combinations)| match combinations.len() {
        1 => format!("{first} (1 of {of})"),
        count => format!("{first} (this or with other numbers in {count} of {of})"),
    });
    terminal::first_five(told.collect(), ", see the column `warnings` of sweep.csv")
}

/// A sentence without its words that have digits.
fn without_numbers(text: &str) -> String {
    text.split(' ').filter(|word| !word.contains(|letter: char| letter.is_ascii_digit())).collect::<Vec<_>>().join(" ")
}
