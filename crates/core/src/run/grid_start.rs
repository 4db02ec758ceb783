//! The grid that a recorder is told of when a run begins on it: problem, surface, and the grids in words.

use crate::counterbody::Surface;
use crate::lattice::Grid;
use crate::problem::Problem;
use crate::spectral::{AdhesiveSolver, Solver};
use std::fmt;
use std::sync::Arc;

/// A grid on which a run begins: the problem, the counterbody's surface, and the grids in words.
#[derive(Debug, Clone)]
pub struct GridStart {
    problem: Arc<Problem>,
    surface: Arc<Surface>,
    words: String,
}

impl GridStart {
    /// The problem.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The counterbody's surface on the grid.
    pub fn surface(&self) -> &Arc<Surface> {
        &self.surface
    }

    /// The grid.
    pub fn grid(&self) -> &Arc<Grid> {
        self.surface.grid()
    }
}

impl From<&Solver> for GridStart {
    fn from(solver: &Solver) -> Self {
        let (problem, surface) = (Arc::clone(solver.problem()), Arc::clone(solver.surface()));
        Self { problem, surface, words: solver.to_string() }
    }
}

impl From<&AdhesiveSolver> for GridStart {
    fn from(solver: &AdhesiveSolver) -> Self {
        let (problem, surface) = (Arc::clone(solver.problem()), Arc::clone(solver.surface()));
        Self { problem, surface, words: solver.to_string() }
    }
}

impl fmt::Display for GridStart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}
