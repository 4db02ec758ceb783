//! Force and contact area of surfaces that adhere over their penetration, step by step, with jumps and pull-off.

use super::snapshot::caption;
use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_core::problem::Problem;
use percoat_core::quantity::Quantity;
use percoat_core::reading::{JumpReading, READING, Reading, pull_off};
use percoat_core::run::StepRecord;
use percoat_core::spectral::Stop;
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Style};

/// The picture; `None` without adhesion, and for less than two steps.
pub fn approach(title: &str, problem: &Problem, units: &Units, steps: &[StepRecord]) -> Option<Canvas> {
    let adheres = steps.iter().any(|step| step.adhesion.is_some());
    if steps.len() < 2 || !adheres {
        return None;
    }
    let charts = [
        chart('a', &READING.force, steps, units, |jump| jump.force),
        chart('b', &READING.contact_area, steps, units, |jump| jump.contact_area),
    ];
    let has = |of: &dyn Fn(&StepRecord) -> bool, words: &'static str| if steps.iter().any(of) { words } else { "" };
    let jumps = has(&|step| step.adhesion.as_ref().is_some_and(|reading| !reading.jumps.is_empty()), " Dashed: jumps.");
    let pulled = has(
        &|step| step.adhesion.as_ref().is_some_and(|reading| reading.pull_off.is_some()),
        " Open marker: pull-off.",
    );
    let words = " Filled markers: pressed together; lines without: drawn apart. Bars: estimated errors.";
    let more = [format!("{} steps", steps.len())];
    Some(plots(&format!("{}{words}{jumps}{pulled}", caption(title, problem, units, &more)), &charts))
}

/// A quantity over the penetration: ways that press together and ways that draw apart, jumps, and pull-off.
fn chart(
    letter: char,
    quantity: &Quantity<Reading>,
    steps: &[StepRecord],
    units: &Units,
    of_jump: impl Fn(&JumpReading) -> [f64; 2],
) -> Chart {
    let mut curves = ways(quantity, steps, &of_jump);
    let readings = || steps.iter().filter_map(|step| step.adhesion.as_ref());
    for jump in readings().flat_map(|reading| &reading.jumps) {
        if let ([Some(before), Some(after)], [from, to]) = (jump.penetration, of_jump(jump)) {
            curves.push(curve(vec![[before, from], [after, to]], Style::Dashed, 0));
        }
    }
    if let Some(found) = pull_off(readings()) {
        let value = if letter == 'a' { found.force } else { found.contact_area };
        curves.push(curve(vec![[found.penetration, value]], Style::Markers, 0));
    }
    Chart {
        title: format!("({letter}) {}", quantity.named.name),
        x: Axis::linear(units.label(&READING.penetration.named)),
        y: Axis::linear(units.label(&quantity.named)),
        curves,
    }
}

fn curve(points: Vec<[f64; 2]>, style: Style, colour: usize) -> Curve {
    Curve { label: String::new(), points, errors: Vec::new(), style, colour: colour.into() }
}

/// Lines through the steps, a new one where the way turns; interrupted by jumps, and where nothing holds the surfaces.
fn ways(quantity: &Quantity<Reading>, steps: &[StepRecord], of_jump: &impl Fn(&JumpReading) -> [f64; 2]) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    let style = |is_in: bool| if is_in { Style::LineMarkers } else { Style::Line };
    let at = |step: &StepRecord| {
        let found = quantity.of(&step.reading).filter(|_| step.stop != Stop::Detached);
        let value = found.map_or(f64::NAN, |found| found.value);
        let place = if value.is_nan() { f64::NAN } else { step.reading.penetration };
        ([place, value], found.and_then(|found| found.error).unwrap_or(f64::NAN))
    };
    for pair in steps.windows(2) {
        let is_in = pair[1].reading.penetration > pair[0].reading.penetration;
        let goes_on = curves.last().is_some_and(|last| last.style == style(is_in));
        let jumps = pair[1].adhesion.as_ref().map_or(&[][..], |reading| &reading.jumps);
        if !goes_on {
            let (place, error) = at(&pair[0]);
            curves.push(Curve { errors: vec![error], ..curve(vec![place], style(is_in), if is_in { 1 } else { 2 }) });
        }
        if let Some(last) = curves.last_mut() {
            // A line ends before a jump and goes on behind.
            for jump in jumps {
                let [before, after] = of_jump(jump);
                let [from, to] = jump.penetration.map(|place| place.unwrap_or(f64::NAN));
                last.points.extend([[from, before], [f64::NAN; 2], [to, after]]);
                last.errors.extend([f64::NAN; 3]);
            }
            let (place, error) = at(&pair[1]);
            last.points.push(place);
            last.errors.push(error);
        }
    }
    curves
}
