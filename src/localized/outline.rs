//! The outline of a spot of elements, between them.
//!
//! Near its edge p² falls evenly inside and g^{2/3} rises evenly outside, on a bare body. Layers that are thin against
//! the way over which they do so bend both, by the factors Φ(d) of pressures and Γ(d) of gaps (`edge.rs`), which are
//! taken out. How steep each side is is read off the elements, not off a modulus. Both sides over their slopes measure
//! the distance d from the edge,
//!
//! ψ = −(p/Φ)²/a inside,  ψ = (g/Γ)^{2/3}/b outside,
//!
//! whose root, the edge, lies between elements of both. With d, also of Φ and Γ, from the present outline ρ(θ), a and b, which vary
//! around the spot, and then
//!
//! ψ ≈ Σ_k [(α_k + β_k d) cos kθ + (α′_k + β′_k d) sin kθ] + γ d² + γ′ d|d|
//!
//! are fitted by least squares, and ρ moves to the root until it stands. Elements next to the edge, which cut it, weigh
//! little.
//!
//! The open elements that a spot encloses are the hole of a ring; its rim is an outline seen from the other side. Φ and Γ are 1
//! for a ring, whose two edges bend the coating together.

use super::edge::Edge;
use super::mesh::Mesh;
use crate::numeric::closed_line::{self, ANGLES, angle, mean_radius, radius, series, waves};
use crate::numeric::least_squares;
use std::f64::consts::PI;

/// The line around a spot, and around the hole of a ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Distances from the axis at equally spaced angles from θ = 0, lengths.
    pub radii: Vec<f64>,
    /// √(area of the hole/π), a length; 0 without one.
    pub hole: f64,
}

/// Highest harmonic of an outline.
const HARMONICS: usize = 6;
/// Fewest elements per radius for a fit.
const FEWEST: f64 = 3.0;
/// Distance from the edge, in elements, over which the weight of an element rises from zero to one.
const RISE: f64 = 2.5;
/// Largest distance of an outline from the counted radius, in elements, beside 0.3 of that: beyond it the fit is not
/// believed.
const BELIEF: f64 = 2.0;
/// The same of its mean radius. Counting errs by 0.27 elements at most where the fit is good (530 outlines, bare, soft and
/// hard coatings); the fit by one to two where the pressure is heaped within two elements of the edge.
const COUNTED: f64 = 0.5;
/// Fits, each from the outline of the last.
const ROUNDS: usize = 8;

/// An element near a rim.
#[derive(Debug, Clone, Copy)]
struct Place {
    r: f64,
    theta: f64,
    /// p² in contact, g^{2/3} beside it.
    height: f64,
    open: bool,
}

impl Outline {
    /// The outline of what is pressed, from the pressure on each element and the gap over it; `None` for spots of too
    /// few elements or not around the axis.
    pub fn new(mesh: &Mesh, edge: &Edge, pressure: &[f64], gap: &[f64]) -> Option<Self> {
        let enclosed = enclosed(mesh, pressure);
        let place = |index: usize| {
            let [x, y] = mesh.place(index);
            let open = pressure[index] <= 0.0;
            let height = if open { gap[index].max(0.0).powf(2.0 / 3.0) } else { pressure[index].powi(2) };
            Place { r: x.hypot(y), theta: y.atan2(x), height, open }
        };
        let places = |hole: bool| -> Vec<Place> {
            let wanted = |&index: &usize| pressure[index] > 0.0 || enclosed[index] == hole;
            (0..mesh.elements()).filter(wanted).map(place).collect()
        };
        let counted = |wanted: &dyn Fn(usize) -> bool| {
            let count = (0..mesh.elements()).filter(|&index| wanted(index)).count();
            (count as f64 / PI).sqrt() * mesh.size
        };
        let whole = counted(&|index| pressure[index] > 0.0 || enclosed[index]);
        let open = counted(&|index| enclosed[index]);
        // The law is that of an edge alone, and a ring has two.
        let bare = Edge::bare();
        let edge = if open > 0.0 { &bare } else { edge };
        // Each edge of a ring has its own half of it, a disc as much as the fit reaches.
        let deep = if open > 0.0 { 0.5 * (whole - open) } else { whole };
        let radii = rim(&places(false), edge, mesh.size, [whole, deep], 1.0)?;
        let hole = if open > 0.0 { rim(&places(true), edge, mesh.size, [open, deep], -1.0) } else { None };
        Some(Self { radii, hole: hole.map_or(open, |radii| mean_radius(&radii)) })
    }

