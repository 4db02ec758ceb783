//! The loads at which the levels of indenters begin to touch, found on a grid of their own.

use percoat_case::case::Case;
use percoat_core::lattice::{Cell, LatticeError};
use percoat_core::load::LoadQuantity;
use percoat_core::reading::{FirstTouch, first_touches};
use percoat_core::run::balanced_points;
use percoat_core::spectral::Solver;
use std::sync::Arc;

/// Points along the shorter cell vector of the grid for first touches.
const POINTS: usize = 192;

/// First touches of the levels.
#[derive(Debug, Clone)]
pub struct Touches {
    /// The grid on which they were found, points along a₁ and a₂.
    pub points: [usize; 2],
    /// The quantity of their loads.
    pub quantity: LoadQuantity,
    /// Load and its error at the first touch of each level; `None` for a level hidden behind the others.
    pub levels: Vec<Option<(f64, Option<f64>)>>,
}

impl Touches {
    /// First touches found on a grid of these points over the cell, in a quantity of loads.
    pub(super) fn new(points: [usize; 2], found: &[Option<FirstTouch>], quantity: LoadQuantity, cell: Cell) -> Self {
        let per_pressure = match quantity {
            LoadQuantity::MeanPressure => 1.0,
            LoadQuantity::Force => cell.area(),
        };
        let load = |FirstTouch { mean_pressure, error }: FirstTouch| {
            (mean_pressure * per_pressure, error.map(|error| error * per_pressure))
        };
        Self { points, quantity, levels: found.iter().map(|touch| touch.map(load)).collect() }
    }

    /// Load at first touch, level by level.
    pub(super) fn loads(&self) -> Vec<Option<f64>> {
        self.levels.iter().map(|touch| touch.map(|(load, _)| load)).collect()
    }

    /// Errors of the loads, level by level.
    pub(super) fn errors(&self) -> Vec<Option<f64>> {
        self.levels.iter().map(|touch| touch.and_then(|(_, error)| error)).collect()
    }
}

/// First touches found on a grid, points along a₁ and a₂, level by level.
type FoundTouches = ([usize; 2], Vec<Option<FirstTouch>>);

/// First touches of the levels; `first` is the coarsest grid of the case, for which there is memory.
pub(super) fn touches(case: &Case, first: [usize; 2]) -> Result<Option<FoundTouches>, LatticeError> {
    // A single isolated contact touches under any load.
    let is_single = case.problem().kind().is_indentation() && case.problem().levels().len() == 1;
    // Surfaces that adhere touch before any load, and part under none.
    if case.problem().indenters().is_none() || is_single || case.problem().adhesion().is_some() {
        return Ok(None);
    }
    let [n1, n2] = balanced_points(&case.problem().cell(), POINTS);
    // A long cell would have many points.
    let points = if n1 * n2 <= 4 * POINTS * POINTS { [n1, n2] } else { first };
    let mut solver = Solver::new(Arc::clone(case.problem()), points, case.solver)?;
    Ok(Some((points, first_touches(&mut solver))))
}
