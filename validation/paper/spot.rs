//! The contact spot of one level: its boundary, its pressure along a line through the axis, and what a coarse raster of
//! square elements would make of its asymmetry.

use crate::StudyError;
use percoat_core::localized::spot::Spot;
use percoat_core::reading::{Boundary, Reading};
use percoat_core::spectral::Step;
use std::f64::consts::PI;

/// Direction in which level 1 stands as seen from level 3 and, opposite, level 2.
pub const TOWARD_NEIGHBOUR: f64 = PI / 6.0;

/// (max − min)/max of each level's boundary; not a number where there is none.
pub fn asymmetries(found: &Reading) -> [f64; 3] {
    [0, 1, 2].map(|m| found.levels.get(m).and_then(|level| level.asymmetry).unwrap_or(f64::NAN))
}

/// A sample seen from an indenter's axis: its distance, a length, its angle, radians, and its pressure.
struct Polar {
    r: f64,
    theta: f64,
    p: f64,
}

/// Samples around the axis of a level's first indenter, out to `reach` times the counted contact radius.
fn samples(step: &Step, level: usize, reach: f64) -> Vec<Polar> {
    let (grid, surface, contact) = (step.grid(), step.surface(), step.finest());
    let reduced = grid.cell().reduced();
    let Some(site) = surface.site_of(level) else { return Vec::new() };
    let (pressure, owners) = (contact.pressures(), surface.owners());
    let is_owned = |index: &usize| owners[*index] as usize == site;
    let counted = (0..grid.len()).filter(is_owned).filter(|&index| pressure[index] > 0.0).count() as f64;
    let reach = reach * (counted * grid.sample_area() / PI).sqrt();
    let polar = |index: usize| {
        let [x, y] = surface.offset(&reduced, site as u32, index);
        Polar { r: x.hypot(y), theta: y.atan2(x), p: pressure[index] }
    };
    (0..grid.len()).filter(is_owned).map(polar).filter(|sample| sample.r < reach).collect()
}

/// Boundary of the contact of a level around its axis.
pub fn boundary(step: &Step, level: usize) -> Result<Boundary, StudyError> {
    let site = step.surface().site_of(level);
    let boundary = site.and_then(|site| Reading::of(step.finest()).boundaries.swap_remove(site));
    boundary.ok_or_else(|| format!("no boundary of level {level}").into())
}

/// Distance from the axis and pressure along the line through the axis in the direction `angle`, both ways, from the
/// samples that lie on it.
pub fn pressure_profile(step: &Step, level: usize, angle: f64) -> Vec<[f64; 2]> {
    let tolerance = 1e-6 * step.grid().spacing();
    let along = |sample: &Polar| {
        let (sine, cosine) = (sample.theta - angle).sin_cos();
        ((sample.r * sine).abs() < tolerance).then_some([sample.r * cosine, sample.p])
    };
    let mut profile: Vec<[f64; 2]> = samples(step, level, 1.4).iter().filter_map(along).collect();
    profile.sort_by(|a, b| a[0].total_cmp(&b[0]));
    profile
}

/// (largest − smallest)/largest, or over the mean, of radii around a closed boundary.
pub fn asymmetry(radii: &[f64]) -> [f64; 2] {
    let (least, most) = radii.iter().fold((f64::INFINITY, 0f64), |(least, most), &r| (least.min(r), most.max(r)));
    let mean = radii.iter().sum::<f64>() / radii.len() as f64;
    [(most - least) / most, (most - least) / mean]
}

/// Radii of a boundary seen from the centre of its area.
pub fn from_centroid(boundary: &Boundary) -> Vec<f64> {
    let count = boundary.radii.len();
    let angle = |i: usize| 2.0 * PI * i as f64 / count as f64;
    let mut centre = [0.0; 2];
    for (i, r) in boundary.radii.iter().enumerate() {
        let (sine, cosine) = angle(i).sin_cos();
        centre[0] += r.powi(3) / 3.0 * cosine * 2.0 * PI / count as f64 / boundary.area();
        centre[1] += r.powi(3) / 3.0 * sine * 2.0 * PI / count as f64 / boundary.area();
    }
    (0..count)
        .map(|i| {
            let (sine, cosine) = angle(i).sin_cos();
            (boundary.radii[i] * cosine - centre[0]).hypot(boundary.radii[i] * sine - centre[1])
        })
        .collect()
}

