//! Depths pressed in for good where the pressure reaches the hardness, step by step.

use super::{DETAILED, Table};
use crate::output::number::{in_unit, number};
use percoat_case::units::{Prefixed, Units};
use percoat_core::measured::Measured;
use percoat_core::reading::{PLASTIC, PlasticReading, READING};
use percoat_core::run::StepRecord;

/// A sentence about what is pressed in, and the table of it, a row a step, of many steps the last; `None` without hardness. Where nothing
/// is pressed in there is no table.
pub fn plastic(steps: &[StepRecord], units: &Units) -> Option<(String, Option<Table>)> {
    let readings = || steps.iter().filter_map(|step| Some((step, step.plastic.as_ref()?)));
    let (_, last) = readings().next_back()?;
    let hardness = units.pressure().with_unit(last.hardness, number);
    let pressed: Vec<(&StepRecord, &PlasticReading)> =
        readings().filter(|(_, reading)| reading.is_pressed_in()).collect();
    if pressed.is_empty() {
        let most = readings().map(|(step, _)| step.reading.grid_peak()).fold(0.0, f64::max);
        let part = 100.0 * most / last.hardness;
        let beneath = readings().filter_map(|(step, _)| step.beneath).next_back();
        let beneath = beneath.map_or(String::new(), |beneath| {
            let [pressure, hardness] =
                [beneath.pressure, beneath.hardness].map(|x| units.pressure().with_unit(x, number));
            format!(
                ", but {pressure} reaches {} beneath, of hardness {hardness}: the elastic solution no longer holds",
                beneath.material
            )
        });
        let at = if last.hardness_depth.is_some() { " at the penetration of the last step" } else { "" };
        let words =
            format!("hardness {hardness}{at}: no pressure reaches it, the peak pressure is {part:.0} % of it{beneath}");
        return Some((words, None));
    }
    let shown = if pressed.len() > DETAILED { &pressed[pressed.len() - 1..] } else { &pressed[..] };
    let load = units.load().suited(shown.iter().map(|(step, _)| step.reading.load(units.quantity())));
    let area = units.area().suited(shown.iter().map(|(_, reading)| reading.area));
    let length = units.length().suited(shown.iter().flat_map(|(_, reading)| [reading.depth, reading.permanent_depth]));
    let pressure = units.pressure().suited(shown.iter().map(|(_, reading)| reading.hardness));
    let is_composite = last.hardness_depth.is_some();
    let header = [
        load.headed(units.quantity().name()),
        area.headed(PLASTIC.area.named.name),
        "of the contact".to_owned(),
        length.headed(PLASTIC.depth.named.name),
        length.headed(PLASTIC.permanent_depth.named.name),
    ];
    let header: Vec<String> =
        header.into_iter().chain(is_composite.then(|| pressure.headed(PLASTIC.hardness.named.name))).collect();
    let row = |(step, plastic): &(&StepRecord, &PlasticReading)| {
        // Two areas, each read with its own error.
        let part = (plastic.area / step.reading.contact_area).clamp(0.0, 1.0);
        let text =
            |unit: &Prefixed, found: Option<Measured>| found.map_or("–".to_owned(), |found| in_unit(unit, found));
        let row = [
            text(&load, READING.load(units.quantity()).of(&step.reading)),
            text(&area, PLASTIC.area.of(plastic)),
            if part.is_finite() { format!("{:.0} %", 100.0 * part) } else { "–".to_owned() },
            text(&length, PLASTIC.depth.of(plastic)),
            text(&length, PLASTIC.permanent_depth.of(plastic)),
        ];
        row.into_iter().chain(is_composite.then(|| text(&pressure, PLASTIC.hardness.of(plastic)))).collect()
    };
    Some((pressed_in(&hardness, is_composite), Some(Table::new(&header, shown.iter().map(row).collect(), 0))))
}

/// Effect of a hardness on the surface with the assumption behind it, a sentence.
fn pressed_in(hardness: &str, is_composite: bool) -> String {
    let (of, assumption) = match is_composite {
        false => (format!("hardness {hardness}"), "the hardness does not depend on the depth"),
        true => (
            "composite hardness of the penetration".to_owned(),
            "by a law of indentation tests with pyramids, whose depth is taken for the penetration",
        ),
    };
    format!("{of}: where the pressure reaches it the surface is pressed in for good (without pile-up; {assumption})")
}
