//! The answer of a run: its last load step with contact in a sentence, and its numbers with their errors.

use super::markup::{Markup, numbers, tag, with};
use super::table::pairs;
use crate::output::{shown, with_error, with_unit};
use percoat_case::units::Units;
use percoat_case::words::Words;
use percoat_core::quantity::Quantity;
use percoat_core::reading::{LEVEL, LevelReading, READING, ROUGH, Reading, ReadingQuantities, RoughReading};
use percoat_core::run::{STEP, StepRecord};

/// The first section of a run: a sentence on the last load step with contact, and a table of its numbers.
pub(super) fn answer(steps: &[StepRecord], units: &Units) -> Markup {
    let number = steps.iter().rposition(|step| step.reading.touches()).map_or(steps.len(), |index| index + 1);
    let Some(step) = number.checked_sub(1).and_then(|index| steps.get(index)) else {
        return tag("p", "The case has no load step.");
    };
    let step_of = format!("Load step {number} of {}, with the estimated errors of the grid", steps.len());
    let answer = with("p", &[("class", "answer")], numbers(&sentence(step, units)));
    vec![answer, pairs(&step_of, &rows(step, units))].into()
}

/// A quantity of a record with its error and unit; empty where the record does not have it.
fn text<R>(quantity: &Quantity<R>, record: &R, units: &Units) -> String {
    quantity.of(record).map_or(String::new(), |found| shown(&quantity.named, found, units))
}

/// Sentence on the penetration, the contact and the peak pressure of a load step.
fn sentence(step: &StepRecord, units: &Units) -> String {
    let reading = &step.reading;
    let ReadingQuantities { penetration: depth, max_pressure: peak, .. } = &READING;
    let load = READING.load(units.quantity());
    let pulls = step.adhesion.as_ref().is_some_and(|adhesion| adhesion.adhesive_load > 0.0);
    if !reading.touches() && pulls {
        return format!(
            "Nothing touches, but the surfaces pull: the {} is {} at the {} {}.",
            load.named.name,
            text(load, reading, units),
            depth.named.name,
            text(depth, reading, units)
        );
    }
    if !reading.touches() {
        return "Nothing touches: there is no load.".to_owned();
    }
    let is = match reading.singular() {
        true => "is infinite".to_owned(),
        false => format!("is {}", text(peak, reading, units)),
    };
    let under = highest(&reading.levels).map_or(String::new(), |level| format!(" under level {}", level.level));
    format!(
        "Under the {} {} the {} is {}; {} {}, and the {} {is}{under}.",
        load.named.name,
        text(load, reading, units),
        depth.named.of(step.kind().is_given),
        text(depth, reading, units),
        text(reading.extent(), reading, units),
        Words::of(step.kind()).extent_of,
        peak.named.name
    )
}

/// The numbers of a step under their names.
fn rows(step: &StepRecord, units: &Units) -> Vec<(&'static str, Markup)> {
    let (reading, is_given) = (&step.reading, step.kind().is_given);
    let words = Words::of(step.kind());
    let around = words.around;
    let row = |quantity: &Quantity<Reading>| (quantity.named.of(is_given), numbers(&text(quantity, reading, units)));
    let mut rows = vec![
        row(READING.load(units.quantity())),
        row(&READING.penetration),
        row(reading.extent()),
        row(&READING.max_pressure),
    ];
    rows.extend(
        words
            .load
            .mean_pressure
            .zip(reading.mean_contact_pressure())
            .map(|(name, mean)| (name, numbers(&with_unit(units.pressure(), mean)))),
    );
    if let [level] = &reading.levels[..]
        && level.contact_radius.is_some_and(|_| level.touches() && !level.ring)
    {
        rows.push((LEVEL.contact_radius.named.name, numbers(&text(&LEVEL.contact_radius, level, units))));
    }
    rows.push((around.energy, numbers(&text(&READING.elastic_energy, reading, units))));
    if reading.levels.len() > 1 {
        let shares = reading.levels.iter().map(|level| {
            let share = text(&LEVEL.load_share, level, units);
            tag("li", numbers(&format!("level {}: {share}", level.level)))
        });
        let shares = with("ul", &[("class", "plain")], shares.collect::<Markup>());
        rows.push((LEVEL.load_share.named.name, shares));
    }
    if let Some(rough) = &step.rough {
        let row = |quantity: &Quantity<RoughReading>| {
            quantity.of(rough).map(|found| (quantity.named.short, numbers(&shown(&quantity.named, found, units))))
        };
        rows.extend(row(&ROUGH.corrected_fraction));
        rows.push((around.spots, rough.spots.count.to_string().into()));
        rows.extend(row(&ROUGH.mean_gap));
        let stiffness = ROUGH.stiffness.of(rough).map(|found| with_error(found.value, found.error));
        rows.extend(stiffness.map(|text| (around.stiffness, numbers(&text))));
    }
    let stiffness = STEP.contact_stiffness.of(step);
    rows.extend(
        stiffness.map(|_| (STEP.contact_stiffness.named.name, numbers(&text(&STEP.contact_stiffness, step, units)))),
    );
    rows
}

/// The level with the largest pressure, where there are several.
fn highest(levels: &[LevelReading]) -> Option<&LevelReading> {
    let loaded = levels.iter().filter(|level| level.touches() && levels.len() > 1);
    loaded.max_by(|a, b| a.max_pressure.total_cmp(&b.max_pressure))
}

/// The load steps that have not converged, in a sentence; empty where all have.
pub(super) fn doubts(steps: &[StepRecord]) -> Markup {
    let failed = (1..).zip(steps).filter(|(_, step)| !step.converged());
    let failed: Vec<String> = failed.map(|(number, step)| format!("{number} ({})", step.stop)).collect();
    if failed.is_empty() {
        return Markup::default();
    }
    let text = format!(
        "Not converged: load step {}. Its numbers are those of the last iterate; judge them by the certificate below.",
        failed.join(", ")
    );
    with("p", &[("class", "doubt"), ("role", "note")], text)
}
