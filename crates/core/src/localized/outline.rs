//! The outline of a contact spot, located between the elements.
//!
//! On a bare body p² decreases linearly towards the edge inside, and g^{2/3} increases linearly outside. Layers that are thin
//! against the range of the fit change both, by the ratios Φ(d) of pressures and Γ(d) of gaps (`edge_ratios.rs`), by which they
//! are divided. The slopes a and b of both sides are fitted to the elements, not computed from a modulus. Both sides over their
//! slopes give the distance d from the edge,
//!
//! ψ = −(p/Φ)²/a inside,  ψ = (g/Γ)^{2/3}/b outside,
//!
//! whose root is the edge. With d, also in Φ and Γ, from the present outline ρ(θ), first a and b, which vary around the spot, and
//! then
//!
//! ψ ≈ Σ_k [(α_k + β_k d) cos kθ + (α′_k + β′_k d) sin kθ] + γ d² + γ′ d|d|
//!
//! are fitted by least squares, and ρ moves to the root until it converges. Elements next to the edge, which it cuts, have little
//! weight.
//!
//! The open elements that a spot encloses are the hole of a ring; its rim is located with inside and outside exchanged. Φ and Γ
//! are 1 for a ring, where they are not known: the two edges bend the coating together.

use super::edge_ratios::EdgeRatios;
use super::mesh::Mesh;
use crate::numeric::closed_line::{self, ANGLES, mean_radius, radius, series, series_line, waves};
use crate::numeric::series_fit::SeriesFit;
use crate::reading::boundary::constants::{
    COUNTED_ERROR, HARMONICS, MAX_ITERATIONS, MAX_SHIFT, MIN_RESOLUTION, WEIGHT_RISE,
};
use std::f64::consts::PI;

/// Outline of a spot, with the hole of a ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Distances from the axis at equally spaced angles from θ = 0, lengths.
    pub radii: Vec<f64>,
    /// √(area of the hole/π), a length; 0 without one.
    pub hole: f64,
}

/// Part of the counted radius by which an outline may also differ from it, beside [`MAX_SHIFT`] elements.
const MAX_RELATIVE_SHIFT: f64 = 0.3;

/// An element near a rim.
#[derive(Debug, Clone, Copy)]
struct RimElement {
    r: f64,
    theta: f64,
    /// p² in contact, g^{2/3} outside.
    height: f64,
    open: bool,
}

impl Outline {
    /// Outline of a contact from the pressure on each element and the gap over it; `None` for spots of too few elements or not
    /// around the axis.
    pub fn new(mesh: &Mesh, edge: &EdgeRatios, pressure: &[f64], gap: &[f64]) -> Option<Self> {
        let enclosed = enclosed(mesh, pressure);
        let element = |index: usize| {
            let [x, y] = mesh.place(index);
            let open = pressure[index] <= 0.0;
            let height = if open { gap[index].max(0.0).powf(2.0 / 3.0) } else { pressure[index].powi(2) };
            RimElement { r: x.hypot(y), theta: y.atan2(x), height, open }
        };
        let elements = |hole: bool| -> Vec<RimElement> {
            let wanted = |&index: &usize| pressure[index] > 0.0 || enclosed[index] == hole;
            (0..mesh.elements()).filter(wanted).map(element).collect()
        };
        let counted = |wanted: &dyn Fn(usize) -> bool| {
            let count = (0..mesh.elements()).filter(|&index| wanted(index)).count();
            (count as f64 / PI).sqrt() * mesh.size
        };
        let whole = counted(&|index| pressure[index] > 0.0 || enclosed[index]);
        let open = counted(&|index| enclosed[index]);
        // The ratios are those of a single edge, and a ring has two.
        let bare = EdgeRatios::bare();
        let edge = if open > 0.0 { &bare } else { edge };
        // Each edge of a ring has half of the contact, that of a disc all within the reach of the fit.
        let deep = if open > 0.0 { 0.5 * (whole - open) } else { whole };
        let radii = rim(&elements(false), edge, mesh.size, [whole, deep], 1.0)?;
        let hole = if open > 0.0 { rim(&elements(true), edge, mesh.size, [open, deep], -1.0) } else { None };
        Some(Self { radii, hole: hole.map_or(open, |radii| mean_radius(&radii)) })
    }

    /// Area in contact, a length squared.
    pub fn area(&self) -> f64 {
        PI * (mean_radius(&self.radii).powi(2) - self.hole * self.hole)
    }
}

/// Whether each element is open and enclosed by contact: not connected over open elements with the sides of the mesh.
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

struct RimFit<'a> {
    elements: &'a [RimElement],
    edge: &'a EdgeRatios,
    /// Side of an element, a length.
    size: f64,
    /// Largest distance of a fitted element from the rim, a length.
    reach: f64,
    /// Depth to which the contact beside the rim is this rim's, a length.
    deep: f64,
    /// 1 where contact is inside the rim, −1 for the hole of a ring.
    sign: f64,
}

/// An element within reach of the rim, its height divided by the edge ratio of the layers, and its distance from the rim over
/// the reach, positive where open.
type Near = (RimElement, f64);

