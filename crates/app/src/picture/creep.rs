//! Penetration, contact and load of bodies that creep over time.

use super::snapshot::caption;
use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_core::problem::Problem;
use percoat_core::quantity::Quantity;
use percoat_core::reading::{CREEP, READING, Reading};
use percoat_core::run::StepRecord;
use percoat_draw::axis::{Axis, log_spaced};
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Style};

/// The picture; `None` where nothing depends on time, and for less than two steps.
pub fn creep(title: &str, problem: &Problem, units: &Units, steps: &[StepRecord]) -> Option<Canvas> {
    let creeping: Vec<&StepRecord> = steps.iter().filter(|step| step.creep.is_some()).collect();
    if creeping.len() < 2 {
        return None;
    }
    let extent = creeping.last()?.reading.extent();
    let quantities: [&Quantity<Reading>; 3] = [READING.load(units.quantity()), &READING.penetration, extent];
    let charts: Vec<Chart> =
        ('a'..).zip(quantities).map(|(letter, quantity)| chart(letter, quantity, &creeping, units)).collect();
    let more = [format!("{} times", creeping.len())];
    let words = " Bars: estimated errors.";
    Some(plots(&format!("{}{words}", caption(title, problem, units, &more)), &charts))
}

/// A quantity over time; on a logarithmic axis times since the first one.
fn chart(letter: char, quantity: &Quantity<Reading>, steps: &[&StepRecord], units: &Units) -> Chart {
    let time = |step: &StepRecord| step.creep.map_or(f64::NAN, |creep| creep.time);
    let begins = steps.first().map_or(0.0, |step| time(step));
    let since: Vec<f64> = steps.iter().map(|step| time(step) - begins).filter(|time| *time > 0.0).collect();
    let is_log = log_spaced(&since);
    let at = |step: &&StepRecord| {
        let found = quantity.of(&step.reading);
        let place =
            if is_log { Some(time(step) - begins).filter(|time| *time > 0.0).unwrap_or(f64::NAN) } else { time(step) };
        let value = found.map_or(f64::NAN, |found| found.value);
        ([place, value], found.and_then(|found| found.error).unwrap_or(f64::NAN))
    };
    let (points, errors) = steps.iter().map(at).filter(|(point, _)| point.iter().all(|x| x.is_finite())).unzip();
    let label = units.label(&CREEP.time.named);
    Chart {
        title: format!("({letter}) {}", quantity.named.name),
        x: if is_log { Axis::log(label) } else { Axis::linear(label) },
        y: Axis::linear(units.label(&quantity.named)),
        curves: vec![Curve { label: String::new(), points, errors, style: Style::LineMarkers, colour: 1.into() }],
    }
}
