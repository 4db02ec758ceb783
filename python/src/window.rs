//! The part of the surface that a map of `percoat.plot` shows: that of the command line's pictures.

use crate::errors::refused;
use numpy::PyReadonlyArray2;
use percoat::picture;
use percoat::{Cell, Grid};
use pyo3::prelude::*;

/// First and last x, first and last y of the window, lengths: of an isolated contact around the samples that are `seen` (n₁, n₂), with a
/// margin; else cells side by side under levels of indenters, and one cell of a topography.
#[pyfunction]
pub fn window(
    vectors: [[f64; 2]; 2],
    isolated: bool,
    has_levels: bool,
    seen: PyReadonlyArray2<'_, bool>,
) -> PyResult<(f64, f64, f64, f64)> {
    let seen = seen.as_array();
    let [a1, a2] = vectors;
    let cell = if isolated { Cell::window([a1[0], a2[1]]) } else { Cell::new(a1, a2) };
    let (n1, n2) = seen.dim();
    let grid = Grid::new(cell.map_err(refused)?, [n1, n2]).map_err(refused)?;
    let [[x0, x1], [y0, y1]] = picture::view(&grid, has_levels, |index| seen[[index / n2, index % n2]]).window;
    Ok((x0, x1, y0, y1))
}
