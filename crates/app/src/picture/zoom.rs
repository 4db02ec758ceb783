//! The parts of the surface that a picture shows: whole cells side by side, or the contact alone where it would be small.
//!
//! - An isolated contact: the rectangle around it with a margin, unless it fills the window.
//! - A lattice of contacts, or a topography: the cells, and where the spot of the largest pressure is less than a twelfth of their width a
//!   second map around it.

use super::snapshot::Snapshot;
use super::window::{View, Window};
use percoat_core::lattice::{Grid, Surroundings};
use percoat_draw::canvas::{Dash, Stroke};
use percoat_draw::colour::Colour;
use percoat_draw::map::Over;

/// Width of a spot over that of the view below which it is shown once more.
const SMALL: f64 = 1.0 / 12.0;
/// Width of a view over that of the contact in its middle.
const MARGIN: f64 = 1.5;
/// Least width of the view around a spot, spacings of the samples.
const LEAST: f64 = 20.0;
/// Part of the window of an isolated contact from which on the whole is shown.
const WHOLE: f64 = 0.8;

/// The part of the surface that is shown: of an isolated contact the rectangle around the samples that are `seen`, else cells side by
/// side under levels of indenters, and one cell of a topography.
pub fn view(grid: &Grid, has_levels: bool, is_seen: impl Fn(usize) -> bool) -> View {
    let cell = grid.cell();
    let whole = if has_levels { View::cells(cell) } else { View::one(cell) };
    if cell.surroundings() == Surroundings::Periodic {
        return whole;
    }
    let places = (0..grid.len()).filter(|&index| is_seen(index)).map(|index| cell.point(grid.fractions(index)));
    around(bounds(places), grid.spacing(), &whole).filter(|part| part.part_of(&whole) < WHOLE).unwrap_or(whole)
}

/// The part around the spot of the largest pressure, where it is small in a view of a periodic surface.
pub fn close(snapshot: &Snapshot, view: &View) -> Option<View> {
    let grid = snapshot.step.grid();
    if grid.cell().surroundings() == Surroundings::FreeSpace {
        return None;
    }
    let spot = bounds(spot(snapshot).into_iter())?;
    let width = view.window[0][1] - view.window[0][0];
    let extent = spot.iter().map(|[first, last]| last - first).fold(0.0, f64::max);
    let close = around(Some(spot), grid.spacing(), view)?;
    (extent < SMALL * width && close.part_of(view) < 0.5).then_some(close)
}

/// The outline of a close view in the whole.
pub fn outline(close: &View) -> Over {
    let [[x0, x1], [y0, y1]] = close.window;
    let points = vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]];
    Over::Line(Stroke { points, width: 0.5, dash: Dash::Solid, colour: Colour::BLACK })
}

/// Text of the caption on what is shown of a window, and on a close view.
pub fn words(grid: &Grid, view: &View, close: Option<&View>) -> &'static str {
    match close {
        Some(_) => " Thin rectangle: what (b) shows, around the largest pressure.",
        None if grid.cell().surroundings() == Surroundings::FreeSpace
            && view.part_of(&View::cells(grid.cell())) < 1.0 =>
        {
            " Shown: the contact with a margin, a part of the window."
        }
        None => "",
    }
}

/// Places of the samples of the spot with the largest pressure, one next to the other across the borders of the cell.
fn spot(snapshot: &Snapshot) -> Vec<[f64; 2]> {
    let (grid, pressures) = (snapshot.step.grid(), snapshot.pressures());
    let highest = pressures.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).filter(|(_, p)| **p > 0.0);
    let Some((first, _)) = highest else { return Vec::new() };
    let [e1, e2] = grid.steps();
    let steps = [e1, e2, e1.map(|x| -x), e2.map(|x| -x)];
    let mut is_found = vec![false; pressures.len()];
    is_found[first] = true;
    let mut found = vec![(first, grid.cell().point(grid.fractions(first)))];
    let mut next = 0;
    while let Some(&(index, [x, y])) = found.get(next) {
        for (other, [dx, dy]) in grid.adjacent(index).into_iter().zip(steps) {
            if pressures[other] > 0.0 && !is_found[other] {
                is_found[other] = true;
                found.push((other, [x + dx, y + dy]));
            }
        }
        next += 1;
    }
    found.into_iter().map(|(_, place)| place).collect()
}

