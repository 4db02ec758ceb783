//! Depths pressed in for good: over the surface, and along a line through the deepest place.

use super::pressure::{axes, unit_cell};
use super::snapshot::Snapshot;
use super::zoom;
use crate::picture::labels::Labels;
use percoat_core::lattice::Surroundings;
use percoat_core::numeric::array::samples;
use percoat_draw::axis::Axis;
use percoat_draw::bar::Bar;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, Plot};
use percoat_draw::curve::{Curve, Style};
use percoat_draw::map::{Fill, Map};
use percoat_draw::sheet::sheet;

/// Points of the profile.
const POINTS: u32 = 480;

/// The picture; `None` where nothing is pressed in.
pub fn indentation(snapshot: &Snapshot) -> Option<Canvas> {
    let depths = snapshot.step.indentation()?;
    let (cell, grid) = (snapshot.step.grid().cell(), snapshot.step.grid());
    let deepest = samples(&depths).iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    if deepest.1 <= 0.0 {
        return None;
    }
    let is_window = cell.surroundings() == Surroundings::FreeSpace;
    let is_seen = |index: usize| samples(&depths)[index] > 0.0 || snapshot.pressures()[index] > 0.0;
    let view = zoom::view(grid, snapshot.levels() > 0, is_seen);
    let at = |place: [f64; 2]| {
        if snapshot.is_outside(place) { 0.0 } else { snapshot.between_samples(samples(&depths), place) }
    };
    let value = |place: [f64; 2]| Some(at(place)).filter(|depth| *depth > 0.0);
    let bar = Bar::sequential(snapshot.units.length_of("depth pressed in", "u"), deepest.1);
    let [x, y] = axes(snapshot, view.window);
    let map = Map {
        title: "(a) pressed in for good".into(),
        x,
        y,
        aspect: view.aspect(),
        fill: Fill::Values(bar, &value),
        over: unit_cell(snapshot, view),
    };
    // Along x through the deepest place, over the width of the view.
    let [x0, y0] = cell.point(grid.fractions(deepest.0));
    let [[first, last], _] = view.window;
    let half = 0.5 * (last - first);
    let line = |k: u32| {
        let x = if is_window { first } else { x0 - half } + 2.0 * half * f64::from(k) / f64::from(POINTS);
        [x, -at([x, y0])]
    };
    let curve = Curve {
        label: String::new(),
        points: (0..=POINTS).map(line).collect(),
        errors: Vec::new(),
        style: Style::Line,
        colour: 1.into(),
    };
    let chart = Chart {
        title: "(b) profile through the deepest place".into(),
        x: Axis::linear(snapshot.units.length_of("", "x"))
            .from_to(curve.points[0][0], curve.points[POINTS as usize][0]),
        y: Axis::linear(snapshot.units.length_of("height of the surface", "−u")),
        curves: vec![curve],
    };
    let words = "What the hardness has pressed in, without the elastic displacement; without pile-up. White: nothing."
        .to_owned();
    Some(sheet(
        &snapshot.caption(&(words + zoom::words(grid, &view, None) + &view.words())),
        &[&map, &Plot { chart: &chart, aspect: view.aspect().min(1.0) }],
    ))
}
