//! Bodies that creep, surfaces pressed into them, and the steps in time of these contacts.

use crate::StudyError;
use percoat_core::body::{Bodies, ConstantModulus, HalfSpace, Interface, Layer, Material, Relaxation};
use percoat_core::counterbody::roughness::{Rms, SelfAffine};
use percoat_core::counterbody::{Indenters, Level, LoadedBy, Shape, Topography};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{CreepSolver, CreepStep, Settings, Solver, Step};

pub const POISSON: f64 = 0.3;

/// A material of relaxed shear modulus, Poisson's ratio, and the moduli and times of what relaxes; none of an elastic one.
#[derive(Debug, Clone)]
pub struct Stuff {
    pub shear: f64,
    pub poisson: f64,
    pub terms: Vec<[f64; 2]>,
    pub constant: ConstantModulus,
}

impl Stuff {
    pub fn elastic(shear: f64, poisson: f64) -> Self {
        Self { shear, poisson, terms: Vec::new(), constant: ConstantModulus::Poisson }
    }

    /// A modulus that falls by 10 in two times, the bulk modulus constant.
    pub fn relaxing(shear: f64, poisson: f64) -> Self {
        let terms = vec![[2.7 * shear, 1.0], [6.3 * shear, 0.1]];
        Self { shear, poisson, terms, constant: ConstantModulus::Bulk }
    }

    /// A relaxed modulus of 1 with these terms at constant ν.
    pub fn simple(terms: &[[f64; 2]]) -> Self {
        Self { terms: terms.to_vec(), ..Self::elastic(1.0, POISSON) }
    }

    /// The material as it responds at once: all terms, and the bulk modulus or ν of the relaxed one.
    pub fn glassy(&self) -> Self {
        let shear = self.shear + self.terms.iter().map(|term| term[0]).sum::<f64>();
        let poisson = match self.constant {
            ConstantModulus::Poisson => self.poisson,
            ConstantModulus::Bulk => {
                let bulk = 2.0 * self.shear * (1.0 + self.poisson) / (3.0 * (1.0 - 2.0 * self.poisson));
                (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
            }
        };
        Self::elastic(shear, poisson)
    }

    /// The material after all has relaxed.
    pub fn relaxed(&self) -> Self {
        Self::elastic(self.shear, self.poisson)
    }

    fn material(&self) -> Result<Material, StudyError> {
        let material = Material::from_shear(self.shear, self.poisson)?;
        if self.terms.is_empty() {
            return Ok(material);
        }
        let [moduli, times]: [Vec<f64>; 2] = [0, 1].map(|of| self.terms.iter().map(|term| term[of]).collect());
        Ok(material.with_relaxation(Some(Relaxation::new(&moduli, &times)?.with_constant(self.constant))))
    }

    pub fn half_space(&self) -> Result<HalfSpace, StudyError> {
        Ok(HalfSpace::new(Vec::new(), self.material()?))
    }
}

/// A coat on a substrate, or on a rigid base.
#[derive(Debug, Clone)]
pub struct Coated {
    pub coat: Stuff,
    pub thickness: f64,
    pub substrate: Option<Stuff>,
}

impl Coated {
    fn with(&self, of: fn(&Stuff) -> Stuff) -> Self {
        Self { coat: of(&self.coat), thickness: self.thickness, substrate: self.substrate.as_ref().map(of) }
    }

