//! Bodies that conduct heat, what slides over them, and the steps of these.

use crate::StudyError;
use ndarray::Array2;
use percoat_core::body::{Bodies, Conduction, HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{GivenPressure, Indenters, Level, LoadedBy, Shape};
use percoat_core::friction::Friction;
use percoat_core::heating::Heating;
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Settings, Solver, Step, SurfaceHeat};
use percoat_core::steady_motion::SteadyMotion;

/// A velocity at which the transport of heat is far below rounding beside its conduction, where lengths and diffusivities are near 1.
pub const AT_REST: f64 = 1e-9;

/// A material: Young's modulus, Poisson's ratio, and λ, κ and α of its heat.
#[derive(Debug, Clone, Copy)]
pub struct Stuff {
    pub young: f64,
    pub poisson: f64,
    pub conductivity: f64,
    pub diffusivity: f64,
    pub expansion: f64,
}

/// A layer, and how it is joined to what lies below it.
#[derive(Debug, Clone, Copy)]
pub struct Sheet {
    pub stuff: Stuff,
    pub thickness: f64,
    pub interface: Interface,
    /// Thermal resistance of the lower face; infinite where that insulates.
    pub resistance: f64,
}

/// Sheets from the surface down, on a substrate, or on a rigid base that is held at the bulk temperature.
#[derive(Debug, Clone)]
pub struct Stack {
    pub sheets: Vec<Sheet>,
    pub substrate: Option<Stuff>,
}

impl Stuff {
    /// E and ν = 0.3, with λ, κ and α.
    pub fn new(young: f64, [conductivity, diffusivity, expansion]: [f64; 3]) -> Self {
        Self { young, poisson: 0.3, conductivity, diffusivity, expansion }
    }

    fn material(&self) -> Result<Material, StudyError> {
        let conduction = Conduction::new(self.conductivity, self.diffusivity, self.expansion)?;
        Ok(Material::from_young(self.young, self.poisson)?.with_conduction(Some(conduction)))
    }
}

impl Sheet {
    /// A bonded sheet without thermal resistance below it.
    pub fn bonded(stuff: Stuff, thickness: f64) -> Self {
        Self { stuff, thickness, interface: Interface::Bonded, resistance: 0.0 }
    }
}

impl Stack {
    pub fn bare(stuff: Stuff) -> Self {
        Self { sheets: Vec::new(), substrate: Some(stuff) }
    }

    pub fn half_space(&self) -> Result<HalfSpace, StudyError> {
        let layer = |sheet: &Sheet| -> Result<Layer, StudyError> {
            let layer = Layer::new(sheet.stuff.material()?, sheet.thickness, sheet.interface)?;
            Ok(layer.with_thermal_resistance(sheet.resistance)?)
        };
        let layers = self.sheets.iter().map(layer).collect::<Result<_, _>>()?;
        Ok(match &self.substrate {
            Some(substrate) => HalfSpace::new(layers, substrate.material()?),
            None => HalfSpace::on_rigid_base(layers)?,
        })
    }
}

/// A paraboloid of the radius `radius` in each square of a side.
pub fn paraboloid(period: f64, radius: f64) -> Result<Indenters, StudyError> {
    let level = Level::new(Shape::Paraboloid { radius }, 0.0)?;
    Ok(Indenters::new(Lattice::square(period, 1)?, vec![level])?)
}

/// Load that moves along +x with μ and v, and its heat.
pub fn sliding(
    loaded_by: impl Into<LoadedBy>,
    bodies: impl Into<Bodies>,
    [coefficient, velocity]: [f64; 2],
    heating: Heating,
) -> Result<Problem, StudyError> {
    let friction = Friction::new(coefficient, [1.0, 0.0])?.uncoupled();
    let moving = Problem::new(loaded_by, bodies).sliding(friction)?.moving(SteadyMotion::new(velocity)?)?;
    Ok(moving.heated(heating)?)
}

/// The step of a load; an error unless it converged.
pub fn solved(problem: Problem, points: [usize; 2], load: Load) -> Result<Step, StudyError> {
    let step = Solver::new(problem, points, Settings::default())?.solve(load);
    if step.report.stop.solved() { Ok(step) } else { Err(format!("{load}: {}", step.report).into()) }
}

/// Heat of a step.
pub fn heat(step: &Step) -> Result<&SurfaceHeat, StudyError> {
    step.finest().heat().ok_or_else(|| "nothing heats".into())
}

/// Step under a flux of heat into a body, given by a pressure: the flux over the pressure, μv, is 1, so that the pressure is the flux.
pub fn under_flux(given: GivenPressure, body: &Stack, velocity: f64, points: [usize; 2]) -> Result<Step, StudyError> {
    let force = given.force();
    let problem =
        sliding(given, body.half_space()?, [1.0 / velocity, velocity], Heating::default().without_expansion())?;
    solved(problem, points, Load::Force(force))
}

/// A flux that is the mean of `value` over the cell of each sample, in a rectangle of `sides`, the source around the origin.
pub fn flux(sides: [f64; 2], points: [usize; 2], value: impl Fn(f64, f64) -> f64) -> Result<GivenPressure, StudyError> {
    let cell = Cell::new([sides[0], 0.0], [0.0, sides[1]])?;
    let at = |i: usize, axis: usize| place(i, points[axis], sides[axis]);
    Ok(GivenPressure::field(cell, Array2::from_shape_fn((points[0], points[1]), |(i, j)| value(at(i, 0), at(j, 1))))?)
}

/// Place of a sample along a side, between −½ and ½ of it.
pub fn place(sample: usize, points: usize, side: f64) -> f64 {
    let s = sample as f64 / points as f64;
    side * (s - s.round())
}
