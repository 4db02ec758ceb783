//! Bravais cells, where the indenters of each level stand in them, and the grids that sample them.

mod cell;
pub(crate) mod components;
mod error;
mod grid;
mod interpolation;
mod sites;

pub use cell::{Cell, Reduced};
pub use error::LatticeError;
pub use grid::{Grid, ShapeError};
pub use interpolation::{Interpolation, resample};
pub use sites::Lattice;
