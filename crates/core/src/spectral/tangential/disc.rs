//! The disc |**q**| ≤ m of tractions that Coulomb's law admits on a sample under the pressure p, m = μp.
//!
//! A sample **sticks** where |**q**| < m. On the circle it **slips** where the slip would go on outward: there the tractions may change along
//! the circle alone, and the slip **s** = λ**q** adds the curvature λ ≥ 0 of the circle to the elastic energy.

use std::ops::{Add, Mul, Sub};

/// Part of the bound within which a traction lies on the circle.
const ON_CIRCLE: f64 = 1e-12;

/// Part of the bound by which a traction that sticks is below it at least.
const STICKING: f64 = 1e-9;

/// A vector in the plane of the surface.
pub(in crate::spectral) type Vector = [f64; 2];

/// **a** + **b**.
pub(super) fn add(a: Vector, b: Vector) -> Vector {
    both(a, b, Add::add)
}

/// **a** − **b**.
pub(super) fn sub(a: Vector, b: Vector) -> Vector {
    both(a, b, Sub::sub)
}

/// c **a**.
pub(super) fn scale(c: f64, a: Vector) -> Vector {
    both([c; 2], a, Mul::mul)
}

/// **a**·**b**.
pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// |**a**|.
pub(super) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

fn both(a: Vector, b: Vector, of: fn(f64, f64) -> f64) -> Vector {
    [of(a[0], b[0]), of(a[1], b[1])]
}

/// The nearest vector to **q** on the disc of the radius m.
pub(super) fn projected(q: Vector, m: f64) -> Vector {
    let size = length(q);
    if size <= m { q } else { scale(m / size, q) }
}

/// Whether a sample under pressure sticks: its traction is within the disc.
pub(crate) fn sticks(q: Vector, m: f64) -> bool {
    m > 0.0 && length(q) < m * (1.0 - STICKING)
}

/// State of a sample: apart, sticking, or slipping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum State {
    /// No pressure, no traction.
    Apart,
    /// The traction is free within the disc.
    Sticks,
    /// The traction stays on the circle; λ > 0 is the slip over the traction, a length per pressure.
    Slips(f64),
}

impl State {
    /// State under the traction **q**, |**q**| ≤ m, with the slip **s** that it leaves.
    pub fn of(q: Vector, m: f64, slip: Vector) -> Self {
        if m <= 0.0 {
            return Self::Apart;
        }
        let along = dot(slip, q);
        if along > 0.0 && length(q) >= m * (1.0 - ON_CIRCLE) { Self::Slips(along / (m * m)) } else { Self::Sticks }
    }

    /// λ; 0 unless the sample slips.
    pub fn curvature(self) -> f64 {
        if let Self::Slips(lambda) = self { lambda } else { 0.0 }
    }

    /// The part of **v** that the traction **q** may change by: all of it, its part along the circle, or none.
    pub fn tangent(self, v: Vector, q: Vector) -> Vector {
        match self {
            Self::Apart => [0.0; 2],
            Self::Sticks => v,
            Self::Slips(_) => {
                let square = dot(q, q);
                sub(v, scale(dot(v, q) / square, q))
            }
        }
    }

    /// The matrix of [`Self::tangent`]: xx, yy, xy.
    pub fn projection(self, q: Vector) -> [f64; 3] {
        match self {
            Self::Apart => [0.0; 3],
            Self::Sticks => [1.0, 1.0, 0.0],
            Self::Slips(_) => {
                let square = dot(q, q);
                [q[1] * q[1], q[0] * q[0], -q[0] * q[1]].map(|product| product / square)
            }
        }
    }
}

/// The solution **v** of M **v** = **b** for the symmetric matrix M = [xx, yy, xy]; `None` where it is singular.
pub(super) fn solve([xx, yy, xy]: [f64; 3], b: Vector) -> Option<Vector> {
    let determinant = xx * yy - xy * xy;
    let is_regular = determinant > 1e-12 * (xx + yy) * (xx + yy);
    is_regular.then(|| [(yy * b[0] - xy * b[1]) / determinant, (xx * b[1] - xy * b[0]) / determinant])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_slips_on_the_circle_and_sticks_within() {
        assert_eq!(State::of([0.0, 0.0], 0.0, [1.0, 0.0]), State::Apart);
        assert_eq!(State::of([0.3, 0.0], 1.0, [1.0, 0.0]), State::Sticks);
        assert_eq!(State::of([0.6, 0.8], 1.0, [-1.0, 0.0]), State::Sticks, "the slip turns back");
        let slips = State::of([0.6, 0.8], 1.0, [0.3, 0.4]);
        assert_eq!(slips, State::Slips(0.5));
        let along = slips.tangent([1.0, 0.0], [0.6, 0.8]);
        assert!((along[0] - 0.64).abs() < 1e-15 && (along[1] + 0.48).abs() < 1e-15);
        let [xx, yy, xy] = slips.projection([0.6, 0.8]);
        assert!((xx - 0.64).abs() < 1e-15 && (yy - 0.36).abs() < 1e-15 && (xy + 0.48).abs() < 1e-15);
    }

    #[test]
    fn the_nearest_vector_of_a_disc_has_its_direction() {
        assert_eq!(projected([0.3, -0.4], 1.0), [0.3, -0.4]);
        assert_eq!(projected([3.0, -4.0], 1.0), [0.6000000000000001, -0.8]);
        assert_eq!(solve([2.0, 1.0, 0.0], [4.0, 3.0]), Some([2.0, 3.0]));
        assert_eq!(solve([1.0, 1.0, 1.0], [4.0, 3.0]), None);
    }
}
