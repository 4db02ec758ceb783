//! The case file: what a person writes, checked once, with every default resolved.
//!
//! A [`Case`] is read from TOML ([`Case::read`]), changed by overrides `KEY=VALUE`, and handed on as the core's types:
//! its problem, and the run that solves it. What is wrong is refused with its line ([`CaseError`]). One file a section:
//! lattice, levels, surface, layers (with the substrate), load, grid, solver, friction, units, stress, localized; `keys` says what every key is.
//! `magnitude` refuses what double precision cannot carry; [`plausibility`] doubts what looks mixed up; [`resources`] says
//! what a run takes.
//!
//! ```
//! use percoat::case::{Case, embedded};
//! let source = embedded::source(embedded::DEFAULT).expect("the default case is embedded");
//! let case = Case::read(&source, &["load.mean_pressure=0.01".to_owned()]).expect("a valid case");
//! assert_eq!(case.load.values(), [0.01]);
//! ```

pub mod embedded;
mod error;
mod find;
mod foreseen;
mod friction;
mod grading;
mod grid;
mod half_space;
mod interface;
mod keys;
mod lattice;
mod layers;
mod levels;
mod load;
mod localized;
mod magnitude;
mod material_names;
mod model;
mod node;
mod overrides;
mod pipes;
mod place;
pub mod plausibility;
mod reader;
pub mod resources;
mod room;
mod section;
mod sizes;
mod solver;
mod source;
mod stress;
mod sublayers;
mod surface;
#[cfg(test)]
mod tests;
mod threads;
mod units;
mod value;
mod words;

pub use error::CaseError;
pub use find::{NoCase, find};
pub use foreseen::foreseen;
pub use friction::FrictionSection;
pub use grading::{Grading, Law};
pub use grid::Points;
pub use half_space::half_space;
pub use interface::{InterfaceSection, InterfaceStrengthSection, InterfaceWord, SpringSection};
pub use keys::{CARRIED, Explanation, UnknownKey, explain, overview, schema};
pub use lattice::{LatticeKind, LatticeSection};
pub use layers::{LayerSection, SubstrateSection};
pub use levels::{LevelSection, ShapeKind};
pub use load::{LoadSection, Steps};
pub use localized::LocalizedSection;
pub use material_names::MaterialNames;
pub use model::Case;
pub(crate) use model::written;
pub use pipes::Pipes;
pub use room::{Room, available_memory};
pub use source::Source;
pub use stress::{Cut, Origin, StressSection, Toward};
pub use sublayers::sublayer_error;
pub use surface::{ORIENTATION, RandomSection, Sides, SurfaceSection, Taper};
pub use threads::Threads;
pub use units::UnitsSection;
