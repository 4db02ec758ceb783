//! The outline of a spot of elements, from their pressures alone.
//!
//! Along every row and column of elements contact is a set of intervals. At an end p² falls nearly evenly to zero: the
//! end is the root of a parabola through p² of the elements before it, without the last one, and no farther than the
//! centre of the first open element. The ends that a line meets steeply are points of the outline, a Fourier series in
//! the angle goes through them.
//!
//! It knows nothing of gaps and moduli: on a coating that is thin against the elements p² does not fall evenly, and only
//! the open elements hold the outline.

use super::mesh::Mesh;
use crate::least_squares;
use std::f64::consts::{PI, TAU};

/// The line around a spot, and around the hole of a ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Distances from the axis at equally spaced angles from θ = 0, lengths.
    pub radii: Vec<f64>,
    /// √(area of the hole/π), a length; 0 without one.
    pub hole: f64,
}

/// Angles at which an outline is given, and its highest harmonic.
const ANGLES: usize = 360;
const HARMONICS: usize = 6;
/// Fewest elements of an interval for a parabola.
const FEWEST: usize = 6;
/// Least cosine between a line and the way from the axis to its end.
const STEEP: f64 = 0.6;

impl Outline {
    /// The outline of what is pressed; `None` for spots of too few elements or not around the axis.
    pub fn new(mesh: &Mesh, pressure: &[f64]) -> Option<Self> {
        let (mut outer, mut inner) = (Vec::new(), Vec::new());
        for line in 0..mesh.width {
            for direction in [0, 1] {
                let index = |k: usize| if direction == 0 { k * mesh.width + line } else { line * mesh.width + k };
                let intervals = intervals(mesh.width, |k| pressure[index(k)]);
                let (Some(first), Some(last)) = (intervals.first(), intervals.last()) else { continue };
                let (first, last) = (first[0], last[1]);
                for end in intervals.into_iter().flatten() {
                    let mut place = mesh.place(index(0));
                    place[direction] += end * mesh.size;
                    let r = place[0].hypot(place[1]);
                    if place[direction].abs() > STEEP * r {
                        let is_outer = end == first || end == last;
                        let side = if is_outer { &mut outer } else { &mut inner };
                        side.push([place[1].atan2(place[0]), r]);
                    }
                }
            }
        }
        let radii = through(&outer)?;
        let hole = through(&inner).map_or(0.0, |radii| mean_square(&radii).sqrt());
        Some(Self { radii, hole })
    }

    /// Area in contact.
    pub fn area(&self) -> f64 {
        PI * (mean_square(&self.radii) - self.hole * self.hole)
    }
}

fn mean_square(radii: &[f64]) -> f64 {
    radii.iter().map(|r| r * r).sum::<f64>() / radii.len() as f64
}

/// Where a line of `n` elements touches: both ends of each interval, in elements from the centre of the first.
fn intervals(n: usize, pressure: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    let mut k = 0;
    while k < n {
        let first = k;
        while k < n && pressure(k) > 0.0 {
            k += 1;
        }
        if k > first {
            let count = k - first;
            let beyond = |square: &dyn Fn(usize) -> f64| overhang(square, count).unwrap_or(0.5);
            let before = beyond(&|i| pressure(first + i).powi(2));
            let after = beyond(&|i| pressure(first + count - 1 - i).powi(2));
            found.push([first as f64 - before, (k - 1) as f64 + after]);
        }
        k += 1;
    }
    found
}

/// How far beyond the centre of the last of `count` elements p² vanishes, in elements between 0 and 1; `square(i)` is p²
/// of the element i before the last.
fn overhang(square: &dyn Fn(usize) -> f64, count: usize) -> Option<f64> {
    if count < FEWEST {
        return None;
    }
    let used = (count / 2).clamp(3, 8);
    let rows = (1..=used).map(|i| {
        let x = i as f64 / used as f64;
        (vec![1.0, x, x * x], square(i) / square(used))
    });
    let c = least_squares::fit(3, rows)?;
    let root = 2.0 * c[0] / (c[1] + (c[1] * c[1] - 4.0 * c[0] * c[2]).sqrt()) * used as f64;
    (c[1] > 0.0 && root.is_finite()).then(|| root.clamp(0.0, 1.0))
}

/// Radii at equal angles of the Fourier series through points (angle, radius); `None` for fewer than a dozen, or when
/// they do not surround the axis.
fn through(points: &[[f64; 2]]) -> Option<Vec<f64>> {
    let harmonics = HARMONICS.min(points.len() / 12);
    let row = |theta: f64| -> Vec<f64> {
        let pair = |k: usize| [(k as f64 * theta).cos(), (k as f64 * theta).sin()];
        std::iter::once(1.0).chain((1..=harmonics).flat_map(pair)).collect()
    };
    if harmonics == 0 {
        return None;
    }
    let c = least_squares::fit(1 + 2 * harmonics, points.iter().map(|&[theta, r]| (row(theta), r)))?;
    let radius = |k: usize| row(TAU * k as f64 / ANGLES as f64).iter().zip(&c).map(|(x, c)| x * c).sum();
    let radii: Vec<f64> = (0..ANGLES).map(radius).collect();
    radii.iter().all(|r| *r > 0.0).then_some(radii)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hertzian_pressures_end_at_their_circle_and_a_ring_at_both_of_its_own() {
        let mesh = Mesh { width: 61, size: 0.04 };
        let pressed = |p: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (0..mesh.elements()).map(|index| mesh.place(index)).map(|[x, y]| p(x.hypot(y))).collect()
        };
        let disc = Outline::new(&mesh, &pressed(&|r| (1.0 - r * r).max(0.0).sqrt())).unwrap();
        assert!(disc.hole == 0.0 && (disc.area() / PI - 1.0).abs() < 1e-3, "{}", disc.area() / PI);
        let ring = pressed(&|r| ((1.0 - r * r) * (r * r - 0.16)).max(0.0).sqrt());
        let ring = Outline::new(&mesh, &ring).unwrap();
        assert!((ring.hole / 0.4 - 1.0).abs() < 1e-2, "{}", ring.hole);
        assert!((ring.area() / PI / 0.84 - 1.0).abs() < 3e-3, "{}", ring.area() / PI);
    }
}
