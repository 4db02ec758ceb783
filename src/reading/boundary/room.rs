//! How far what is open around a rim belongs to it, by directions.

use super::rim::Rim;
use super::spot::{Sample, Spot};
use crate::numeric::closed_line::{ANGLES, angle, mean_radius};

/// Sectors in which neighbours stand nearer or farther.
pub const SECTORS: usize = 24;

/// Room over the radius from which on no neighbour is felt.
const FAR: f64 = 0.7;

/// How far samples lie open beside the rim `radii` in each of equal sectors, out to twice its mean radius; lengths, infinite
/// where no neighbour is felt.
pub fn room(spot: &Spot<'_>, rim: Rim, radii: &[f64], spacing: f64) -> [f64; SECTORS] {
    let mut room = [0.0f64; SECTORS];
    let mean = mean_radius(radii);
    for (index, radius) in radii.iter().enumerate() {
        let (sine, cosine) = angle(index).sin_cos();
        let is_open = |r: &f64| match rim {
            Rim::Outer => spot.at([r * cosine, r * sine]) == Sample::Open,
            Rim::Hole => spot.at([r * cosine, r * sine]) == Sample::Hole,
        };
        // The farthest first.
        let steps = |length: f64| (0..=(length / spacing) as usize).map(move |k| k as f64 * spacing);
        let own = match rim {
            Rim::Outer => {
                steps(2.0 * mean - radius).map(|inwards| 2.0 * mean - inwards).find(is_open).map(|r| r - radius)
            }
            Rim::Hole => steps(*radius).find(is_open).map(|r| radius - r),
        };
        let sector = &mut room[index * SECTORS / ANGLES];
        *sector = sector.max(own.unwrap_or(0.0));
    }
    let unbounded = |room: f64| rim == Rim::Outer && room > FAR * mean;
    room.map(|room| if unbounded(room) { f64::INFINITY } else { room })
}
