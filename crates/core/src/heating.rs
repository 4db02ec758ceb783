//! Frictional heat of a counterbody that slides steadily: q = μ p v, and how it is shared between the bodies.
//!
//! Both surfaces have one temperature where they touch (**solved** partition), or the body takes a given share of the flux everywhere. A rigid
//! counterbody takes none. Temperatures count from the bulk temperatures; the mean over the cell, which grows without end on a half-space,
//! is left out: in a periodic cell they are those above the mean temperature of each surface.

use crate::body::{HalfSpace, MaterialId};
use crate::heat::HeatedBody;
use crate::notation::number;
use rustfft::num_complex::Complex64;
use std::fmt;

/// How the frictional heat is shared between body and counterbody.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Partition {
    /// Temperatures of both surfaces are equal where they touch.
    #[default]
    Solved,
    /// The share of the body, from 0 to 1, is given everywhere.
    Share(f64),
}

/// Why a problem has no frictional heat.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum HeatingError {
    /// A share of the body outside [0, 1].
    #[error("the share of the body must lie between 0 and 1, not {0}")]
    Share(f64),
    /// A bulk temperature that is not finite.
    #[error("bulk temperatures must be finite, not {0}")]
    Bulk(f64),
    /// Nothing moves.
    #[error("frictional heat needs a velocity")]
    Rest,
    /// No friction.
    #[error("frictional heat needs friction: a coefficient above 0")]
    Smooth,
    /// A material without conduction.
    #[error("{0} has no conduction of heat: give each material a conductivity and a diffusivity")]
    Material(MaterialId),
}

/// Frictional heat of a problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heating {
    partition: Partition,
    bulk: [f64; 2],
    expands: bool,
}

impl Default for Heating {
    fn default() -> Self {
        Self { partition: Partition::Solved, bulk: [0.0; 2], expands: true }
    }
}

impl Heating {
    /// Heat with a partition, and the bulk temperatures of body and counterbody.
    ///
    /// # Errors
    /// [`HeatingError`] for a share outside [0, 1] and a temperature that is not finite.
    pub fn new(partition: Partition, bulk: [f64; 2]) -> Result<Self, HeatingError> {
        if let Partition::Share(share) = partition
            && !(0.0..=1.0).contains(&share)
        {
            return Err(HeatingError::Share(share));
        }
        match bulk.into_iter().find(|temperature| !temperature.is_finite()) {
            Some(temperature) => Err(HeatingError::Bulk(temperature)),
            None => Ok(Self { partition, bulk, expands: true }),
        }
    }

    /// Heat that expands nothing: temperatures alone.
    #[must_use]
    pub fn without_expansion(self) -> Self {
        Self { expands: false, ..self }
    }

    /// How the heat is shared.
    pub fn partition(&self) -> Partition {
        self.partition
    }

    /// Bulk temperatures of body and counterbody.
    pub fn bulk(&self) -> [f64; 2] {
        self.bulk
    }

    /// Whether the bodies expand, and the contact changes.
    pub fn expands(&self) -> bool {
        self.expands
    }
}

/// Conducting bodies below and above the source of heat, which moves over the body in a direction.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HeatedBodies {
    pub body: HeatedBody,
    /// `None` of a rigid counterbody, which takes no heat.
    pub counterbody: Option<HeatedBody>,
    /// Unit vector of the motion.
    direction: [f64; 2],
}

impl HeatedBodies {
    /// Conducting bodies below a source of this velocity over the body, in a direction.
    ///
    /// # Errors
    /// [`HeatingError::Material`] for a material without conduction.
    pub fn new(
        body: &HalfSpace,
        counterbody: Option<&HalfSpace>,
        (speed, direction): (f64, [f64; 2]),
    ) -> Result<Self, HeatingError> {
        let of = |half_space: &HalfSpace, speed: f64| {
            HeatedBody::of(half_space, speed).ok_or_else(|| {
                let index = half_space.materials().position(|material| material.conduction().is_none());
                HeatingError::Material(half_space.material_id(index.map_or(1, |index| index + 1)))
            })
        };
        let counterbody = counterbody.map(|above| of(above, 0.0)).transpose()?;
        Ok(Self { body: of(body, speed)?, counterbody, direction })
    }

    /// Unit vector of the motion.
    pub fn direction(&self) -> [f64; 2] {
        self.direction
    }

    /// The wavevector **k** in axes along and across the motion.
    pub fn turned(&self, [kx, ky]: [f64; 2]) -> [f64; 2] {
        let [ex, ey] = self.direction;
        [kx * ex + ky * ey, ky * ex - kx * ey]
    }

    /// Share of the body that is nearest to one temperature of both surfaces for waves of a wavenumber, 1/length, along the motion.
    pub fn nearest_share(&self, wavenumber: f64) -> f64 {
        let of = |body: &HeatedBody| body.surface_temperature([wavenumber, 0.0]).re;
        self.counterbody.as_ref().map_or(1.0, |above| of(above) / (of(&self.body) + of(above)))
    }

    /// Swelling Ŵ of the gap under a flux of which the body has a share, at a wavevector **k** ≠ 0: a length per power and area, below 0.
    pub fn swelling(&self, wavevector: [f64; 2], share: f64) -> Complex64 {
        let wavevector = self.turned(wavevector);
        let above = self.counterbody.as_ref().map_or(Complex64::default(), |above| above.swelling(wavevector));
        self.body.swelling(wavevector) * share + above * (1.0 - share)
    }
}

impl fmt::Display for Heating {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [body, counterbody] = self.bulk.map(number);
        match self.partition {
            Partition::Solved => write!(f, "frictional heat, one temperature in contact")?,
            Partition::Share(share) => write!(f, "frictional heat, {} of it into the body", number(share))?,
        }
        let expands = if self.expands { "" } else { ", without expansion" };
        write!(f, ", bulk temperatures {body} and {counterbody}{expands}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(Heating::new(Partition::Share(1.1), [0.0; 2]), Err(HeatingError::Share(1.1)));
        assert_eq!(Heating::new(Partition::Solved, [0.0, f64::INFINITY]), Err(HeatingError::Bulk(f64::INFINITY)));
        let heating = Heating::new(Partition::Share(0.5), [20.0, 40.0]).unwrap();
        assert!(heating.expands() && !heating.without_expansion().expands());
    }
}
