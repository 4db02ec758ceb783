//! The plane of admissible states below a depth, by its 2 × 2 minors.
//!
//! Two independent solutions that decay into the substrate span a plane in the space of (U, w, t, p). The plane is
//! known by its minors N = t∧p, A = U∧p, B = t∧U = w∧p, C = t∧w, D = U∧w (Betti's reciprocity makes the two readings of
//! B equal), up to a common factor. Where t, p determine U, w, the surface compliances are A/N, B/N, C/N; where they do
//! not (below a frictionless interface N = 0) the minors stay finite. Across a layer
//!
//! N′ = eA,  A′ = 2B + N,  B′ = C − rA,  C′ = eD − 2rB + mN,  D′ = C + mA   (′ = d/dζ, upwards)
//!
//! is a linear system **m**′ = Q**m** with Q⁵ = 4Q³, so that by Cayley–Hamilton
//!
//! exp(xQ) = 1 + xQ + ½x²Q² + s₃Q³ + s₄Q⁴,  s₃ = (sinh 2x − 2x)/8,  s₄ = (cosh 2x − 1 − 2x²)/16,
//!
//! five positive functions: no cancellation in thin layers, and e^{2x} is a common factor in thick ones.
//! Source of the idea: J. W. Dunkin, Bull. Seismol. Soc. Am. 55, 335 (1965).

use super::{Interface, Moduli};
use crate::numeric::number::Number;

/// Largest distance times q: e^{−800} is 0 in double precision. Thicker layers are taken to be as thick as this, so that
/// exponents stay small and exact.
pub(super) const MAX_EXPONENT: f64 = 800.0;

/// Coefficients e, r, m of a material's plane-strain equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlaneStrain<N = f64> {
    pub shear: N,
    pub poisson: N,
    /// e = 2/(1−ν), in-plane stiffness over G.
    pub e: N,
    /// r = ν/(1−ν).
    pub r: N,
    /// m = (1−2ν)/(2(1−ν)), uniaxial compliance times G.
    pub m: N,
}

impl<N: Number> PlaneStrain<N> {
    pub fn new(Moduli { shear, poisson }: Moduli<N>) -> Self {
        let lateral = N::from(1.0) - poisson;
        let (e, r) = (N::from(2.0).over(lateral), poisson.over(lateral));
        Self { shear, poisson, e, r, m: (N::from(1.0) - poisson * 2.0).over(lateral * 2.0) }
    }
}

/// Minors of the plane of admissible states, displacements in units of 1/(Gq) of the material they stand in.
/// The true minors are these times e^`exponent`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Minors<N = f64> {
    pub n: N,
    pub a: N,
    pub b: N,
    pub c: N,
    pub d: N,
    pub exponent: f64,
}

impl<N: Number> Minors<N> {
    /// The plane on a rigid base: no displacement, any tractions.
    pub fn rigid() -> Self {
        let zero = N::from(0.0);
        Self { n: N::from(1.0), a: zero, b: zero, c: zero, d: zero, exponent: 0.0 }
    }

    /// The plane at the top of a homogeneous half-space: A/N = C/N = 1−ν, B/N = ½−ν, D/N = ¾−ν.
    pub fn half_space(material: &PlaneStrain<N>) -> Self {
        let less_poisson = |number: f64| N::from(number) - material.poisson;
        let [a, b, d] = [1.0, 0.5, 0.75].map(less_poisson);
        Self { n: N::from(1.0), a, b, c: a, d, exponent: 0.0 }
    }

    /// The plane seen from above an interface, in the units of the layer above it (`wavenumber` q); `below` is `None` on a rigid
    /// base.
    pub fn above(
        self,
        interface: Interface,
        below: Option<&PlaneStrain<N>>,
        above: &PlaneStrain<N>,
        wavenumber: f64,
    ) -> Self {
        let ratio = below.map_or(N::from(0.0), |below| above.shear.over(below.shear));
        let scaled =
            Self { a: ratio * self.a, b: ratio * self.b, c: ratio * self.c, d: ratio * ratio * self.d, ..self };
        let Self { n, a, b, c, d, exponent } = scaled;
        match interface {
            Interface::Bonded => scaled,
            Interface::Spring { .. } => {
                let [slip, closure] = interface.jumps(above.shear * wavenumber);
                Self {
                    n,
                    a: a + slip * n,
                    b,
                    c: c + closure * n,
                    d: d + closure * a + slip * c + slip * closure * n,
                    exponent,
                }
            }
            // The spring with k_t → 0, divided by its slip: U is free and t = 0.
            Interface::Frictionless => {
                let zero = N::from(0.0);
                Self { n: zero, a: n, b: zero, c: zero, d: c, exponent }
            }
        }
        .normalised()
    }

