//! State of a solver during wear: initial gaps, permanent depths, pressures and worn depths. The solver may return to it.

use super::grid_level::{GridLevel, Indented};
use super::iteration::Unknowns;
use super::wear::on_grids;
use super::worn::Worn;
use super::{Solver, Wear, WearError};
use crate::counterbody::Surface;
use ndarray::Array2;
use std::sync::Arc;

/// State of a [`Solver`] during wear, to which it may return: on all grids initial gap, permanent depths, pressure and gap, and the worn
/// depths. It shares its fields with the solver, which copies them while it wears on.
#[derive(Debug, Clone)]
pub struct WearState {
    levels: Vec<LevelState>,
    worn: Option<Worn>,
}

/// State of one grid.
#[derive(Debug, Clone)]
struct LevelState {
    surface: Arc<Surface>,
    indented: Option<Indented>,
    unknowns: Unknowns,
}

impl WearState {
    /// Pressure on the finest grid, one value per sample, a₂ fastest.
    pub fn pressure(&self) -> &[f64] {
        &self.levels[0].unknowns.pressure
    }
}

impl Solver {
    /// Depths that sliding has worn off both surfaces; `None` before the first step of [wear](Self::wear).
    pub fn worn(&self) -> Option<&Worn> {
        self.worn.as_ref()
    }

    /// The present surfaces, pressures and worn depths.
    pub fn wear_state(&self) -> WearState {
        let level = |level: &GridLevel| LevelState {
            surface: Arc::clone(level.surface()),
            indented: level.indented().cloned(),
            unknowns: level.unknowns().clone(),
        };
        WearState { levels: self.levels.iter().map(level).collect(), worn: self.worn.clone() }
    }

    /// Wears both surfaces by the pressures of earlier moments, over a `distance` of sliding (which may be negative) under each. The
    /// pressure on the surfaces stays, as the start of the next load.
    ///
    /// # Errors
    /// [`WearError`] for a direction that the window does not allow.
    ///
    /// # Panics
    /// When the moments are those of a solver on other grids.
    pub fn wear_by(&mut self, moments: &[(&WearState, f64)], wear: &Wear) -> Result<(), WearError> {
        let on_grids = on_grids(self, wear, 1.0)?;
        let sums: Vec<Vec<f64>> = (0..self.levels.len()).map(|level| weighted(moments, level)).collect();
        let distance = moments.iter().map(|(_, distance)| distance).sum();
        self.wear_off(&on_grids, |number, _| sums[number].clone(), distance);
        Ok(())
    }

    /// Depth that the pressures of moments wear off both surfaces together on the finest grid, over a distance of sliding (which may be
    /// negative) under each.
    ///
    /// # Errors
    /// [`WearError`] as for [`Self::wear_by`].
    pub fn depth_by(&self, moments: &[(&WearState, f64)], wear: &Wear) -> Result<Array2<f64>, WearError> {
        let compliance = wear.compliance(1.0, self.grid())?;
        let mut depth = Array2::zeros(self.grid().points());
        compliance.displacements(&weighted(moments, 0)).iter().flatten().for_each(|worn| depth += worn);
        Ok(depth)
    }

    /// Returns to surfaces, pressures and worn depths of an earlier moment of this solver.
    ///
    /// # Panics
    /// When they are those of a solver on other grids.
    pub fn return_to(&mut self, state: WearState) {
        self.return_to_surfaces(&state);
        for (level, level_state) in self.levels.iter_mut().zip(state.levels) {
            level.set_unknowns(level_state.unknowns);
        }
    }

    /// Returns to surfaces and worn depths of an earlier moment of this solver; the pressure stays, as the start of the next load.
    ///
    /// # Panics
    /// When they are those of a solver on other grids.
    pub fn return_to_surfaces(&mut self, state: &WearState) {
        assert_eq!(state.levels.len(), self.levels.len(), "surfaces of another solver");
        for (level, level_state) in self.levels.iter_mut().zip(&state.levels) {
            assert_eq!(level_state.surface.grid().points(), level.points(), "surfaces of another solver");
            level.set_surface(Arc::clone(&level_state.surface), level_state.indented.clone());
        }
        self.worn = state.worn.clone();
    }
}

/// Σ s p of moments on one grid, a pressure times a length.
fn weighted(moments: &[(&WearState, f64)], level: usize) -> Vec<f64> {
    let len = moments.first().map_or(0, |(state, _)| state.levels[level].unknowns.pressure.len());
    let of =
        |i: usize| moments.iter().map(|(state, distance)| distance * state.levels[level].unknowns.pressure[i]).sum();
    (0..len).map(of).collect()
}
