//! The contact pressure over the surface, true to scale: several cells side by side (Fig. 2a), one of a topography.

use super::axis::Axis;
use super::bar::Bar;
use super::canvas::{Canvas, Dash, Stroke};
use super::colour::Colour;
use super::map::{Fill, Map, Over};
use super::sheet::sheet;
use super::snapshot::{Snapshot, is_oblique};
use super::tiling::{Window, images, window, window_of_one};

/// The picture; white is where there is no contact.
pub fn pressure(snapshot: &Snapshot) -> Canvas {
    let cell = snapshot.step.grid().cell();
    let window = if snapshot.levels() == 0 { window_of_one(cell) } else { window(cell) };
    let value = |place: [f64; 2]| snapshot.pressure_at(place);
    let most = snapshot.pressures().iter().copied().fold(0.0, f64::max);
    let most = if most > 0.0 { most } else { 1.0 };
    let bar = Bar::sequential(snapshot.units.pressure_of("contact pressure", "p"), most);
    let [x, y] = axes(snapshot, window);
    let mut over = unit_cell(snapshot);
    over.extend(numbers(snapshot, window, |place| {
        let dark = snapshot.pressure_at(place).is_some_and(|p| p < 0.6 * most);
        if dark { Colour::WHITE } else { Colour::BLACK }
    }));
    over.extend(sliding_arrow(snapshot));
    let map = Map { title: String::new(), x, y, aspect: aspect(window), fill: Fill::Values(bar, &value), over };
    let what = match snapshot.levels() {
        0 if cell.is_rectangular() => "White: no contact; one unit cell.",
        0 => "White: no contact; dashed: the unit cell.",
        _ => "Numbers are levels; white: no contact; dashed: the unit cell.",
    };
    sheet(&snapshot.caption(&(what.to_owned() + sliding_words(snapshot))), &[&map])
}

/// An arrow along the sliding, where there is friction.
pub fn sliding_arrow(snapshot: &Snapshot) -> Option<Over> {
    snapshot.step.problem().friction().map(|friction| Over::Arrow { direction: friction.direction() })
}

/// What a caption says about it.
pub fn sliding_words(snapshot: &Snapshot) -> &'static str {
    snapshot.step.problem().friction().map_or("", |_| " Arrow: direction of sliding.")
}

/// Height over width of a window.
pub fn aspect([[x0, x1], [y0, y1]]: Window) -> f64 {
    (y1 - y0) / (x1 - x0)
}

/// Axes along the surface.
pub fn axes(snapshot: &Snapshot, [[x0, x1], [y0, y1]]: Window) -> [Axis; 2] {
    [
        Axis::linear(snapshot.units.length_of("", "x")).from_to(x0, x1),
        Axis::linear(snapshot.units.length_of("", "y")).from_to(y0, y1),
    ]
}

/// The unit cell's outline between the contacts.
pub fn unit_cell(snapshot: &Snapshot) -> Vec<Over> {
    let cell = snapshot.step.grid().cell();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|s| cell.point(s));
    let side = |k: usize| {
        let [from, to] = [corners[k], corners[(k + 1) % 4]];
        let at = move |part: f64| [0, 1].map(|c| from[c] + (to[c] - from[c]) * part);
        let open = snapshot.stretches([from, to], false).into_iter().map(move |ends| ends.map(at).to_vec());
        open.map(|points| {
            Over::Line(Stroke { points, width: 0.6, dash: Dash::Dashed, colour: Colour([120, 120, 120]) })
        })
    };
    (0..4).flat_map(side).chain(names(snapshot, corners)).collect()
}

/// a₁ and a₂ beside their sides, outside the cell, where it has no other name.
fn names(snapshot: &Snapshot, [origin, along1, _, along2]: [[f64; 2]; 4]) -> Vec<Over> {
    let cell = snapshot.step.grid().cell();
    if !is_oblique(&cell) {
        return Vec::new();
    }
    let [[x0, x1], [y0, y1]] = window(cell);
    let off = 0.035 * (x1 - x0).min(y1 - y0);
    let beside = |word: &str, to: [f64; 2], other: [f64; 2]| {
        let ([dx, dy], away) = ([to[0] - origin[0], to[1] - origin[1]], [other[0] - origin[0], other[1] - origin[1]]);
        let length = dx.hypot(dy);
        let sign = if dx * away[1] - dy * away[0] > 0.0 { 1.0 } else { -1.0 };
        let normal = [sign * dy / length, -sign * dx / length];
        let at = [0, 1].map(|k| origin[k] + 0.38 * [dx, dy][k] + off * normal[k]);
        let dark = snapshot.pressure_at(at).is_some();
        Over::Word { word: word.to_owned(), at, colour: if dark { Colour::WHITE } else { Colour::BLACK } }
    };
    vec![beside("a₁", along1, along2), beside("a₂", along2, along1)]
}

/// The number of the level at each site within the window.
pub fn numbers(snapshot: &Snapshot, window: Window, colour: impl Fn([f64; 2]) -> Colour) -> Vec<Over> {
    let [[x0, x1], [y0, y1]] = window;
    let border = 0.02 * (x1 - x0).min(y1 - y0);
    let inner = [[x0 + border, x1 - border], [y0 + border, y1 - border]];
    let cell = snapshot.step.grid().cell();
    let sites = snapshot.step.surface().sites().iter();
    let places = sites.flat_map(|site| images(cell, site.place, inner).into_iter().map(|at| (site.level, at)));
    places.map(|(level, at)| Over::Word { word: level.to_string(), at, colour: colour(at) }).collect()
}
