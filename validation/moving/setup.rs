//! Bodies that relax, their moving contacts, and the steps of these.

use crate::StudyError;
use percoat_core::body::{Bodies, ConstantModulus, HalfSpace, Interface, Layer, Material, Relaxation};
use percoat_core::counterbody::{Indenters, Level, LoadedBy, Shape, Topography};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::reading::HysteresisReading;
use percoat_core::spectral::{Settings, Solver, Step};
use percoat_core::steady_motion::SteadyMotion;

/// Samples of a surface along the direction in which nothing changes.
pub const ROWS: usize = 4;
/// Tolerance of the solver where nothing else is said.
pub const TOLERANCE: f64 = 1e-8;

/// A material with the relaxed shear modulus and Poisson's ratio, and the moduli and times of what relaxes; none of an elastic one.
#[derive(Debug, Clone)]
pub struct Stuff {
    pub shear: f64,
    pub poisson: f64,
    pub terms: Vec<[f64; 2]>,
    pub constant: ConstantModulus,
}

/// Sheets from the surface down, each with its thickness and whether it slides freely on what lies below, on a substrate.
#[derive(Debug, Clone)]
pub struct Stack {
    pub sheets: Vec<(Stuff, f64, bool)>,
    pub substrate: Stuff,
}

impl Stuff {
    /// An elastic material.
    pub fn elastic(shear: f64, poisson: f64) -> Self {
        Self { shear, poisson, terms: Vec::new(), constant: ConstantModulus::Poisson }
    }

    /// A material whose shear modulus falls by `ratio` in the time 1, at constant ν.
    pub fn relaxing(shear: f64, poisson: f64, ratio: f64) -> Self {
        Self { terms: vec![[(ratio - 1.0) * shear, 1.0]], ..Self::elastic(shear, poisson) }
    }

    pub fn material(&self) -> Result<Material, StudyError> {
        let material = Material::from_shear(self.shear, self.poisson)?;
        if self.terms.is_empty() {
            return Ok(material);
        }
        let [moduli, times]: [Vec<f64>; 2] = [0, 1].map(|of| self.terms.iter().map(|term| term[of]).collect());
        Ok(material.with_relaxation(Some(Relaxation::new(&moduli, &times)?.with_constant(self.constant))))
    }
}

impl Stack {
    /// A half-space of one material.
    pub fn bare(ratio: f64) -> Self {
        Self { sheets: Vec::new(), substrate: Stuff::relaxing(1.0, 0.3, ratio) }
    }

    /// A bonded sheet on a substrate.
    pub fn coated(sheet: Stuff, thickness: f64, substrate: Stuff) -> Self {
        Self { sheets: vec![(sheet, thickness, false)], substrate }
    }

    /// S: a soft layer that relaxes on an elastic body.
    pub fn soft(ratio: f64) -> Self {
        Self::coated(Stuff::relaxing(1.0, 0.4, ratio), 0.05, Stuff::elastic(20.0, 0.3))
    }

    /// H: a stiff elastic layer on a body that relaxes.
    pub fn stiff(ratio: f64) -> Self {
        Self::coated(Stuff::elastic(20.0, 0.25), 0.02, Stuff::relaxing(1.0, 0.45, ratio))
    }

    pub fn half_space(&self) -> Result<HalfSpace, StudyError> {
        let layer = |(stuff, thickness, slides): &(Stuff, f64, bool)| -> Result<Layer, StudyError> {
            let interface = if *slides { Interface::Frictionless } else { Interface::Bonded };
            Ok(Layer::new(stuff.material()?, *thickness, interface)?)
        };
        Ok(HalfSpace::new(self.sheets.iter().map(layer).collect::<Result<_, _>>()?, self.substrate.material()?))
    }
}

/// A paraboloid of the radius 1 in each square of the side 1.
pub fn paraboloids() -> Result<Indenters, StudyError> {
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0)?;
    Ok(Indenters::new(Lattice::square(1.0, 1)?, vec![level])?)
}

/// A surface f(x) of the period `period` on `points` samples that does not change along y.
pub fn cylinder(period: f64, points: usize, gap: impl Fn(f64) -> f64) -> Result<Topography, StudyError> {
    let cell = Cell::new([period, 0.0], [0.0, period * ROWS as f64 / points as f64])?;
    crate::steps::topography(cell, [points, ROWS], |s, _| -gap(period * (s - s.round())))
}

pub fn moving(loaded_by: impl Into<LoadedBy>, bodies: impl Into<Bodies>, velocity: f64) -> Result<Problem, StudyError> {
    Ok(Problem::new(loaded_by, bodies).moving(SteadyMotion::new(velocity)?)?)
}

/// The step of a mean pressure; an error unless it converged.
pub fn solved(problem: Problem, points: [usize; 2], [mean, tolerance]: [f64; 2]) -> Result<Step, StudyError> {
    let mut solver = Solver::new(problem, points, Settings { tolerance, ..Settings::default() })?;
    let step = solver.solve(Load::MeanPressure(mean));
    if step.report.stop.solved() { Ok(step) } else { Err(format!("{}: {}", step.load, step.report).into()) }
}

/// Friction by hysteresis of a step.
pub fn friction(step: &Step) -> Result<HysteresisReading, StudyError> {
    HysteresisReading::of(step).ok_or_else(|| "nothing moves".into())
}
