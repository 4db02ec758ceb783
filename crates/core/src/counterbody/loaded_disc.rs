//! Discs under uniform pressures: the part of a grid's cell that a disc covers, and the largest pressure where discs overlap.

use crate::lattice::{Cell, Grid};
use ndarray::Array2;
use std::f64::consts::TAU;

/// Relative distance from a circle within which a point counts as inside: circles that coincide enclose one another.
const ON_CIRCLE: f64 = 1e-9;

/// A disc under a uniform pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedDisc {
    /// Centre x, y; lengths.
    pub centre: [f64; 2],
    /// Radius > 0, a length.
    pub radius: f64,
    /// Pressure ≥ 0.
    pub pressure: f64,
}

/// Loaded discs of one cell, each with those that overlap it, periodic images and those of itself included.
pub(super) struct Arrangement {
    discs: Vec<Placed>,
}

/// A loaded disc with what overlaps it.
struct Placed {
    disc: LoadedDisc,
    /// The discs and images that overlap it, their centres seen from the centre of this disc.
    others: Vec<LoadedDisc>,
}

impl Arrangement {
    /// The discs of a cell that have a pressure.
    pub fn new(cell: Cell, discs: &[LoadedDisc]) -> Self {
        let loaded: Vec<LoadedDisc> = discs.iter().filter(|disc| disc.pressure > 0.0).copied().collect();
        let place = |number: usize| {
            let disc = loaded[number];
            let others = loaded.iter().enumerate().flat_map(|(index, other)| {
                let images = images(cell, &disc, other);
                images
                    .into_iter()
                    .filter(move |[x, y]| index != number || x.hypot(*y) > 0.0)
                    .map(move |centre| LoadedDisc { centre, ..*other })
            });
            Placed { disc, others: others.collect() }
        };
        Self { discs: (0..loaded.len()).map(place).collect() }
    }

    /// The loaded discs.
    pub fn discs(&self) -> impl Iterator<Item = &LoadedDisc> {
        self.discs.iter().map(|placed| &placed.disc)
    }

    /// Whether any discs overlap.
    pub fn overlaps(&self) -> bool {
        self.discs.iter().any(|placed| !placed.others.is_empty())
    }

    /// The largest pressure of all discs together.
    pub fn highest(&self) -> f64 {
        self.discs.iter().map(Placed::highest).fold(0.0, f64::max)
    }
}

impl Placed {
    /// The largest pressure just inside of the disc's circle. The region of the largest pressure of all is bounded by
    /// arcs of circles that enclose it, so that the largest value of all discs is this pressure.
    fn highest(&self) -> f64 {
        let radius = self.disc.radius;
        let crossings = |other: &LoadedDisc| {
            let [x, y] = other.centre;
            let distance = x.hypot(y);
            let cosine =
                (distance * distance + radius * radius - other.radius * other.radius) / (2.0 * radius * distance);
            // One circle may lie inside of the other.
            let half = (cosine.abs() < 1.0).then(|| cosine.acos());
            half.into_iter().flat_map(move |half| [-half, half].map(|by| (y.atan2(x) + by).rem_euclid(TAU)))
        };
        let mut angles: Vec<f64> = self.others.iter().flat_map(crossings).collect();
        angles.sort_by(f64::total_cmp);
        let first = angles.first().map_or(TAU, |first| first + TAU);
        let ends: Vec<f64> = angles.iter().skip(1).copied().chain([first]).collect();
        let starts = if angles.is_empty() { vec![0.0] } else { angles };
        let middles = starts.iter().zip(&ends).map(|(start, end)| 0.5 * (start + end));
        middles.map(|angle| self.at([radius * angle.cos(), radius * angle.sin()])).fold(self.disc.pressure, f64::max)
    }

    /// The pressure inside of the disc beside a point of its circle, seen from its centre.
    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let encloses =
            |other: &&LoadedDisc| (x - other.centre[0]).hypot(y - other.centre[1]) < other.radius * (1.0 + ON_CIRCLE);
        self.disc.pressure + self.others.iter().filter(encloses).map(|other| other.pressure).sum::<f64>()
    }
}

