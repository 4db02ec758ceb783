//! The grid of the series of a pressure, wider than that of the pressure around an isolated contact.

use crate::lattice::{Cell, Grid, Surroundings};
use std::borrow::Cow;
use std::sync::Arc;

/// Sides of the cell of the series over those of the contact's own cell: twice a window, and a periodic cell itself.
pub fn times(cell: Cell) -> usize {
    match cell.surroundings() {
        Surroundings::Periodic => 1,
        Surroundings::FreeSpace => 2,
    }
}

/// Rows and columns of the grid of the series before those of the contact's own grid: half a window of them around an isolated
/// contact, none in a periodic cell.
pub fn samples_before(grid: &Grid) -> [usize; 2] {
    grid.points().map(|n| (times(grid.cell()) - 1) * (n / 2))
}

/// The grid of the series of a pressure on `grid`: that grid in a periodic cell; one of twice the window around an isolated contact.
pub fn series_grid(grid: &Arc<Grid>) -> Arc<Grid> {
    let cell = grid.cell();
    if times(cell) == 1 {
        return Arc::clone(grid);
    }
    let (before, steps) = (samples_before(grid), grid.steps());
    let corner = [0, 1].map(|axis| cell.corner()[axis] - before[axis] as f64 * steps[axis][axis]);
    let sides = [0, 1].map(|axis| 2.0 * cell.vectors()[axis][axis]);
    let wide = Cell::window_at(corner, sides).and_then(|wide| Grid::new(wide, grid.points().map(|n| 2 * n)));
    Arc::new(wide.expect("twice a window is one"))
}

/// A pressure on the grid of its series, zero around the samples of its own grid.
pub fn spread<'a>(grid: &Grid, pressure: &'a [f64]) -> Cow<'a, [f64]> {
    if times(grid.cell()) == 1 {
        return pressure.into();
    }
    let ([n1, n2], before) = (grid.points(), samples_before(grid));
    let mut spread = vec![0.0; 4 * n1 * n2];
    for (i, row) in pressure.chunks_exact(n2).enumerate() {
        spread[(before[0] + i) * 2 * n2 + before[1]..][..n2].copy_from_slice(row);
    }
    spread.into()
}
