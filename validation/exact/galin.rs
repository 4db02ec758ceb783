//! One axisymmetric indenter f = Σ c_n rⁿ on a half-space (Galin 1946; Sneddon, Int. J. Eng. Sci. 3 (1965) 47).
//!
//! δ = Σ κ_n c_n aⁿ,  P = 2E* Σ n κ_n c_n aⁿ⁺¹/(n+1),  p(0) = (E*/π) Σ n κ_n c_n aⁿ⁻¹/(n−1),
//! κ_n = √π Γ(n/2+1)/Γ((n+1)/2), and from the same density the moments ∫p r², ∫p r⁴.
//!
//! For f = c₂r² + c₄r⁴ the pressure is p = (4E*/π)√(a²−r²)[c₂ + (8/9)c₄(a² + 2r²)]; on the axis it causes (Boussinesq)
//!
//! σ_z = −3z³ ∫ p r dr/ρ⁵,  σ_r = σ_θ = ½ ∫ p r [(1−2ν)z/ρ³ − 3zr²/ρ⁵] dr,  ρ² = r² + z².

use super::gauss_between;
use std::f64::consts::PI;

/// √π Γ(7/4)/Γ(5/4).
const KAPPA_THREE_HALVES: f64 = 1.797210352103388;

/// One term c rⁿ of an indenter's profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// c, a length to the power 1 − n.
    pub coefficient: f64,
    /// n: a whole number or half of one, at least 1 and not 2.5, 4.5, ….
    pub exponent: f64,
}

/// r²/(2R).
pub fn paraboloid(radius: f64) -> Term {
    Term { coefficient: 0.5 / radius, exponent: 2.0 }
}

/// A circular contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Contact {
    /// Radius a, a length.
    pub radius: f64,
    /// P = ∫p, a force.
    pub load: f64,
    /// ∫p r², ∫p r⁴: what its images feel of it beyond the load.
    pub moments: [f64; 2],
    /// p(0), on the axis; infinite for a cone.
    pub axis: f64,
    /// δ, from the mean plane when images take part, a length.
    pub penetration: f64,
}

impl Contact {
    /// Contact of radius a with the profile Σ c rⁿ alone on a half-space with contact modulus E* = `modulus`.
    pub fn isolated(radius: f64, profile: &[Term], modulus: f64) -> Self {
        let a = radius;
        let mut contact = Self { radius, ..Self::default() };
        for &Term { coefficient, exponent: n } in profile {
            let depth = kappa(n) * coefficient * a.powf(n);
            contact.penetration += depth;
            contact.load += 2.0 * modulus * n / (n + 1.0) * depth * a;
            contact.moments[0] += 4.0 / 3.0 * modulus * n / (n + 3.0) * depth * a.powi(3);
            contact.moments[1] += 16.0 / 15.0 * modulus * n / (n + 5.0) * depth * a.powi(5);
            contact.axis += modulus / PI * n / (n - 1.0) * depth / a;
        }
        contact
    }
}

/// σ_z and σ_r = σ_θ on the axis at the depth z > 0 (a length) under an indenter c₂r² + c₄r⁴ with contact radius a;
/// pressures, positive in tension.
pub fn axis_stresses([c2, c4]: [f64; 2], radius: f64, modulus: f64, nu: f64, z: f64) -> [f64; 2] {
    let mut stresses = [0.0; 2];
    // r = a sin θ makes the square root smooth.
    for [angle, weight] in gauss_between(0.0, 0.5 * PI, 64) {
        let (r, root) = (radius * angle.sin(), radius * angle.cos());
        let pressure = 4.0 * modulus / PI * root * (c2 + 8.0 / 9.0 * c4 * (radius * radius + 2.0 * r * r));
        let part = weight * pressure * r * root;
        let rho = r.hypot(z);
        stresses[0] -= 3.0 * part * z.powi(3) / rho.powi(5);
        stresses[1] += 0.5 * part * ((1.0 - 2.0 * nu) * z / rho.powi(3) - 3.0 * z * r * r / rho.powi(5));
    }
    stresses
}

/// κ_n by κ_n = n/(n−1) κ_{n−2} from n = 1, 1.5 and 2; not a number for other exponents.
fn kappa(n: f64) -> f64 {
    if n > 2.0 {
        return n / (n - 1.0) * kappa(n - 2.0);
    }
    match n {
        1.0 => 0.5 * PI,
        1.5 => KAPPA_THREE_HALVES,
        2.0 => 2.0,
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_is_sneddons_and_a_paraboloid_is_hertz() {
        // Sneddon (1965): P = ½πE*s a², δ = ½πs a. Hertz: P = 4E*a³/(3R), δ = a²/R, p(0) = 2E*a/(πR).
        let cone = Contact::isolated(2.0, &[Term { coefficient: 0.3, exponent: 1.0 }], 5.0);
        assert!((cone.load / (0.5 * PI * 5.0 * 0.3 * 4.0) - 1.0).abs() < 1e-15);
        assert!((cone.penetration / (0.5 * PI * 0.3 * 2.0) - 1.0).abs() < 1e-15);
        let sphere = Contact::isolated(2.0, &[paraboloid(7.0)], 5.0);
        assert!((sphere.load / (4.0 / 3.0 * 5.0 * 8.0 / 7.0) - 1.0).abs() < 1e-15);
        assert!((sphere.penetration / (4.0 / 7.0) - 1.0).abs() < 1e-15);
        assert!((sphere.axis / (2.0 * 5.0 * 2.0 / (PI * 7.0)) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_axis_of_a_paraboloid_is_hubers_and_a_fourth_power_carries_its_load() {
        let (modulus, nu, a) = (3.0, 0.3, 0.4);
        let peak = Contact::isolated(a, &[paraboloid(1.0)], modulus).axis;
        for zeta in [0.3f64, 1.0, 2.0] {
            let [axial, lateral] = axis_stresses([0.5, 0.0], a, modulus, nu, zeta * a);
            let fall = 1.0 / (1.0 + zeta * zeta);
            let exact = -(1.0 + nu) * (1.0 - zeta * (1.0 / zeta).atan()) + 0.5 * fall;
            assert!((axial / peak + fall).abs() < 1e-12 && (lateral / peak - exact).abs() < 1e-12);
        }
        // Far below, any contact is a point load: σ_z = −3P/(2πz²).
        let load = Contact::isolated(a, &[Term { coefficient: 2.0, exponent: 4.0 }], modulus).load;
        let [axial, _] = axis_stresses([0.0, 2.0], a, modulus, nu, 1e4);
        assert!((axial / (-1.5 * load / (PI * 1e8)) - 1.0).abs() < 1e-8);
    }
}
