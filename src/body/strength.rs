//! Strengths of materials and interfaces: what they bear before something fails.
//!
//! A material yields where the von Mises stress reaches its yield strength, and cracks where the largest principal stress
//! reaches its tensile strength. An interface comes off where its tension ⟨σ_zz⟩ and shear τ reach
//! (⟨σ_zz⟩/σ_c)² + (τ/τ_c)² = 1. A strength that is not given has no limit.

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
}

impl Strength {
    pub(super) fn check(self) -> Result<Self, MaterialError> {
        check([self.yielding, self.tensile]).map(|()| self)
    }
}

impl InterfaceStrength {
    pub(super) fn check(self) -> Result<Self, MaterialError> {
        check([self.normal, self.shear]).map(|()| self)
    }

    /// Whether nothing is given.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// √((⟨σ_zz⟩/σ_c)² + (τ/τ_c)²) of a tension σ_zz and a shear τ ≥ 0: 1 where the interface comes off.
    pub fn utilisation(&self, tension: f64, shear: f64) -> f64 {
        let part = |stress: f64, strength: Option<f64>| strength.map_or(0.0, |strength| stress / strength);
        part(tension.max(0.0), self.normal).hypot(part(shear, self.shear))
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
        let strength = InterfaceStrength { normal: Some(0.5), shear: Some(2.0) };
        assert!((strength.utilisation(0.3, 1.6) - 1.0).abs() < 1e-15);
        assert_eq!(strength.utilisation(-7.0, 1.0), 0.5);
        assert_eq!(InterfaceStrength { shear: None, ..strength }.utilisation(1.0, 9.0), 2.0);
        assert_eq!(Strength { yielding: Some(0.0), tensile: None }.check(), Err(MaterialError::Strength(0.0)));
    }
}
