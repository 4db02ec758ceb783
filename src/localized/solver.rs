//! The method from end to end: meshes that fit the contacts, then the coupled solution.

use super::coupled::Coupled;
use super::mesh::Mesh;
use super::setup::{FILLING, Setup};
use super::solution::{Solution, Stop};
use super::spot::Spot;
use super::system::{COARSE_INDENTERS, System};
use crate::body::HalfSpace;
use crate::counterbody::Indenters;
use crate::load::Load;
use crate::problem::Problem;
use std::sync::Arc;

/// Elements along the side of the meshes on which the size of the contacts is found.
const COARSE: usize = 25;

/// A topography has no indenters to draw circles around.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the localized method needs indenters, and a topography has none: solve it with the spectral method alone")]
pub struct NoIndenters;

/// The localized method for a system of indenters.
#[derive(Debug, Clone)]
pub struct Localized {
    system: Arc<System>,
}

impl Localized {
    /// For a problem, with circles of up to `count` indenters.
    ///
    /// # Errors
    /// [`NoIndenters`] for a topography.
    pub fn new(problem: &Problem, count: usize) -> Result<Self, NoIndenters> {
        let indenters = problem.counterbody().indenters().ok_or(NoIndenters)?;
        Ok(Self::of(indenters, problem.half_space(), count))
    }

    pub(super) fn of(indenters: &Indenters, half_space: &HalfSpace, count: usize) -> Self {
        Self { system: Arc::new(System::new(indenters, half_space, count)) }
    }

    /// The indenters and what they press into.
    pub fn system(&self) -> &Arc<System> {
        &self.system
    }

    /// Circles of at least `indenters` (in whole shells) on `mesh`; without mutual effect every indenter is alone.
    pub fn coupled(&self, mesh: Mesh, indenters: usize, mutual_effect: bool) -> Coupled {
        Coupled::new(&self.system, mesh, indenters, mutual_effect)
    }

    /// The mesh with `setup.elements` across the largest contact, and a coarse solution on the way to it: coarse meshes
    /// shrink onto the contacts, with few indenters in the circles.
    pub fn mesh(&self, load: Load, setup: &Setup) -> (Mesh, Solution) {
        let mut mesh = Mesh { width: COARSE, size: self.system.nearest() / COARSE as f64 };
        let mut start = None;
        loop {
            let indenters = setup.indenters.min(COARSE_INDENTERS);
            let solution = self.coupled(mesh, indenters, setup.mutual_effect).solve(load, setup.radius, start.as_ref());
            let radius = solution.spots.iter().map(Spot::counted_radius).fold(0.0, f64::max);
            let loose = 2.0 * radius < 0.5 * FILLING * 2.0 * mesh.half();
            if loose && solution.stop == Stop::Converged && solution.mean_pressure > 0.0 {
                mesh.size = 2.0 * (radius + mesh.size) / FILLING / COARSE as f64;
                start = Some(solution);
                continue;
            }
            // Loads that did not come to rest tell nothing of the contact's size.
            let radius = if solution.stop == Stop::Stalled { FILLING * mesh.half() } else { radius };
            let fine = Mesh {
                width: Setup::width(setup.elements),
                size: 2.0 * radius.max(0.5 * mesh.size) / setup.elements as f64,
            };
            return (fine, solution);
        }
    }

    /// Solves one load step.
    pub fn solve(&self, load: Load, setup: &Setup) -> Solution {
        let (mut mesh, start) = self.mesh(load, setup);
        let most = 2 * mesh.width;
        loop {
            let coupled = self.coupled(mesh, setup.indenters, setup.mutual_effect);
            let solution = coupled.solve(load, setup.radius, Some(&start));
            if solution.stop != Stop::Rim {
                return solution;
            }
            mesh.width = mesh.width * 5 / 4 / 2 * 2 + 1;
            if mesh.width > most {
                // Far larger than thought: as many elements across the contact are twice as large.
                mesh = mesh.halved();
            }
        }
    }
}
