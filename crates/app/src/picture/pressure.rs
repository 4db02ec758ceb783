//! The contact pressure over the surface, true to scale: several cells side by side (Fig. 2a), one cell of a topography.

use super::snapshot::{Snapshot, is_oblique};
use super::window::{View, Window};
use super::zoom;
use crate::picture::labels::Labels;
use percoat_case::words::Words;
use percoat_core::lattice::Surroundings;
use percoat_draw::axis::Axis;
use percoat_draw::bar::Bar;
use percoat_draw::canvas::{Canvas, Dash, Stroke};
use percoat_draw::colour::Colour;
use percoat_draw::map::{Fill, Map, Over};
use percoat_draw::sheet::{Panel, sheet};

/// Least distance of numbers beside and above each other, in widths of a plot.
const NUMBERS_APART: [f64; 2] = [0.035, 0.055];

/// The picture; places without contact are white.
pub fn pressure(snapshot: &Snapshot) -> Canvas {
    let (grid, cell) = (snapshot.step.grid(), snapshot.step.grid().cell());
    let view = zoom::view(grid, snapshot.levels() > 0, |index| snapshot.pressures()[index] > 0.0);
    let close = zoom::close(snapshot, &view);
    let value = |place: [f64; 2]| snapshot.pressure_at(place);
    let most = snapshot.pressures().iter().copied().fold(0.0, f64::max);
    let most = if most > 0.0 { most } else { 1.0 };
    let kind = snapshot.step.problem().kind();
    let name = Words::of(kind).load.pressure;
    let map = |title: &str, view: View, outline: Option<Over>| {
        let [x, y] = axes(snapshot, view.window);
        let mut over: Vec<Over> = sliding_arrow(snapshot, view).into_iter().collect();
        over.extend(unit_cell(snapshot, view));
        over.extend(outline);
        over.extend(numbers(snapshot, view, |place| {
            let dark = snapshot.pressure_at(place).is_some_and(|p| p < 0.6 * most);
            if dark { Colour::WHITE } else { Colour::BLACK }
        }));
        let bar = Bar::sequential(snapshot.units.pressure_of(name, "p"), most);
        Map { title: title.to_owned(), x, y, aspect: view.aspect(), fill: Fill::Values(bar, &value), over }
    };
    let maps = match close {
        None => vec![map("", view, None)],
        Some(part) => {
            vec![map("(a) all contacts", view, Some(zoom::outline(&part))), map("(b) one contact", part, None)]
        }
    };
    let is_one = cell.is_rectangular() && !view.is_part;
    let what = match (snapshot.levels(), kind.surroundings) {
        (0, _) if kind.is_given && is_one => "White: no pressure.",
        (0, _) if kind.is_given => "White: no pressure; thin line: the unit cell.",
        (0, Surroundings::FreeSpace) => "White: no contact.",
        (_, Surroundings::FreeSpace) if snapshot.is_lone() => "White: no contact.",
        (_, Surroundings::FreeSpace) => "Numbers are levels; white: no contact.",
        (0, Surroundings::Periodic) if is_one => "White: no contact; one unit cell.",
        (0, Surroundings::Periodic) => "White: no contact; thin line: the unit cell.",
        (_, Surroundings::Periodic) => "Numbers are levels; white: no contact; thin line: the unit cell.",
    };
    let words = [what, sliding_words(snapshot), zoom::words(grid, &view, close.as_ref()), &view.words()].concat();
    let panels: Vec<&dyn Panel> = maps.iter().map(|map| map as &dyn Panel).collect();
    sheet(&snapshot.caption(&words), &panels)
}

/// An arrow along the sliding, where there is any.
pub fn sliding_arrow(snapshot: &Snapshot, view: View) -> Option<Over> {
    let [x, y] = snapshot.step.problem().sliding_direction()?;
    let y = view.stretch() * y;
    Some(Over::Arrow { direction: [x, y].map(|part| part / x.hypot(y)) })
}

/// Text of the caption on the arrow.
pub fn sliding_words(snapshot: &Snapshot) -> &'static str {
    snapshot.step.problem().sliding_direction().map_or("", |_| " Arrow: direction of sliding.")
}

/// Axes along the surface.
pub fn axes(snapshot: &Snapshot, [[x0, x1], [y0, y1]]: Window) -> [Axis; 2] {
    [
        Axis::linear(snapshot.units.length_of("", "x")).from_to(x0, x1),
        Axis::linear(snapshot.units.length_of("", "y")).from_to(y0, y1),
    ]
}