/// The rectangle around places; `None` without any.
fn bounds(places: impl Iterator<Item = [f64; 2]>) -> Option<Window> {
    let ends = |[[x0, x1], [y0, y1]]: Window, [x, y]: [f64; 2]| [[x0.min(x), x1.max(x)], [y0.min(y), y1.max(y)]];
    places.map(|[x, y]| [[x, x], [y, y]]).reduce(|all, [[x, _], [y, _]]| ends(all, [x, y]))
}

/// A view around a rectangle with a margin, no wider than the whole.
fn around(contact: Option<Window>, spacing: f64, whole: &View) -> Option<View> {
    let contact = contact?;
    let middle = contact.map(|[first, last]| 0.5 * (first + last));
    let [mut x, mut y] = contact.map(|[first, last]| (0.5 * MARGIN * (last - first)).max(0.5 * LEAST * spacing));
    // A slender contact is shown to scale.
    let [flat, steep] = View::ASPECT;
    (x, y) = (x.max(y / steep), y.max(flat * x));
    let half = [0, 1].map(|k| [x, y][k].min(0.5 * (whole.window[k][1] - whole.window[k][0])));
    Some(View { window: [0, 1].map(|k| [middle[k] - half[k], middle[k] + half[k]]), is_part: false })
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::{HalfSpace, Material};
    use percoat_core::counterbody::{Indenters, Level, Shape};
    use percoat_core::lattice::{Cell, Lattice};
    use percoat_core::load::Load;
    use percoat_core::problem::Problem;
    use percoat_core::spectral::{Settings, Solver};

    /// A sphere on a lattice whose period is 1, under a mean pressure.
    fn snapshot(mean_pressure: f64) -> Snapshot {
        let level = Level::new(Shape::Paraboloid { radius: 0.5 }, 0.0).unwrap();
        let indenters = Indenters::new(Lattice::square(1.0, 1).unwrap(), vec![level]).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let mut solver = Solver::new(Problem::new(indenters, body), [96, 96], Settings::default()).unwrap();
        let step = solver.solve(Load::MeanPressure(mean_pressure));
        let reading = step.reading();
        Snapshot::new("", step, reading)
    }

    #[test]
    fn a_small_spot_of_a_lattice_is_shown_once_more_and_one_that_fills_it_is_not() {
        for (mean_pressure, is_small) in [(1e-3, true), (3e-2, false)] {
            let snapshot = snapshot(mean_pressure);
            let all = view(snapshot.step.grid(), true, |index| snapshot.pressures()[index] > 0.0);
            assert_eq!(all, View::cells(snapshot.step.grid().cell()));
            let part = close(&snapshot, &all);
            assert_eq!(part.is_some(), is_small, "{mean_pressure}");
            let radius = snapshot.reading.levels[0].contact_radius.unwrap();
            // Around the axis, which lies at the corner of the cell, and wider than the spot.
            for [first, last] in part.iter().flat_map(|part| part.window) {
                assert!((first + last).abs() < 1e-9 && last > radius && last < 0.2, "{first} {last} {radius}");
            }
        }
    }

    #[test]
    fn an_isolated_contact_fills_its_view_and_a_large_one_its_window() {
        let grid = Grid::new(Cell::window([120.0, 100.0]).unwrap(), [60, 50]).unwrap();
        let seen = |radius: f64| {
            let view = view(&grid, true, |index| {
                let [x, y] = grid.cell().point(grid.fractions(index));
                (x - 10.0).hypot(y) < radius
            });
            view.window
        };
        let [[x0, x1], [y0, y1]] = seen(19.0);
        assert!(x0 < 10.0 - 19.0 && x1 > 10.0 + 19.0 && x1 - x0 < 1.6 * 38.0, "{x0} {x1}");
        assert!((0.5 * (x0 + x1) - 10.0).abs() < 1e-9 && (y0 + y1).abs() < 1e-9);
        assert_eq!(seen(40.0), View::cells(grid.cell()).window);
        assert_eq!(seen(0.0), View::cells(grid.cell()).window);
    }
}
