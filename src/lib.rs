//! **percoat**: periodic contact of coated bodies.
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
//! # Crates
//!
//! Each crate sees those that stand to its left, and the compiler holds it; within a crate no files import each other in a ring:
//!
//! ```text
//! core, common → surfaces, draw → case → app → validation → percoat: this facade and the program
//! ```
//!
//! - `percoat-core`: the numerical library, which reads no file and prints nothing. All of it is here too, module by module;
//! - `percoat-common`: [`plain`] text, the unit of a number, memory and threads of the [`machine`];
//! - `percoat-surfaces`: the formats of instruments; `percoat-draw`: charts and maps, which know no physics ([`draw`]);
//! - `percoat-case`: [`case`] files, [`units`], [`words`] for kinds of contact, [`measurements`] from tables;
//! - `percoat-app`: [`output`], [`sweep`], [`picture`] and [`report`];
//! - `percoat-validation`: the studies and the closed forms that they compare with ([`validation`]).
//!
//! The feature `cli` has the crates around the core and the [`command`] line, `validate` the studies.
//!
//! [`theory`] leads from each equation of the book, `docs/src/theory.md`, to its code and to the test that guards it.
//!
//! # Example
//!
//! ```
//! use percoat::*;
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

pub use percoat_core::*;

#[cfg(feature = "cli")]
pub use percoat_app::{output, picture, report, sweep, task};
#[cfg(feature = "cli")]
pub use percoat_case::{case, measurements, units, words};
#[cfg(feature = "cli")]
pub use percoat_common::{machine, plain};
#[cfg(feature = "cli")]
pub use percoat_draw as draw;
#[cfg(feature = "validate")]
pub use percoat_validation as validation;

#[cfg(all(feature = "cli", not(target_family = "wasm")))]
pub mod command;
/// The examples of the book's page on the library, which are tests of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../docs/src/how-to/rust.md")]
mod how_to_rust {}
#[doc = include_str!("theory.md")]
pub mod theory {}
