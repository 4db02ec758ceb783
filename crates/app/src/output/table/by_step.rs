//! Tables of quantities and their places over the load steps, a row each.

use super::{DETAILED, Table};
use crate::output::number::number;
use percoat_case::units::{Prefixed, Unit, Units};
use percoat_core::measured::Measured;
use percoat_core::reading::StressReading;
use percoat_core::run::StepRecord;
use percoat_core::stress::Peak;

/// Value and place of a quantity in a load step.
#[derive(Clone, Copy)]
pub(super) struct QuantityInStep {
    pub measured: Measured,
    /// Place x, y, z; lengths.
    pub position: [f64; 3],
    /// Another place where it may be largest within the errors.
    pub rival: Option<[f64; 3]>,
}

/// A row of the table.
pub(super) struct Quantity {
    pub name: String,
    /// The quantity in each step; `None` where a step does not have it.
    pub found: Vec<Option<QuantityInStep>>,
}

impl Quantity {
    /// A largest value of each step, with its place.
    pub(super) fn of_peaks(name: String, steps: &[StepRecord], peak: impl Fn(&StressReading) -> Option<Peak>) -> Self {
        let found = |step: &StepRecord| {
            let Peak { value, error, position, rival, .. } = peak(step.stress.as_ref()?)?;
            let rival = rival.map(|rival| rival.position);
            Some(QuantityInStep { measured: Measured::new(value, error), position, rival })
        };
        Self { name, found: steps.iter().map(found).collect() }
    }
}

/// Table of quantities of one unit, `told` in it: a few steps side by side, or the last of many; places are those in the last step. `None` where
/// no step has any.
pub(super) fn by_step(
    head: &str,
    (unit, told): (&Unit, fn(&Prefixed, Measured) -> String),
    units: &Units,
    steps: &[StepRecord],
    rows: &[Quantity],
) -> Option<Table> {
    let last = (0..steps.len()).rev().find(|&step| rows.iter().any(|row| row.found[step].is_some()))?;
    let shown = if steps.len() <= DETAILED { 0..steps.len() } else { last..last + 1 };
    let loads = steps[shown.clone()].iter().map(|step| step.reading.load(units.quantity()));
    let load_unit = units.load().suited(loads.clone());
    let loads = loads.map(|load| format!("{} = {}", units.quantity().symbol(), load_unit.with_unit(load, number)));
    let loads = told_apart(loads.collect(), shown.start + 1);
    let place_of = if shown.len() > 1 { "place (x, y, z) in the last" } else { "place (x, y, z)" };
    let unit =
        unit.suited(rows.iter().flat_map(|row| &row.found[shown.clone()]).flatten().map(|found| found.measured.value));
    let length = units.length().suited(rows.iter().filter_map(|row| row.found[last]).flat_map(|found| found.position));
    let header: Vec<String> = [unit.headed(head)].into_iter().chain(loads).chain([length.headed(place_of)]).collect();
    let line = |row: &Quantity| {
        let of = |found: &Option<QuantityInStep>| found.map_or("–".to_owned(), |found| told(&unit, found.measured));
        let values = row.found[shown.clone()].iter().map(of);
        let place = row.found[last].map_or("–".to_owned(), |found| places(&length, found));
        [row.name.clone()].into_iter().chain(values).chain([place]).collect()
    };
    Some(Table::new(&header, rows.iter().map(line).collect(), 1))
}

/// Headings of steps from a number on by their loads, with the numbers where loads are alike.
fn told_apart(loads: Vec<String>, first: usize) -> Vec<String> {
    let alike = (1..loads.len()).any(|step| loads[..step].contains(&loads[step]));
    if !alike {
        return loads;
    }
    (first..).zip(loads).map(|(step, load)| format!("step {step}, {load}")).collect()
}

/// The place, and where it is undecided within the errors the other one.
fn places(length: &Prefixed, found: QuantityInStep) -> String {
    let first = place(length, found.position);
    found.rival.map_or(first.clone(), |rival| format!("{first} or at {}", place(length, rival)))
}

/// Coordinates x, y, z; those below a millionth of the largest are shown as zero.
pub(super) fn place(length: &Prefixed, [x, y, z]: [f64; 3]) -> String {
    let size = x.abs().max(y.abs()).max(z.abs());
    let plain = |v: f64| if v.abs() <= 1e-6 * size { "0".to_owned() } else { number(length.shown(v)) };
    format!("({}, {}, {})", plain(x), plain(y), plain(z))
}

#[cfg(test)]
mod tests {
    use super::told_apart;

    #[test]
    fn steps_of_equal_loads_are_told_apart_by_their_numbers() {
        let headings = |loads: [&str; 2]| told_apart(loads.map(str::to_owned).to_vec(), 3);
        assert_eq!(headings(["P = 1 N", "P = 2 N"]), ["P = 1 N", "P = 2 N"]);
        assert_eq!(headings(["P = 1 N", "P = 1 N"]), ["step 3, P = 1 N", "step 4, P = 1 N"]);
    }
}
