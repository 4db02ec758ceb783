//! The contact problem: a rigid counterbody above a layered elastic half-space.

use crate::body::HalfSpace;
use crate::counterbody::Counterbody;
use crate::lattice::Cell;
use std::fmt;

/// What is pressed into what. Both parts were checked when they were built: every problem is valid.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    counterbody: Counterbody,
    half_space: HalfSpace,
}

impl Problem {
    /// The counterbody ([`Indenters`](crate::counterbody::Indenters) or a
    /// [`Topography`](crate::counterbody::Topography)) above the half-space, in one unit of length.
    pub fn new(counterbody: impl Into<Counterbody>, half_space: HalfSpace) -> Self {
        Self { counterbody: counterbody.into(), half_space }
    }

    /// The rigid counterbody.
    pub fn counterbody(&self) -> &Counterbody {
        &self.counterbody
    }

    /// The layers on the substrate.
    pub fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.counterbody.cell()
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", self.counterbody, self.half_space)
    }
}
