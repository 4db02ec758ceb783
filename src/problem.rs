//! The contact problem: a rigid counterbody above a layered elastic half-space, at rest or sliding.

use crate::body::{HalfSpace, Interface};
use crate::counterbody::Counterbody;
use crate::friction::{Friction, FrictionError};
use crate::lattice::Cell;
use std::fmt;

/// A counterbody above a half-space, with or without friction. Both parts are checked at construction: every problem is valid.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    counterbody: Counterbody,
    half_space: HalfSpace,
    friction: Option<Friction>,
}

impl Problem {
    /// Frictionless contact of the counterbody ([`Indenters`](crate::counterbody::Indenters) or a
    /// [`Topography`](crate::counterbody::Topography)) with the half-space, in one unit of length.
    pub fn new(counterbody: impl Into<Counterbody>, half_space: HalfSpace) -> Self {
        Self { counterbody: counterbody.into(), half_space, friction: None }
    }

    /// The problem with friction.
    ///
    /// # Errors
    /// [`FrictionError::Unheld`] when a layer lies on a frictionless interface, unless the coefficient is zero.
    pub fn sliding(self, friction: Friction) -> Result<Self, FrictionError> {
        let loose = self.half_space.layers().iter().position(|layer| layer.interface() == Interface::Frictionless);
        match loose.filter(|_| friction.coefficient() > 0.0) {
            Some(layer) => Err(FrictionError::Unheld(layer + 1)),
            None => Ok(Self { friction: Some(friction), ..self }),
        }
    }

    /// The rigid counterbody.
    pub fn counterbody(&self) -> &Counterbody {
        &self.counterbody
    }

    /// The layered half-space.
    pub fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// The friction of a sliding counterbody; `None` at rest.
    pub fn friction(&self) -> Option<&Friction> {
        self.friction.as_ref()
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.counterbody.cell()
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", self.counterbody, self.half_space)?;
        self.friction.iter().try_for_each(|friction| write!(f, "\n{friction}"))
    }
}
