//! Contact spots by level with their boundaries, and how far each boundary is from a circle (Fig. 2b).

use super::pressure::{axes, numbers, sliding_arrow, sliding_words, unit_cell};
use super::snapshot::Snapshot;
use super::window::{View, Window};
use super::zoom;
use percoat_core::reading::LevelReading;
use percoat_draw::axis::Axis;
use percoat_draw::canvas::{Canvas, Dash, Stroke};
use percoat_draw::chart::{Chart, Plot};
use percoat_draw::colour::Colour;
use percoat_draw::curve::{Curve, Style};
use percoat_draw::map::{Fill, Map, Over};
use percoat_draw::number::signed;
use percoat_draw::scale::Scale;
use percoat_draw::sheet::{Panel, sheet};
use std::f64::consts::TAU;

/// Least range of deviations from a circle that is shown, per cent: a fitted boundary errs by some 0.03 per cent.
const LEAST: f64 = 0.1;

/// The picture; `None` for a topography. `without_mutual_effect`: per level the contact radius that indenters would
/// have without each other, a length, drawn dashed.
pub fn contact(snapshot: &Snapshot, without_mutual_effect: Option<&[f64]>) -> Option<Canvas> {
    if snapshot.levels() == 0 {
        return None;
    }
    let grid = snapshot.step.grid();
    let view = zoom::view(grid, true, |index| snapshot.pressures()[index] > 0.0);
    let close = zoom::close(snapshot, &view);
    let colour = |place: [f64; 2]| {
        snapshot.level_in_contact(place).map_or(Colour::WHITE, |level| Colour::line(level).lighter(0.6))
    };
    let map = |title: &str, view: View, outline: Option<Over>| {
        let [x, y] = axes(snapshot, view.window);
        let mut over = unit_cell(snapshot, view);
        over.extend(outline);
        over.extend(boundaries(snapshot, view.window, without_mutual_effect));
        let outlines = snapshot.outlines(view.window).into_iter();
        over.extend(outlines.map(|points| line(points, Dash::Solid, 0.6, Colour::BLACK)));
        over.extend(numbers(snapshot, view, |_| Colour::BLACK));
        over.extend(sliding_arrow(snapshot, view));
        Map { title: title.to_owned(), x, y, aspect: view.aspect(), fill: Fill::Colours(&colour), over }
    };
    let mut maps = vec![map("contact spots", view, close.as_ref().map(zoom::outline))];
    maps.extend(close.map(|part| map("one contact", part, None)));
    let letter = if close.is_some() { 'c' } else { 'b' };
    let radii = radii(snapshot, letter, without_mutual_effect);
    let mut words = if snapshot.is_lone() { String::new() } else { "Numbers are levels.".to_owned() };
    words += &merged_words(snapshot);
    if let Some((_, beyond)) = &radii {
        words += &radii_words(snapshot, letter, without_mutual_effect.is_some(), beyond);
    }
    words += sliding_words(snapshot);
    words += zoom::words(grid, &view, close.as_ref());
    words += &view.words();
    let plot = radii.as_ref().map(|(chart, _)| Plot { chart, aspect: view.aspect().min(1.0) });
    for (letter, map) in ('a'..).zip(&mut maps).filter(|_| plot.is_some() || close.is_some()) {
        map.title = format!("({letter}) {}", map.title);
    }
    if plot.is_none() && close.is_none() {
        maps[0].title.clear();
    }
    let panels = maps.iter().map(|map| map as &dyn Panel).chain(plot.iter().map(|plot| plot as &dyn Panel));
    Some(sheet(&snapshot.caption(words.trim_start()), &panels.collect::<Vec<_>>()))
}

/// The located boundaries and holes in a window, and dashed circles of the radii without mutual effect.
fn boundaries(snapshot: &Snapshot, window: Window, without_mutual_effect: Option<&[f64]>) -> Vec<Over> {
    let cell = snapshot.step.grid().cell();
    let mut over = Vec::new();
    for (site, boundary) in snapshot.step.surface().sites().iter().zip(&snapshot.reading.boundaries) {
        for centre in cell.images_in(site.place, widened(window)) {
            let closed = |radius: &dyn Fn(f64) -> f64, dash: Dash, width: f64, colour: Colour| {
                let point = |k: u32| {
                    let theta = TAU * f64::from(k) / 180.0;
                    [centre[0] + radius(theta) * theta.cos(), centre[1] + radius(theta) * theta.sin()]
                };
                line((0..=180).map(point).collect(), dash, width, colour)
            };
            if let Some(boundary) = boundary {
                let colour = Colour::line(site.level);
                over.push(closed(&|theta| boundary.radius(theta), Dash::Solid, 0.9, colour));
                if !boundary.hole.is_empty() {
                    over.push(closed(&|theta| boundary.hole_radius(theta), Dash::Solid, 0.9, colour));
                }
            }
            let alone = without_mutual_effect.and_then(|radii| radii.get(site.level - 1));
            if let Some(&radius) = alone.filter(|radius| **radius > 0.0) {
                over.push(closed(&|_| radius, Dash::Dashed, 0.7, Colour::BLACK));
            }
        }
    }
    over
}

