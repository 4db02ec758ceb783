//! Table of bodies that creep, a row a step: time, load, penetration and contact.

use super::Table;
use crate::output::number::{number, percent, shown};
use percoat_case::case::Case;
use percoat_case::units::Units;
use percoat_core::creep;
use percoat_core::numeric::search::largest;
use percoat_core::quantity::Quantity;
use percoat_core::reading::{CREEP, CreepReading, READING, Reading};
use percoat_core::run::StepRecord;

/// Most rows that are shown whole.
const MOST: usize = 24;
/// Rows at the end that are shown of more.
const LAST: usize = 4;

/// Sentences about the path in time, and the table of its steps, of very many some; `None` where nothing depends on time.
pub fn creep(case: &Case, steps: &[StepRecord], units: &Units) -> Option<(Vec<String>, Table)> {
    type Row<'a> = (usize, &'a StepRecord, &'a CreepReading);
    let all: Vec<Row<'_>> =
        (1..).zip(steps).filter_map(|(number, step)| Some((number, step, step.creep.as_ref()?))).collect();
    let (.., last) = all.last()?;
    let every = all.len().div_ceil(MOST);
    let is_shown = |index: usize| index.is_multiple_of(every) || index + LAST >= all.len();
    let readings = || all.iter().map(|(_, step, _)| &step.reading);
    let of = |quantity: &Quantity<Reading>| {
        let values = readings().filter_map(|reading| quantity.finite(reading)).map(|found| found.value);
        units.unit(quantity.named.kind).suited(values)
    };
    let time = units.time().suited(all.iter().map(|(.., reading)| reading.time));
    let columns = [READING.load(units.quantity()), &READING.penetration];
    let suited = columns.map(of);
    let mut header = vec!["step".to_owned(), time.headed(CREEP.time.named.name)];
    header.extend(columns.iter().zip(&suited).map(|(quantity, unit)| unit.headed(quantity.named.name)));
    header.push("in contact".to_owned());
    let row = |(step, record, reading): &Row<'_>| {
        let mut row = vec![step.to_string(), number(time.shown(reading.time))];
        row.extend(columns.iter().zip(&suited).map(|(quantity, unit)| {
            let found = quantity.of(&record.reading);
            found.map_or("–".to_owned(), |found| crate::output::number::in_unit(unit, found))
        }));
        let extent = record.reading.extent();
        row.push(extent.of(&record.reading).map_or("–".to_owned(), |found| shown(&extent.named, found, units)));
        row
    };
    let rows = all.iter().enumerate().filter(|(index, _)| is_shown(*index)).map(|(_, found)| row(found)).collect();
    let mut words = creep_words(case, units);
    let relative = |(_, step, reading): &Row<'_>| Some(reading.time_error? / step.reading.penetration.abs());
    let most = largest(all.iter().filter_map(relative).filter(|error| error.is_finite()));
    if let (Some(pressure), true) = (last.pressure_time_error, most.is_finite()) {
        words.push(format!(
            "steps in time, {} in all, leave errors of up to {} of the penetration and {} of the pressure; time.tolerance sets them",
            all.iter().map(|(.., reading)| reading.time_steps).sum::<usize>(),
            percent(most),
            percent(pressure)
        ));
    }
    Some((words, Table::new(&header, rows, 1)))
}

/// Sentences on bodies that creep: their state at a jump and in the end, and their retardation times; none where nothing depends on time.
pub fn creep_words(case: &Case, units: &Units) -> Vec<String> {
    let (Some(_), Some([shortest, longest])) = (&case.time, creep::times(case.problem().bodies())) else {
        return Vec::new();
    };
    let [shortest, longest] = [shortest, longest].map(|time| units.time().with_unit(time, number));
    vec![format!(
        "bodies creep under loads in time: glassy under a jump of the load, relaxed in the end; their retardation times lie between {shortest} and \
         {longest}"
    )]
}
