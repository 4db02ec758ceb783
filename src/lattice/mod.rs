//! The periodic plane: cells, the places of the indenters in them, grids of samples, and what is read between them.

mod cell;
pub(crate) mod components;
mod error;
mod grid;
mod interpolation;
mod nearest;
pub(crate) mod runs;
mod sites;
pub(crate) mod waves;
mod zone;

pub use cell::{Cell, Reduced};
pub use error::LatticeError;
pub use grid::{Grid, NotOnGrid};
pub(crate) use interpolation::{Interpolation, resampled};
pub(crate) use nearest::Joined;
pub use sites::Lattice;
