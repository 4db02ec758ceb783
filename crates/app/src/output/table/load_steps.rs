//! The table of the load steps: a row for every level, or of many steps a row each.

use super::{NOTHING, Table};
use crate::output::number::{in_unit, number, percent_with_error, shown};
use percoat_case::units::Units;
use percoat_case::words::LoadWords;
use percoat_core::lattice::Surroundings;
use percoat_core::quantity::{Kind, Named, Quantity};
use percoat_core::reading::{LEVEL, LevelQuantities, LevelReading, READING, Reading};
use percoat_core::run::StepRecord;

/// Most load steps with a row for every level.
pub const DETAILED: usize = 6;

/// Table of the load steps: up to [`DETAILED`] with a row for every level, more with one row a step.
pub fn steps(steps: &[StepRecord], units: &Units) -> Table {
    let levels = steps.first().map_or(0, |step| step.reading.levels.len());
    if steps.len() <= DETAILED && levels > 0 { detailed(steps, units) } else { compact(steps, levels, units) }
}

/// A column of a table of records: its head, and its cell in the row of a record.
struct Column<'a, R> {
    head: String,
    cell: Box<dyn Fn(&R) -> String + 'a>,
}

impl<'a, R: 'static> Column<'a, R> {
    fn new(head: impl Into<String>, cell: impl Fn(&R) -> String + 'a) -> Self {
        Self { head: head.into(), cell: Box::new(cell) }
    }

    /// The column of a quantity under a name, in the unit that suits `all` of its rows.
    fn of(quantity: &'static Quantity<R>, name: &str, units: &Units, all: impl Iterator<Item = &'a R>) -> Self {
        let unit = units
            .unit(quantity.named.kind)
            .suited(all.filter_map(|record| quantity.finite(record)).map(|found| found.value));
        Self::new(unit.headed(name), move |record| match (quantity.of(record), quantity.named.kind) {
            (None, _) => "–".to_owned(),
            (Some(found), Kind::Fraction) => percent_with_error(found),
            (Some(found), _) => in_unit(&unit, found),
        })
    }
}

/// The columns of a load step itself: load, penetration, and how far contact extends.
fn leading<'a>(steps: &'a [StepRecord], units: &'a Units) -> Vec<Column<'a, Reading>> {
    let is_given = steps.iter().any(|step| step.kind().is_given);
    let of = |quantity: &'static Quantity<Reading>| {
        Column::of(quantity, quantity.named.of(is_given), units, steps.iter().map(|step| &step.reading))
    };
    let extent = |reading: &Reading| {
        let extent = reading.extent();
        extent.of(reading).map_or("–".to_owned(), |found| shown(&extent.named, found, units))
    };
    vec![of(READING.load(units.quantity())), of(&READING.penetration), Column::new(LoadWords::of(steps).area, extent)]
}

fn detailed(steps: &[StepRecord], units: &Units) -> Table {
    let readings = || steps.iter().map(|step| &step.reading);
    let levels = || readings().flat_map(|reading| &reading.levels);
    let of = |quantity: &'static Quantity<LevelReading>, name| Column::of(quantity, name, units, levels());
    let several = readings().any(|reading| reading.levels.len() > 1);
    // A single level has the whole load, and a single isolated indenter the force: no columns of level, load on one and share.
    let has_force = |reading: &Reading| (reading.levels[0].load - reading.force).abs() <= NOTHING * reading.force.abs();
    let is_alone = |reading: &Reading| reading.surroundings() == Surroundings::FreeSpace && has_force(reading);
    let mut columns: Vec<Column<'_, LevelReading>> = Vec::new();
    if several {
        columns.push(Column::new("level", |level: &LevelReading| level.level.to_string()));
    }
    if several || !readings().all(is_alone) {
        columns.push(of(&LEVEL.load, LEVEL.load.named.name));
    }
    if several {
        columns.push(of(&LEVEL.load_share, LEVEL.load_share.named.short));
    }
    columns.push(of(&LEVEL.max_pressure, LEVEL.max_pressure.named.name));
    columns.push(contact_radius(levels(), units));
    columns.push(of(&LEVEL.asymmetry, LEVEL.asymmetry.named.name));
    let lead = leading(steps, units);
    let mut rows = Vec::new();
    for reading in readings() {
        for (index, level) in reading.levels.iter().enumerate() {
            let first = |column: &Column<'_, Reading>| if index == 0 { (column.cell)(reading) } else { String::new() };
            rows.push(lead.iter().map(first).chain(columns.iter().map(|column| (column.cell)(level))).collect());
        }
    }
    let heads: Vec<&String> =
        lead.iter().map(|column| &column.head).chain(columns.iter().map(|column| &column.head)).collect();
    let table = Table::new(&heads, rows, 0);
    if several { table.keyed(&[0, lead.len()]) } else { table }
}

/// The contact radius, both radii of a ring, or that contacts have merged.
fn contact_radius<'a>(all: impl Iterator<Item = &'a LevelReading>, units: &Units) -> Column<'a, LevelReading> {
    let LevelQuantities { contact_radius: radius, radius_inner, radius_outer, .. } = &LEVEL;
    let Named { name, kind, .. } = radius.named;
    let length = units.unit(kind).suited(all.filter_map(|level| radius.of(level)).map(|found| found.value));
    Column::new(length.headed(name), move |level: &LevelReading| match radius.of(level) {
        _ if !level.touches() => "–".to_owned(),
        Some(found) if level.ring => match radius_inner.of(level).zip(radius_outer.of(level)) {
            Some((inner, outer)) => format!("ring {} to {}", in_unit(&length, inner), in_unit(&length, outer)),
            None => format!("ring, area of {}", number(length.shown(found.value))),
        },
        Some(found) => in_unit(&length, found),
        None => "merged".to_owned(),
    })
}

fn compact(steps: &[StepRecord], levels: usize, units: &Units) -> Table {
    let readings = || steps.iter().map(|step| &step.reading);
    let peaks = readings().filter_map(|reading| READING.max_pressure.finite(reading)).map(|found| found.value);
    let pressure = units.pressure().suited(peaks);
    let pressure = &pressure;
    let mut columns = leading(steps, units);
    let of_level = |quantity: &'static Quantity<LevelReading>, head: &str, level: usize| {
        let head = if quantity.named.kind == Kind::Pressure { pressure.headed(head) } else { head.to_owned() };
        Column::new(head, move |reading: &Reading| {
            quantity.of(&reading.levels[level - 1]).map_or("–".to_owned(), |found| match quantity.named.kind {
                Kind::Fraction => percent_with_error(found),
                _ => in_unit(pressure, found),
            })
        })
    };
    // A single level has the whole load.
    for quantity in [&LEVEL.max_pressure, &LEVEL.load_share].into_iter().take(if levels > 1 { 2 } else { 1 }) {
        let named = |level: usize| match levels {
            1 => quantity.named.name.to_owned(),
            _ => format!("{} {level}", quantity.named.short),
        };
        columns.extend((1..=levels).map(|level| of_level(quantity, &named(level), level)));
    }
    if levels == 0 {
        let whole = [&READING.max_pressure, &READING.elastic_energy];
        columns.extend(whole.map(|quantity| Column::of(quantity, quantity.named.name, units, readings())));
    }
    let row = |reading: &Reading| columns.iter().map(|column| (column.cell)(reading)).collect();
    let heads: Vec<&String> = columns.iter().map(|column| &column.head).collect();
    Table::new(&heads, readings().map(row).collect(), 0)
}