/// Radii of the contour p = `part` of the peak around a level's axis, in the directions of the samples that
/// straddle it.
pub fn contour(step: &Step, level: usize, part: f64) -> Vec<f64> {
    let around = samples(step, level, 1.2);
    let peak = around.iter().map(|sample| sample.p).fold(0.0, f64::max);
    // p² is nearly linear in r² inside a contact: interpolate along rays of thirty degrees, where samples lie.
    let mut radii = Vec::new();
    for ray in 0..12 {
        let angle = f64::from(ray) * PI / 6.0;
        let tolerance = 1e-6 * step.grid().spacing();
        let mut line: Vec<[f64; 2]> = around
            .iter()
            .filter(|s| (s.r * (s.theta - angle).sin()).abs() < tolerance && (s.theta - angle).cos() > 0.0)
            .map(|s| [s.r * s.r, s.p * s.p])
            .collect();
        line.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let level = (part * peak).powi(2);
        for pair in line.windows(2) {
            if pair[0][1] >= level && pair[1][1] < level {
                let share = (pair[0][1] - level) / (pair[0][1] - pair[1][1]);
                radii.push((pair[0][0] + share * (pair[1][0] - pair[0][0])).sqrt());
            }
        }
    }
    radii
}

/// How a raster of square elements places itself on a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Raster {
    /// An element's centre on the axis.
    Centred,
    /// An element's corner on the axis.
    Cornered,
}

/// (largest − smallest)/largest distance from the axis to the staircase boundary of the elements (side 1) whose centres
/// lie within a circle of `radius`: what counting elements makes of a perfect circle.
pub fn staircase(radius: f64, raster: Raster) -> f64 {
    let shift = if raster == Raster::Centred { 0.0 } else { 0.5 };
    let inside = |i: i32, j: i32| (f64::from(i) + shift).hypot(f64::from(j) + shift) <= radius;
    outline(radius.ceil() as i32 + 2, shift, inside)
}

/// Asymmetry as in [`staircase`] of the elements in contact of a localized solution.
pub fn counted(spot: &Spot) -> f64 {
    let middle = (spot.mesh.width / 2) as i32;
    let inside = |i: i32, j: i32| {
        let [row, column] = [i + middle, j + middle].map(|k| usize::try_from(k).ok());
        let place = row.zip(column).filter(|(row, column)| row.max(column) < &spot.mesh.width);
        place.is_some_and(|(row, column)| spot.pressure[[row, column]] > 0.0)
    };
    outline(middle, 0.0, inside)
}

/// Asymmetry of the elements `inside` among those up to `reach` from the middle, whose centres are shifted by `shift`.
fn outline(reach: i32, shift: f64, inside: impl Fn(i32, i32) -> bool) -> f64 {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for (i, j) in (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j))) {
        let (x, y) = (f64::from(i) + shift, f64::from(j) + shift);
        for (di, dj) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            if inside(i, j) && !inside(i + di, j + dj) {
                // The side between them: its nearest point and its ends.
                let (nx, ny) = (x + 0.5 * f64::from(di), y + 0.5 * f64::from(dj));
                let ends = [-0.5, 0.5].map(|t| (nx + t * f64::from(dj)).hypot(ny + t * f64::from(di)));
                let across = if di == 0 { nx } else { ny };
                let nearest =
                    if across.abs() < 0.5 { if di == 0 { ny } else { nx }.abs() } else { ends[0].min(ends[1]) };
                least = least.min(nearest);
                most = most.max(ends[0].max(ends[1]));
            }
        }
    }
    (most - least) / most
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_alone_is_a_square() {
        // From the middle of a side, ½, to a corner, √½.
        assert!((staircase(0.3, Raster::Centred) - (1.0 - 0.5f64.sqrt())).abs() < 1e-12);
        assert!((staircase(0.8, Raster::Cornered) - (1.0 - 0.5f64.sqrt())).abs() < 1e-12);
    }

    #[test]
    fn a_shifted_circle_is_a_circle_from_its_centroid() {
        let radii = (0..360).map(|i| {
            let angle = 2.0 * PI * f64::from(i) / 360.0;
            0.2 * angle.cos() + (1.0 - (0.2 * angle.sin()).powi(2)).sqrt()
        });
        let boundary = Boundary { radii: radii.collect(), hole: Vec::new(), error: 0.0, hole_error: 0.0 };
        let [from_axis, _] = asymmetry(&boundary.radii);
        assert!((from_axis - (1.2 - 0.8) / 1.2).abs() < 1e-12);
        assert!(asymmetry(&from_centroid(&boundary))[0] < 1e-4);
    }
}
