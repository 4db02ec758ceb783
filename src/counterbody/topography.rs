//! One period of a measured or generated surface.

use super::CounterbodyError;
use super::roughness::Spectrum;
use crate::lattice::{Cell, LatticeError};
use ndarray::{Array2, ArrayView2};
use std::fmt;

/// One period of a measured or generated topography.
#[derive(Debug, Clone, PartialEq)]
pub struct Topography {
    cell: Cell,
    /// In standard layout.
    heights: Array2<f64>,
}

impl Topography {
    /// Topography on `cell` with `heights` (lengths, protrusion upward) at equally spaced samples: axis 0 along a₁,
    /// axis 1 along a₂, sample \[0, 0\] at the origin.
    ///
    /// # Errors
    /// [`CounterbodyError::Empty`] without heights, [`CounterbodyError::Height`] for one that is not finite.
    pub fn new(cell: Cell, heights: Array2<f64>) -> Result<Self, CounterbodyError> {
        let (n1, n2) = heights.dim();
        if heights.is_empty() {
            return Err(CounterbodyError::Empty(n1, n2));
        }
        if let Some(((i, j), &value)) = heights.indexed_iter().find(|(_, height)| !height.is_finite()) {
            return Err(CounterbodyError::Height { place: [i, j], value });
        }
        let heights = if heights.is_standard_layout() { heights } else { heights.as_standard_layout().into_owned() };
        Ok(Self { cell, heights })
    }

    /// The cell.
    pub fn cell(&self) -> Cell {
        self.cell
    }

    /// Heights, lengths; axes along a₁ and a₂.
    pub fn heights(&self) -> ArrayView2<'_, f64> {
        self.heights.view()
    }

    /// Samples [n₁, n₂] along a₁ and a₂.
    pub fn points(&self) -> [usize; 2] {
        self.heights.dim().into()
    }

    /// Depths below the highest sample on a grid of `points` = [N₁, N₂], lengths: every k-th sample where the grid has a
    /// whole fraction of them along either direction, else the [sum of waves](Spectrum::resampled) through all.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn depths(&self, points: [usize; 2]) -> Result<Array2<f64>, LatticeError> {
        let own = self.points();
        let on_grid = if (0..2).all(|axis| points[axis] > 0 && own[axis].is_multiple_of(points[axis])) {
            let [every1, every2] = [0, 1].map(|axis| own[axis] / points[axis]);
            Array2::from_shape_fn(points, |(i, j)| self.heights[[every1 * i, every2 * j]])
        } else {
            Spectrum::of(self.cell, self.heights.view())?.resampled(points)?
        };
        // Between its samples the surface may rise above them.
        let all = self.heights.iter().chain(&on_grid);
        let highest = all.copied().fold(f64::NEG_INFINITY, f64::max);
        Ok(on_grid.mapv_into(|height| highest - height))
    }
}

impl fmt::Display for Topography {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [n1, n2] = self.points();
        write!(f, "{}, topography of {n1} × {n2} samples", self.cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::ShapeBuilder;

    #[test]
    fn heights_keep_their_places_in_any_memory_order() {
        let cell = Cell::square(1.0).unwrap();
        let height = |(i, j): (usize, usize)| (10 * i + j) as f64;
        let rows = Topography::new(cell, Array2::from_shape_fn((3, 4), height)).unwrap();
        let columns = Topography::new(cell, Array2::from_shape_fn((3, 4).f(), height)).unwrap();
        assert_eq!(rows.depths([3, 4]), columns.depths([3, 4]));
        assert_eq!((rows.points(), rows.heights()[[2, 3]]), ([3, 4], 23.0));
    }

    #[test]
    fn a_coarser_grid_takes_every_kth_sample_and_a_finer_one_the_waves_between() {
        let wave = |i: usize, n: usize| (std::f64::consts::TAU * (i as f64 / n as f64 - 0.04)).cos();
        let heights = Array2::from_shape_fn((12, 6), |(i, j)| wave(i, 12) + 0.2 * wave(j, 6));
        let surface = Topography::new(Cell::hexagonal(1.0).unwrap(), heights.clone()).unwrap();
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!(
            surface.depths([4, 3]).unwrap().indexed_iter().all(|((i, j), d)| *d == highest - heights[[3 * i, 2 * j]])
        );
        let finer = surface.depths([30, 18]).unwrap();
        let expected = Array2::from_shape_fn((30, 18), |(i, j)| wave(i, 30) + 0.2 * wave(j, 18));
        let apex = expected.iter().copied().fold(highest, f64::max);
        assert!(finer.indexed_iter().all(|(at, d)| (d - (apex - expected[at])).abs() < 1e-14 && *d >= 0.0));
        assert!(surface.depths([0, 3]).is_err());
    }

    #[test]
    fn empty_and_infinite_heights_are_refused() {
        let cell = Cell::square(1.0).unwrap();
        assert_eq!(Topography::new(cell, Array2::zeros((0, 4))), Err(CounterbodyError::Empty(0, 4)));
        let mut heights = Array2::zeros((2, 2));
        heights[[1, 0]] = f64::INFINITY;
        let refused = CounterbodyError::Height { place: [1, 0], value: f64::INFINITY };
        assert_eq!(Topography::new(cell, heights), Err(refused));
    }
}
