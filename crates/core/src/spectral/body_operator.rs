//! The operator of the bodies of a problem: on a periodic cell, or in the window of an isolated contact.

use super::LayeredOperator;
use super::free_space::{bytes_per_sample, bytes_while_made};
use crate::body::Bodies;
use crate::friction::Friction;
use crate::lattice::{Cell, Grid, Surroundings};
use crate::problem::Problem;
use rustfft::num_complex::Complex64;

/// Memory of the operator on a grid, bytes.
#[derive(Debug)]
pub(super) struct OperatorMemory {
    /// Multipliers, per sample.
    pub multipliers: usize,
    /// Spectrum of a convolution, per sample.
    pub spectrum: usize,
    /// Tables while the operator is made.
    pub setup: usize,
}

impl OperatorMemory {
    /// Memory of the operator with `points` on a cell.
    pub fn of(cell: Cell, points: [usize; 2], coupled: bool) -> Self {
        match cell.surroundings() {
            Surroundings::Periodic => Self { multipliers: 4 + 4 * usize::from(coupled), spectrum: 8, setup: 0 },
            Surroundings::FreeSpace => Self {
                multipliers: bytes_per_sample(points, coupled).ceil() as usize,
                spectrum: 3 * 8,
                setup: bytes_while_made(cell, points),
            },
        }
    }
}

impl LayeredOperator {
    /// The operator of a problem on a grid, with its friction, and with the swelling by its heat of which the body has a `share`.
    pub(super) fn of_problem(problem: &Problem, grid: &Grid, share: f64) -> Self {
        let bodies = problem.bodies();
        if problem.motion().is_some() {
            let traction =
                problem.friction().filter(|friction| friction.couples()).map_or([0.0; 2], Friction::traction);
            let heat = problem.heating().filter(|heating| heating.expands()).map(|_| problem.heat_over_pressure());
            let heated = heat.and_then(|heat| Some((problem.heated_bodies().ok()?, heat)));
            let swelling = |wavevector| {
                heated
                    .as_ref()
                    .map_or(Complex64::default(), |(bodies, heat)| bodies.swelling(wavevector, share) * *heat)
            };
            return Self::moving(grid, bodies, [problem.velocity(), traction], swelling);
        }
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
