//! Contact spots: connected samples in contact, whatever indenter they belong to.

use std::f64::consts::PI;

/// The spots of a periodic grid.
#[derive(Debug)]
pub(super) struct Spots {
    /// Per sample, the index of its spot; `None` outside contact.
    pub of: Vec<Option<u32>>,
    /// Per spot, its number of samples.
    pub sizes: Vec<usize>,
}

impl Spots {
    /// Spots of a `pressure` on a grid of `points`; samples that touch at a corner are one spot.
    pub fn new([n1, n2]: [usize; 2], pressure: &[f64]) -> Self {
        let mut of = vec![None; pressure.len()];
        let mut sizes = Vec::new();
        let mut waiting = Vec::new();
        for start in 0..pressure.len() {
            if pressure[start] <= 0.0 || of[start].is_some() {
                continue;
            }
            let spot = sizes.len() as u32;
            of[start] = Some(spot);
            waiting.push(start);
            let mut size = 0;
            while let Some(index) = waiting.pop() {
                size += 1;
                for next in neighbours([n1, n2], index) {
                    if pressure[next] > 0.0 && of[next].is_none() {
                        of[next] = Some(spot);
                        waiting.push(next);
                    }
                }
            }
            sizes.push(size);
        }
        Self { of, sizes }
    }

    /// Whether contact ends anywhere.
    pub fn have_edges(&self) -> bool {
        !self.sizes.is_empty() && self.of.iter().any(Option::is_none)
    }

    /// Samples along the radius of a disc as large as a spot.
    pub fn resolution(&self, spot: u32) -> f64 {
        (self.sizes[spot as usize] as f64 / PI).sqrt()
    }

    /// The least of all resolutions.
    pub fn least_resolution(&self) -> f64 {
        (0..self.sizes.len() as u32).map(|spot| self.resolution(spot)).fold(f64::INFINITY, f64::min)
    }
}

/// The eight samples around one.
pub(super) fn neighbours([n1, n2]: [usize; 2], index: usize) -> impl Iterator<Item = usize> {
    let (row, column) = (index / n2, index % n2);
    (0..9).filter(|&k| k != 4).map(move |k| (row + n1 + k / 3 - 1) % n1 * n2 + (column + n2 + k % 3 - 1) % n2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spots_reach_across_the_border_of_the_cell_and_over_corners() {
        // Two spots: one over the corner of the cell, one of three samples along a diagonal.
        let mut pressure = [0.0; 48];
        for [row, column] in [[0, 0], [5, 0], [0, 7], [5, 7], [2, 3], [3, 4], [4, 5]] {
            pressure[row * 8 + column] = 1.0;
        }
        let spots = Spots::new([6, 8], &pressure);
        assert_eq!(spots.sizes, [4, 3]);
        assert_eq!(spots.of[5 * 8 + 7], Some(0));
        assert!((spots.least_resolution() - (3.0 / PI).sqrt()).abs() < 1e-15 && spots.have_edges());
        assert!(!Spots::new([6, 8], &[1.0; 48]).have_edges());
    }
}
