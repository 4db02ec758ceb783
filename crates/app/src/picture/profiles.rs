//! Pressure through the middle of each level's contact, along the line of its largest extent (Fig. 3).

use super::snapshot::Snapshot;
use super::tiling::around;
use crate::picture::labels::Labels;
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Style};
use percoat_draw::number::degrees;
use std::f64::consts::PI;

/// The picture; `None` for a topography or without contact. `isolated`: per level the points (distance from the axis,
/// pressure) of an indenter that carries the same load alone, drawn dashed on both sides.
pub fn profiles(snapshot: &Snapshot, isolated: Option<&[Vec<[f64; 2]>]>) -> Option<Canvas> {
    let mut curves = Vec::new();
    let mut directions = Vec::new();
    for level in 1..=snapshot.levels() {
        let Some((direction, points)) = snapshot.profile(level) else { continue };
        curves.push(Curve {
            label: snapshot.step.problem().level_name(level).label(),
            points,
            errors: Vec::new(),
            style: Style::Line,
            colour: level.into(),
        });
        if let Some((&peak, error)) = peak_of(&curves).zip(snapshot.reading.levels[level - 1].errors.max_pressure) {
            curves.push(Curve {
                label: String::new(),
                points: vec![peak],
                errors: vec![error],
                style: Style::LineMarkers,
                colour: level.into(),
            });
        }
        directions.push(degrees([direction.cos(), direction.sin()]));
        if let Some(points) = isolated.and_then(|levels| levels.get(level - 1)) {
            let points = smooth(points);
            let left = points.iter().rev().map(|[r, p]| [-r, *p]);
            curves.push(Curve {
                label: String::new(),
                points: left.chain(points.iter().copied()).collect(),
                errors: Vec::new(),
                style: Style::Dashed,
                colour: level.into(),
            });
        }
    }
    let reach = curves.iter().flat_map(|curve| &curve.points).map(|[s, _]| s.abs()).fold(0.0, f64::max);
    (!curves.is_empty()).then(|| {
        let mut what = format!("Lines of largest extent: {} from the x axis.", directions.join(", "));
        if snapshot.reading.levels.iter().any(|level| level.merged && level.touches()) {
            what += " Lines of merged contacts end where the neighbour's begins.";
        }
        if isolated.is_some() {
            what += " Dashed: isolated indenters under the same loads.";
        }
        if curves.iter().any(Curve::has_errors) {
            what += " Markers with bars: the peaks with their estimated errors.";
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

/// The point of the last curve where it is largest.
fn peak_of(curves: &[Curve]) -> Option<&[f64; 2]> {
    curves.last()?.points.iter().max_by(|a, b| a[1].total_cmp(&b[1]))
}

/// Number of points on either side of the axis.
const POINTS: u32 = 240;

/// Largest number of steps of a quarter of a spacing to the end of a contact.
const MOST_STEPS: f64 = 4e4;

/// The end of a contact along a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ContactEnd {
    /// The edge of contact.
    Edge,
    /// The contact of the next indenter, with which it has merged.
    Seam,
}

/// A line through points (distance from the axis, pressure) from the axis, or the inner edge of a ring, to the edge: between
/// them the square of the pressure over that of the distance is a cubic without waves (F. Fritsch & R. Carlson, 1980).
/// Elements next to an edge, which err most, are left out.
fn smooth(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let Some((&[edge, _], inner)) = points.split_last() else { return Vec::new() };
    let element = if inner.len() > 1 { inner[1][0] - inner[0][0] } else { 0.0 };
    // The first element of a ring is half of its width behind the inner edge.
    let first = inner.first().map_or(0.0, |[r, _]| *r);
    let hole = if first > 1.1 * element { first - 0.5 * element } else { 0.0 };
    let is_whole = |r: f64| edge - r > 1.05 * element && (hole == 0.0 || r - hole > 1.05 * element);
    let kept = inner.iter().filter(|[r, _]| is_whole(*r)).chain(points.last());
    let begin = (hole > 0.0).then_some([hole * hole, 0.0]);
    let places: Vec<[f64; 2]> = begin.into_iter().chain(kept.map(|[r, p]| [r * r, p * p])).collect();
    if places.len() < 3 {
        return points.to_vec();
    }
    let chords: Vec<f64> =
        places.windows(2).map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).collect();
    let slope = |k: usize| match (k.checked_sub(1).map(|before| chords[before]), chords.get(k)) {
        (Some(a), Some(b)) if a * b > 0.0 => 2.0 * a * b / (a + b),
        (Some(_), Some(_)) => 0.0,
        (a, b) => a.or(b.copied()).unwrap_or(0.0),
    };
    let at = |r: f64| {
        let u = (r * r).max(places[0][0]);
        let k = places.partition_point(|place| place[0] <= u).clamp(1, places.len() - 1) - 1;
        let ([from, a], [to, b]) = (places[k], places[k + 1]);
        let (width, t) = (to - from, (u - from) / (to - from));
        let (c, d) = (slope(k) * width, slope(k + 1) * width);
        let square = a + t * (c + t * (3.0 * (b - a) - 2.0 * c - d + t * (2.0 * (a - b) + c + d)));
        [r, square.max(0.0).sqrt()]
    };
    // Points are denser at edges.
    let part = |k: u32| {
        let angle = PI * f64::from(k) / f64::from(POINTS);
        if hole > 0.0 { 0.5 - 0.5 * angle.cos() } else { (0.5 * angle).sin() }
    };
    let mut line: Vec<[f64; 2]> = (0..=POINTS).map(|k| at(hole + (edge - hole) * part(k))).collect();
    // The pressure ends without rounding errors.
    line[POINTS as usize] = points[points.len() - 1];
    line
}

impl Snapshot {
    /// A line through an indenter's axis: its direction from the x axis in radians, distances from the axis and
    /// pressures.
    fn profile(&self, level: usize) -> Option<(f64, Vec<[f64; 2]>)> {
        let site = self.step.surface().site_of(level)?;
        let centre = self.step.grid().cell().point(self.step.surface().sites()[site].place);
        if self.reading.boundaries[site].is_none() && self.pressure_squared(centre) <= 0.0 {
            return None;
        }
        let boundary = self.reading.boundaries[site].as_ref();
        let ends = |theta: f64| match boundary {
            Some(boundary) => [theta + PI, theta].map(|theta| (boundary.radius(theta), ContactEnd::Edge)),
            None => [theta + PI, theta].map(|theta| self.end(site, centre, theta)),
        };
        // The first of equal extents.
        let (mut direction, mut widest) = (0.0, 0.0);
        for theta in (0..180).map(|k| f64::from(k).to_radians()) {
            let extent: f64 = ends(theta).iter().map(|(end, _)| end).sum();
            if extent > widest * (1.0 + 1e-4) {
                (direction, widest) = (theta, extent);
            }
        }
        let [(left, left_rim), (right, right_rim)] = ends(direction);
        let hole = |theta: f64| boundary.map_or(0.0, |boundary| boundary.hole_radius(theta));
        let (sin, cos) = direction.sin_cos();
        let squared = |s: f64| self.pressure_squared([centre[0] + s * cos, centre[1] + s * sin]);
        // Between the outermost samples and an edge the square of the pressure falls evenly to zero.
        let rim = 1.5 * self.step.grid().spacing();
        let at = |s: f64| {
            let (end, kind, sign, hole) = match s < 0.0 {
                true => (left, left_rim, -1.0, hole(direction + PI)),
                false => (right, right_rim, 1.0, hole(direction)),
            };
            let (outer, inner) = (end - s.abs(), s.abs() - hole);
            let square = match kind {
                _ if hole > 0.0 && inner < rim => squared(sign * (hole + rim)) * inner.max(0.0) / rim,
                ContactEnd::Edge if outer < rim => squared(sign * (end - rim)) * outer / rim,
                _ => squared(s),
            };
            [s, square.max(0.0).sqrt()]
        };
        let points = (0..=2 * POINTS)
            .map(|k| f64::from(k) / f64::from(POINTS) - 1.0)
            // Points are denser at the edge, where the pressure falls like a square root.
            .map(|t| (t * 0.5 * PI).sin())
            .map(|t| at(if t < 0.0 { t * left } else { t * right }))
            .collect();
        Some((direction, points))
    }

    /// Distance at which a line from the axis of an indenter leaves its contact for the last time, a length, and the kind of this
    /// end; for contacts without a located boundary.
    fn end(&self, site: usize, centre: [f64; 2], theta: f64) -> (f64, ContactEnd) {
        let step = 0.25 * self.step.grid().spacing();
        let at = |r: f64| [centre[0] + r * theta.cos(), centre[1] + r * theta.sin()];
        let faces = |r: f64| {
            let offset = self.facing(at(r)).filter(|(facing, _)| *facing == site).map(|(_, offset)| offset);
            offset.is_some_and(|[x, y]| (x - r * theta.cos()).hypot(y - r * theta.sin()) < step)
        };
        let (mut last, mut k) = (0.0, 0.0);
        while faces(k * step) && k < MOST_STEPS {
            if self.inside(at(k * step)) > 0.0 {
                last = k * step;
            }
            k += 1.0;
        }
        let rim = if last >= (k - 1.5) * step { ContactEnd::Seam } else { ContactEnd::Edge };
        (last, rim)
    }

    /// Square of the pressure between the samples: near the edge it is almost linear, as the pressure is not.
    fn pressure_squared(&self, place: [f64; 2]) -> f64 {
        around(self.step.grid(), place).iter().map(|&(index, weight)| weight * self.pressures()[index].powi(2)).sum()
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

    #[test]
    fn a_smooth_line_through_few_points_of_a_hertzian_contact_is_hertzian() {
        let mut points: Vec<[f64; 2]> =
            (0..12).map(|k| f64::from(k) / 12.0).map(|r| [r, (1.0 - r * r).sqrt()]).collect();
        // The last element is too high.
        points[11][1] *= 1.3;
        points.push([1.0, 0.0]);
        for [r, p] in smooth(&points) {
            assert!((p * p - (1.0 - r * r)).abs() < 1e-12, "{r}: {p}");
        }
    }

    #[test]
    fn a_smooth_line_through_a_ring_is_zero_at_both_edges() {
        let square = |r: f64| (r - 0.5) * (1.0 - r);
        let points = (0..8).map(|k| 0.53 + 0.06 * f64::from(k)).map(|r| [r, square(r).sqrt()]);
        let line = smooth(&points.chain([[1.0, 0.0]]).collect::<Vec<[f64; 2]>>());
        let edges = [line[0], line[line.len() - 1]];
        assert!(
            edges.iter().zip([0.5, 1.0]).all(|([r, p], edge)| (r - edge).abs() < 1e-12 && p * p < 1e-12),
            "{edges:?}"
        );
        // Halfway between edge and first whole element a cubic without waves is within a tenth.
        assert!(line.iter().all(|[r, p]| (p * p - square(*r)).abs() < 0.1 * square(0.75)), "{line:?}");
    }

    /// Neighbours of two levels on a square lattice are √½ apart: the seam is not far from halfway.
    #[test]
    fn a_merged_contact_ends_at_the_seam() {
        let levels = [0.01, 0.0].map(|height| Level::new(Shape::Paraboloid { radius: 1.0 }, height).unwrap()).to_vec();
        let indenters = Indenters::new(Lattice::square(1.0, 2).unwrap(), levels).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let mut solver = Solver::new(Problem::new(indenters, body), [48, 48], Settings::default()).unwrap();
        let step = solver.solve(Load::MeanPressure(0.6));
        let reading = step.reading();
        assert!(reading.levels.iter().all(|level| level.merged));
        let snapshot = Snapshot::new("", step, reading);
        // The seam, where r²/2 + d of both sides are equal, lies at ½l + d/l from the higher axis.
        let (apart, drop) = (snapshot.step.problem().indenters().unwrap().lattice().period(), 0.01);
        for (level, farthest) in [(1, 0.5 * apart + drop / apart), (2, 0.5 * apart - drop / apart)] {
            let (direction, points) = snapshot.profile(level).unwrap();
            let reach = points.iter().map(|[s, _]| s.abs()).fold(0.0, f64::max);
            // The cell of the indenter is a square whose corners are farther than its sides.
            assert!(reach <= farthest * 2f64.sqrt() + 1e-9 && reach > 0.9 * farthest, "{level}: {reach} {direction}");
        }
    }
}
