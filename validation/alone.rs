//! One indenter alone in its window, under the load of a table: readings, and errors that the grid may leave.
//!
//! The errors are of second order in spacing over radius. A Hertz contact of 47 samples to the radius leaves 3·10⁻⁵ of its penetration;
//! where a layer bends the pressure within a part of the radius, ten times that is allowed. The stiffness is that of the samples
//! in contact, which join by eight at a time: their area steps by up to 8/N with N of them, 1.1·10⁻³ here, and the stiffness by half as many
//! times d ln S/d ln a, which is 1 without layers and 3 at most on a soft one that keeps its volume.

use super::steps::Steps;
use super::{Check, Data, StudyError, Tolerance};
use percoat_core::body::{Bodies, HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::Step;

/// Side of a window over the contact radius.
pub const WINDOW: f64 = 2.7;
/// Samples along its side.
pub const POINTS: usize = 128;
/// Quantities of a single contact that are compared with their reference, each with its relative tolerance.
pub const QUANTITIES: [(&str, f64); 4] = [("delta", 3e-4), ("p0", 1e-3), ("a", 2e-3), ("S", 1.4e-3)];
/// Tolerance of the solver: below the errors of the grid.
const TOLERANCE: f64 = 1e-10;

/// A layer: thickness, Young's modulus, Poisson's ratio and the interface below.
pub type LayerOf = (f64, f64, f64, Interface);

/// A half-space of layers, from the surface down, on a substrate of Young's modulus and Poisson's ratio.
pub fn half_space(layers: &[LayerOf], [young, poisson]: [f64; 2]) -> Result<HalfSpace, StudyError> {
    let layer = |&(thickness, young, poisson, interface): &LayerOf| -> Result<Layer, StudyError> {
        Ok(Layer::new(Material::from_young(young, poisson)?, thickness, interface)?)
    };
    let layers = layers.iter().map(layer).collect::<Result<Vec<_>, _>>()?;
    Ok(HalfSpace::new(layers, Material::from_young(young, poisson)?))
}

/// An indenter over the middle of a square window.
pub fn problem(shape: Shape, bodies: impl Into<Bodies>, side: f64) -> Result<Problem, StudyError> {
    let lattice = Lattice::new(Cell::window([side; 2])?, vec![vec![[0.5; 2]]])?;
    Ok(Problem::new(Indenters::new(lattice, vec![Level::new(shape, 0.0)?])?, bodies))
}

/// A contact that is solved.
pub struct Alone {
    pub step: Step,
    /// Penetration, pressure on the axis, contact radius and stiffness, in the order of [`QUANTITIES`].
    pub found: [f64; 4],
}

impl Alone {
    /// The contact under the force that makes one of this radius.
    pub fn new(
        shape: Shape,
        bodies: impl Into<Bodies>,
        [radius, force]: [f64; 2],
        points: usize,
    ) -> Result<Self, StudyError> {
        let mut steps = Steps::to(problem(shape, bodies, WINDOW * radius)?, [points; 2], TOLERANCE)?;
        let (step, reading) = steps.solve(Load::Force(force))?;
        let stiffness = steps.solver.tangent().ok_or("no tangent")?.stiffness();
        let radius = reading.levels[0].contact_radius.unwrap_or(f64::NAN);
        let axis = step.pressure()[[points / 2; 2]];
        Ok(Self { step, found: [reading.penetration, axis, radius, stiffness] })
    }
}

/// The worst of each quantity of a table with columns like `delta` and `delta_exact`, in rows that are wanted, in the order of radii.
pub fn checks(what: &str, data: &Data, wanted: impl Fn(&[f64]) -> bool) -> Vec<Check> {
    let column = |name: &str| data.columns.iter().position(|column| column == name);
    let rows: Vec<&Vec<f64>> = data.rows.iter().filter(|row| wanted(row)).collect();
    let check = |(name, tolerance): (&str, f64)| {
        let (found, exact, radius) = (column(name)?, column(&format!("{name}_exact"))?, column("a_exact")?);
        let pairs = rows.iter().map(|row| (row[found], row[exact]));
        Some(match name {
            "delta" => Check::worst(format!("{what}: penetration δ"), pairs, Tolerance::Relative(tolerance)),
            "p0" => Check::worst(format!("{what}: pressure on the axis"), pairs, Tolerance::Relative(tolerance)),
            "a" => Check::worst(format!("{what}: radius a"), pairs, Tolerance::Relative(tolerance)),
            _ => {
                let exponents = exponents(rows.iter().map(|row| [row[radius], row[exact]]).collect());
                let pairs = pairs
                    .zip(exponents)
                    .map(|((found, exact), exponent)| ((found / exact - 1.0) / exponent.max(1.0), 0.0));
                let name = format!("{what}: error of dP/dδ over d ln S/d ln a");
                Check::worst(name, pairs, Tolerance::Absolute(tolerance))
            }
        })
    };
    QUANTITIES.into_iter().filter_map(check).collect()
}

/// d ln y/d ln x at points (x, y): the larger of both sides.
fn exponents(points: Vec<[f64; 2]>) -> Vec<f64> {
    let slopes: Vec<f64> =
        points.windows(2).map(|pair| (pair[1][1] / pair[0][1]).ln() / (pair[1][0] / pair[0][0]).ln()).collect();
    let side = |k: Option<usize>| k.and_then(|k| slopes.get(k).copied()).unwrap_or(f64::NEG_INFINITY);
    (0..points.len()).map(|i| side(i.checked_sub(1)).max(side(Some(i)))).collect()
}
