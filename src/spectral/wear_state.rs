//! Surfaces, pressures and worn depths of a solver at a moment, to which it may return.

use super::Solver;
use super::iteration::Unknowns;
use super::worn::Worn;
use crate::counterbody::Surface;
use std::sync::Arc;

/// Surfaces, pressures and worn depths of a [`Solver`], to which it may return. It shares its fields with the solver, which copies them
/// while it wears on: on all grids pressure, gap and initial gap, and the worn depths.
#[derive(Debug, Clone)]
pub struct WearState {
    levels: Vec<(Arc<Surface>, Unknowns)>,
    worn: Option<Worn>,
}

impl Solver {
    /// What sliding has worn off both surfaces; `None` before the first step of [wear](Self::wear).
    pub fn worn(&self) -> Option<&Worn> {
        self.worn.as_ref()
    }

    /// The present surfaces, pressures and worn depths.
    pub fn wear_state(&self) -> WearState {
        let level = |level: &super::grid_level::GridLevel| (Arc::clone(level.surface()), level.unknowns().clone());
        WearState { levels: self.levels.iter().map(level).collect(), worn: self.worn.clone() }
    }

    /// Returns to surfaces, pressures and worn depths of an earlier moment of this solver.
    ///
    /// # Panics
    /// When they are those of a solver on other grids.
    pub fn return_to(&mut self, state: WearState) {
        assert_eq!(state.levels.len(), self.levels.len(), "surfaces of another solver");
        for (level, (surface, unknowns)) in self.levels.iter_mut().zip(state.levels) {
            assert_eq!(surface.grid().points(), level.points(), "surfaces of another solver");
            level.set_surface(surface);
            level.set_unknowns(unknowns);
        }
        self.worn = state.worn;
    }
}
