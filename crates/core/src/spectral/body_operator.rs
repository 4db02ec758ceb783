//! The operator of the bodies of a problem: on a periodic cell, or in the window of an isolated contact.

use super::LayeredOperator;
use crate::body::Bodies;
use crate::lattice::{Grid, Surroundings};
use crate::problem::Problem;

impl LayeredOperator {
    /// The operator of a problem on a grid, with its friction.
    pub(super) fn of_problem(problem: &Problem, grid: &Grid) -> Self {
        let bodies = problem.bodies();
        match (grid.cell().surroundings(), problem.friction()) {
            (Surroundings::Periodic, Some(friction)) => Self::sliding(grid, bodies, friction),
            (Surroundings::Periodic, None) => Self::new(grid, bodies),
            (Surroundings::FreeSpace, Some(friction)) => Self::sliding_in_free_space(grid, bodies, friction),
            (Surroundings::FreeSpace, None) => Self::in_free_space(grid, bodies),
        }
    }

    /// Σ wᵢ Cᵢ of several bodies on a grid, without friction; only to displace.
    pub(super) fn of_bodies(grid: &Grid, bodies: &[(f64, &Bodies)]) -> Self {
        match grid.cell().surroundings() {
            Surroundings::Periodic => Self::combined(grid, bodies),
            Surroundings::FreeSpace => Self::combined_in_free_space(grid, bodies),
        }
    }
}
