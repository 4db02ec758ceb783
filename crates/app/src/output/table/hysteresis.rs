//! Table of friction by hysteresis, a row a step, and where each material loses it.

use super::{DETAILED, Table};
use crate::output::number::{in_unit, number, percent};
use percoat_case::units::{Prefixed, Unit, Units};
use percoat_core::measured::Measured;
use percoat_core::problem::Problem;
use percoat_core::reading::{HYSTERESIS, HysteresisReading, READING};
use percoat_core::run::StepRecord;

/// Sentences about the motion, and the table of friction by hysteresis, a row a step, of many steps the last ones; `None` at rest.
pub fn hysteresis(problem: &Problem, steps: &[StepRecord], units: &Units) -> Option<(Vec<String>, Table)> {
    type Row<'a> = (usize, &'a StepRecord, &'a HysteresisReading);
    let all: Vec<Row<'_>> =
        (1..).zip(steps).filter_map(|(number, step)| Some((number, step, step.hysteresis.as_ref()?))).collect();
    let shown = &all[all.len().saturating_sub(DETAILED)..];
    let (.., last) = shown.last()?;
    let load = READING.load(units.quantity());
    let unit = units.load().suited(shown.iter().filter_map(|(_, step, _)| Some(load.of(&step.reading)?.value)));
    let force = units.force().suited(shown.iter().map(|(.., reading)| reading.force));
    let plain = Unit::None.prefixed(1.0);
    let mut header = vec![
        "step".to_owned(),
        unit.headed(load.named.name),
        HYSTERESIS.friction_coefficient.named.name.to_owned(),
        HYSTERESIS.by_energy.named.name.to_owned(),
        force.headed(HYSTERESIS.force.named.name),
    ];
    let shares = last.materials.len() > 1;
    if shares {
        header.extend(last.materials.iter().map(|loss| format!("lost in {}", loss.material)));
    }
    let text = |unit: &Prefixed, found: Option<Measured>| found.map_or("–".to_owned(), |found| in_unit(unit, found));
    let row = |(step, record, reading): &Row<'_>| {
        let mut row = vec![
            step.to_string(),
            text(&unit, load.of(&record.reading)),
            text(&plain, HYSTERESIS.friction_coefficient.of(reading)),
            text(&plain, HYSTERESIS.by_energy.of(reading)),
            text(&force, HYSTERESIS.force.of(reading)),
        ];
        if shares {
            row.extend(reading.materials.iter().map(|loss| percent(loss.share)));
        }
        row
    };
    Some((motion_words(problem, units), Table::new(&header, shown.iter().map(row).collect(), 1)))
}

/// How a problem moves and what its steady state rests on, a sentence each; none at rest.
pub fn motion_words(problem: &Problem, units: &Units) -> Vec<String> {
    let Some(motion) = problem.motion() else { return Vec::new() };
    let velocity = motion.velocity();
    let times = problem.half_space().materials().filter_map(|material| material.relaxation());
    let times: Vec<f64> = times.flat_map(|relaxation| relaxation.terms()).map(|term| term.time).collect();
    let (least, most) = times.iter().fold((f64::INFINITY, 0.0f64), |(a, b), time| (a.min(*time), b.max(*time)));
    let moves = format!("the load moves steadily with the velocity {}", units.velocity().with_unit(velocity, number));
    let images = "each point is passed again and again in the cell; errors are those of the grid, and a cell twice as wide shows that of the cell";
    if times.is_empty() {
        return vec![moves, images.to_owned()];
    }
    let way = |time: f64| units.length().with_unit(velocity * time, number);
    let ways = if least < most { format!("{} to {}", way(least), way(most)) } else { way(most) };
    vec![
        format!("{moves}, in a relaxation time by {ways}; a counterbody is relaxed, at rest in its frame"),
        format!(
            "{images}; waves along the track stay relaxed at any velocity, and the fastest motion is not the glassy contact"
        ),
    ]
}
