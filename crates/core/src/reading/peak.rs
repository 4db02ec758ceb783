//! Peak pressure between the samples, and its distance from the edge of contact.

use crate::adhesion::Adhesion;
use crate::lattice::Grid;
use crate::numeric::paraboloid;
use crate::spectral::Contact;

/// Pressure at the top of the paraboloid through the 3 × 3 samples around the one with a flat index, at most the hardness; the sample's
/// own pressure next to the contact edge, and where there is no top nearby.
pub fn interpolated(contact: &Contact, index: usize) -> f64 {
    let (pressure, [n1, n2]) = (contact.pressures(), contact.grid().points());
    let (row, column) = ((index / n2) as i32, (index % n2) as i32);
    let wrapped = |k: i32, n: usize| k.rem_euclid(n as i32) as usize;
    let at = |i: i32, j: i32| pressure[wrapped(row + i, n1) * n2 + wrapped(column + j, n2)];
    // The paraboloid is shifted to pass through the sample.
    (pressure[index] + paraboloid::rise(1, at).unwrap_or(0.0)).min(contact.hardness())
}

/// A pressure of contact less the tension between surfaces that adhere and touch.
pub fn net(contact: &Contact, pressure: f64) -> f64 {
    pressure - contact.tensions().and(contact.problem().adhesion()).map_or(0.0, Adhesion::strength)
}

/// Distance from the edge, in samples, at which a ridge along it is resolved: an edge farther away is not searched.
const RESOLVED: f64 = 64.0;

/// Distance in samples from the one with a flat index to the edge of contact; `farthest` at most, and where no edge is near. Under a
/// stiff coating the pressure is highest in a ridge along the edge, which many samples along the contact radius may not resolve.
pub fn samples_to_edge(grid: &Grid, pressure: &[f64], index: usize, farthest: f64) -> f64 {
    let [n1, n2] = grid.points().map(|n| n as i32);
    let (row, column) = (index as i32 / n2, index as i32 % n2);
    let [e1, e2] = grid.steps();
    let side = grid.sample_area().sqrt();
    let is_open =
        |i: i32, j: i32| pressure[((row + i).rem_euclid(n1) * n2 + (column + j).rem_euclid(n2)) as usize] <= 0.0;
    let samples = |i: i32, j: i32| {
        let [i, j] = [i, j].map(f64::from);
        (i * e1[0] + j * e2[0]).hypot(i * e1[1] + j * e2[1]) / side
    };
    // Rings of samples around the peak: the nearest open sample of the first ring that has any.
    let ring = |k: i32| {
        let sides = (-k..=k).flat_map(move |t| [(-k, t), (k, t), (t, -k), (t, k)]);
        sides.filter(|&(i, j)| is_open(i, j)).map(|(i, j)| samples(i, j)).reduce(f64::min)
    };
    let edge = (1..=farthest.min(RESOLVED).ceil() as i32).find_map(ring).unwrap_or(farthest);
    edge.min(farthest)
}