fn line(points: Vec<[f64; 2]>, dash: Dash, width: f64, colour: Colour) -> Over {
    Over::Line(Stroke { points, width, dash, colour })
}

/// Text of the caption on the chart of radii; `beyond`: the levels whose radius without mutual effect is not in the chart.
fn radii_words(snapshot: &Snapshot, letter: char, has_dashed: bool, beyond: &[String]) -> String {
    let mut words =
        " ρ(θ) is the boundary's distance from the indenter's axis, θ its direction from the x axis, πa² the area \
                     within it."
            .to_owned();
    if snapshot.reading.boundaries.iter().flatten().any(|boundary| !boundary.hole.is_empty()) {
        words += &format!(" Dotted in ({letter}): the hole of a ring, over its own mean radius.");
    }
    if snapshot.reading.levels.iter().any(|level| level.errors.radius_max.is_some()) {
        words += " Bands: estimated errors.";
    }
    if has_dashed {
        words += " Dashed circles and lines: without the mutual effect of the indenters";
        words +=
            &if beyond.is_empty() { ".".to_owned() } else { format!(", beyond ({letter}) {}.", beyond.join(", ")) };
    }
    words
}

/// Text of the caption on the contacts without a boundary of their own: merged ones, and those of few samples.
fn merged_words(snapshot: &Snapshot) -> String {
    let levels = |which: fn(&LevelReading) -> bool| {
        let matching = snapshot.reading.levels.iter().filter(|level| level.touches() && which(level));
        matching.map(|level| level.level.to_string()).collect::<Vec<String>>()
    };
    let plural = |levels: &[String]| format!("level{} {}", if levels.len() > 1 { "s" } else { "" }, levels.join(", "));
    let merged = levels(|level| level.merged);
    let few = levels(|level| !level.merged && level.radius_min.is_none());
    let mut words = String::new();
    if !merged.is_empty() {
        words += &format!(
            " Contacts of {} have merged with neighbours: black outlines around all of them, colours by whose indenter \
             faces the surface, no radius.",
            plural(&merged)
        );
    }
    if !few.is_empty() && snapshot.is_lone() {
        words += " The contact has too few samples for a radius (black outline).";
    } else if !few.is_empty() {
        words += &format!(" Contacts of {} have too few samples for a radius (black outlines).", plural(&few));
    }
    words
}