/// Rim of a contact that is open outside (`sign` 1) or inside (−1), fitted from the circle of the `counted` radius; contact
/// deeper than `deep` belongs to another rim; lengths. `None` where the fit fails or departs from the counted radius.
fn rim(
    elements: &[RimElement],
    edge: &EdgeRatios,
    size: f64,
    [counted, deep]: [f64; 2],
    sign: f64,
) -> Option<Vec<f64>> {
    let resolution = counted / size;
    if resolution < MIN_RESOLUTION {
        return None;
    }
    let reach = (WEIGHT_RISE + resolution.sqrt()).min(0.6 * resolution) * size;
    let fit = RimFit { elements, edge, size, reach, deep, sign };
    let mut radii = vec![counted; ANGLES];
    for _ in 0..MAX_ITERATIONS {
        radii = fit.moved(&radii)?;
        let most = MAX_SHIFT * size + MAX_RELATIVE_SHIFT * counted;
        if radii.iter().any(|r| (r - counted).abs() > most) {
            return None;
        }
    }
    ((mean_radius(&radii) - counted).abs() <= COUNTED_ERROR * size).then_some(radii)
}

impl RimFit<'_> {
    /// The line through the root of ψ, fitted to the elements within reach of the line `radii`.
    fn moved(&self, radii: &[f64]) -> Option<Vec<f64>> {
        let near = self.near(radii);
        // Four elements per unknown at least.
        let harmonics = HARMONICS.min(near.len() / 16);
        let slopes = [slopes(&near, harmonics, false)?, slopes(&near, harmonics, true)?];
        let slope = |element: &RimElement| series(&slopes[usize::from(element.open)], element.theta);
        if near.iter().any(|(element, _)| slope(element) <= 0.0) {
            return None;
        }
        let mut fit = SeriesFit::new(vec![harmonics, harmonics, 0, 0, 0]);
        for (element, d) in &near {
            let weight = (d.abs() * self.reach / (WEIGHT_RISE * self.size)).min(1.0);
            let distance = element.height / slope(element) * if element.open { 1.0 } else { -1.0 };
            let factors = [1.0, *d, d.abs(), d * d, d * d.abs()];
            add(&mut fit, &waves(element.theta, 2 * harmonics), factors, distance, weight);
        }
        let (c, count) = (fit.solve()?, 1 + 2 * harmonics);
        let [values, slopes] = [&c[..count], &c[count..2 * count]].map(series_line);
        // ψ increases about as d.
        if !slopes.iter().all(|slope| *slope > 0.2) {
            return None;
        }
        let shift = |(value, slope): (&f64, &f64)| -self.sign * value / slope * self.reach;
        let shifts: Vec<f64> = values.iter().zip(&slopes).map(shift).collect();
        // One iteration moves the line by one element at most.
        Some(closed_line::moved(radii, &shifts, self.size))
    }

    /// The elements within reach of the line `radii`.
    fn near(&self, radii: &[f64]) -> Vec<Near> {
        let bare = |element: &RimElement, distance: f64| {
            let ratio = if element.open {
                self.edge.opening(distance).powf(2.0 / 3.0)
            } else {
                self.edge.pressure(distance).powi(2)
            };
            RimElement { height: element.height / ratio, ..*element }
        };
        self.elements
            .iter()
            .map(|element| (element, self.sign * (element.r - radius(radii, element.theta)) / self.reach))
            .filter(|(element, d)| d.abs() < 1.0 && (element.open || -d * self.reach < self.deep))
            .map(|(element, d)| (bare(element, d.abs() * self.reach), d))
            .collect()
    }
}

/// Fourier series of the slope a, in contact, or b, where `open`, of height ≈ slope |d| (1 + κ|d|).
fn slopes(near: &[Near], harmonics: usize, open: bool) -> Option<Vec<f64>> {
    let mut fit = SeriesFit::new(vec![harmonics, 0]);
    for (element, d) in near.iter().filter(|(element, d)| element.open == open && (*d > 0.0) == open) {
        add(&mut fit, &waves(element.theta, 2 * harmonics), [d.abs(), d * d], element.height, d.abs());
    }
    let mut slopes = fit.solve()?;
    slopes.truncate(1 + 2 * harmonics);
    Some(slopes)
}

/// Adds Σₜ aₜ sₜ(θ) ≈ `value` with the factors aₜ and the weight of its residual.
fn add<const T: usize>(fit: &mut SeriesFit, waves: &[f64], factors: [f64; T], value: f64, weight: f64) {
    let factors = factors.map(|factor| weight * factor);
    let products: Vec<f64> = (0..T).flat_map(|t| (0..=t).map(move |u| factors[t] * factors[u])).collect();
    fit.add(waves, &products, &factors.map(|factor| weight * value * factor));
}

#[cfg(test)]
mod tests {
    use super::super::point::PointKernel;
    use super::*;
    use crate::body::{HalfSpace, Material};

    fn bare() -> EdgeRatios {
        EdgeRatios::new(&PointKernel::new(HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()), 1.0))
    }

    /// Elements of a contact between radii `inner` and 1: near the edges p² = `stiff` times a distance and
    /// g^{2/3} a distance.
    fn fields(mesh: &Mesh, inner: f64, stiff: f64) -> [Vec<f64>; 2] {
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
            let [pressure, gap] = fields(&mesh, 0.4, stiff);
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
