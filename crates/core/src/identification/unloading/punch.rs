//! Contacts of a given radius a on layered bodies without friction, the flat punch and the paraboloid, by the integral equation of their
//! pressure (Lebedev & Ufliand, J. Appl. Math. Mech. 22 (1958) 442).
//!
//! p(r) = −(E*/π) ∫ᵣᵃ φ′(t)/√(t² − r²) dt, with a punch's φ(a) besides, displaces by δ − r²/(2R) where
//!
//! φ(x) + (2/π) ∫₀ᵃ φ(t) ∫₀^∞ (T(q) − 1) cos qx cos qt dq dt = δ − x²/R,   P = 2E* ∫₀ᵃ φ dt,
//!
//! T the layer correction of both bodies. With φ = Σ (−1)ⁿ cₙ P₂ₙ(t/a), Galerkin's equations have the spherical Bessel functions
//! ∫₀¹ P₂ₙ(ξ) cos sξ dξ = (−1)ⁿ j₂ₙ(s):
//!
//! cₘ/(4m + 1) + (2/π) Σₙ cₙ ∫₀^∞ (T(s/a) − 1) j₂ₘ(s) j₂ₙ(s) ds = gₘ.
//!
//! The punch, g = (1, 0, …), has S = dP/dδ = 2E* a c₀. φ(a) = 0 gives the penetration of the paraboloid, and with it
//! ε = (δ − a²/(2R)) S/P: 3/4 on bare bodies, where S = 2E* a. As Galerkin's equations are those of a minimum, S rises with the number of
//! functions to the exact one; the difference to two thirds of them is stated as its error.

use crate::body::{Bodies, HalfSpace};
use crate::numeric::linear::solve;
use crate::numeric::quadrature::gauss;
use std::f64::consts::PI;

/// Functions for a contact much smaller than the layer at the surface is thick, more for the root of their ratio, and most of them.
const FUNCTIONS: [f64; 3] = [8.0, 4.0, 72.0];
/// Points of the quadrature over a panel, and largest phase s over it.
const POINTS: usize = 16;
const PANEL: f64 = 4.0;
/// First panel, from which on they double in size: part of the smaller one of 1 and contact radius over thickness.
const FIRST: f64 = 1e-6;
/// |T − 1| behind which waves are left out, and the largest phase s.
const NEGLIGIBLE: f64 = 1e-11;
const LARGEST: f64 = 2e4;

/// Flat punch and paraboloid of a given contact radius on layered bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Punch {
    /// S = dP/dδ of the flat punch, a force per length.
    pub stiffness: f64,
    /// Estimated relative error of S.
    pub error: f64,
    /// ε of the paraboloid, dimensionless.
    pub epsilon: f64,
}

impl Punch {
    /// The contact of the radius `a`, a length. Stiffness and ε are NaN where layers are too thin for it.
    pub fn new(bodies: &Bodies, a: f64) -> Self {
        let bare = 2.0 * bodies.contact_modulus() * a;
        if bodies.is_bare() {
            return Self { stiffness: bare, error: 0.0, epsilon: 0.75 };
        }
        let (matrix, left_out) = matrix(bodies, a);
        let count = matrix.len();
        // Of a² over R and E* as units: the punch and x² on the right-hand side.
        let punch = solved(&matrix, count, [1.0, 0.0]);
        let square = solved(&matrix, count, [1.0 / 3.0, -2.0 / 15.0]);
        let fewer = solved(&matrix, (2 * count).div_ceil(3), [1.0, 0.0]);
        let end = |c: &[f64]| c.iter().zip(0..).map(|(c, n)| if n % 2 == 0 { *c } else { -c }).sum::<f64>();
        let penetration = end(&square) / end(&punch);
        let force = 2.0 * (penetration * punch[0] - square[0]);
        Self {
            stiffness: bare * punch[0],
            error: (1.0 - fewer[0] / punch[0]).abs() + left_out * punch[0],
            epsilon: (penetration - 0.5) * 2.0 * punch[0] / force,
        }
    }
}

/// Coefficients by the first `count` equations, for a right-hand side in the first two; NaN where they are singular to rounding.
fn solved(matrix: &[Vec<f64>], count: usize, [first, second]: [f64; 2]) -> Vec<f64> {
    let rows: Vec<Vec<f64>> = matrix[..count].iter().map(|row| row[..count].to_vec()).collect();
    let mut right = vec![0.0; count];
    right[0] = first;
    right[1] = second;
    solve(rows, right).unwrap_or_else(|| vec![f64::NAN; count])
}

