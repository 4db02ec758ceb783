//! Quantities with their places over the load steps, a row each.

use super::{DETAILED, Table};
use crate::output::number::{number, with_error};
use crate::run::StepRecord;

/// Value, error and place of a quantity in a step that has it.
pub(super) type Found = (f64, Option<f64>, [f64; 3]);

/// A quantity.
pub(super) struct Row {
    pub name: String,
    /// What it is in each step that has it.
    pub found: Vec<Option<Found>>,
}

/// A few steps side by side, or the last of many; the places are those in the last. `None` where no step has any.
pub(super) fn by_step(head: &str, steps: &[StepRecord], rows: &[Row]) -> Option<Table> {
    let last = (0..steps.len()).rev().find(|&step| rows.iter().any(|row| row.found[step].is_some()))?;
    let shown = if steps.len() <= DETAILED { 0..steps.len() } else { last..last + 1 };
    let pressures = steps[shown.clone()].iter().map(|step| format!("p̄ = {}", number(step.reading.mean_pressure)));
    let place_of = if shown.len() > 1 { "place (x, y, z) in the last" } else { "place (x, y, z)" };
    let header: Vec<String> = [head.to_owned()].into_iter().chain(pressures).chain([place_of.to_owned()]).collect();
    let line = |row: &Row| {
        let of = |found: &Option<Found>| found.map_or("–".to_owned(), |(x, error, _)| finite(x, error));
        let values = row.found[shown.clone()].iter().map(of);
        let place = row.found[last].map_or("–".to_owned(), |(_, _, position)| place(position));
        [row.name.clone()].into_iter().chain(values).chain([place]).collect()
    };
    Some(Table::new(&header, rows.iter().map(line).collect(), 1))
}

/// What is no number is not infinite.
fn finite(x: f64, error: Option<f64>) -> String {
    if x.is_infinite() { "singular".to_owned() } else { with_error(x, error) }
}

/// x, y, z; what is a millionth of the largest is zero: no place is known as well.
pub(super) fn place([x, y, z]: [f64; 3]) -> String {
    let size = x.abs().max(y.abs()).max(z.abs());
    let plain = |v: f64| if v.abs() <= 1e-6 * size { "0".to_owned() } else { number(v) };
    format!("({}, {}, {})", plain(x), plain(y), plain(z))
}
