//! Pressure through the middle of each level's contact, along the line of its largest extent (Fig. 3).

use super::axis::Axis;
use super::canvas::Canvas;
use super::chart::{Chart, plots};
use super::curve::{Curve, Style};
use super::snapshot::Snapshot;
use super::tiling::around;
use std::f64::consts::PI;

/// The picture; `None` for a topography or without contact. `isolated`: per level the points (distance from the axis,
/// pressure) of an indenter that carries the same load alone, drawn dashed on both sides.
pub fn profiles(snapshot: &Snapshot, isolated: Option<&[Vec<[f64; 2]>]>) -> Option<Canvas> {
    let mut curves = Vec::new();
    let mut directions = Vec::new();
    for level in 1..=snapshot.levels() {
        let Some((direction, points)) = snapshot.profile(level) else { continue };
        curves.push(Curve { label: format!("level {level}"), points, style: Style::Line, colour: level });
        directions.push(format!("{:.0}°", direction.to_degrees()));
        if let Some(points) = isolated.and_then(|levels| levels.get(level - 1)) {
            let left = points.iter().rev().map(|[r, p]| [-r, *p]);
            curves.push(Curve {
                label: String::new(),
                points: left.chain(points.iter().copied()).collect(),
                style: Style::Dashed,
                colour: level,
            });
        }
    }
    let reach = curves.iter().flat_map(|curve| &curve.points).map(|[s, _]| s.abs()).fold(0.0, f64::max);
    (!curves.is_empty()).then(|| {
        let mut what = format!("Lines of largest extent: {} from the x axis.", directions.join(", "));
        if isolated.is_some() {
            what += " Dashed: isolated indenters under the same loads.";
        }
        let chart = Chart {
            title: String::new(),
            x: Axis::linear(snapshot.units.length_of("distance from the axis", "s"))
                .from_to(-1.06 * reach, 1.06 * reach),
            y: Axis::linear(snapshot.units.pressure_of("contact pressure", "p")),
            curves,
        };
        plots(&snapshot.caption(&what), &[chart])
    })
}

/// Points on either side of the axis.
const POINTS: u32 = 240;

impl Snapshot {
    /// A line through an indenter's axis: its direction from the x axis in radians, distances from the axis and
    /// pressures.
    fn profile(&self, level: usize) -> Option<(f64, Vec<[f64; 2]>)> {
        let site = self.step.surface().site_of(level)?;
        let centre = self.step.grid().cell().point(self.step.surface().sites()[site].place);
        if self.reading.boundaries[site].is_none() && self.pressure_squared(centre) <= 0.0 {
            return None;
        }
        let (direction, [left, right]) = match &self.reading.boundaries[site] {
            Some(boundary) => {
                let ends = |theta: f64| [boundary.radius(theta + PI), boundary.radius(theta)];
                // Of equal extents the first one.
                let (mut best, mut widest) = (0.0, 0.0);
                for theta in (0..180).map(|k| f64::from(k).to_radians()) {
                    let extent: f64 = ends(theta).iter().sum();
                    if extent > widest * (1.0 + 1e-4) {
                        (best, widest) = (theta, extent);
                    }
                }
                (best, ends(best))
            }
            // Merged: halfway to the nearest equal indenter.
            None => {
                let lattice = self.step.problem().counterbody().indenters()?.lattice();
                let [x, y] = lattice.toward(self.step.surface().sites()[site].place, level);
                (y.atan2(x), [0.5 * x.hypot(y); 2])
            }
        };
        let (sin, cos) = direction.sin_cos();
        let squared = |s: f64| self.pressure_squared([centre[0] + s * cos, centre[1] + s * sin]);
        // Between the outermost samples and the edge the square of the pressure falls evenly to zero.
        let rim = if self.reading.boundaries[site].is_some() { 1.5 * self.step.grid().spacing() } else { 0.0 };
        let at = |s: f64| {
            let (end, sign) = if s < 0.0 { (left, -1.0) } else { (right, 1.0) };
            let inside = end - s.abs();
            let square = if inside < rim { squared(sign * (end - rim)) * inside / rim } else { squared(s) };
            [s, square.max(0.0).sqrt()]
        };
        let points = (0..=2 * POINTS)
            .map(|k| f64::from(k) / f64::from(POINTS) - 1.0)
            // Points gather at the edge, where the pressure ends like a square root.
            .map(|t| (t * 0.5 * PI).sin())
            .map(|t| at(if t < 0.0 { t * left } else { t * right }))
            .collect();
        Some((direction, points))
    }

    /// Square of the pressure between the samples: near the edge it is almost linear, as the pressure is not.
    fn pressure_squared(&self, place: [f64; 2]) -> f64 {
        around(self.step.grid(), place).iter().map(|&(index, weight)| weight * self.pressures()[index].powi(2)).sum()
    }
}
