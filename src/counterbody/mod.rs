//! The rigid counterbody: indenters at several levels, or a topography; and its surface on a grid.

mod error;
mod indenter;
mod indenters;
pub mod roughness;
mod surface;
mod topography;

pub use error::CounterbodyError;
pub use indenter::{IndenterError, Level, Shape};
pub use indenters::{Indenters, Site};
pub use surface::Surface;
pub use topography::Topography;

use crate::lattice::Cell;
use std::fmt;

/// The rigid counterbody, independent of any grid.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Counterbody {
    /// Indenters at several levels on the sites of a lattice.
    Indenters(Indenters),
    /// One period of a measured or generated topography.
    Topography(Topography),
}

impl Counterbody {
    /// The unit cell.
    pub fn cell(&self) -> Cell {
        match self {
            Self::Indenters(indenters) => indenters.lattice().cell(),
            Self::Topography(topography) => topography.cell(),
        }
    }

    /// The indenters; `None` for a topography.
    pub fn indenters(&self) -> Option<&Indenters> {
        match self {
            Self::Indenters(indenters) => Some(indenters),
            Self::Topography(_) => None,
        }
    }

    /// The topography; `None` for indenters.
    pub fn topography(&self) -> Option<&Topography> {
        match self {
            Self::Topography(topography) => Some(topography),
            Self::Indenters(_) => None,
        }
    }

    /// The levels of the indenters; none for a topography.
    pub fn levels(&self) -> &[Level] {
        self.indenters().map_or(&[], Indenters::levels)
    }
}

impl From<Indenters> for Counterbody {
    fn from(indenters: Indenters) -> Self {
        Self::Indenters(indenters)
    }
}

impl From<Topography> for Counterbody {
    fn from(topography: Topography) -> Self {
        Self::Topography(topography)
    }
}

impl fmt::Display for Counterbody {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Indenters(indenters) => indenters.fmt(f),
            Self::Topography(topography) => topography.fmt(f),
        }
    }
}
