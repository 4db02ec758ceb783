//! Contact spots and the open regions between and inside them, with the number of samples that resolves each.

use crate::lattice::Grid;
use crate::lattice::components::{contact_spots, open_regions};
use std::f64::consts::PI;

/// Contact spots of a pressure and the open regions around and inside them.
#[derive(Debug, Clone)]
pub(super) struct Regions {
    /// Index of the spot or open region of each sample; spots come first.
    pub of: Vec<u32>,
    /// Number of spots.
    count: u32,
    /// Number of samples of each spot and open region.
    sizes: Vec<usize>,
    /// Largest ringing of waves of the grid on the surface under a given pressure, a pressure; `None` of a contact,
    /// whose pressure vanishes at its edge like a power of the distance.
    ringing: Option<f64>,
    /// Number of samples along lines on which nothing changes; `None` where there are none.
    along_lines: Option<usize>,
    /// Whether the waves of the pressure are known whatever the samples are, see [`super::series::Series::coefficients`].
    is_exact: bool,
}

/// Overshoot of the waves of a grid beside a jump, over the jump (Gibbs).
const OVERSHOOT: f64 = 0.09;

impl Regions {
    /// Spots and open regions of a `pressure`, one value per sample, that is constant along an axis `line`.
    pub fn new(grid: &Grid, pressure: &[f64], line: Option<usize>) -> Self {
        let mut of = vec![0; grid.len()];
        let mut all = contact_spots(grid, pressure);
        let count = all.len() as u32;
        all.extend(open_regions(grid, pressure));
        for (number, spot) in (0..).zip(&all) {
            spot.indices(grid).for_each(|run| of[run].fill(number));
        }
        Self {
            of,
            count,
            sizes: all.iter().map(|spot| spot.size()).collect(),
            ringing: None,
            along_lines: line.map(|axis| grid.points()[axis]),
            is_exact: false,
        }
    }

    /// The regions of a pressure that is not of a contact: it may end with a jump, and has no edges. `is_exact`: its waves are known.
    #[must_use]
    pub fn without_edges(self, grid: &Grid, pressure: &[f64], is_exact: bool) -> Self {
        let [n1, n2] = grid.points();
        // From a sample to the one after the next: one between them may have a part of the jump.
        let jump = |index: usize| {
            let (i, j) = (index / n2, index % n2);
            let [along, across] = [(i + 2) % n1 * n2 + j, i * n2 + (j + 2) % n2];
            (pressure[index] - pressure[along]).abs().max((pressure[index] - pressure[across]).abs())
        };
        let jumps = (0..pressure.len()).map(jump).fold(0.0, f64::max);
        Self { ringing: Some(OVERSHOOT * jumps), is_exact, ..self }
    }

    /// Largest ringing of stresses on the surface beside jumps of a given pressure, a pressure; zero under a contact.
    pub fn ringing(&self) -> f64 {
        self.ringing.unwrap_or(0.0)
    }

    /// Whether contact has an edge: it is neither complete nor absent, nor a pressure that is given.
    pub fn have_edges(&self) -> bool {
        self.ringing.is_none() && 0 < self.count && (self.count as usize) < self.sizes.len()
    }

    /// Whether a sample is in contact.
    pub fn touches(&self, sample: usize) -> bool {
        self.of[sample] < self.count
    }

    /// Samples along the radius of a disc as large as the spot or open region of a sample, or along half the width of a line.
    pub fn resolution(&self, sample: usize) -> f64 {
        self.samples_along(self.sizes[self.of[sample] as usize])
    }

    /// Samples along the radius of a disc of `size` samples, or along half the width of a line.
    fn samples_along(&self, size: usize) -> f64 {
        match self.along_lines {
            Some(along) => 0.5 * size as f64 / along as f64,
            None => (size as f64 / PI).sqrt(),
        }
    }

    /// Whether the waves of the pressure are known, so that below the surface its samples leave nothing open.
    pub fn is_exact(&self) -> bool {
        self.is_exact
    }

    /// Samples along the radius of a disc as large as the smallest spot, or along half the width of a line; infinite without contact.
    pub fn least_resolution(&self) -> f64 {
        let least = self.sizes[..self.count as usize].iter().min();
        least.map_or(f64::INFINITY, |&size| self.samples_along(size))
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
        let regions = Regions::new(&grid, &pressure, None);
        assert_eq!((regions.sizes.as_slice(), regions.count, regions.of[5 * 8 + 7]), ([4, 3, 41].as_slice(), 2, 0));
        assert!(
            regions.touches(0) && !regions.touches(1) && (regions.resolution(1) - (41.0 / PI).sqrt()).abs() < 1e-15
        );
        assert!((regions.least_resolution() - (3.0 / PI).sqrt()).abs() < 1e-15 && regions.have_edges());
        assert!(!Regions::new(&grid, &[1.0; 48], None).have_edges());
    }
}
