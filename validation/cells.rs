//! Periodic cells of few samples, whose problems are solved densely by `validation/dense.py`: their samples, shapes and bodies.

use super::StudyError;
use super::alone::half_space;
use super::steps::Steps;
use ndarray::Array2;
use percoat_core::body::{Bodies, HalfSpace, Interface::Bonded};
use percoat_core::counterbody::Topography;
use percoat_core::lattice::Cell;
use percoat_core::problem::Problem;
use std::f64::consts::TAU;

/// Names of the cells, and the numbers of samples and vectors of each.
pub const NAMES: [&str; 3] = ["square", "rectangle", "oblique"];
pub const CELLS: [([usize; 2], [[f64; 2]; 2]); 3] =
    [([24, 24], [[1.0, 0.0], [0.0, 1.0]]), ([20, 27], [[1.0, 0.0], [0.0, 1.3]]), ([21, 24], [[1.0, 0.0], [0.35, 0.9]])];
/// Tolerance of the solver: near what double precision carries, so that the samples in contact are those of the dense solution.
const TOLERANCE: f64 = 1e-14;

/// Gap of two waves on the samples of a cell.
pub fn wavy(points: [usize; 2]) -> Array2<f64> {
    on_samples(points, |[u, v]| 0.02 * (2.0 - (TAU * u).cos() - (TAU * v).cos()))
}

/// Gap of waves in all directions with fixed phases, from its least value on.
pub fn rough(points: [usize; 2]) -> Array2<f64> {
    let waves = (0..5).flat_map(|m| (-5..=5).map(move |n| [m, n].map(f64::from)));
    let waves: Vec<[f64; 2]> = waves.filter(|&[m, n]| m > 0.0 || n > 0.0).collect();
    let height = |[u, v]: [f64; 2]| {
        let wave = |&[m, n]: &[f64; 2]| {
            let phase = 1.7 * m * m + 2.3 * m * n + 3.1 * n * n + 0.5;
            0.012 * (m * m + n * n).powf(-0.9) * (TAU * (m * u + n * v) + phase).cos()
        };
        waves.iter().map(wave).sum::<f64>()
    };
    let gap = on_samples(points, height);
    let least = gap.iter().copied().fold(f64::INFINITY, f64::min);
    gap - least
}

/// Values at the fractions of the samples.
fn on_samples(points: [usize; 2], value: impl Fn([f64; 2]) -> f64) -> Array2<f64> {
    Array2::from_shape_fn(points, |(i, j)| value([i as f64 / points[0] as f64, j as f64 / points[1] as f64]))
}

/// The body with E* = 1.
pub fn bare() -> Result<HalfSpace, StudyError> {
    half_space(&[], [0.91, 0.3])
}

/// A hard layer on a softer substrate.
pub fn coated() -> Result<HalfSpace, StudyError> {
    half_space(&[(0.1, 5.0, 0.2, Bonded)], [1.0, 0.3])
}

/// Largest less least value.
pub fn range(field: &Array2<f64>) -> f64 {
    let of = |start: f64, pick: fn(f64, f64) -> f64| field.iter().copied().fold(start, pick);
    of(f64::NEG_INFINITY, f64::max) - of(f64::INFINITY, f64::min)
}

/// Load steps of a gap on a cell, by its number.
pub fn steps(cell: usize, gap: &Array2<f64>, bodies: impl Into<Bodies>) -> Result<Steps, StudyError> {
    let (points, [a1, a2]) = CELLS[cell];
    let topography = Topography::new(Cell::new(a1, a2)?, -gap)?;
    // A topography touches first between its samples.
    let solver = Steps::to(Problem::new(topography, bodies), points, TOLERANCE)?.solver.with_gap(gap.clone())?;
    Ok(Steps { solver })
}
