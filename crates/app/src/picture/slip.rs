//! Partial slip: where the contact sticks and slips, with arrows along the slip, the energy dissipated there, and the loop of force and shift.

use super::pressure::{axes, numbers, unit_cell};
use super::snapshot::{Snapshot, caption};
use super::window::View;
use super::zoom;
use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_core::problem::Problem;
use percoat_core::quantity::{Kind, Quantity};
use percoat_core::reading::{SLIP, SlipReading};
use percoat_core::run::StepRecord;
use percoat_core::spectral::Shear;
use percoat_draw::Label;
use percoat_draw::axis::Axis;
use percoat_draw::bar::Bar;
use percoat_draw::canvas::{Canvas, Dash, Stroke};
use percoat_draw::chart::{Chart, plots};
use percoat_draw::colour::Colour;
use percoat_draw::curve::{Curve, Style};
use percoat_draw::map::{Fill, Map, Over};
use percoat_draw::sheet::sheet;

/// Arrows across the view.
const ARROWS: f64 = 24.0;
/// Least slip of an arrow over the largest one.
const LEAST: f64 = 0.02;
const STICKS: Colour = Colour([59, 89, 152]);
const SLIPS: Colour = Colour([247, 200, 150]);

/// The picture of a step; `None` where nothing sticks or slips.
pub fn slip(snapshot: &Snapshot) -> Option<Canvas> {
    let shear = snapshot.step.finest().shear()?;
    let (grid, pressures) = (snapshot.step.grid(), snapshot.pressures());
    let view = zoom::view(grid, snapshot.levels() > 0, |index| pressures[index] > 0.0);
    let nearest = |place: [f64; 2]| snapshot.nearest(place).filter(|&i| pressures[i] > 0.0);
    let colour = |place: [f64; 2]| match nearest(place) {
        None => Colour::WHITE,
        Some(i) if shear.sticks(i, pressures[i]) => STICKS,
        Some(_) => SLIPS,
    };
    let most = shear.work.iter().copied().fold(0.0, f64::max);
    let work = |place: [f64; 2]| nearest(place).map(|i| shear.work[i].max(0.0));
    let [x, y] = axes(snapshot, view.window);
    let mut over = unit_cell(snapshot, view);
    over.extend(arrows(snapshot, shear, view));
    over.extend(numbers(snapshot, view, |_| Colour::BLACK));
    let states = Map {
        title: "(a) stick and slip".into(),
        x: x.clone(),
        y: y.clone(),
        aspect: view.aspect(),
        fill: Fill::Colours(&colour),
        over,
    };
    let unit = snapshot.units.unit(Kind::Stiffness);
    let label = Label::of("dissipated energy per area", "", &unit, "unit\u{a0}of\u{a0}E\u{a0}times\u{a0}length");
    let bar = Bar::sequential(label, if most > 0.0 { most } else { 1.0 });
    let energies = Map {
        title: "(b) dissipated in this step".into(),
        x,
        y,
        aspect: view.aspect(),
        fill: Fill::Values(bar, &work),
        over: unit_cell(snapshot, view),
    };
    let words = "Dark: sticks; light: slips, arrows along the slip of the counterbody in this step; white: no contact.";
    let words = [words, zoom::words(grid, &view, None), &view.words()].concat();
    Some(sheet(&snapshot.caption(&words), &[&states, &energies]))
}

/// Arrows of the slip at equal distances, as long as the slip over its largest value.
fn arrows(snapshot: &Snapshot, shear: &Shear, view: View) -> Vec<Over> {
    let [[x0, x1], [y0, y1]] = view.window;
    let [sx, sy] = &shear.slip;
    let most = sx.iter().zip(sy).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    let distance = (x1 - x0) / ARROWS;
    let places = |from: f64, to: f64| {
        let count = ((to - from) / distance).floor().max(1.0) as u32;
        (0..count).map(move |k| from + (f64::from(k) + 0.5) * (to - from) / f64::from(count))
    };
    let mut over = Vec::new();
    for (x, y) in places(x0, x1).flat_map(|x| places(y0, y1).map(move |y| (x, y))) {
        let Some(i) = snapshot.nearest([x, y]) else { continue };
        let slip = [sx[i], sy[i]];
        let size = slip[0].hypot(slip[1]);
        if most == 0.0 || size < LEAST * most {
            continue;
        }
        let [ux, uy] = slip.map(|s| s / size);
        let length = distance * (0.35 + 0.55 * size / most);
        let (tail, tip) =
            ([x - 0.5 * length * ux, y - 0.5 * length * uy], [x + 0.5 * length * ux, y + 0.5 * length * uy]);
        let head = 0.3 * distance;
        let side = |sign: f64| [tip[0] - head * (ux + sign * 0.5 * uy), tip[1] - head * (uy - sign * 0.5 * ux)];
        for points in [vec![tail, tip], vec![side(1.0), tip, side(-1.0)]] {
            over.push(Over::Line(Stroke { points, width: 0.5, dash: Dash::Solid, colour: Colour::BLACK }));
        }
    }
    over
}

/// The picture of all steps: tangential force, stick fraction and dissipated energy over the shift; `None` without partial slip, and for
/// less than two steps.
pub fn slip_loop(title: &str, problem: &Problem, units: &Units, steps: &[StepRecord]) -> Option<Canvas> {
    let readings: Vec<_> = steps.iter().filter_map(|step| step.tangential.as_ref()).collect();
    if readings.len() < 2 {
        return None;
    }
    let chart = |letter: char, quantity: &Quantity<SlipReading>| {
        let measured: Vec<_> = readings.iter().map(|reading| quantity.of(reading)).collect();
        let points = readings.iter().zip(&measured);
        let curve = Curve {
            label: String::new(),
            points: points
                .map(|(reading, found)| [reading.tangential_shift, found.map_or(f64::NAN, |found| found.value)])
                .collect(),
            errors: measured.iter().map(|found| found.and_then(|found| found.error).unwrap_or(f64::NAN)).collect(),
            style: Style::LineMarkers,
            colour: 1.into(),
        };
        Chart {
            title: format!("({letter}) {}", quantity.named.name),
            x: Axis::linear(units.label(&SLIP.tangential_shift.named)),
            y: Axis::linear(units.label(&quantity.named)),
            curves: vec![curve],
        }
    };
    let charts = [chart('a', &SLIP.tangential_force), chart('b', &SLIP.stick_fraction), chart('c', &SLIP.work)];
    let more = [format!("{} steps", readings.len())];
    let words = " The energy is that of each step. Bars: estimated errors.";
    Some(plots(&format!("{}{words}", caption(title, problem, units, &more)), &charts))
}
