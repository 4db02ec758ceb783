//! Lattice sums: what the images of an indenter do at its place.
//!
//! Around a site of a lattice the displacement of a unit load and of all its images, measured from the mean plane, is
//!
//! πE* w = 1/r + S₁ + S₃ r²/4 + 9 S₅ r⁴/64 + …,  S_n = Σ' 1/|R|ⁿ (S₁ without its uniform background).
//!
//! The sums are Epstein zeta functions: 6 ζ(n/2) L(χ₋₃, n/2) for the triangular lattice, 4 ζ(n/2) L(χ₋₄, n/2) for the
//! square one. A coating replaces E* by its own E₁* and adds the smooth part of its layer (Poisson's summation):
//! S₁ + Σ(2π/A₀G)(T−1), S₃ − Σ(2πG/A₀)(T−1), S₅ + Σ(2πG³/9A₀)(T−1) over the reciprocal vectors G ≠ 0.

use super::coating::Coating;
use std::f64::consts::PI;

/// S₁, S₃, S₅ of a lattice, lengths to the power −n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sums(pub [f64; 3]);

/// Triangular lattice of unit period: Epstein zeta sums to 30 digits, confirmed by an Ewald sum.
#[allow(clippy::excessive_precision, reason = "the digits they were computed with")]
pub const TRIANGULAR: Sums = Sums([-4.213422636136906890, 11.03417573491480977, 6.761898524398701589]);

/// Square lattice of unit period: Epstein zeta sums to 30 digits, confirmed by an Ewald sum.
#[allow(clippy::excessive_precision, reason = "the digits they were computed with")]
pub const SQUARE: Sums = Sums([-3.900264920001955883, 9.033621683100950306, 5.090258233665482946]);

impl Sums {
    /// Sums of the lattice with `period` times the period.
    pub fn scaled(self, period: f64) -> Self {
        let [s1, s3, s5] = self.0;
        Self([s1 / period, s3 / period.powi(3), s5 / period.powi(5)])
    }

    /// Sums from one of three equal sublattices of a lattice with these sums to each of the others: (whole − same)/2.
    pub fn other_sublattice(self, same: Self) -> Self {
        Self([0, 1, 2].map(|n| 0.5 * (self.0[n] - same.0[n])))
    }

    fn minus(self, other: Self) -> Self {
        Self([0, 1, 2].map(|n| self.0[n] - other.0[n]))
    }
}

/// Effective sums of a triangular lattice of the given period (a length) on a coating.
pub fn coated_triangular(coating: &Coating, period: f64) -> Sums {
    layered_triangular(|q| coating.correction(q * coating.thickness()), coating.thickness(), period)
}

/// Effective sums of a triangular lattice of the given period on layers with the correction T(q), the upper one of the
/// given thickness: lengths.
pub fn layered_triangular(correction: impl Fn(f64) -> f64, thickness: f64, period: f64) -> Sums {
    let area = 0.75f64.sqrt() * period * period;
    let least = 4.0 * PI / (3f64.sqrt() * period);
    // T − 1 falls as e^{−2Gh}.
    let reach = (22.0 / (thickness * least)).ceil() as i32 + 1;
    let [mut s1, mut s3, mut s5] = TRIANGULAR.scaled(period).0;
    for (i, j) in (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j))) {
        if (i, j) != (0, 0) {
            let g = least * f64::from(i * i + i * j + j * j).sqrt();
            let excess = 2.0 * PI / area * (correction(g) - 1.0);
            s1 += excess / g;
            s3 -= excess * g;
            s5 += excess * g.powi(3) / 9.0;
        }
    }
    Sums([s1, s3, s5])
}

/// A_n = ∫ xⁿ (1 − T(x)) dx over all x > 0, by Simpson's rule.
pub fn moment(correction: impl Fn(f64) -> f64, n: i32) -> f64 {
    let (steps, step) = (8000, 0.005);
    let total: f64 = (0..=steps)
        .map(|i| {
            let x = (f64::from(i) * step).max(1e-9);
            let weight = if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
            weight * x.powi(n) * (1.0 - correction(x))
        })
        .sum();
    total * step / 3.0
}

/// Effective sums of the images alone: a lattice on a coating minus one indenter on the same coating, whose own layer
/// gives −A₀/h, A₂/h³, −A₄/(9h⁵).
pub fn coated_images(coating: &Coating, period: f64) -> Sums {
    let moment = |n| moment(|x| coating.correction(x), n);
    let h = coating.thickness();
    let layer = Sums([-moment(0) / h, moment(2) / h.powi(3), -moment(4) / (9.0 * h.powi(5))]);
    coated_triangular(coating, period).minus(layer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layer_on_a_nearly_rigid_base_has_the_moments_of_the_rigid_one() {
        // A_n of the layer bonded to a rigid base, T = [(3−4ν) sinh 2x − 2x]/[(3−4ν) cosh 2x + 5 − 12ν + 8ν² + 2x²], by
        // quadrature in high precision.
        for (nu, expected) in [
            (0.3, [1.3768541655, 2.5102066455, 16.963356698]),
            (0.45, [1.6254706121, 3.3460758897, 23.894470851]),
            (0.5, [1.77021677337, 3.83107715559, 27.99097798]),
        ] {
            let coating = Coating::new(1e-10, [nu, 0.3], 1.0).unwrap();
            for (n, expected) in [0, 2, 4].into_iter().zip(expected) {
                let found = moment(|x| coating.correction(x), n);
                assert!((found / expected - 1.0).abs() < 1e-8, "ν = {nu}, A{n}: {found} against {expected}");
            }
        }
    }
}
