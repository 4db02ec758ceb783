//! The contact on the way back of a counterbody that goes to and fro.

use super::task::{LifeError, LifeTask};
use crate::counterbody::Surface;
use crate::load::Load;
use crate::problem::Problem;
use crate::spectral::{Solver, Step};
use std::sync::Arc;

/// Solver of the way back; none where the contact there is that of the way there.
#[derive(Debug)]
pub(super) struct WayBack {
    solver: Option<Solver>,
    load: Load,
}

impl LifeTask {
    /// The way back over the bodies of a problem, which tire, on a grid.
    pub(super) fn way_back(&self, problem: &Problem, points: [usize; 2]) -> Result<WayBack, LifeError> {
        let matters = self.stroke.is_some() && problem.bodies().tire();
        let friction = problem.friction().filter(|friction| matters && friction.coefficient() > 0.0);
        // Interfaces that hold a layer against the friction of one direction hold it against the other's.
        let reversed = friction.and_then(|friction| problem.clone().sliding(friction.reversed()).ok());
        let solver = reversed.map(|problem| Solver::new(Arc::new(problem), points, self.settings)).transpose()?;
        Ok(WayBack { solver, load: self.load })
    }
}

impl WayBack {
    /// The contact of a surface on the way back; `None` where it is that of the way there.
    pub fn over(&mut self, surface: &Surface) -> Result<Option<Step>, LifeError> {
        let Some(solver) = self.solver.take() else { return Ok(None) };
        let mut solver = solver.with_gap(surface.initial_gap().to_owned())?;
        let step = solver.solve(self.load);
        self.solver = Some(solver);
        Ok(Some(step))
    }
}
