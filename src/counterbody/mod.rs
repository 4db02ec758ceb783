//! What loads the body: indenters at several levels, a topography, or a given pressure; and its surface on a grid.

mod error;
mod indenter;
mod indenters;
mod pressure;
pub mod roughness;
mod surface;
mod topography;

pub use error::CounterbodyError;
pub use indenter::{IndenterError, Level, Shape};
pub use indenters::{Indenters, Site};
pub use pressure::{GivenPressure, LoadedDisc};
pub use surface::Surface;
pub use topography::Topography;

use crate::lattice::Cell;
use std::fmt;

/// The counterbody, independent of any grid, or a pressure in its place.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Counterbody {
    /// Indenters at several levels on the sites of a lattice.
    Indenters(Indenters),
    /// One period of a measured or generated topography.
    Topography(Topography),
    /// No counterbody, but a pressure that is given.
    Pressure(GivenPressure),
}

impl Counterbody {
    /// The unit cell.
    pub fn cell(&self) -> Cell {
        match self {
            Self::Indenters(indenters) => indenters.lattice().cell(),
            Self::Topography(topography) => topography.cell(),
            Self::Pressure(pressure) => pressure.cell(),
        }
    }

    /// The indenters; `None` for a topography and a given pressure.
    pub fn indenters(&self) -> Option<&Indenters> {
        match self {
            Self::Indenters(indenters) => Some(indenters),
            Self::Topography(_) | Self::Pressure(_) => None,
        }
    }

    /// The topography; `None` for indenters and a given pressure.
    pub fn topography(&self) -> Option<&Topography> {
        match self {
            Self::Topography(topography) => Some(topography),
            Self::Indenters(_) | Self::Pressure(_) => None,
        }
    }

    /// The given pressure; `None` for indenters and a topography.
    pub fn pressure(&self) -> Option<&GivenPressure> {
        match self {
            Self::Pressure(pressure) => Some(pressure),
            Self::Indenters(_) | Self::Topography(_) => None,
        }
    }

    /// The levels of the indenters; none for a topography and a given pressure.
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

impl From<GivenPressure> for Counterbody {
    fn from(pressure: GivenPressure) -> Self {
        Self::Pressure(pressure)
    }
}

impl fmt::Display for Counterbody {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Indenters(indenters) => indenters.fmt(f),
            Self::Topography(topography) => topography.fmt(f),
            Self::Pressure(pressure) => pressure.fmt(f),
        }
    }
}
