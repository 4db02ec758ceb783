//! **percoat**: periodic contact of coated bodies.
//!
//! Frictionless normal contact of a doubly periodic, multi-level system of rigid indenters (or any periodic topography)
//! with a layered elastic half-space: I. Goryacheva & E. Torskaya, *Contact of multi-level periodic system of indenters
//! with coated elastic half-space*, Facta Universitatis, Mech. Eng. 17 (2019) 149–159.
//!
//! # Conventions
//!
//! - z points into the body; pressure p > 0 is compression; stresses are positive in tension; displacement w > 0 goes
//!   into the body.
//! - Any consistent units. Wavenumbers are angular, 1/length.
//! - Fields are stored sample by sample, **a**₂ fastest; displacements have zero mean, so that the penetration δ,
//!   measured from the mean plane of the deformed surface to the highest apex, is the additional displacement w_a of
//!   the paper's Eq. (8).
//! - Frictionless interfaces carry tension: they slide but do not open.
//!
//! # Modules
//!
//! Each uses only what stands to its left; problem, grid and solution are built in that order.
//!
//! ```text
//! lattice, indenter ─────────────→ texture ─┐
//! lattice → grid → fourier ─────────────────┤
//! material → layered ─────────→ operator ───┴→ solver → hierarchy → observables → refinement, touch
//! indenter, lattice, layered ────────────────→ localized ────────────┴→ comparison
//!                                                         case → output → picture → validation → command line
//! ```
//!
//! [`field`] (sums that do not depend on the number of threads), [`least_squares`], [`linear`] (small systems),
//! [`edge`] and [`boundary`] (the outline of a contact between samples) and [`number`] serve all of them.
//! Nothing left of [`case`] reads a file or prints. [`exact`] holds the closed forms that [`validation`] compares with;
//! the solver knows nothing of it.
//!
//! # Example
//!
//! ```
//! use percoat::hierarchy::Hierarchy;
//! use percoat::indenter::{Level, Shape};
//! use percoat::lattice::Lattice;
//! use percoat::material::{HalfSpace, Interface, Layer, Material};
//! use percoat::observables::observe;
//! use percoat::solver::{Control, Settings};
//! use percoat::texture::Surface;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height);
//! let surface = Surface::Indenters {
//!     lattice: Lattice::hexagonal(1.0, 3)?,
//!     levels: vec![level(0.02)?, level(0.01)?, level(0.0)?],
//! };
//! let substrate = Material::from_young(1.0, 0.3)?;
//! let coating = Material::from_shear(2.0 * substrate.shear(), 0.2)?;
//! let half_space = HalfSpace::new(vec![Layer::new(coating, 0.5, Interface::Bonded)?], substrate);
//! let mut hierarchy = Hierarchy::new(&surface, &half_space, [96, 96], Settings::default())?;
//! let solution = hierarchy.solve(Control::MeanPressure(0.06), &mut |_| ());
//! let observables = observe(&hierarchy, &solution);
//! assert!(solution.report.stop.solved());
//! assert!((observables.penetration - 0.0554).abs() < 1e-4);
//! # Ok(())
//! # }
//! ```

pub mod boundary;
pub mod case;
mod closed_line;
pub mod comparison;
mod components;
pub mod edge;
pub mod exact;
pub mod field;
pub mod fourier;
pub mod grid;
pub mod hierarchy;
pub mod indenter;
pub mod lattice;
pub mod layered;
pub mod least_squares;
pub mod linear;
pub mod localized;
pub mod material;
pub mod number;
pub mod observables;
pub mod operator;
pub mod output;
pub mod picture;
pub mod refinement;
pub mod solver;
pub mod stress;
pub mod texture;
pub mod touch;
pub mod validation;
