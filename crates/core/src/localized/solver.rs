//! The localized method: meshes that fit the contacts, then the coupled solution.

use super::circle::CircleRadius;
use super::coupled::Coupled;
use super::mesh::Mesh;
use super::solution::{Solution, Stop};
use super::spot::Spot;
use super::system::{COARSE_INDENTERS, System};
use crate::counterbody::Indenters;
use crate::load::Load;
use crate::problem::Problem;
use std::sync::Arc;

/// Number of elements along the side of the meshes on which the size of the contacts is found.
const COARSE_WIDTH: usize = 25;

/// Part of the mesh's side that the largest contact should fill.
const FILLED_PART: f64 = 0.75;

/// Circles and elements of the localized method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup {
    /// Least number of indenters inside each circle; whole shells are taken.
    pub indenters: usize,
    /// Number of elements across the largest contact.
    pub elements: usize,
    /// Rule for the radius of the circles, or for what acts outside them.
    pub rule: CircleRadius,
    /// Whether indenters act on each other; if not, each is alone on the half-space.
    pub mutual_effect: bool,
}

impl Setup {
    /// Number of elements along the side of a mesh with `elements` across the largest contact.
    pub fn width(elements: usize) -> usize {
        (elements as f64 / FILLED_PART).ceil() as usize / 2 * 2 + 1
    }
}

/// Why the localized method cannot solve a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum LocalizedError {
    /// A topography and a given pressure have no indenters for the circles.
    #[error("the localized method needs indenters, and there are none: solve it with the spectral method alone")]
    NoIndenters,
    /// Far from the circle the body is taken for an elastic half-space.
    #[error(
        "the localized method takes the body for an elastic half-space far from the circle, and layers on a rigid base are none: solve \
         it with the spectral method alone"
    )]
    RigidBase,
}

/// The localized method for a system of indenters.
#[derive(Debug, Clone)]
pub struct Localized {
    system: Arc<System>,
}

impl Localized {
    /// The method for a problem, with circles of up to `count` indenters.
    ///
    /// # Errors
    /// [`LocalizedError`] for a topography or a given pressure, and for a body on a rigid base.
    pub fn new(problem: &Problem, count: usize) -> Result<Self, LocalizedError> {
        let indenters = Self::solvable(problem)?;
        Ok(Self { system: Arc::new(System::new(indenters, problem.bodies(), count)) })
    }

    /// The indenters of a problem that the method can solve.
    pub(crate) fn solvable(problem: &Problem) -> Result<&Indenters, LocalizedError> {
        match problem.indenters() {
            None => Err(LocalizedError::NoIndenters),
            Some(_) if problem.bodies().has_rigid_base() => Err(LocalizedError::RigidBase),
            Some(indenters) => Ok(indenters),
        }
    }

    /// The indenters and the half-space.
    pub fn system(&self) -> &Arc<System> {
        &self.system
    }

    /// The mesh with `setup.elements` across the largest contact, and the coarse solution from which its size is taken: coarse
    /// meshes shrink onto the contacts, with few indenters in the circles.
    pub fn mesh(&self, load: Load, setup: &Setup) -> (Mesh, Solution) {
        let mut mesh = Mesh { width: COARSE_WIDTH, size: self.system.nearest() / COARSE_WIDTH as f64 };
        let mut start = None;
        loop {
            let indenters = setup.indenters.min(COARSE_INDENTERS);
            let coupled = Coupled::new(&self.system, mesh, indenters, setup.mutual_effect);
            let solution = coupled.solve(load, setup.rule, start.as_ref());
            let radius = solution.spots.iter().map(Spot::counted_radius).fold(0.0, f64::max);
            let loose = 2.0 * radius < 0.5 * FILLED_PART * 2.0 * mesh.half();
            if loose && solution.stop == Stop::Converged && solution.mean_pressure > 0.0 {
                mesh.size = 2.0 * (radius + mesh.size) / FILLED_PART / COARSE_WIDTH as f64;
                start = Some(solution);
                continue;
            }
            // A solution that has not converged does not give the size of the contact.
            let radius = if solution.stop == Stop::Stalled { FILLED_PART * mesh.half() } else { radius };
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
            let coupled = Coupled::new(&self.system, mesh, setup.indenters, setup.mutual_effect);
            let solution = coupled.solve(load, setup.rule, Some(&start));
            if solution.stop != Stop::Rim {
                return solution;
            }
            mesh.width = mesh.width * 5 / 4 / 2 * 2 + 1;
            if mesh.width > most {
                // The contact is far larger than estimated: elements of twice the size.
                mesh = mesh.halved();
            }
        }
    }
}
