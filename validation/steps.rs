//! Load steps of a study, each of which must have converged.

use super::StudyError;
use ndarray::Array2;
use percoat_case::case::{Case, Source};
use percoat_core::body::Bodies;
use percoat_core::counterbody::{LoadedBy, Topography};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::reading::Reading;
use percoat_core::spectral::{Settings, Solver, Step};
use std::sync::Arc;

/// Load steps of one problem.
pub struct Steps {
    pub solver: Solver,
}

impl Steps {
    pub fn new(
        counterbody: impl Into<LoadedBy>,
        bodies: impl Into<Bodies>,
        points: [usize; 2],
    ) -> Result<Self, StudyError> {
        Self::to(Problem::new(counterbody, bodies), points, Settings::default().tolerance)
    }

    /// The steps of a problem, solved to a tolerance.
    pub fn to(problem: Problem, points: [usize; 2], tolerance: f64) -> Result<Self, StudyError> {
        Ok(Self { solver: Solver::new(problem, points, Settings { tolerance, ..Settings::default() })? })
    }

    /// The problem of a case, on `points` × `points` samples.
    pub fn of(case: &Case, points: usize) -> Result<Self, StudyError> {
        Ok(Self { solver: Solver::new(Arc::clone(case.problem()), [points; 2], Settings::default())? })
    }

    /// The next step; an error unless it converged.
    pub fn step(&mut self, load: Load) -> Result<Step, StudyError> {
        let step = self.solver.solve(load);
        if step.report.stop.solved() { Ok(step) } else { Err(format!("{load}: {}", step.report).into()) }
    }

    /// The next step and its reading.
    pub fn solve(&mut self, load: Load) -> Result<(Step, Reading), StudyError> {
        let step = self.step(load)?;
        let reading = Reading::of(step.finest());
        Ok((step, reading))
    }

    /// Penetration of the next step alone.
    pub fn penetration(&mut self, mean_pressure: f64) -> Result<f64, StudyError> {
        Ok(self.step(Load::MeanPressure(mean_pressure))?.penetration())
    }

    pub fn loaded(&mut self, mean_pressure: f64) -> Result<Reading, StudyError> {
        Ok(self.solve(Load::MeanPressure(mean_pressure))?.1)
    }
}

/// Fraction of the cell in contact; an error of an isolated contact.
pub fn fraction_in_contact(reading: &Reading) -> Result<f64, StudyError> {
    reading.contact_fraction.ok_or_else(|| "an isolated contact has no cell".into())
}

/// A case file of `validation/`, with overrides `KEY=VALUE`.
pub fn case(name: &str, text: &str, overrides: &[String]) -> Result<Case, StudyError> {
    let source = Source { name: format!("validation/{name}"), text: text.to_owned(), ..Source::default() };
    Case::read(&source, overrides).map_err(|error| error.render(false).into())
}

/// Topography with the heights h(s₁, s₂) at the samples, s in fractions of the cell vectors.
pub fn topography(
    cell: Cell,
    [n1, n2]: [usize; 2],
    height: impl Fn(f64, f64) -> f64,
) -> Result<Topography, StudyError> {
    let at = |(i, j): (usize, usize)| height(i as f64 / n1 as f64, j as f64 / n2 as f64);
    Ok(Topography::new(cell, Array2::from_shape_fn((n1, n2), at))?)
}
