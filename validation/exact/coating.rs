//! One layer bonded to a substrate whose Young's modulus is 1, and its correction in closed form.
//!
//! A pressure p̂ cos qx presses the surface in by ŵ = 2/(E₁* q) T p̂, E₁* that of the coating. With x = qh, θ = e^{−2x},
//!
//! T = [1 + 4xκθ − λκθ²] / [1 − (λ + κ + 4κx²)θ + λκθ²],
//! λ = 1 − 4(1−ν₁)/(1 + χ(3−4ν₂)), κ = (χ−1)/(χ + 3 − 4ν₁), χ = G₁/G₂
//!
//! (plane strain with the surface loaded as in Eq. (6) and the interface bonded as in Eq. (3) of Goryacheva & Torskaya
//! 2019).

use percoat_core::body::{HalfSpace, Interface, Layer, Material, MaterialError};

/// A coating bonded to a substrate with E₂ = 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Coating {
    chi: f64,
    poisson: [f64; 2],
    thickness: f64,
    half_space: HalfSpace,
}

impl Coating {
    /// χ = G₁/G₂, Poisson's ratios of coating and substrate, thickness h (a length).
    ///
    /// # Errors
    /// [`MaterialError`] for values out of range.
    pub fn new(chi: f64, poisson: [f64; 2], thickness: f64) -> Result<Self, MaterialError> {
        let substrate = Material::from_young(1.0, poisson[1])?;
        let coating = Material::from_shear(chi * substrate.shear(), poisson[0])?;
        let half_space = HalfSpace::new(vec![Layer::new(coating, thickness, Interface::Bonded)?], substrate);
        Ok(Self { chi, poisson, thickness, half_space })
    }

    /// The coated body for the solver.
    pub fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// E₁* of the coating, in units of E₂.
    pub fn modulus(&self) -> f64 {
        self.half_space.surface_material().contact_modulus()
    }

    /// Thickness h, a length.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Layer correction T at x = qh.
    pub fn correction(&self, x: f64) -> f64 {
        let [nu1, nu2] = self.poisson;
        let lambda = 1.0 - 4.0 * (1.0 - nu1) / (1.0 + self.chi * (3.0 - 4.0 * nu2));
        let kappa = (self.chi - 1.0) / (self.chi + 3.0 - 4.0 * nu1);
        let theta = (-2.0 * x).exp();
        let end = lambda * kappa * theta * theta;
        (1.0 + 4.0 * x * kappa * theta - end) / (1.0 - (lambda + kappa + 4.0 * kappa * x * x) * theta + end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_correction_has_its_twelve_digit_values() {
        // 6 × 6 boundary conditions of a bonded layer solved to 36 digits. χ, ν₁, x = qh, T; ν₂ = 0.3.
        for [chi, nu1, x, expected] in [
            [2.0, 0.20, 0.1, 1.72526660632],
            [2.0, 0.20, 0.5, 1.61261047905],
            [2.0, 0.20, 1.0, 1.41117464928],
            [2.0, 0.20, 2.0, 1.1244653574],
            [2.0, 0.20, 4.0, 1.00660669173],
            [0.5, 0.45, 0.1, 0.618461746474],
            [0.5, 0.45, 0.5, 0.606912178864],
            [0.5, 0.45, 1.0, 0.687768355896],
            [0.5, 0.45, 2.0, 0.874281670537],
        ] {
            let found = Coating::new(chi, [nu1, 0.3], 1.0).unwrap().correction(x);
            assert!((found / expected - 1.0).abs() < 1e-11, "χ = {chi}, x = {x}: {found} against {expected}");
        }
    }
}
