//! Strengths of materials and interfaces: what they bear before something fails.
//!
//! A material yields where the von Mises stress reaches its yield strength, and cracks where the largest principal stress
//! reaches its tensile strength. An interface comes off where its tension ⟨σ_zz⟩ and shear τ reach
//! (⟨σ_zz⟩/σ_c)² + (τ/(τ_c + f p))² = 1, where the pressure p = ⟨−σ_zz⟩ adds the friction f p to the shear strength τ_c (Mohr and
//! Coulomb under pressure, an ellipse under tension: Sun et al., DOT/FAA/AR-95/109, 1996, for layers of laminates). The shear that
//! an interface bears is τ_c where it opens, and rises from there with the pressure. A strength that is not given has no limit.

use super::MaterialError;

/// Strengths of a material, pressures.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Strength {
    /// Yield strength, which the von Mises stress must not reach.
    pub yielding: Option<f64>,
    /// Tensile strength, which the largest principal stress must not reach.
    pub tensile: Option<f64>,
}

/// Strengths of an interface, pressures.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InterfaceStrength {
    /// σ_c: under tension alone.
    pub normal: Option<f64>,
    /// τ_c: under shear alone.
    pub shear: Option<f64>,
    /// f ≥ 0: friction by which the pressure p on the interface adds f p to its shear strength, dimensionless; 0: no credit for pressure.
    pub friction: f64,
}

impl Strength {
    pub(super) fn check(self) -> Result<Self, MaterialError> {
        check([self.yielding, self.tensile]).map(|()| self)
    }
}

impl InterfaceStrength {
    pub(super) fn check(self) -> Result<Self, MaterialError> {
        check([self.normal, self.shear])?;
        if !(self.friction.is_finite() && self.friction >= 0.0) {
            return Err(MaterialError::Friction(self.friction));
        }
        Ok(self)
    }

    /// Whether no strength is given.
    pub fn is_empty(&self) -> bool {
        self.normal.is_none() && self.shear.is_none()
    }

    /// √((⟨σ_zz⟩/σ_c)² + (τ/(τ_c + f⟨−σ_zz⟩))²) of a tension σ_zz and a shear τ ≥ 0: 1 where the interface comes off. Rises with
    /// both of them.
    pub fn utilisation(&self, tension: f64, shear: f64) -> f64 {
        let part = |stress: f64, strength: Option<f64>| strength.map_or(0.0, |strength| stress / strength);
        let borne = self.shear.map(|strength| match self.friction {
            0.0 => strength,
            friction => strength + friction * (-tension).max(0.0),
        });
        part(tension.max(0.0), self.normal).hypot(part(shear, borne))
    }
}

fn check(strengths: [Option<f64>; 2]) -> Result<(), MaterialError> {
    let wrong = strengths.into_iter().flatten().find(|strength| !(strength.is_finite() && *strength > 0.0));
    wrong.map_or(Ok(()), |strength| Err(MaterialError::Strength(strength)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tension_and_shear_meet_on_an_ellipse_and_pressure_does_not_count() {
        let strength = InterfaceStrength { normal: Some(0.5), shear: Some(2.0), friction: 0.0 };
        assert!((strength.utilisation(0.3, 1.6) - 1.0).abs() < 1e-15);
        assert_eq!(strength.utilisation(-7.0, 1.0), 0.5);
        assert_eq!(InterfaceStrength { shear: None, ..strength }.utilisation(1.0, 9.0), 2.0);
        assert_eq!(Strength { yielding: Some(0.0), tensile: None }.check(), Err(MaterialError::Strength(0.0)));
    }

    #[test]
    fn friction_adds_the_pressure_to_the_shear_strength_and_nothing_under_tension() {
        let bare = InterfaceStrength { normal: Some(0.5), shear: Some(2.0), friction: 0.0 };
        let rubs = InterfaceStrength { friction: 0.25, ..bare };
        // On the line τ = τ_c + f p of Mohr and Coulomb it comes off.
        for pressure in [0.0, 0.1, 4.0, 1e3] {
            assert!((rubs.utilisation(-pressure, 2.0 + 0.25 * pressure) - 1.0).abs() < 1e-15);
            assert_eq!(bare.utilisation(-pressure, 2.0), 1.0);
        }
        // However large shear and pressure grow together, what is below the friction holds.
        assert!(rubs.utilisation(-1e9, 0.24e9) < 0.97 && bare.utilisation(-1e9, 0.24e9) > 1e8);
        for [tension, shear] in [[0.0, 1.3], [0.2, 1.3], [0.7, 0.0]] {
            assert_eq!(rubs.utilisation(tension, shear), bare.utilisation(tension, shear));
        }
        // Friction alone is no strength, nor is friction below 0 or without end.
        assert!(InterfaceStrength { friction: 0.3, ..InterfaceStrength::default() }.is_empty());
        for friction in [-0.1, f64::INFINITY] {
            let refused = InterfaceStrength { friction, ..bare }.check();
            assert_eq!(refused, Err(MaterialError::Friction(friction)));
        }
    }
}
