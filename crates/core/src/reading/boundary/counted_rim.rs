//! The rim of a contact as its samples are counted: where the fits start.

use super::constants::HARMONICS;
use super::rim::Rim;
use super::spot::{PolarSpot, Sample};
use crate::numeric::closed_line::series_line;
use std::f64::consts::PI;

/// Radius of a disc that round contacts fill, over the distance of their farthest sample.
const DISC: f64 = 0.9;

/// Radii of the boundary of low harmonics that encloses the samples as they are counted, and √(area/π), lengths: ρ² has the
/// moments ½∮ρ² cos kθ dθ = ∫ cos kθ d²x.
pub fn counted_rim(spot: &PolarSpot<'_>, sample_area: f64, rim: Rim) -> (Vec<f64>, f64) {
    const COUNT: usize = 2 * HARMONICS + 1;
    // The waves cancel over a disc around the axis: of their sums remain the samples of the spot outside the disc, less those of
    // the disc outside the spot.
    let disc = if rim == Rim::Outer { DISC * spot.farthest() } else { 0.0 };
    // No sample of the spot or its hole lies beyond the farthest one in contact.
    let blocks = spot.taken([0.0, spot.farthest() * (1.0 + 1e-9)], |sums: &mut [f64; COUNT], _, [x, y], sample| {
        let inside = sample == Sample::Hole || rim == Rim::Outer && sample == Sample::Contact;
        sums[0] += f64::from(u8::from(inside));
        let square = x * x + y * y;
        if inside != (square < disc * disc) && square > 0.0 {
            let r = square.sqrt();
            let (cosine, sine) = (x / r, y / r);
            let (mut c, mut s) = (if inside { 1.0 } else { -1.0 }, 0.0);
            for k in 0..HARMONICS {
                (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
                sums[2 * k + 1] += c;
                sums[2 * k + 2] += s;
            }
        }
    });
    let mut squares = blocks.iter().fold([0.0; COUNT], |sum, block| std::array::from_fn(|k| sum[k] + block[k]));
    for (k, square) in squares.iter_mut().enumerate() {
        *square *= if k == 0 { 1.0 } else { 2.0 } * sample_area / PI;
    }
    let least = 0.1 * squares[0];
    (series_line(&squares).into_iter().map(|square| square.max(least).sqrt()).collect(), squares[0].sqrt())
}