    /// The plane at a height `x` = q·(distance) ≥ 0 further up in the same material.
    pub fn raised(self, material: &PlaneStrain<N>, x: f64) -> Self {
        let x = x.min(MAX_EXPONENT);
        let (one, s1, s2, s3, s4) = exponential_coefficients(x);
        let q1 = self.slope(material);
        let q2 = q1.slope(material);
        let q3 = q2.slope(material);
        let q4 = q3.slope(material);
        let sum = |m: N, m1: N, m2: N, m3: N, m4: N| m * one + m1 * s1 + m2 * s2 + m3 * s3 + m4 * s4;
        Self {
            n: sum(self.n, q1.n, q2.n, q3.n, q4.n),
            a: sum(self.a, q1.a, q2.a, q3.a, q4.a),
            b: sum(self.b, q1.b, q2.b, q3.b, q4.b),
            c: sum(self.c, q1.c, q2.c, q3.c, q4.c),
            d: sum(self.d, q1.d, q2.d, q3.d, q4.d),
            exponent: self.exponent + 2.0 * x,
        }
        .normalised()
    }

    /// Q**m**.
    fn slope(&self, &PlaneStrain { e, r, m, .. }: &PlaneStrain<N>) -> Self {
        Self {
            n: e * self.a,
            a: self.b * 2.0 + self.n,
            b: self.c - r * self.a,
            c: e * self.d - r * 2.0 * self.b + m * self.n,
            d: self.c + m * self.a,
            exponent: self.exponent,
        }
    }

    /// The plane by minors of order one.
    fn normalised(self) -> Self {
        let Self { n, a, b, c, d, exponent } = self;
        let scale = n.size().max(a.size()).max(b.size()).max(c.size()).max(d.size());
        Self { n: n / scale, a: a / scale, b: b / scale, c: c / scale, d: d / scale, exponent: exponent + scale.ln() }
    }
}

/// e^{−2x} times 1, x, x²/2, s₃, s₄ of exp(xQ).
fn exponential_coefficients(x: f64) -> (f64, f64, f64, f64, f64) {
    let theta = (-2.0 * x).exp();
    let (s3, s4) = if x < 1.0 {
        // s₃ = Σ 4ʲ x^{2j+3}/(2j+3)!, s₄ = Σ 4ʲ x^{2j+4}/(2j+4)!
        let square = 4.0 * x * x;
        let (mut term3, mut sum3) = (x * x * x / 6.0, 0.0);
        let (mut term4, mut sum4) = (x * x * x * x / 24.0, 0.0);
        let mut k = 3.0;
        while term3 > 1e-17 * sum3 {
            sum3 += term3;
            sum4 += term4;
            term3 *= square / ((k + 1.0) * (k + 2.0));
            term4 *= square / ((k + 2.0) * (k + 3.0));
            k += 2.0;
        }
        (theta * sum3, theta * sum4)
    } else {
        (
            (0.5 * (1.0 - theta * theta) - 2.0 * x * theta) / 8.0,
            (0.5 * (1.0 + theta * theta) - theta - 2.0 * x * x * theta) / 16.0,
        )
    };
    (theta, theta * x, theta * 0.5 * x * x, s3, s4)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Material;

    fn material(shear: f64, poisson: f64) -> PlaneStrain {
        PlaneStrain::new(Material::from_shear(shear, poisson).unwrap().into())
    }

    #[test]
    fn a_half_space_under_its_own_material_is_the_same_half_space() {
        for nu in [0.0, 0.2, 0.5] {
            let m = material(3.0, nu);
            for x in [1e-8, 1e-3, 0.5, 0.999_999, 1.0, 7.0, 700.0, 1e155, f64::INFINITY] {
                let bottom = Minors::half_space(&m);
                let top = bottom.raised(&m, x);
                for (raised, expected) in [(top.a, bottom.a), (top.b, bottom.b), (top.c, bottom.c), (top.d, bottom.d)] {
                    assert!((raised / top.n - expected).abs() < 1e-15, "ν = {nu}, x = {x}");
                }
                let x = x.min(MAX_EXPONENT);
                assert!((top.exponent - 2.0 * x).abs() < 1e-13 * (1.0 + x));
            }
        }
    }

    #[test]
    fn minors_keep_their_plucker_relation() {
        let (layer, base) = (material(0.03, 0.5), material(1.0, 0.3));
        let spring = Interface::Spring { tangential: 0.2, normal: 7.0 };
        for interface in [Interface::Bonded, spring, Interface::Frictionless] {
            let m = Minors::half_space(&base).above(interface, Some(&base), &layer, 1.3).raised(&layer, 0.4);
            assert!((m.a * m.c - m.b * m.b - m.n * m.d).abs() < 1e-15);
        }
    }
}