/// Boundary radius against direction, relative to the radius of the circle of equal area, and the levels whose radius
/// without mutual effect is not in the chart; `None` when no spot has a boundary of its own.
fn radii(snapshot: &Snapshot, letter: char, without_mutual_effect: Option<&[f64]>) -> Option<(Chart, Vec<String>)> {
    let degrees = |k: usize, count: usize| 360.0 * k as f64 / count as f64;
    let deviations = |radii: &[f64], mean: f64| -> Vec<[f64; 2]> {
        let count = radii.len();
        (0..=count).map(|k| [degrees(k, count), 100.0 * (radii[k % count] / mean - 1.0)]).collect()
    };
    let (mut curves, mut alone) = (Vec::new(), Vec::new());
    let name = |level: usize| snapshot.step.problem().level_name(level).label();
    for level in 1..=snapshot.levels() {
        let site = snapshot.step.surface().site_of(level)?;
        let Some(boundary) = &snapshot.reading.boundaries[site] else { continue };
        let curve = |label: String, points: Vec<[f64; 2]>, error: Option<f64>, style: Style| Curve {
            label,
            errors: error.map_or(Vec::new(), |error| vec![error; points.len()]),
            points,
            style,
            colour: level.into(),
        };
        let (mean, errors) = (boundary.mean_radius(), snapshot.reading.levels[level - 1].errors);
        let error =
            errors.radius_min.into_iter().chain(errors.radius_max).reduce(f64::max).map(|error| 100.0 * error / mean);
        curves.push(curve(name(level), deviations(&boundary.radii, mean), error, Style::Line));
        if !boundary.hole.is_empty() {
            let points = deviations(&boundary.hole, boundary.mean_hole_radius());
            let error = 100.0 * boundary.hole_error / boundary.mean_hole_radius();
            curves.push(curve(format!("{}, hole", name(level)), points, Some(error), Style::Dotted));
        }
        let undisturbed = without_mutual_effect.and_then(|radii| radii.get(level - 1)).filter(|radius| **radius > 0.0);
        if let Some(radius) = undisturbed {
            let deviation = 100.0 * (radius / boundary.mean_radius() - 1.0);
            alone.push((
                level,
                deviation,
                curve(String::new(), vec![[0.0, deviation], [360.0, deviation]], None, Style::Dashed),
            ));
        }
    }
    // The computed boundaries make the scale; deviations near the accuracy of the fit are not blown up.
    let y = Axis::linear("boundary radius, ρ/a − 1 (%)");
    let computed = || curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]);
    let largest = computed().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    // Bands that are narrower than the deviations are shown whole.
    let ends = curves.iter().flat_map(|curve| (0..curve.points.len()).filter_map(|index| curve.bar(index)));
    let ends = ends.filter(|[low, high]| high - low <= 2.0 * largest).flatten();
    let [low, high] = if largest < LEAST { [-LEAST, LEAST] } else { y.reach(computed().chain(ends), 0.05) };
    let mut beyond = Vec::new();
    for (level, deviation, curve) in alone {
        if (low..=high).contains(&deviation) {
            curves.push(curve);
        } else {
            beyond.push(format!("{} at {}\u{a0}%", name(level), signed(&format!("{deviation:.1}"))));
        }
    }
    let chart = Chart {
        title: format!("({letter}) boundary"),
        x: Axis { scale: Scale::Degrees, ..Axis::linear("direction θ (degrees)").from_to(0.0, 360.0) },
        y: y.from_to(low, high),
        curves,
    };
    (!chart.curves.is_empty()).then_some((chart, beyond))
}

/// A window with a margin for the spots that reach into it.
fn widened(window: Window) -> Window {
    window.map(|[first, last]| [first - 0.25 * (last - first), last + 0.25 * (last - first)])
}

impl Snapshot {
    /// Level whose indenter is in contact at a place, if one is.
    fn level_in_contact(&self, place: [f64; 2]) -> Option<usize> {
        self.pressure_at(place)?;
        self.facing(place).map(|(site, _)| self.step.surface().sites()[site].level)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::{HalfSpace, Material};
    use percoat_core::counterbody::{Indenters, Level, Shape};
    use percoat_core::lattice::Lattice;
    use percoat_core::load::Load;
    use percoat_core::problem::Problem;
    use percoat_core::spectral::{Settings, Solver};

    fn snapshot(mean_pressure: f64) -> Snapshot {
        let levels = [0.01, 0.0].map(|height| Level::new(Shape::Paraboloid { radius: 1.0 }, height).unwrap()).to_vec();
        let indenters = Indenters::new(Lattice::square(1.0, 2).unwrap(), levels).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let mut solver = Solver::new(Problem::new(indenters, body), [48, 48], Settings::default()).unwrap();
        let step = solver.solve(Load::MeanPressure(mean_pressure));
        let reading = step.reading();
        Snapshot::new("", step, reading)
    }

    #[test]
    fn the_computed_boundaries_make_the_scale_and_what_lies_beyond_is_told() {
        let snapshot = snapshot(0.05);
        let range = |alone: Option<&[f64]>| {
            let (chart, beyond) = radii(&snapshot, 'b', alone).unwrap();
            (chart.y.range.unwrap(), chart.curves.len(), beyond)
        };
        let radius = |level: usize| snapshot.reading.levels[level].contact_radius.unwrap();
        let (bare, two, none) = range(None);
        assert_eq!((two, none.len()), (2, 0));
        let near = [radius(0) * (1.0 + 0.004 * bare[1]), radius(1) * 3.0];
        let (scaled, curves, beyond) = range(Some(&near));
        assert_eq!((scaled, curves), (bare, 3));
        assert_eq!(beyond, ["level 2 at 200.0\u{a0}%"]);
    }

    #[test]
    fn merged_contacts_are_outlined_and_have_no_radius() {
        let snapshot = snapshot(0.6);
        assert!(snapshot.reading.levels.iter().all(|level| level.merged), "{}", snapshot.reading);
        assert!(radii(&snapshot, 'b', None).is_none());
        assert!(merged_words(&snapshot).contains("levels 1, 2 have merged"));
        assert!(!snapshot.outlines(View::cells(snapshot.step.grid().cell()).window).is_empty());
    }
}