/// Centres of the images of `other` that overlap `one`, seen from the centre of `one`: 0 too for the same disc twice.
fn images(cell: Cell, one: &LoadedDisc, other: &LoadedDisc) -> Vec<[f64; 2]> {
    let away = [0, 1].map(|k| other.centre[k] - one.centre[k]);
    cell.equivalents_within(away, one.radius + other.radius)
}

impl LoadedDisc {
    /// Adds the pressure of the disc and of its periodic images to the samples of a grid.
    pub(super) fn add(&self, grid: &Grid, pressure: &mut Array2<f64>) {
        let (cell, points, steps) = (grid.cell(), grid.points(), grid.steps());
        let area = grid.sample_area();
        // In steps along both axes: the disc is an ellipse between two parallels a distance r/|sin| apart.
        let middle = cell.fractions(self.centre);
        let reach = [0, 1].map(|axis| {
            let [x, y] = steps[1 - axis];
            self.radius * x.hypot(y) / area + 0.5
        });
        let span = |axis: usize| {
            let at = middle[axis] * points[axis] as f64;
            (at - reach[axis]).ceil() as i64..=(at + reach[axis]).floor() as i64
        };
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        for i in span(0) {
            for j in span(1) {
                let place = cell.point([i as f64 / points[0] as f64, j as f64 / points[1] as f64]);
                let corner =
                    |[s, t]: [f64; 2]| [0, 1].map(|k| place[k] + s * steps[0][k] + t * steps[1][k] - self.centre[k]);
                let covered = covered(self.radius, &corners.map(corner), area);
                if covered == 0.0 {
                    continue;
                }
                let at = [(i, 0), (j, 1)].map(|(index, axis)| index.rem_euclid(points[axis] as i64) as usize);
                pressure[at] += self.pressure * covered;
            }
        }
    }
}

/// Part of a convex polygon of an `area` that the disc of a radius around the origin covers. Where that is nothing or all of it, it is
/// said without rounding: a trace of pressure outside of the disc would be a contact spot of its own.
fn covered(radius: f64, corners: &[[f64; 2]], area: f64) -> f64 {
    let edges = || corners.iter().zip(corners.iter().cycle().skip(1));
    // Cells may be left-handed.
    let turns = |sign: f64| edges().all(|(a, b)| sign * (a[0] * b[1] - a[1] * b[0]) >= 0.0);
    let encloses = turns(1.0) || turns(-1.0);
    let nearest = edges().map(|(a, b)| distance_to_edge(*a, *b)).fold(f64::INFINITY, f64::min);
    let farthest = corners.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    if farthest <= radius {
        1.0
    } else if !encloses && nearest >= radius {
        0.0
    } else {
        (disc_over_polygon(radius, corners) / area).min(1.0)
    }
}

/// Distance of the origin from the line between two points, ends included, a length.
fn distance_to_edge(from: [f64; 2], to: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let part = -(from[0] * along[0] + from[1] * along[1]) / (along[0] * along[0] + along[1] * along[1]);
    let part = part.clamp(0.0, 1.0);
    (from[0] + part * along[0]).hypot(from[1] + part * along[1])
}

/// Area of the disc of a radius around the origin that lies in a polygon, corner by corner.
fn disc_over_polygon(radius: f64, corners: &[[f64; 2]]) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges.map(|(&from, &to)| disc_over_triangle(radius, from, to)).sum::<f64>().abs()
}

/// Area, positive counterclockwise, of the disc that lies in the triangle of the origin and two points.
fn disc_over_triangle(radius: f64, from: [f64; 2], to: [f64; 2]) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let sector = |a: [f64; 2], b: [f64; 2]| 0.5 * radius * radius * cross(a, b).atan2(dot(a, b));
    let along = [to[0] - from[0], to[1] - from[1]];
    let (a, b, c) = (dot(along, along), dot(from, along), dot(from, from) - radius * radius);
    let root = b * b - a * c;
    if root <= 0.0 {
        return sector(from, to);
    }
    // Parts of the edge at which it enters the disc and leaves it.
    let [enters, leaves] = [-1.0, 1.0].map(|sign| ((-b + sign * root.sqrt()) / a).clamp(0.0, 1.0));
    if enters >= leaves {
        return sector(from, to);
    }
    let [inner, outer] = [enters, leaves].map(|t| [from[0] + t * along[0], from[1] + t * along[1]]);
    sector(from, inner) + 0.5 * cross(inner, outer) + sector(outer, to)
}