    fn half_space(&self) -> Result<HalfSpace, StudyError> {
        let layers = vec![Layer::new(self.coat.material()?, self.thickness, Interface::Bonded)?];
        Ok(match &self.substrate {
            Some(substrate) => HalfSpace::new(layers, substrate.material()?),
            None => HalfSpace::on_rigid_base(layers)?,
        })
    }
}

/// Names of the coated bodies.
pub const NAMES: [&str; 4] = ["soft coat", "stiff coat", "coat on a rigid base", "two bodies"];

/// A soft coat that relaxes, a stiff coat on a body that does, one that does on a rigid base, and two bodies.
fn coats() -> [Vec<Coated>; 4] {
    let soft = |substrate| Coated { coat: Stuff::relaxing(1.0, 0.45), thickness: 0.05, substrate };
    let stiff =
        Coated { coat: Stuff::elastic(20.0, 0.25), thickness: 0.02, substrate: Some(Stuff::relaxing(1.0, 0.45)) };
    let above = Coated { coat: Stuff::elastic(3.0, 0.3), thickness: 0.1, substrate: Some(Stuff::relaxing(2.0, 0.45)) };
    let on_body = soft(Some(Stuff::elastic(20.0, 0.3)));
    [vec![on_body.clone()], vec![stiff], vec![soft(None)], vec![on_body, above]]
}

/// A coated body by its number, with all materials as they are, glassy or relaxed.
pub fn coated(number: usize, of: fn(&Stuff) -> Stuff) -> Result<Bodies, StudyError> {
    let of_all: Vec<_> = coats()[number].iter().map(|coated| coated.with(of).half_space()).collect::<Result<_, _>>()?;
    Ok(match &of_all[..] {
        [body, above] => Bodies::elastic(body.clone(), above.clone()),
        _ => Bodies::from(of_all[0].clone()),
    })
}

/// Names of the surfaces.
pub const SURFACES: [&str; 4] = ["paraboloid", "levels", "rough", "waves on an oblique cell"];

pub fn surface(number: usize) -> Result<LoadedBy, StudyError> {
    let level = |height: f64| Level::new(Shape::Sphere { radius: 1.0 }, height);
    Ok(match number {
        0 => {
            Indenters::new(Lattice::square(1.0, 1)?, vec![Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0)?])?.into()
        }
        1 => Indenters::new(Lattice::hexagonal(1.0, 3)?, vec![level(0.02)?, level(0.01)?, level(0.0)?])?.into(),
        2 => {
            let cell = Cell::square(1.0)?;
            let [longest, rolloff, shortest] = [0.5, 0.5, 1.0 / 16.0];
            let rough = SelfAffine { hurst: 0.8, longest, rolloff, shortest, rms: Rms::Slope(0.1), seed: 4 };
            Topography::new(cell, rough.heights(cell, [128; 2])?)?.into()
        }
        _ => {
            let cell = Cell::new([1.0, 0.1], [0.3, 0.8])?;
            let turn = std::f64::consts::TAU;
            let height = |s: f64, t: f64| {
                let (x, y) = (turn * s, turn * t);
                0.004 * ((x + y).cos() + 0.6 * (2.0 * x - y + 0.3).cos() + 0.4 * (3.0 * y + 1.0).cos())
            };
            crate::steps::topography(cell, [45, 36], height)?.into()
        }
    })
}

/// Solver in time of a problem whose steps are divided by their errors; none at an infinite tolerance.
pub fn in_time(problem: &Problem, points: [usize; 2], tolerance: f64) -> Result<CreepSolver, StudyError> {
    Ok(CreepSolver::new(problem.clone(), points, Settings::default(), tolerance)?)
}

pub fn advanced(solver: &mut CreepSolver, time: f64, load: Load) -> Result<CreepStep, StudyError> {
    let step = solver.advance(time, load)?;
    if step.contact.report.stop.solved() { Ok(step) } else { Err(format!("t {time}: {}", step.contact).into()) }
}

/// The elastic step of a load.
pub fn solved(problem: Problem, points: [usize; 2], load: Load) -> Result<Step, StudyError> {
    let step = Solver::new(problem, points, Settings::default())?.solve(load);
    if step.report.stop.solved() { Ok(step) } else { Err(format!("{load}: {}", step.report).into()) }
}

pub fn in_contact(step: &Step) -> usize {
    step.pressure().iter().filter(|p| **p > 0.0).count()
}