    /// Area in contact.
    pub fn area(&self) -> f64 {
        PI * (mean_radius(&self.radii).powi(2) - self.hole * self.hole)
    }
}

/// Which open elements no way over open elements leads to from the sides of the mesh.
fn enclosed(mesh: &Mesh, pressure: &[f64]) -> Vec<bool> {
    let width = mesh.width;
    let mut enclosed: Vec<bool> = pressure.iter().map(|p| *p <= 0.0).collect();
    let mut next: Vec<usize> = (0..mesh.elements()).filter(|&index| mesh.on_rim(index)).collect();
    while let Some(index) = next.pop() {
        if std::mem::take(&mut enclosed[index]) {
            let (row, column) = (index / width, index % width);
            let around = [
                (row > 0).then(|| index - width),
                (row + 1 < width).then(|| index + width),
                (column > 0).then(|| index - 1),
                (column + 1 < width).then(|| index + 1),
            ];
            next.extend(around.into_iter().flatten());
        }
    }
    enclosed
}

/// The line between contact, `deep` as far as it is this line's, and what is open beside it, outwards (`sign` 1) or
/// inwards (−1), from a circle.
fn rim(places: &[Place], edge: &Edge, size: f64, [counted, deep]: [f64; 2], sign: f64) -> Option<Vec<f64>> {
    let resolution = counted / size;
    if resolution < FEWEST {
        return None;
    }
    let reach = (RISE + resolution.sqrt()).min(0.6 * resolution) * size;
    let mut radii = vec![counted; ANGLES];
    for _ in 0..ROUNDS {
        radii = moved(&radii, places, edge, size, [reach, deep], sign)?;
        if radii.iter().any(|r| (r - counted).abs() > BELIEF * size + 0.3 * counted) {
            return None;
        }
    }
    ((mean_radius(&radii) - counted).abs() <= COUNTED * size).then_some(radii)
}

/// The line through the root of ψ, fitted to the places within `reach` of the line `radii`.
fn moved(
    radii: &[f64],
    places: &[Place],
    edge: &Edge,
    size: f64,
    [reach, deep]: [f64; 2],
    sign: f64,
) -> Option<Vec<f64>> {
    // What the layers make of the heights at the present distance is taken out.
    let bare = |place: &Place, distance: f64| {
        let factor = if place.open { edge.opening(distance).powf(2.0 / 3.0) } else { edge.pressure(distance).powi(2) };
        Place { height: place.height / factor, ..*place }
    };
    let near: Vec<(Place, f64)> = places
        .iter()
        .map(|place| (place, sign * (place.r - radius(radii, place.theta)) / reach))
        .filter(|(place, d)| d.abs() < 1.0 && (place.open || -d * reach < deep))
        .map(|(place, d)| (bare(place, d.abs() * reach), d))
        .collect();
    // Four elements per unknown at least.
    let harmonics = HARMONICS.min(near.len() / 16);
    let count = 1 + 2 * harmonics;
    // a and b of height ≈ slope |d| (1 + κ|d|).
    let slopes = |open: bool| -> Option<Vec<f64>> {
        let side = near.iter().filter(|(place, d)| place.open == open && (*d > 0.0) == open);
        let rows = side.map(|(place, d)| {
            let row = waves(place.theta, harmonics).into_iter().map(|wave| d.abs() * wave).chain([d * d]);
            let weight = d.abs();
            (row.map(|x| weight * x).collect(), weight * place.height)
        });
        let mut slopes = least_squares::fit(count + 1, rows)?;
        slopes.truncate(count);
        Some(slopes)
    };
    let sides = [slopes(false)?, slopes(true)?];
    let slope = |place: &Place| series(&sides[usize::from(place.open)], place.theta);
    if near.iter().any(|(place, _)| slope(place) <= 0.0) {
        return None;
    }
    let rows = near.iter().map(|(place, d)| {
        let weight = (d.abs() * reach / (RISE * size)).min(1.0);
        let waves = waves(place.theta, harmonics);
        let row = waves.iter().copied().chain(waves.iter().map(|wave| d * wave)).chain([d.abs(), d * d, d * d.abs()]);
        let distance = place.height / slope(place) * if place.open { 1.0 } else { -1.0 };
        (row.map(|x| weight * x).collect(), weight * distance)
    });
    let c = least_squares::fit(2 * count + 3, rows)?;
    let shift = |index: usize| {
        let (value, slope) = (series(&c[..count], angle(index)), series(&c[count..2 * count], angle(index)));
        // ψ rises about as d.
        (slope > 0.2).then(|| -sign * value / slope * reach)
    };
    let shifts = (0..ANGLES).map(shift).collect::<Option<Vec<f64>>>()?;
    // One round moves the line by one element at most.
    Some(closed_line::moved(radii, &shifts, size))
}

