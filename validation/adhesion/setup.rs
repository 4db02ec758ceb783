//! Contacts of the study, and their paths.

use crate::StudyError;
use percoat_core::adhesion::{Adhesion, AdhesionLaw};
use percoat_core::body::{HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, LoadedBy, Shape};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{AdhesiveSolver, AdhesiveStep, Settings};

/// A half-space with E* = 1.
pub fn unit() -> Result<HalfSpace, StudyError> {
    Ok(HalfSpace::new(vec![], Material::from_young(0.91, 0.3)?))
}

/// A bonded layer of Young's modulus, Poisson's ratio and thickness.
pub fn layer([young, poisson, thickness]: [f64; 3]) -> Result<Layer, StudyError> {
    Ok(Layer::new(Material::from_young(young, poisson)?, thickness, Interface::Bonded)?)
}

/// A ball of the radius 1 over the middle of a cell.
pub fn ball(cell: Cell) -> Result<Indenters, StudyError> {
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0)?;
    Ok(Indenters::new(Lattice::new(cell, vec![vec![[0.5; 2]]])?, vec![level])?)
}

/// Surfaces that adhere by Dugdale's law with a work and a range.
pub fn adhering(
    loaded_by: impl Into<LoadedBy>,
    body: HalfSpace,
    [work, range]: [f64; 2],
) -> Result<Problem, StudyError> {
    Ok(Problem::new(loaded_by, body).adhering(Adhesion::new(work, range, AdhesionLaw::Dugdale)?)?)
}

pub fn solver(problem: Problem, points: [usize; 2]) -> Result<AdhesiveSolver, StudyError> {
    Ok(AdhesiveSolver::new(problem, points, Settings::default())?)
}

/// One step; an error unless it converged, or the surfaces are apart.
pub fn advance(solver: &mut AdhesiveSolver, load: Load) -> Result<AdhesiveStep, StudyError> {
    let step = solver.advance(load);
    if step.contact.report.stop.solved() { Ok(step) } else { Err(format!("{load}: {}", step.contact.report).into()) }
}

/// The steps of a way by the penetration from one to another.
pub fn draw_off(solver: &mut AdhesiveSolver, from: f64, to: f64, steps: u32) -> Result<Vec<AdhesiveStep>, StudyError> {
    let place = |k: u32| from + (to - from) * f64::from(k) / f64::from(steps);
    (0..=steps).map(|k| advance(solver, Load::Penetration(place(k)))).collect()
}
