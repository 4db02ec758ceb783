//! The method from end to end: meshes that fit the contacts, then the coupled solution.

use super::circle::CircleRadius;
use super::coupled::Coupled;
use super::mesh::Mesh;
use super::solution::{Solution, Stop};
use super::spot::Spot;
use super::system::{COARSE_INDENTERS, System};
use crate::load::Load;
use crate::problem::Problem;
use std::sync::Arc;

/// Elements along the side of the meshes on which the size of the contacts is found.
const COARSE: usize = 25;

/// Part of a mesh that the largest contact should fill.
const FILLING: f64 = 0.75;

/// What the localized method is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup {
    /// Indenters inside each circle, at least: whole shells are taken.
    pub indenters: usize,
    /// Elements across the largest contact.
    pub elements: usize,
    /// How large the circles are, or what stands outside them.
    pub rule: CircleRadius,
    /// Whether the indenters around the one looked at act on it; if not, each is alone on the half-space.
    pub mutual_effect: bool,
}

impl Setup {
    /// Elements along the side of a mesh with so many across the largest contact.
    pub fn width(elements: usize) -> usize {
        (elements as f64 / FILLING).ceil() as usize / 2 * 2 + 1
    }
}

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
        Ok(Self { system: Arc::new(System::new(indenters, problem.half_space(), count)) })
    }

    /// The indenters and what they press into.
    pub fn system(&self) -> &Arc<System> {
        &self.system
    }

    /// The mesh with `setup.elements` across the largest contact, and a coarse solution on the way to it: coarse meshes
    /// shrink onto the contacts, with few indenters in the circles.
    pub fn mesh(&self, load: Load, setup: &Setup) -> (Mesh, Solution) {
        let mut mesh = Mesh { width: COARSE, size: self.system.nearest() / COARSE as f64 };
        let mut start = None;
        loop {
            let indenters = setup.indenters.min(COARSE_INDENTERS);
            let coupled = Coupled::new(&self.system, mesh, indenters, setup.mutual_effect);
            let solution = coupled.solve(load, setup.rule, start.as_ref());
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
            let coupled = Coupled::new(&self.system, mesh, setup.indenters, setup.mutual_effect);
            let solution = coupled.solve(load, setup.rule, Some(&start));
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
