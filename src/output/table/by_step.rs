//! Quantities with their places over the load steps, a row each.

use super::{DETAILED, Table, in_unit};
use crate::output::number::number;
use crate::run::StepRecord;
use crate::units::{Prefixed, Unit, Units};

/// A quantity in a step that has it.
#[derive(Clone, Copy)]
pub(super) struct Found {
    pub value: f64,
    pub error: Option<f64>,
    /// x, y, z; lengths.
    pub position: [f64; 3],
    /// Where else it may be largest within the errors.
    pub rival: Option<[f64; 3]>,
}

/// A quantity.
pub(super) struct Row {
    pub name: String,
    /// What it is in each step that has it.
    pub found: Vec<Option<Found>>,
}

/// Quantities of one unit, a few steps side by side, or the last of many; the places are those in the last. `None` where
/// no step has any.
pub(super) fn by_step(head: &str, unit: &Unit, units: &Units, steps: &[StepRecord], rows: &[Row]) -> Option<Table> {
    let last = (0..steps.len()).rev().find(|&step| rows.iter().any(|row| row.found[step].is_some()))?;
    let shown = if steps.len() <= DETAILED { 0..steps.len() } else { last..last + 1 };
    let pressures = steps[shown.clone()].iter().map(|step| step.reading.mean_pressure);
    let pressures = pressures.map(|pressure| format!("p̄ = {}", units.pressure().told(pressure, number)));
    let place_of = if shown.len() > 1 { "place (x, y, z) in the last" } else { "place (x, y, z)" };
    let unit = unit.suited(rows.iter().flat_map(|row| &row.found[shown.clone()]).flatten().map(|found| found.value));
    let length = units.length().suited(rows.iter().filter_map(|row| row.found[last]).flat_map(|found| found.position));
    let header: Vec<String> =
        [unit.headed(head)].into_iter().chain(pressures).chain([length.headed(place_of)]).collect();
    let line = |row: &Row| {
        let of =
            |found: &Option<Found>| found.map_or("–".to_owned(), |found| finite(&unit, found.value, found.error));
        let values = row.found[shown.clone()].iter().map(of);
        let place = row.found[last].map_or("–".to_owned(), |found| places(&length, found));
        [row.name.clone()].into_iter().chain(values).chain([place]).collect()
    };
    Some(Table::new(&header, rows.iter().map(line).collect(), 1))
}

/// What is no number is not infinite.
fn finite(unit: &Prefixed, x: f64, error: Option<f64>) -> String {
    if x.is_infinite() { "singular".to_owned() } else { in_unit(unit, x, error) }
}

/// The place, and where the errors leave it undecided the other one.
fn places(length: &Prefixed, found: Found) -> String {
    let own = place(length, found.position);
    found.rival.map_or(own.clone(), |rival| format!("{own} or at {}", place(length, rival)))
}

/// x, y, z; what is a millionth of the largest is zero: no place is known as well.
pub(super) fn place(length: &Prefixed, [x, y, z]: [f64; 3]) -> String {
    let size = x.abs().max(y.abs()).max(z.abs());
    let plain = |v: f64| if v.abs() <= 1e-6 * size { "0".to_owned() } else { number(length.shown(v)) };
    format!("({}, {}, {})", plain(x), plain(y), plain(z))
}
