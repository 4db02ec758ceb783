//! One period of a measured or generated surface.

use super::CounterbodyError;
use crate::lattice::Cell;
use crate::numeric::array::samples;
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

    /// Depths below the highest sample, lengths, a₂ fastest.
    pub(super) fn depths(&self) -> Vec<f64> {
        let heights = samples(&self.heights);
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        heights.iter().map(|h| highest - h).collect()
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
        assert_eq!(rows.depths(), columns.depths());
        assert_eq!((rows.points(), rows.heights()[[2, 3]]), ([3, 4], 23.0));
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
