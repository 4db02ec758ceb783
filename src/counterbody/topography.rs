use super::CounterbodyError;
use super::roughness::{RunOut, Spectrum, apex};
use crate::lattice::{Cell, LatticeError};
use ndarray::{Array2, ArrayView2};
use std::borrow::Cow;
use std::fmt;

/// One period of a measured or generated topography.
#[derive(Debug, Clone, PartialEq)]
pub struct Topography {
    cell: Cell,
    /// Lengths, in standard layout.
    heights: Array2<f64>,
    run_out: Option<RunOut>,
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
        Ok(Self { cell, heights, run_out: None })
    }

    /// The topography, whose heights were [tapered](super::roughness::tapered), with the run-out at the border of the cell.
    #[must_use]
    pub fn with_run_out(self, run_out: RunOut) -> Self {
        Self { run_out: Some(run_out), ..self }
    }

    /// Run-out at the border of the cell; `None` without a taper.
    pub fn run_out(&self) -> Option<&RunOut> {
        self.run_out.as_ref()
    }

    /// Heights for statistics and spectrum: tapered, but without the run-out below the surface; lengths, axes along a₁ and a₂.
    pub fn own_heights(&self) -> Cow<'_, Array2<f64>> {
        match &self.run_out {
            Some(run_out) => Cow::Owned(run_out.undone(self.heights.clone())),
            None => Cow::Borrowed(&self.heights),
        }
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.cell
    }

    /// Heights, lengths; axes along a₁ and a₂.
    pub fn heights(&self) -> ArrayView2<'_, f64> {
        self.heights.view()
    }

    /// Number of samples [n₁, n₂] along a₁ and a₂.
    pub fn points(&self) -> [usize; 2] {
        self.heights.dim().into()
    }

    /// Depths below the apex on a grid of `points` = [N₁, N₂], lengths ≥ 0: of the [sum of waves](Spectrum::resampled) through all
    /// samples, without those that the grid cannot hold. The apex is the highest point of that sum, also between the samples: all
    /// grids that hold all waves measure from the same point.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn depths(&self, points: [usize; 2]) -> Result<Array2<f64>, LatticeError> {
        let on_grid = match points == self.points() {
            true => self.heights.clone(),
            false => Spectrum::of(self.cell, self.heights.view())?.resampled(points)?,
        };
        let apex = apex(self.cell, on_grid.view())?;
        Ok(on_grid.mapv_into(|height| apex - height))
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
    fn other_grids_have_the_waves_between_the_samples_below_the_same_apex() {
        let wave = |i: usize, n: usize| (std::f64::consts::TAU * (i as f64 / n as f64 - 0.04)).cos();
        let on = |[n1, n2]: [usize; 2]| Array2::from_shape_fn([n1, n2], |(i, j)| wave(i, n1) + 0.2 * wave(j, n2));
        let surface = Topography::new(Cell::hexagonal(1.0).unwrap(), on([12, 6])).unwrap();
        for points in [[12, 6], [4, 3], [30, 18], [7, 5]] {
            let (depths, expected) = (surface.depths(points).unwrap(), on(points));
            // Both crests, of 1 and 0.2, stand between the samples.
            assert!(depths.indexed_iter().all(|(at, d)| (d - (1.2 - expected[at])).abs() < 1e-14), "{points:?}");
        }
        assert!(surface.depths([0, 3]).is_err());
    }

    /// What a grid cannot hold is left out, whether or not it divides the samples.
    #[test]
    fn waves_too_short_for_a_grid_are_left_out_on_every_grid() {
        let wave = |k: usize, i: usize, n: usize| (std::f64::consts::TAU * (k * i) as f64 / n as f64).cos();
        let heights = Array2::from_shape_fn((24, 24), |(i, _)| wave(1, i, 24) + wave(7, i, 24));
        let surface = Topography::new(Cell::square(1.0).unwrap(), heights).unwrap();
        for n in [12, 10] {
            let depths = surface.depths([n, n]).unwrap();
            assert!(depths.indexed_iter().all(|((i, _), d)| (d - (1.0 - wave(1, i, n))).abs() < 1e-13), "{n}");
        }
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
