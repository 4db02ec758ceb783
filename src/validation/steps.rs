//! Load steps that a study rests on: each must have converged.

use super::StudyError;
use crate::case::{Case, Source};
use crate::hierarchy::{Hierarchy, Solution};
use crate::lattice::Cell;
use crate::material::HalfSpace;
use crate::observables::{Observables, observe};
use crate::solver::{Control, Settings};
use crate::texture::Surface;
use std::path::PathBuf;

/// Load steps of one surface on one half-space.
pub struct Steps {
    pub hierarchy: Hierarchy,
}

impl Steps {
    pub fn new(surface: &Surface, half_space: &HalfSpace, points: [usize; 2]) -> Result<Self, StudyError> {
        Ok(Self { hierarchy: Hierarchy::new(surface, half_space, points, Settings::default())? })
    }

    /// The surface of a case on its half-space, on `points` × `points` samples.
    pub fn of(case: &Case, points: usize) -> Result<Self, StudyError> {
        Self::new(case.surface(), case.half_space(), [points; 2])
    }

    /// Solution and observables of the next step; an error unless it converged.
    pub fn solve(&mut self, control: Control) -> Result<(Solution, Observables), StudyError> {
        let solution = self.hierarchy.solve(control, &mut |_| ());
        if !solution.report.stop.solved() {
            return Err(format!("{control:?}: {}", solution.report).into());
        }
        let observables = observe(&self.hierarchy, &solution);
        Ok((solution, observables))
    }

    /// Penetration of the next step alone.
    pub fn penetration(&mut self, mean_pressure: f64) -> Result<f64, StudyError> {
        let solution = self.hierarchy.solve(Control::MeanPressure(mean_pressure), &mut |_| ());
        if !solution.report.stop.solved() {
            return Err(format!("p̄ = {mean_pressure}: {}", solution.report).into());
        }
        Ok(solution.penetration)
    }

    pub fn loaded(&mut self, mean_pressure: f64) -> Result<Observables, StudyError> {
        Ok(self.solve(Control::MeanPressure(mean_pressure))?.1)
    }
}

/// A case file of `validation/`, with overrides `KEY=VALUE`.
pub fn case(name: &str, text: &str, overrides: &[String]) -> Result<Case, StudyError> {
    let source = Source { name: format!("validation/{name}"), text: text.to_owned(), folder: PathBuf::new() };
    Case::read(&source, overrides).map_err(|error| error.render(false).into())
}

/// Topography with the heights h(s₁, s₂) at the samples, s in fractions of the cell vectors.
pub fn topography(cell: Cell, points: [usize; 2], height: impl Fn(f64, f64) -> f64) -> Surface {
    let [n1, n2] = points;
    let place = |index: usize| ((index / n2) as f64 / n1 as f64, (index % n2) as f64 / n2 as f64);
    let heights = (0..n1 * n2).map(place).map(|(s, t)| height(s, t)).collect();
    Surface::Heights { cell, points, heights }
}
