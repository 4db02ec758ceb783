//! One axisymmetric indenter f = Σ c_n rⁿ on a half-space (Galin 1946; Sneddon, Int. J. Eng. Sci. 3 (1965) 47).
//!
//! δ = Σ κ_n c_n aⁿ,  P = 2E* Σ n κ_n c_n aⁿ⁺¹/(n+1),  p(0) = (E*/π) Σ n κ_n c_n aⁿ⁻¹/(n−1),
//! κ_n = √π Γ(n/2+1)/Γ((n+1)/2), and from the same density the moments ∫p r², ∫p r⁴.

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
}
