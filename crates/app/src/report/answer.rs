//! The answer of a run: its last load step with contact in a sentence, and its numbers with their errors.

use super::markup::{Markup, numbers, tag, with};
use super::table::pairs;
use super::units::with_unit;
use crate::output::table::percent_with_error;
use crate::output::with_error;
use percoat_case::units::Units;
use percoat_case::words::Words;
use percoat_core::reading::LevelReading;
use percoat_core::run::StepRecord;

/// The first section of a run: a sentence on the last load step with contact, and a table of its numbers.
pub(super) fn answer(steps: &[StepRecord], units: &Units) -> Markup {
    let number = steps.iter().rposition(|step| step.reading.touches()).map_or(steps.len(), |index| index + 1);
    let Some(step) = number.checked_sub(1).and_then(|index| steps.get(index)) else {
        return tag("p", "The case has no load step.");
    };
    let reading = &step.reading;
    let errors = &reading.errors;
    let quantity = units.quantity();
    let load = with_unit(&units.load(), reading.load(quantity), reading.load_error(quantity));
    let penetration = with_unit(units.length(), reading.penetration, errors.penetration);
    let words = Words::of(step.kind());
    let contact = match reading.contact_fraction {
        Some(part) => percent_with_error(part, errors.contact_fraction),
        None => with_unit(&units.area(), reading.contact_area, errors.contact_area),
    };
    let peak = reading
        .finite_peak()
        .map_or("singular".to_owned(), |peak| with_unit(units.pressure(), peak, errors.max_pressure));
    let sentence = if reading.touches() {
        let highest = highest(&reading.levels);
        let under = highest.map_or(String::new(), |level| format!(" under level {}", level.level));
        let peak = if reading.singular() { "is infinite".to_owned() } else { format!("is {peak}") };
        format!(
            "Under the {} {load} the {} is {penetration}; {contact} {}, and \
             the largest pressure {peak}{under}.",
            quantity.name(),
            words.load.depth,
            words.extent_of
        )
    } else {
        "Nothing touches: there is no load.".to_owned()
    };
    let mut rows: Vec<(&str, Markup)> = vec![
        (quantity.name(), numbers(&load)),
        (words.load.depth, numbers(&penetration)),
        (words.extent, numbers(&contact)),
        ("peak pressure", numbers(&peak)),
    ];
    rows.extend(
        words
            .load
            .mean_pressure
            .zip(reading.mean_contact_pressure())
            .map(|(name, (mean, error))| (name, numbers(&with_unit(units.pressure(), mean, error)))),
    );
    if let [level] = &reading.levels[..]
        && let Some(radius) = level.contact_radius.filter(|_| level.load > 0.0 && !level.ring)
    {
        let radius = with_unit(units.length(), radius, level.errors.contact_radius);
        rows.push(("contact radius", numbers(&radius)));
    }
    rows.push((
        words.around.energy,
        numbers(&with_unit(&units.energy(), reading.elastic_energy, errors.elastic_energy)),
    ));
    let shares = reading.levels.iter().map(|level| {
        let share = percent_with_error(level.load_share, level.errors.load_share);
        tag("li", numbers(&format!("level {}: {share}", level.level)))
    });
    if reading.levels.len() > 1 {
        rows.push(("share of the load", with("ul", &[("class", "plain")], shares.collect::<Markup>())));
    }
    if let Some(rough) = &step.rough {
        let stiffness = rough.stiffness.map(|stiffness| with_error(stiffness, rough.stiffness_error));
        rows.extend(rough.corrected_fraction.map(|part| {
            let part = percent_with_error(part, rough.corrected_fraction_error);
            ("counted, corrected by the perimeter", numbers(&part))
        }));
        rows.push((words.around.spots, rough.spots.count.to_string().into()));
        let gap = rough.mean_gap.map(|gap| with_unit(units.length(), gap, rough.mean_gap_error));
        rows.extend(gap.map(|gap| ("mean gap", numbers(&gap))));
        rows.extend(stiffness.map(|text| (words.around.stiffness, numbers(&text))));
    }
    let stiffness = step.contact_stiffness.map(|stiffness| with_error(stiffness, step.contact_stiffness_error));
    rows.extend(stiffness.map(|text| (words.around.stiffness, numbers(&text))));
    let step_of = format!("Load step {number} of {}, with the estimated errors of the grid", steps.len());
    vec![with("p", &[("class", "answer")], numbers(&sentence)), pairs(&step_of, &rows)].into()
}

/// The level with the largest pressure, where there are several.
fn highest(levels: &[LevelReading]) -> Option<&LevelReading> {
    let loaded = levels.iter().filter(|level| level.load > 0.0 && levels.len() > 1);
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
