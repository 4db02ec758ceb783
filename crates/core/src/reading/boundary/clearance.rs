//! The clearance of a rim: the distance over which samples lie open beside it, by directions.

use super::rim::Rim;
use super::spot::{PolarSpot, Sample};
use crate::numeric::closed_line::{ANGLES, angle, mean_radius};

/// Number of sectors with a clearance of their own.
pub const SECTORS: usize = 24;

/// Clearance over the mean radius from which on neighbours do not change the gap at the rim.
const FAR: f64 = 0.7;

/// Distance over which samples lie open beside the rim `radii` in each of equal sectors, out to twice the mean radius; lengths,
/// infinite where neighbours are far.
pub fn clearance(spot: &PolarSpot<'_>, rim: Rim, radii: &[f64], spacing: f64) -> [f64; SECTORS] {
    let mut clearance = [0.0f64; SECTORS];
    let mean = mean_radius(radii);
    for (index, radius) in radii.iter().enumerate() {
        let (sine, cosine) = angle(index).sin_cos();
        let is_open = |r: &f64| match rim {
            Rim::Outer => spot.at([r * cosine, r * sine]) == Sample::Open,
            Rim::Hole => spot.at([r * cosine, r * sine]) == Sample::Hole,
        };
        // The farthest first.
        let steps = |length: f64| (0..=(length / spacing) as usize).map(move |k| k as f64 * spacing);
        let distance = match rim {
            Rim::Outer => {
                steps(2.0 * mean - radius).map(|inwards| 2.0 * mean - inwards).find(is_open).map(|r| r - radius)
            }
            Rim::Hole => steps(*radius).find(is_open).map(|r| radius - r),
        };
        let sector = &mut clearance[index * SECTORS / ANGLES];
        *sector = sector.max(distance.unwrap_or(0.0));
    }
    let unbounded = |clearance: f64| rim == Rim::Outer && clearance > FAR * mean;
    clearance.map(|clearance| if unbounded(clearance) { f64::INFINITY } else { clearance })
}
