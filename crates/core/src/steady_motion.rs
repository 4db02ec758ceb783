//! Steady motion: a counterbody, or a given pressure, that moves over the body for so long that nothing changes any more beneath it.
//!
//! In the frame of the counterbody, which moves along the unit vector **e** with the velocity v, the fields stand still. A point of the body
//! passes through the wave e^{i**k**·**x**} with the frequency ω = −v **k**·**e**: materials that relax respond by their complex moduli there.
//! The counterbody rests in this frame: its materials have their relaxed moduli.
//!
//! **In a periodic cell** the same track is passed again and again: waves along the crests of which the motion goes (**k**·**e** = 0) stay
//! relaxed at any velocity, and a body that is passed ever faster never becomes as stiff as its glassy moduli make it.

use crate::notation::number;
use std::fmt;

/// Why a problem cannot move steadily.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A velocity that is not above 0, or not finite.
    #[error("a velocity must be finite and greater than 0, not {0}")]
    Velocity(f64),
    /// An elastic body that conducts no heat, in which nothing depends on a velocity.
    #[error(
        "nothing depends on a velocity here: no material of the body relaxes, nor do all conduct heat, and a counterbody rests in the frame that moves with it"
    )]
    Elastic,
    /// An isolated contact.
    #[error(
        "a load that moves steadily passes a body in a periodic cell here, not in the window of an isolated contact: take a cell that is wide \
         beside the contact, and beside the way that the velocity makes in a relaxation time"
    )]
    Isolated,
    /// A surface has a hardness.
    #[error(
        "surfaces under a load that moves steadily have no hardness here: what is pressed in leaves the contact, and the indentation of a moving \
         contact is not steady"
    )]
    Hardness,
    /// A material below a contact has a life by strain.
    #[error(
        "strains below a contact that moves over a body that relaxes are not computed, only those below a given pressure: at edges of contact they \
         follow from glassy moduli"
    )]
    Strain,
    /// The surfaces adhere.
    #[error(
        "surfaces under a load that moves steadily do not adhere here: the work of adhesion would depend on the velocity"
    )]
    Adhesion,
}

/// Steady motion of the counterbody over the body, in the direction of the problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyMotion {
    velocity: f64,
}

impl SteadyMotion {
    /// Motion with the velocity v > 0, a length per time.
    ///
    /// # Errors
    /// [`MotionError::Velocity`] for a velocity out of range.
    pub fn new(velocity: f64) -> Result<Self, MotionError> {
        let is_size = velocity.is_finite() && velocity > 0.0;
        if is_size { Ok(Self { velocity }) } else { Err(MotionError::Velocity(velocity)) }
    }

    /// Velocity v, a length per time.
    pub fn velocity(&self) -> f64 {
        self.velocity
    }
}

impl fmt::Display for SteadyMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "moves steadily with the velocity {}", number(self.velocity))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocities_out_of_range_are_refused() {
        for velocity in [0.0, -1.0, f64::INFINITY] {
            assert_eq!(SteadyMotion::new(velocity), Err(MotionError::Velocity(velocity)));
        }
    }
}