#[cfg(test)]
mod tests {
    use super::super::point::PointKernel;
    use super::*;
    use crate::body::{HalfSpace, Material};

    fn bare() -> Edge {
        Edge::new(&PointKernel::new(&HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()), 1.0))
    }

    /// Elements of a contact between radii `inner` and 1: near the edges p² = `stiff` times a distance and
    /// g^{2/3} a distance.
    fn elements(mesh: &Mesh, inner: f64, stiff: f64) -> [Vec<f64>; 2] {
        let r: Vec<f64> = (0..mesh.elements()).map(|index| mesh.place(index)).map(|[x, y]| x.hypot(y)).collect();
        let height = |r: &f64| (1.0 - r * r) * (r * r - inner * inner);
        let pressure = r.iter().map(|r| stiff * height(r).max(0.0).sqrt()).collect();
        let gap = r.iter().map(|r| (-height(r)).max(0.0).powf(1.5)).collect();
        [pressure, gap]
    }

    #[test]
    fn a_disc_and_a_ring_have_their_edges_whatever_the_pressures_are_to_the_gaps() {
        let mesh = Mesh { width: 61, size: 0.04 };
        for stiff in [0.1, 1.0, 10.0] {
            let [pressure, gap] = elements(&mesh, 0.4, stiff);
            let ring = Outline::new(&mesh, &bare(), &pressure, &gap).unwrap();
            // The inner edge to a tenth of an element, the area to as much.
            assert!((ring.hole - 0.4).abs() < 4e-3, "{}", ring.hole);
            assert!((ring.area() / PI / 0.84 - 1.0).abs() < 5e-3, "{}", ring.area() / PI);
        }
        let r = |index: usize| mesh.place(index)[0].hypot(mesh.place(index)[1]);
        let pressure: Vec<f64> = (0..mesh.elements()).map(|i| (1.0 - r(i).powi(2)).max(0.0).sqrt()).collect();
        let gap: Vec<f64> = (0..mesh.elements())
            .map(r)
            .map(|r| {
                if r > 1.0 {
                    (0.5 * r * r - 1.0) + ((2.0 - r * r) * (1.0 / r).asin() + (r * r - 1.0).sqrt()) / PI
                } else {
                    0.0
                }
            })
            .collect();
        let disc = Outline::new(&mesh, &bare(), &pressure, &gap).unwrap();
        assert!(disc.hole == 0.0 && (disc.area() / PI - 1.0).abs() < 5e-4, "{}", disc.area() / PI);
    }
}
