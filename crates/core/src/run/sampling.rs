//! The sampling of the cell: a grid, or an accuracy.

use super::accuracy::{Refinement, TooOblong};
use crate::lattice::Cell;
use serde::Serialize;

/// The grids of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampling {
    /// One grid, with numbers of samples along a₁ and a₂.
    Points([usize; 2]),
    /// Finer and finer grids, until peak pressures, loads, penetration, stresses and passes to the first damage change by less than
    /// this, relatively.
    Accuracy(f64),
}

impl Sampling {
    /// The grids of a run on a cell, the coarsest first: the prescribed one, or [those of a refinement](Refinement::grids).
    ///
    /// # Errors
    /// [`TooOblong`] when a refinement has no grid.
    pub fn grids(self, cell: &Cell) -> Result<Vec<[usize; 2]>, TooOblong> {
        match self {
            Self::Points(points) => Ok(vec![points]),
            Self::Accuracy(_) => Refinement::grids(cell),
        }
    }
}