/// Galerkin's matrix, and an estimate of what the waves that were left out add to its first entry.
fn matrix(bodies: &Bodies, a: f64) -> (Vec<Vec<f64>>, f64) {
    let thin = bodies.thinnest_first_layer().unwrap_or(a);
    let thickness = |body: &HalfSpace| body.layers().iter().map(|layer| layer.thickness()).sum::<f64>();
    let thick = bodies.each().map(thickness).fold(0.0, f64::max);
    let [least, more, most] = FUNCTIONS;
    let count = (least + more * (a / thin).sqrt()).min(most).ceil() as usize;
    let mut matrix: Vec<Vec<f64>> = vec![vec![0.0; count]; count];
    for (m, row) in matrix.iter_mut().enumerate() {
        row[m] = 1.0 / (4 * m + 1) as f64;
    }
    let rule = gauss(POINTS);
    let (mut from, mut size) = (0.0, FIRST * (a / thick).min(1.0));
    let mut last = f64::INFINITY;
    while from < LARGEST && last > NEGLIGIBLE {
        // Layers below thin ones show in waves that are long against the first one.
        last = if from > 4.0 * a / thin { 0.0 } else { f64::INFINITY };
        for [x, weight] in &rule {
            let s = from + 0.5 * size * (1.0 + x);
            let change = bodies.correction(s / a) - 1.0;
            last = last.max(change.abs());
            let j = bessel(s, count);
            let factor = weight * size / PI * change;
            for (row, jm) in matrix.iter_mut().zip(&j) {
                row.iter_mut().zip(&j).for_each(|(entry, jn)| *entry += factor * jm * jn);
            }
        }
        from += size;
        size = from.min(PANEL);
    }
    // j₀² has the mean 1/(2s²).
    (matrix, last.min(1.0) / (PI * from))
}

/// Spherical Bessel functions j₀, j₂, j₄, … of s > 0.
fn bessel(s: f64, count: usize) -> Vec<f64> {
    let (sin, cos) = s.sin_cos();
    let first = [sin / s, (sin / s - cos) / s];
    let most = 2 * count;
    let mut even = vec![0.0; count];
    even[0] = first[0];
    if s > most as f64 {
        let [mut before, mut value] = first;
        for n in 1..most - 1 {
            (before, value) = (value, (2 * n + 1) as f64 / s * value - before);
            if n % 2 == 1 {
                even[n.div_ceil(2)] = value;
            }
        }
        return even;
    }
    // Miller's recurrence downward, whose start is lost.
    let (mut above, mut value) = (0.0, 1e-280);
    for n in (1..most + 50).rev() {
        (above, value) = (value, (2 * n + 1) as f64 / s * value - above);
        if value.abs() > 1e200 {
            (above, value) = (above * 1e-200, value * 1e-200);
            even.iter_mut().for_each(|x| *x *= 1e-200);
        }
        if n % 2 == 1 && n < most {
            even[n / 2] = value;
        }
    }
    // `above` is j₁ and `value` j₀ up to a factor, which the larger one gives. Near 0 the closed j₁ cancels.
    let scale = if s < 1.0 || first[0].abs() > first[1].abs() { first[0] / value } else { first[1] / above };
    even.iter_mut().for_each(|x| *x *= scale);
    even
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, Layer, Material};

    fn coated(young: f64, thickness: f64) -> Bodies {
        let layer = Layer::new(Material::from_young(young, 0.2).unwrap(), thickness, Interface::Bonded).unwrap();
        HalfSpace::new(vec![layer], Material::from_young(70.0, 0.3).unwrap()).into()
    }

    /// j₂ = (3/s³ − 1/s) sin s − 3 cos s/s², and Σ (2n + 1) jₙ² = 1 over all n, half of it over the even ones up to the mean of cos 2s.
    #[test]
    fn bessel_functions_have_their_closed_forms() {
        for s in [0.5, 1.0, 3.2, 9.0, 15.9, 16.1, 40.0, 900.0f64] {
            let (sin, cos) = s.sin_cos();
            let second = (3.0 / s.powi(3) - 1.0 / s) * sin - 3.0 * cos / (s * s);
            let found = bessel(s, 8);
            assert!((found[1] - second).abs() < 1e-13, "{s}: {found:?} {second}");
        }
        // Σ (4n + 1) j₂ₙ² = (1 + sin 2s/(2s))/2: Parseval of cos sξ over the even polynomials.
        for s in [1e-7f64, 0.02, 1.0, 20.0, 60.0, 119.0] {
            let sum: f64 = bessel(s, 75).iter().zip(0u32..).map(|(j, n)| f64::from(4 * n + 1) * j * j).sum();
            assert!((sum - 0.5 * (1.0 + (2.0 * s).sin() / (2.0 * s))).abs() < 1e-12, "{s}: {sum}");
        }
    }

    /// A layer of the material below it, and one much thicker or thinner than the contact, are none: S = 2E*a and ε = 3/4 of the coating
    /// or substrate. The thin and the thick one approach as a/h and h/a.
    #[test]
    fn bare_bodies_are_the_limits() {
        let alike = HalfSpace::new(
            vec![Layer::new(Material::from_young(70.0, 0.3).unwrap(), 0.4, Interface::Bonded).unwrap()],
            Material::from_young(70.0, 0.3).unwrap(),
        );
        let found = Punch::new(&alike.into(), 0.7);
        assert!((found.stiffness / (2.0 * 70.0 / 0.91 * 0.7) - 1.0).abs() < 1e-10, "{found:?}");
        assert!((found.epsilon - 0.75).abs() < 1e-9, "{found:?}");
        for (thickness, modulus, part) in [(2e3, 300.0 / 0.96, 2e-3), (2e-3, 70.0 / 0.91, 2e-2)] {
            let found = Punch::new(&coated(300.0, thickness), 1.0);
            assert!((found.stiffness / (2.0 * modulus) - 1.0).abs() < part, "{thickness}: {found:?}");
            assert!((found.epsilon / 0.75 - 1.0).abs() < part && found.error < 1e-6, "{thickness}: {found:?}");
        }
    }
}
