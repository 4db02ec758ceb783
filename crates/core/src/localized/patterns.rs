//! Penetration, loads and pressures between two passes over the levels.

use super::mesh::Mesh;
use super::solution::Solution;

/// Penetration, loads and pressures that the next pass over the levels starts from.
#[derive(Clone)]
pub(super) struct Patterns {
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Load on each spot, a force.
    pub loads: Vec<f64>,
    /// Pressure on the elements of each spot, in the unit of Young's modulus.
    pub pressures: Vec<Vec<f64>>,
}

impl Patterns {
    /// Patterns interpolated from an earlier solution onto the `mesh`; without contact where there is none.
    pub fn new(mesh: Mesh, sites: usize, start: Option<&Solution>) -> Self {
        let mut patterns = Self {
            penetration: start.map_or(0.0, |start| start.penetration),
            loads: vec![0.0; sites],
            pressures: vec![vec![0.0; mesh.elements()]; sites],
        };
        for (m, spot) in start.into_iter().flat_map(|start| &start.spots).enumerate() {
            let carried = (0..mesh.elements()).map(|index| spot.mesh.interpolated(spot.pressures(), mesh.place(index)));
            patterns.pressures[m] = carried.collect();
            let load = patterns.pressures[m].iter().sum::<f64>() * mesh.size * mesh.size;
            patterns.scale(m, if load > 0.0 { spot.load() / load } else { 0.0 }, spot.load());
        }
        patterns
    }

    /// Multiplies the pressure of the spot m by the `factor` that brings it to its new `load`.
    pub fn scale(&mut self, m: usize, factor: f64, load: f64) {
        self.pressures[m].iter_mut().for_each(|p| *p *= factor);
        self.loads[m] = if factor > 0.0 { load } else { 0.0 };
    }
}
