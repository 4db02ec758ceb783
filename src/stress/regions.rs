use crate::lattice::Grid;
use crate::lattice::components::{contact_spots, open_regions};
use std::f64::consts::PI;

/// Contact spots of a pressure and the open regions around and inside them.
#[derive(Debug)]
pub(super) struct Regions {
    /// Index of the spot or open region of each sample; spots come first.
    pub of: Vec<u32>,
    /// Number of spots.
    count: u32,
    /// Number of samples of each spot and open region.
    sizes: Vec<usize>,
}

impl Regions {
    /// Spots and open regions of a `pressure`, one value per sample.
    pub fn new(grid: &Grid, pressure: &[f64]) -> Self {
        let mut of = vec![0; grid.len()];
        let mut all = contact_spots(grid, pressure);
        let count = all.len() as u32;
        all.extend(open_regions(grid, pressure));
        for (number, spot) in (0..).zip(&all) {
            spot.indices(grid).for_each(|run| of[run].fill(number));
        }
        Self { of, count, sizes: all.iter().map(|spot| spot.size()).collect() }
    }

    /// Whether contact has an edge: it is neither complete nor absent.
    pub fn have_edges(&self) -> bool {
        0 < self.count && (self.count as usize) < self.sizes.len()
    }

    /// Whether a sample is in contact.
    pub fn touches(&self, sample: usize) -> bool {
        self.of[sample] < self.count
    }

    /// Samples along the radius of a disc as large as the spot or open region of a sample.
    pub fn resolution(&self, sample: usize) -> f64 {
        (self.sizes[self.of[sample] as usize] as f64 / PI).sqrt()
    }

    /// Samples along the radius of a disc as large as the smallest spot; infinite without contact.
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
