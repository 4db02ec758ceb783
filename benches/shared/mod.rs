//! Problems that several benches share, all on cells of side 1.
#![allow(dead_code, reason = "each bench uses its part")]

pub mod library;
mod rough;

pub use rough::Rough;

use percoat::spectral::{LayeredOperator, Workspace};
use percoat::*;
use std::sync::Arc;

/// The bare half-space with E* = 1.
pub fn bare() -> HalfSpace {
    HalfSpace::new(vec![], Material::from_young(1.0, 0.0).expect("valid"))
}

/// `count` layers, together half as thick as the cell is wide, by turns twice and half as stiff as the substrate.
pub fn layered(count: usize) -> HalfSpace {
    let substrate = Material::from_young(1.0, 0.3).expect("valid");
    let layer = |number: usize| {
        let material = Material::from_shear(substrate.shear() * [2.0, 0.5][number % 2], 0.2).expect("valid");
        Layer::new(material, 0.5 / count as f64, Interface::Bonded).expect("valid")
    };
    HalfSpace::new((0..count).map(layer).collect(), substrate)
}

/// One paraboloid in a square cell on the bare half-space.
pub fn one_level() -> Problem {
    let lattice = Lattice::square(1.0, 1).expect("valid");
    Problem::new(Indenters::new(lattice, vec![paraboloid(0.0)]).expect("valid"), bare())
}

/// Presses [`one_level`] into 18 % of the cell.
pub const ONE_LEVEL: Load = Load::MeanPressure(0.021);

/// Fig. 2 of the paper: three levels on a coating.
pub fn three_levels() -> Problem {
    let levels = [0.02, 0.01, 0.0].map(paraboloid).to_vec();
    Problem::new(Indenters::new(Lattice::hexagonal(1.0, 3).expect("valid"), levels).expect("valid"), layered(1))
}

/// Presses [`three_levels`] into 23 % of the cell: all are in contact.
pub const THREE_LEVELS: Load = Load::MeanPressure(0.06);

fn paraboloid(height: f64) -> Level {
    Level::new(Shape::Paraboloid { radius: 0.8 }, height).expect("valid")
}

/// A rough surface on the bare half-space.
pub fn rough(surface: Rough, points: usize) -> Problem {
    let cell = Cell::square(1.0).expect("valid");
    Problem::new(Topography::new(cell, surface.heights(points)).expect("valid"), bare())
}

/// Presses surfaces with unit slope into 15 to 20 % of the cell.
pub const ROUGH: Load = Load::MeanPressure(0.09);

/// The solver of a problem on n × n points, with default settings.
pub fn solver(problem: Problem, n: usize) -> Solver {
    Solver::new(problem, [n, n], Settings::default()).expect("a grid")
}

/// The displacement operator of a half-space under the unit square on n × n points, with its tables.
pub fn operator(half_space: &HalfSpace, n: usize) -> LayeredOperator {
    let grid = Arc::new(Grid::new(Cell::square(1.0).expect("valid"), [n, n]).expect("a grid"));
    LayeredOperator::new(&grid, half_space)
}

/// One convolution at a time, pressure → displacement in place. The one place where benches meet the transform.
pub struct Convolution {
    operator: LayeredOperator,
    workspace: Workspace,
}

impl Convolution {
    pub fn new(half_space: &HalfSpace, n: usize) -> Self {
        Self { operator: operator(half_space, n), workspace: Workspace::default() }
    }

    /// n² samples.
    pub fn run(&mut self, field: &mut [f64]) {
        self.operator.displacement(field, &mut self.workspace);
    }

    /// n² samples in single precision.
    pub fn run_single(&mut self, field: &mut [f32]) {
        self.operator.displacement_single(field, &mut self.workspace);
    }
}
