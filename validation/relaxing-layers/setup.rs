//! One asperity in each cell, what slides below it, and what is read off.

use crate::StudyError;
use crate::moving::setup::{Stuff, TOLERANCE, friction, moving, solved};
use percoat_core::body::{HalfSpace, Interface, Layer, MeanStress};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::reading::Reading;
use percoat_core::spectral::Step;
use percoat_core::stress::{Peak, StressField};

/// Radius of a paraboloid; the unit of lengths. That of moduli is the relaxed shear modulus, that of times the relaxation time.
pub const RADIUS: f64 = 1.0;
/// Hertz' radius a₀ under the load on the relaxed half-space of ν = 0.3, a length: the unit of thicknesses and of ways in a relaxation time.
pub const HERTZ: f64 = 0.1;
/// Glassy over relaxed modulus.
pub const RATIO: f64 = 10.0;
/// Poisson's ratio where nothing else is said; constant in each material.
pub const POISSON: f64 = 0.3;

/// The load of a paraboloid with Hertz' radius a₀ on the relaxed half-space of ν: P = 4/3 · 2G/(1 − ν) · a₀³/R.
pub fn load(poisson: f64) -> f64 {
    8.0 / 3.0 / (1.0 - poisson) * HERTZ.powi(3) / RADIUS
}

/// A layer that relaxes on a rigid base, or the half-space of its material without a thickness.
pub fn layer(thickness: Option<f64>, poisson: f64, ratio: f64) -> Result<HalfSpace, StudyError> {
    let material = Stuff::relaxing(1.0, poisson, ratio).material()?;
    let bonded = |thickness| Layer::new(material, thickness, Interface::Bonded);
    Ok(match thickness {
        Some(thickness) => HalfSpace::on_rigid_base(vec![bonded(thickness)?])?,
        None => HalfSpace::new(Vec::new(), material),
    })
}

/// What slides: an asperity, in cells of these sides on these samples, with a velocity and a load.
#[derive(Debug, Clone, Copy)]
pub struct Slide {
    /// Exponent of the profile, 2 of a paraboloid.
    pub exponent: f64,
    pub sides: [f64; 2],
    pub points: [usize; 2],
    /// Way in the relaxation time, a length.
    pub way: f64,
    pub load: f64,
}

/// Readings of a contact: values, each with its error. That of the peak is its change from half the samples a side: what is stated is far
/// larger, as the peak lies a few samples beside the edge.
#[derive(Debug, Clone)]
pub struct Slid {
    pub friction: [f64; 2],
    /// Friction by the lost energy.
    pub by_energy: f64,
    pub peak: [f64; 2],
    pub step: Step,
}

impl Slide {
    /// A paraboloid in square cells of the side `side`, in a₀, with the way in a₀.
    pub fn square(side: f64, points: usize, way: f64) -> Self {
        let side = side * HERTZ;
        Self { exponent: 2.0, sides: [side; 2], points: [points; 2], way: way * HERTZ, load: load(POISSON) }
    }

    /// The asperities: r²/(2R), or c rⁿ that under the load of a paraboloid has the radius a₀ on a half-space.
    pub fn asperities(&self) -> Result<Indenters, StudyError> {
        let cell = Cell::new([self.sides[0], 0.0], [0.0, self.sides[1]])?;
        let shape = if self.exponent == 2.0 {
            Shape::Paraboloid { radius: RADIUS }
        } else {
            Shape::Power { coefficient: coefficient(self.exponent), exponent: self.exponent }
        };
        Ok(Indenters::new(Lattice::new(cell, vec![vec![[0.5; 2]]])?, vec![Level::new(shape, 0.0)?])?)
    }

    /// The contact with a body.
    pub fn over(&self, body: HalfSpace) -> Result<Slid, StudyError> {
        let mean = self.load / (self.sides[0] * self.sides[1]);
        let step = solved(moving(self.asperities()?, body, self.way)?, self.points, [mean, TOLERANCE])?;
        let (read, contact) = (friction(&step)?, step.reading());
        let coarse = Reading::of(step.coarser().first().ok_or("no coarser grid")?);
        Ok(Slid {
            friction: [read.friction_coefficient, read.error.unwrap_or(f64::NAN)],
            by_energy: read.by_energy,
            peak: [contact.max_pressure, (contact.max_pressure - coarse.max_pressure).abs()],
            step,
        })
    }
}

impl Slid {
    /// Largest τ₁ of a material, from the surface down, with its error.
    pub fn shear(&self, material: usize) -> Result<[f64; 2], StudyError> {
        let radius = self.step.reading().levels[0].contact_radius.ok_or("no contact")?;
        let field = |contact| StressField::new(contact, MeanStress::Confined);
        let coarser = self.step.coarser().first().ok_or("no coarser grid")?;
        let maxima = field(self.step.finest()).maxima([radius; 2]).with_errors(&field(coarser));
        let Peak { value, error, .. } = maxima.materials[material].tau1;
        Ok([value, error.unwrap_or(f64::NAN)])
    }
}

/// c of c rⁿ, n even, whose contact has the radius a₀ under the load of the paraboloid: Galin, P = 2E* n/(n + 1) δ a,
/// δ = c aⁿ · 2/1 · 4/3 · … · n/(n − 1).
fn coefficient(exponent: f64) -> f64 {
    let depth: f64 = (1..=(0.5 * exponent) as usize).map(|k| 2.0 * k as f64 / (2.0 * k as f64 - 1.0)).product();
    let force = 2.0 * exponent / (exponent + 1.0) * depth;
    4.0 / 3.0 / RADIUS * HERTZ.powf(2.0 - exponent) / force
}

/// A change from one value to another with its error, over the first value.
pub fn change(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let ratio = to[0] / from[0];
    [ratio - 1.0, ratio.abs() * (from[1] / from[0]).abs().hypot((to[1] / to[0]).abs())]
}

/// How many of its errors a change is large.
pub fn clear([change, error]: [f64; 2]) -> f64 {
    change.abs() / error
}
