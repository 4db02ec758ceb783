//! Contacts of the study, and their steps.

use crate::StudyError;
use percoat_core::body::{Bodies, HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, LoadedBy, Shape, Topography};
use percoat_core::friction::Friction;
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Drive, Settings, SlipSettings, SlipSolver, SlipStep};

/// Tolerance of the normal contact: below the errors of the grid.
const TOLERANCE: f64 = 1e-10;

/// A half-space of the shear modulus 1 below layers of a shear modulus, Poisson's ratio and thickness.
pub fn half_space(layers: &[[f64; 3]], poisson: f64) -> Result<HalfSpace, StudyError> {
    let layer = |&[shear, poisson, thickness]: &[f64; 3]| -> Result<Layer, StudyError> {
        Ok(Layer::new(Material::from_shear(shear, poisson)?, thickness, Interface::Bonded)?)
    };
    let layers = layers.iter().map(layer).collect::<Result<Vec<_>, _>>()?;
    Ok(HalfSpace::new(layers, Material::from_shear(1.0, poisson)?))
}

/// The same body twice.
pub fn like(body: HalfSpace) -> Bodies {
    Bodies::elastic(body.clone(), body)
}

/// A ball of the radius 1 over the middle of a cell.
pub fn ball(cell: Cell) -> Result<Indenters, StudyError> {
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0)?;
    Ok(Indenters::new(Lattice::new(cell, vec![vec![[0.5; 2]]])?, vec![level])?)
}

pub fn rubbing(
    loaded_by: impl Into<LoadedBy>,
    bodies: impl Into<Bodies>,
    friction: f64,
) -> Result<Problem, StudyError> {
    Ok(Problem::new(loaded_by, bodies).sliding(Friction::new(friction, [1.0, 0.0])?)?)
}

/// Samples of a wave along the direction in which nothing changes.
pub const ROWS: usize = 4;

/// The wave .01(1 − cos 2πx) between like bodies below a layer, of the shear modulus χ unless that is 0, on so many points.
pub fn wave([chi, nu, h]: [f64; 3], points: usize) -> Result<SlipSolver, StudyError> {
    let cell = Cell::new([1.0, 0.0], [0.0, ROWS as f64 / points as f64])?;
    let height = |s: f64, _: f64| 0.01 * ((std::f64::consts::TAU * s).cos() - 1.0);
    let surface: Topography = crate::steps::topography(cell, [points, ROWS], height)?;
    let layers = if chi > 0.0 { vec![[chi, nu, h]] } else { vec![] };
    solver(rubbing(surface, like(half_space(&layers, 0.3)?), 1.0)?, [points, ROWS])
}

/// Width of a wave, a length.
pub fn width(points: usize) -> f64 {
    ROWS as f64 / points as f64
}

pub fn solver(problem: Problem, points: [usize; 2]) -> Result<SlipSolver, StudyError> {
    let settings = Settings { tolerance: TOLERANCE, ..Settings::default() };
    Ok(SlipSolver::new(problem, points, settings, SlipSettings::default())?)
}

/// One step; an error unless it converged.
pub fn advance(solver: &mut SlipSolver, load: Load, drive: Drive) -> Result<SlipStep, StudyError> {
    let step = solver.advance(load, drive)?;
    if step.converged { Ok(step) } else { Err(format!("{load}: {:?}", step.report).into()) }
}

/// One step to a tangential force along x over μP.
pub fn to_part(solver: &mut SlipSolver, load: Load, part: f64) -> Result<SlipStep, StudyError> {
    advance(solver, load, Drive::Part([part, 0.0]))
}
