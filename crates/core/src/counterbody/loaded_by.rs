//! Loading of the body: a counterbody that is pressed onto it, or a given pressure.

use super::{Counterbody, GivenPressure, Indenters, Surface, Topography, constant_axis};
use crate::kind::ContactKind;
use crate::lattice::{Cell, LatticeError};
use ndarray::ArrayView2;
use std::fmt;

/// Loading of the body.
#[derive(Debug, Clone, PartialEq)]
pub enum LoadedBy {
    /// A counterbody, whose pressure of contact is sought.
    Counterbody(Counterbody),
    /// A pressure that is given: nothing stands above the body.
    Pressure(GivenPressure),
}

impl LoadedBy {
    /// The unit cell.
    pub fn cell(&self) -> Cell {
        match self {
            Self::Counterbody(counterbody) => counterbody.cell(),
            Self::Pressure(pressure) => pressure.cell(),
        }
    }

    /// Kind of the contact.
    pub fn kind(&self) -> ContactKind {
        ContactKind { surroundings: self.cell().surroundings(), is_given: self.pressure().is_some() }
    }

    /// The counterbody; `None` under a given pressure.
    pub fn counterbody(&self) -> Option<&Counterbody> {
        match self {
            Self::Counterbody(counterbody) => Some(counterbody),
            Self::Pressure(_) => None,
        }
    }

    /// The given pressure; `None` under a counterbody.
    pub fn pressure(&self) -> Option<&GivenPressure> {
        match self {
            Self::Counterbody(_) => None,
            Self::Pressure(pressure) => Some(pressure),
        }
    }

    /// The axis, 0 along a₁ or 1 along a₂, along which the [samples](Self::samples) are constant, but for rounding, while they change along
    /// the other: contact is that of lines along it. `None` without samples, and in a window, where lines end.
    pub fn line(&self) -> Option<usize> {
        let samples = || constant_axis(self.samples()?);
        self.cell().surroundings().per_cell(samples)?()
    }

    /// The heights of a topography, or the values of a given field of pressures, axes along a₁ and a₂; `None` of indenters and of discs.
    pub fn samples(&self) -> Option<ArrayView2<'_, f64>> {
        match self {
            Self::Counterbody(counterbody) => Some(counterbody.topography()?.heights()),
            Self::Pressure(pressure) => pressure.values(),
        }
    }

    /// The undeformed surface on a grid with `points` = [N₁, N₂]: that of the counterbody, or a flat one under a given pressure.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn surface(&self, points: [usize; 2]) -> Result<Surface, LatticeError> {
        match self {
            Self::Counterbody(counterbody) => Surface::new(counterbody, points),
            Self::Pressure(pressure) => Surface::flat(pressure.cell(), points),
        }
    }

    /// The undeformed surface on a grid coarser than that of a `finer` one, for the start of a solution: exact for indenters, else as the
    /// coarser grid holds the finer surface.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub(crate) fn coarser_surface(&self, finer: &Surface, points: [usize; 2]) -> Result<Surface, LatticeError> {
        match finer.owner() {
            Some(_) => self.surface(points),
            None => finer.coarser(points),
        }
    }
}

impl From<Counterbody> for LoadedBy {
    fn from(counterbody: Counterbody) -> Self {
        Self::Counterbody(counterbody)
    }
}

impl From<Indenters> for LoadedBy {
    fn from(indenters: Indenters) -> Self {
        Self::Counterbody(indenters.into())
    }
}

impl From<Topography> for LoadedBy {
    fn from(topography: Topography) -> Self {
        Self::Counterbody(topography.into())
    }
}

impl From<GivenPressure> for LoadedBy {
    fn from(pressure: GivenPressure) -> Self {
        Self::Pressure(pressure)
    }
}

impl fmt::Display for LoadedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Counterbody(counterbody) => counterbody.fmt(f),
            Self::Pressure(pressure) => pressure.fmt(f),
        }
    }
}
