//! An accepted step of a path of wear: what both surfaces have lost, and the contact at its end.

use crate::body::Side;
use crate::numeric::array::samples;
use crate::numeric::sums;
use crate::spectral::{Solver, Step, Worn};
use ndarray::Array2;
use serde::{Deserialize, Serialize};

/// Wear of one surface since the solver was made.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WornSurface {
    /// Volume on one cell or by an isolated contact, a cubed length.
    pub volume: f64,
    /// Largest depth, a length.
    pub depth: f64,
}

/// An accepted step of a path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WornStep {
    /// Distance from the start of the path to the end of the step, a length.
    pub distance: f64,
    /// Length Δs of the step.
    pub length: f64,
    /// Error e of the step, over the depth worn off in it or a tenth of all.
    pub error: f64,
    /// Error of the depth worn off on the path so far, over the largest one since the solver was made.
    pub accumulated_error: f64,
    /// Wear of the body.
    pub body: WornSurface,
    /// Wear of the counterbody.
    pub counterbody: WornSurface,
    /// Force on one cell or on the isolated contact at the end of the step, a pressure times an area.
    pub force: f64,
    /// Largest pressure at the end of the step.
    pub max_pressure: f64,
    /// Penetration at the end of the step, from the first touch of the worn surfaces, a length.
    pub penetration: f64,
    /// Depth of that first touch below the one of the unworn surfaces, a length.
    pub recession: f64,
    /// Convolutions of all tries of the step, as equivalents of the finest grid.
    pub convolutions: f64,
}

impl WornStep {
    /// The state that a step has reached, without the length, error and convolutions of the step.
    pub(super) fn of(solver: &Solver, step: &Step, distance: f64, errors: &Array2<f64>) -> Self {
        let worn = solver.worn();
        let surface = |side: Side| WornSurface {
            volume: worn.map_or(0.0, |worn| worn.volume(side)),
            depth: worn.map_or(0.0, |worn| worn.largest(side)),
        };
        let (deepest, error) = (largest(samples(&worn_depth(solver))), largest(samples(errors)));
        let pressure = step.finest().pressures();
        Self {
            distance,
            length: 0.0,
            error: 0.0,
            accumulated_error: if deepest > 0.0 { error / deepest } else { 0.0 },
            body: surface(Side::Body),
            counterbody: surface(Side::Counterbody),
            force: sums::of(pressure.len(), |i| [pressure[i]])[0] * step.grid().sample_area(),
            max_pressure: largest(pressure),
            penetration: step.penetration(),
            recession: worn.map_or(0.0, Worn::recession),
            convolutions: 0.0,
        }
    }
}

/// max |x|.
pub(super) fn largest(field: &[f64]) -> f64 {
    -sums::least(field.len(), |i| -field[i].abs())
}

/// Depth worn off both surfaces together.
pub(super) fn worn_depth(solver: &Solver) -> Array2<f64> {
    let none = || Array2::zeros(solver.grid().points());
    solver.worn().map_or_else(none, |worn| &worn.depth(Side::Body) + &worn.depth(Side::Counterbody))
}
