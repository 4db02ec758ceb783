//! Contact spots by level with their boundaries, and how far each boundary is from a circle (Fig. 2b).

use super::axis::{Axis, Scale};
use super::canvas::{Canvas, Dash, Stroke};
use super::chart::{Chart, Plot};
use super::colour::Colour;
use super::curve::{Curve, Style};
use super::map::{Fill, Map, Over};
use super::pressure::{aspect, axes, numbers, sliding_arrow, sliding_words, unit_cell};
use super::sheet::sheet;
use super::snapshot::Snapshot;
use super::tiling::{around, images, window};
use std::f64::consts::TAU;

/// Least range of deviations from a circle that is shown, per cent: a fitted boundary is good to some 0.03.
const LEAST: f64 = 0.1;

/// The picture; `None` for a topography. `without_mutual_effect`: per level the contact radius that indenters would
/// have without each other, a length, drawn dashed.
pub fn contact(snapshot: &Snapshot, without_mutual_effect: Option<&[f64]>) -> Option<Canvas> {
    (snapshot.levels() > 0).then(|| {
        let window = window(snapshot.step.grid().cell());
        let colour = |place: [f64; 2]| {
            snapshot.level_in_contact(place).map_or(Colour::WHITE, |level| Colour::line(level).lighter(0.6))
        };
        let [x, y] = axes(snapshot, window);
        let mut over = unit_cell(snapshot);
        let cell = snapshot.step.grid().cell();
        for (site, boundary) in snapshot.step.surface().sites().iter().zip(&snapshot.reading.boundaries) {
            for centre in images(cell, site.place, widened(window)) {
                let ring = |radius: &dyn Fn(f64) -> f64, dash: Dash, width: f64, colour: Colour| {
                    let point = |k: u32| {
                        let theta = TAU * f64::from(k) / 180.0;
                        [centre[0] + radius(theta) * theta.cos(), centre[1] + radius(theta) * theta.sin()]
                    };
                    Over::Line(Stroke { points: (0..=180).map(point).collect(), width, dash, colour })
                };
                if let Some(boundary) = boundary {
                    over.push(ring(&|theta| boundary.radius(theta), Dash::Solid, 0.9, Colour::line(site.level)));
                    if !boundary.hole.is_empty() {
                        let inner = |theta| boundary.hole_radius(theta);
                        over.push(ring(&inner, Dash::Solid, 0.9, Colour::line(site.level)));
                    }
                }
                let alone = without_mutual_effect.and_then(|radii| radii.get(site.level - 1));
                if let Some(&radius) = alone.filter(|radius| **radius > 0.0) {
                    over.push(ring(&|_| radius, Dash::Dashed, 0.7, Colour::BLACK));
                }
            }
        }
        over.extend(numbers(snapshot, window, |_| Colour::BLACK));
        over.extend(sliding_arrow(snapshot));
        let fill = Fill::Colours(&colour);
        let spots = Map { title: "(a) contact spots".into(), x, y, aspect: aspect(window), fill, over };
        let radii = radii(snapshot, without_mutual_effect);
        let mut what = "Numbers are levels; ρ(θ) is the boundary's distance from the indenter's axis, θ its direction \
                        from the x axis, πa² the area within it."
            .to_owned();
        if without_mutual_effect.is_some() {
            what += " Dashed circles and lines: without the mutual effect of the indenters.";
        }
        what += sliding_words(snapshot);
        let caption = snapshot.caption(&what);
        match radii {
            Some(chart) => sheet(&caption, &[&spots, &Plot { chart: &chart, aspect: aspect(window).min(1.0) }]),
            None => sheet(&caption, &[&Map { title: String::new(), ..spots }]),
        }
    })
}

/// Boundary radius against direction, relative to the radius of the circle of equal area; `None` when no spot has a
/// boundary of its own.
fn radii(snapshot: &Snapshot, without_mutual_effect: Option<&[f64]>) -> Option<Chart> {
    let degrees = |k: usize, count: usize| 360.0 * k as f64 / count as f64;
    let mut curves = Vec::new();
    for level in 1..=snapshot.levels() {
        let site = snapshot.step.surface().site_of(level)?;
        let Some(boundary) = &snapshot.reading.boundaries[site] else { continue };
        let mean = boundary.mean_radius();
        let count = boundary.radii.len();
        let points = (0..=count).map(|k| [degrees(k, count), 100.0 * (boundary.radii[k % count] / mean - 1.0)]);
        curves.push(Curve {
            label: format!("level {level}"),
            points: points.collect(),
            style: Style::Line,
            colour: level,
        });
        let alone = without_mutual_effect.and_then(|radii| radii.get(level - 1));
        if let Some(radius) = alone.filter(|radius| **radius > 0.0) {
            let deviation = 100.0 * (radius / mean - 1.0);
            curves.push(Curve {
                label: String::new(),
                points: vec![[0.0, deviation], [360.0, deviation]],
                style: Style::Dashed,
                colour: level,
            });
        }
    }
    // Deviations near the accuracy of the fit are not blown up.
    let largest = curves.iter().flat_map(|curve| &curve.points).map(|point| point[1].abs()).fold(0.0, f64::max);
    let y = Axis::linear("boundary radius, ρ/a − 1 (%)");
    let y = if largest < LEAST { y.from_to(-LEAST, LEAST) } else { y };
    (!curves.is_empty()).then(|| Chart {
        title: "(b) boundary".into(),
        x: Axis { scale: Scale::Degrees, ..Axis::linear("direction θ (degrees)").from_to(0.0, 360.0) },
        y,
        curves,
    })
}

/// A window with the spots that reach into it.
fn widened(window: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    window.map(|[first, last]| [first - 0.25 * (last - first), last + 0.25 * (last - first)])
}

impl Snapshot {
    /// Level whose indenter is in contact at a place, if one is.
    fn level_in_contact(&self, place: [f64; 2]) -> Option<usize> {
        self.pressure_at(place)?;
        let touching = |&(index, _): &(usize, f64)| self.pressures()[index] > 0.0;
        let nearest = around(self.step.grid(), place).into_iter().filter(touching).max_by(|a, b| a.1.total_cmp(&b.1));
        let (index, _) = nearest?;
        Some(self.step.surface().level_at(index))
    }
}
