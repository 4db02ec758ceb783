//! Sliding friction by Coulomb's law.
//!
//! The shear traction q = μ p **e** acts on the body in contact, μ the coefficient and **e** the direction in which the
//! counterbody slides. The traction displaces the surface vertically too
//! ([`SurfaceResponse`](crate::body::SurfaceResponse)): with **coupled** friction the pressure depends on that displacement;
//! uncoupled, the pressure is that of frictionless contact, as in the school of the paper, and stresses superpose.

use crate::body::InterfaceId;
use crate::notation::number;
use std::f64::consts::PI;
use std::fmt;

/// Why friction cannot be built from its values.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FrictionError {
    /// A coefficient that is negative or not finite.
    #[error("a coefficient of friction must be finite and not negative, not {0}")]
    Coefficient(f64),
    /// A direction whose length is zero or not finite.
    #[error("a direction of sliding needs a finite length greater than 0, not that of [{}, {}]", .0[0], .0[1])]
    Direction([f64; 2]),
    /// A layer on a frictionless interface, which cannot carry the mean traction.
    #[error(
        "layer {}{} lies on a frictionless interface, and nothing holds it against the mean traction of friction: make the \
         interface bonded or a spring", .0.number, if .0.is_counterbody() { " of the counterbody" } else { "" }
    )]
    Unheld(InterfaceId),
}

/// Sliding friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    coefficient: f64,
    /// Unit vector.
    direction: [f64; 2],
    coupled: bool,
}

impl Friction {
    /// Coupled friction of the coefficient μ ≥ 0; the counterbody slides in the `direction`, of any length.
    ///
    /// # Errors
    /// [`FrictionError`] for values out of range.
    pub fn new(coefficient: f64, direction: [f64; 2]) -> Result<Self, FrictionError> {
        if !(coefficient.is_finite() && coefficient >= 0.0) {
            return Err(FrictionError::Coefficient(coefficient));
        }
        let largest = direction[0].abs().max(direction[1].abs());
        if !(largest.is_finite() && largest > 0.0) {
            return Err(FrictionError::Direction(direction));
        }
        let [x, y] = direction.map(|x| x / largest);
        let length = x.hypot(y);
        Ok(Self { coefficient, direction: [x / length, y / length], coupled: true })
    }

    /// Friction without influence on the pressure.
    #[must_use]
    pub fn uncoupled(self) -> Self {
        Self { coupled: false, ..self }
    }

    /// Coefficient of friction μ.
    pub fn coefficient(&self) -> f64 {
        self.coefficient
    }

    /// Direction **e** of sliding and of the traction on the body, a unit vector.
    pub fn direction(&self) -> [f64; 2] {
        self.direction
    }

    /// Whether the pressure depends on the vertical displacement by the traction.
    pub fn is_coupled(&self) -> bool {
        self.coupled
    }

    /// Whether the pressure differs from that without friction: coupled, with μ > 0.
    pub fn couples(&self) -> bool {
        self.coupled && self.coefficient > 0.0
    }

    /// Exponent η = −atan(μβ)/π of the edges of contact of bodies with Dundurs'
    /// [β](crate::body::Bodies::dundurs_beta): the pressure vanishes like d^{½+η} at the trailing edge and like d^{½−η} at the
    /// leading one; 0 without coupling.
    pub fn edge_exponent(&self, beta: f64) -> f64 {
        if self.coupled { -(self.coefficient * beta).atan() / PI } else { 0.0 }
    }

    /// Traction on the body over the pressure, μ **e**.
    pub fn traction(&self) -> [f64; 2] {
        self.direction.map(|e| self.coefficient * e)
    }

    /// The friction as the counterbody bears it: the body slides the other way.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { direction: self.direction.map(|e| -e), ..self }
    }
}

impl fmt::Display for Friction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.direction.map(number);
        let coupled = if self.coupled { "coupled" } else { "uncoupled" };
        write!(f, "sliding along [{x}, {y}], μ {}, {coupled}", number(self.coefficient))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_of_any_length_is_a_unit_vector() {
        for scale in [1e-300, 1.0, 1e300] {
            let friction = Friction::new(0.5, [3.0 * scale, -4.0 * scale]).unwrap();
            let [x, y] = friction.direction();
            assert!((x - 0.6).abs() < 1e-15 && (y + 0.8).abs() < 1e-15 && friction.is_coupled());
            assert!((friction.traction()[1] + 0.4).abs() < 1e-15 && !friction.uncoupled().is_coupled());
        }
    }

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(Friction::new(-0.1, [1.0, 0.0]), Err(FrictionError::Coefficient(-0.1)));
        assert_eq!(Friction::new(0.1, [0.0, 0.0]), Err(FrictionError::Direction([0.0, 0.0])));
        assert!(Friction::new(f64::NAN, [1.0, 0.0]).is_err() && Friction::new(0.1, [1.0, f64::INFINITY]).is_err());
    }
}
