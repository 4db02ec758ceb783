//! Contact spots and what is open between them, as the surface stresses see them.

use crate::lattice::components::components;
use crate::lattice::{Grid, Joined};
use std::f64::consts::PI;

/// The spots of a periodic grid and the open places around and inside them.
#[derive(Debug)]
pub(super) struct Regions {
    /// Per sample, the index of its spot or open place: spots first.
    pub of: Vec<u32>,
    /// Number of spots.
    count: u32,
    /// Number of samples of each spot and open place.
    sizes: Vec<usize>,
}

impl Regions {
    /// Spots of a `pressure`.
    pub fn new(grid: &Grid, pressure: &[f64]) -> Self {
        let mut of = vec![0; grid.len()];
        let mut all = components(grid, Joined::AtCorners, |index| pressure[index] > 0.0);
        let count = all.len() as u32;
        all.extend(components(grid, Joined::AtEdges, |index| pressure[index] <= 0.0));
        for (number, spot) in (0..).zip(&all) {
            spot.indices(grid).for_each(|run| of[run].fill(number));
        }
        Self { of, count, sizes: all.iter().map(|spot| spot.size()).collect() }
    }

    /// Whether contact ends anywhere.
    pub fn have_edges(&self) -> bool {
        0 < self.count && (self.count as usize) < self.sizes.len()
    }

    /// Whether a sample is in contact.
    pub fn touches(&self, sample: usize) -> bool {
        self.of[sample] < self.count
    }

    /// Samples along the radius of a disc as large as the spot or open place of a sample.
    pub fn resolution(&self, sample: usize) -> f64 {
        (self.sizes[self.of[sample] as usize] as f64 / PI).sqrt()
    }

    /// The least resolution of all spots.
    pub fn least_resolution(&self) -> f64 {
        let least = self.sizes[..self.count as usize].iter().min();
        least.map_or(f64::INFINITY, |&size| (size as f64 / PI).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    #[test]
    fn spots_have_the_resolutions_of_discs_as_large() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [6, 8]).unwrap();
        let mut pressure = [0.0; 48];
        for [row, column] in [[0, 0], [5, 0], [0, 7], [5, 7], [2, 3], [2, 4], [3, 4]] {
            pressure[row * 8 + column] = 1.0;
        }
        let regions = Regions::new(&grid, &pressure);
        assert_eq!((regions.sizes.as_slice(), regions.count, regions.of[5 * 8 + 7]), ([4, 3, 41].as_slice(), 2, 0));
        assert!(
            regions.touches(0) && !regions.touches(1) && (regions.resolution(1) - (41.0 / PI).sqrt()).abs() < 1e-15
        );
        assert!((regions.least_resolution() - (3.0 / PI).sqrt()).abs() < 1e-15 && regions.have_edges());
        assert!(!Regions::new(&grid, &[1.0; 48]).have_edges());
    }
}