/// The unit cell's outline between the contacts; none around an isolated contact.
pub fn unit_cell(snapshot: &Snapshot, view: View) -> Vec<Over> {
    let cell = snapshot.step.grid().cell();
    if cell.surroundings() == Surroundings::FreeSpace {
        return Vec::new();
    }
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|s| cell.point(s));
    let side = |k: usize| {
        let [from, to] = [corners[k], corners[(k + 1) % 4]];
        let at = move |part: f64| [0, 1].map(|c| from[c] + (to[c] - from[c]) * part);
        let open = snapshot.stretches([from, to], false).into_iter().map(move |ends| ends.map(at).to_vec());
        open.map(|points| Over::Line(Stroke { points, width: 0.6, dash: Dash::Solid, colour: Colour([120, 120, 120]) }))
    };
    (0..4).flat_map(side).chain(names(snapshot, view, corners)).collect()
}

/// The names a₁ and a₂ beside the sides of an oblique cell: outside the cell, or inside where the plot ends there.
fn names(snapshot: &Snapshot, view: View, [origin, along1, _, along2]: [[f64; 2]; 4]) -> Vec<Over> {
    if !is_oblique(&snapshot.step.grid().cell()) {
        return Vec::new();
    }
    let [[x0, x1], [y0, y1]] = view.window;
    // In the plot lengths along y are stretched.
    let stretch = view.stretch();
    let off = 0.04 * (x1 - x0);
    let beside = |word: &str, to: [f64; 2], other: [f64; 2]| {
        let drawn = |end: [f64; 2]| [end[0] - origin[0], stretch * (end[1] - origin[1])];
        let ([dx, dy], away) = (drawn(to), drawn(other));
        let length = dx.hypot(dy);
        let sign = if dx * away[1] - dy * away[0] > 0.0 { 1.0 } else { -1.0 };
        let at = |side: f64| {
            let [x, y] = [0.38 * dx + side * dy / length * off, 0.38 * dy - side * dx / length * off];
            [origin[0] + x, origin[1] + y / stretch]
        };
        let is_inside = |[x, y]: &[f64; 2]| {
            let [edge_x, edge_y] = [0.9 * off, 0.9 * off / stretch];
            (x0 + edge_x..=x1 - edge_x).contains(x) && (y0 + edge_y..=y1 - edge_y).contains(y)
        };
        let at = [sign, -sign].map(at).into_iter().find(is_inside)?;
        let dark = snapshot.pressure_at(at).is_some();
        Some(Over::Word { word: word.to_owned(), at, colour: if dark { Colour::WHITE } else { Colour::BLACK } })
    };
    [beside("a₁", along1, along2), beside("a₂", along2, along1)].into_iter().flatten().collect()
}

/// The number of the level at each site within the view, none at a lone indenter; numbers that would overlap others nearer to the middle are left out.
pub fn numbers(snapshot: &Snapshot, view: View, colour: impl Fn([f64; 2]) -> Colour) -> Vec<Over> {
    if snapshot.is_lone() {
        return Vec::new();
    }
    let [[x0, x1], [y0, y1]] = view.window;
    let inner = view.window.map(|[first, last]| {
        let border = 0.02 * (last - first);
        [first + border, last - border]
    });
    let cell = snapshot.step.grid().cell();
    let sites = snapshot.step.surface().sites().iter();
    let mut places: Vec<(usize, [f64; 2])> =
        sites.flat_map(|site| cell.images_in(site.place, inner).into_iter().map(|at| (site.level, at))).collect();
    // In widths of the plot.
    let apart =
        |[a, b]: [f64; 2], [c, d]: [f64; 2]| [(a - c) / (x1 - x0), (b - d) / (x1 - x0) * view.stretch()].map(f64::abs);
    let middle = [0.5 * (x0 + x1), 0.5 * (y0 + y1)];
    let off = |at: [f64; 2]| apart(at, middle).iter().map(|part| part * part).sum::<f64>();
    places.sort_by(|(_, a), (_, b)| off(*a).total_cmp(&off(*b)));
    let mut shown: Vec<(usize, [f64; 2])> = Vec::new();
    for (level, at) in places {
        let is_clear = |(_, other): &(usize, [f64; 2])| {
            let [across, up] = apart(at, *other);
            across > NUMBERS_APART[0] || up > NUMBERS_APART[1]
        };
        if shown.iter().all(is_clear) {
            shown.push((level, at));
        }
    }
    shown.into_iter().map(|(level, at)| Over::Word { word: level.to_string(), at, colour: colour(at) }).collect()
}
