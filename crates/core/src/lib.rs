//! The numerical core of percoat: periodic and isolated contact of coated bodies.
//!
//! Normal and sliding contact of a doubly periodic, multi-level system of rigid indenters (or any periodic topography)
//! with a layered elastic half-space: I. Goryacheva & E. Torskaya, *Contact of multi-level periodic system of indenters
//! with coated elastic half-space*, Facta Universitatis, Mech. Eng. 17 (2019) 149–159.
//!
//! # Conventions
//!
//! - z points into the body; pressure p > 0 is compression; stresses are positive in tension; displacement w > 0 goes
//!   into the body.
//! - Any consistent units. Wavenumbers are angular, 1/length.
//! - Fields are stored sample by sample, **a**₂ fastest; on a periodic cell displacements have zero mean, so that the penetration δ,
//!   measured from the mean plane of the deformed surface to the highest apex, is the additional displacement w_a of
//!   the paper's Eq. (8). Around an isolated contact they vanish far away, and δ is the approach of points there. On a rigid base they
//!   count from it: δ then has the mean compression of the layers, p̄ Σ h/M.
//! - Frictionless interfaces carry tension: they slide but do not open.
//!
//! # Modules
//!
//! Problem → solver on a grid → step → reading, built in that order, none reaching back. Each module uses only what
//! stands to its left:
//!
//! ```text
//! numeric → notation → measured → quantity → lattice → load → kind → body → heat → creep → counterbody → friction → steady_motion → heating → adhesion → problem
//! → spectral → stress → reading → identification → localized → run → life → comparison
//! ```
//!
//! - [`lattice`]: cells, sites and grids; [`counterbody`]: indenters, topographies and given pressures; [`body`]: the layered half-space; [`creep`]: its
//!   retardation in time;
//! - [`heat`]: temperature, swelling and thermal stress of layered bodies under a heat source that moves, wave by wave;
//! - [`load`], [`kind`], [`friction`], [`steady_motion`], [`heating`], [`adhesion`], [`problem`]: loads, friction, motion, heat, tension, bodies and counterbody of a problem;
//! - [`spectral`]: the whole cell, by conjugate gradients in Fourier space; [`localized`]: the paper's boundary elements;
//! - [`measured`]: values with their errors; [`quantity`]: names, symbols and kinds of what is read off a step, declared once;
//! - [`stress`]: inside coating and substrate; [`reading`]: what a tribologist reads off, with its errors;
//! - [`identification`]: parameters of a stack from a measured indentation curve;
//! - [`run`]: load paths, refinement, warnings; [`life`]: damage and wear pass after pass; [`comparison`]: both methods side by side.
//!
//! Nothing of these reads a file or prints.
//!
//! # Example
//!
//! ```
//! use percoat_core::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height);
//! let indenters = Indenters::new(Lattice::hexagonal(1.0, 3)?, vec![level(0.02)?, level(0.01)?, level(0.0)?])?;
//! let substrate = Material::from_young(1.0, 0.3)?;
//! let coating = Layer::new(Material::from_shear(2.0 * substrate.shear(), 0.2)?, 0.5, Interface::Bonded)?;
//! let problem = Problem::new(indenters, HalfSpace::new(vec![coating], substrate));
//! let step = Solver::new(problem, [96, 96], Settings::default())?.solve(Load::MeanPressure(0.06));
//! let reading = step.reading();
//! assert!(step.report.stop.solved());
//! assert!((reading.penetration - 0.0554).abs() < 1e-4);
//! # Ok(())
//! # }
//! ```

pub mod adhesion;
pub mod body;
pub mod comparison;
pub mod counterbody;
pub mod creep;
pub mod friction;
pub mod heat;
pub mod heating;
pub mod identification;
pub mod kind;
pub mod lattice;
pub mod life;
pub mod load;
pub mod localized;
pub mod measured;
pub mod notation;
pub mod numeric;
pub mod problem;
pub mod quantity;
pub mod reading;
pub mod run;
pub mod spectral;
pub mod steady_motion;
pub mod stress;

pub use adhesion::{Adhesion, AdhesionLaw};
pub use body::{
    Bodies, Depth, Durability, Endurance, Fatigue, HalfSpace, Interface, InterfaceStrength, Layer, Material,
    MaterialError, MeanStress, StrainDirection, StrainLife, Strength, Substrate,
};
pub use counterbody::{
    Counterbody, CounterbodyError, GivenPressure, IndenterError, Indenters, Level, LoadedBy, LoadedDisc, MeasuredTip,
    Shape, Surface, Topography,
};
pub use friction::{Friction, FrictionError};
pub use heat::{HeatError, HeatedBody};
pub use heating::{Heating, HeatingError, Partition};
pub use kind::{ContactKind, Datum};
pub use lattice::{Cell, Grid, Lattice, LatticeError, NotOnGrid, Surroundings};
pub use load::{Load, LoadQuantity};
pub use measured::Measured;
pub use problem::Problem;
pub use reading::{DamageMap, FatigueReading, LevelReading, Life, Reading, StressReading};
pub use run::{Run, Sampling};
pub use spectral::{
    AdhesiveSolver, AdhesiveStep, Certificate, Contact, CreepSolver, CreepStep, FieldError, Method, Progress, Report,
    Route, Settings, Solver, Step, Stop, Tangent, Wear, WearError, Worn,
};
pub use steady_motion::{MotionError, SteadyMotion};
pub use stress::{
    DepthPlane, SlidingPath, StressField, StressFields, StressState, SurfaceLine, Traction, VerticalSection,
};
