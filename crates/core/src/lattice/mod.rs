//! The periodic plane: cells, lattices of indenters, grids of samples with their waves, and connected components of samples.

mod cell;
mod closed_path;
pub(crate) mod components;
mod error;
mod grid;
mod images;
mod interpolation;
mod nearest;
pub(crate) mod runs;
mod sites;
mod surroundings;
pub(crate) mod waves;
mod zone;

pub use cell::{Cell, ReducedBasis};
pub use error::LatticeError;
pub use grid::{Grid, NotOnGrid};
pub(crate) use interpolation::{Interpolation, resampled};
pub(crate) use nearest::Connectivity;
pub use sites::Lattice;
pub use surroundings::Surroundings;
