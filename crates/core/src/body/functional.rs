//! The functional of the state y = (U, w, t, p) at a depth that is zero on states with the traction of the surface.
//!
//! Going down a layer, ℓ is multiplied by exp(d𝒜) from the right, where
//! (𝒜²−1)² = 0 gives exp(d𝒜) = cosh d + ½d sinh d (𝒜²−1) + 𝒜 sinh d + ½(d cosh d − sinh d)(𝒜³−𝒜).

use super::Interface;
use super::minors::{Minors, PlaneStrain};
use crate::numeric::number::Number;

/// The functional ℓ(y) = ℓ_U U + ℓ_w w + ℓ_t t + ℓ_p p; the true one is this times e^`exponent`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Functional<N = f64> {
    pub u: N,
    pub w: N,
    pub t: N,
    pub p: N,
    pub exponent: f64,
}

impl<N: Number> Functional<N> {
    /// The shear traction at the top of a plane, scaled so that its contraction with the plane has p = 1.
    pub fn shear(plane: &Minors<N>) -> Self {
        let zero = N::from(0.0);
        Self { u: zero, w: zero, t: N::from(1.0).over(plane.n), p: zero, exponent: -plane.exponent }
    }

    /// The pressure on the top of a plane, scaled so that its contraction with the plane has t = −1.
    pub fn pressure(plane: &Minors<N>) -> Self {
        let zero = N::from(0.0);
        Self { u: zero, w: zero, t: zero, p: N::from(1.0).over(plane.n), exponent: -plane.exponent }
    }

    /// The functional times a factor.
    pub fn times(self, factor: N) -> Self {
        Self { u: factor * self.u, w: factor * self.w, t: factor * self.t, p: factor * self.p, ..self }
    }

    /// ℓ𝒜, the derivative of ℓ downwards.
    fn slope(&self, &PlaneStrain { e, r, m, .. }: &PlaneStrain<N>) -> Self {
        Self {
            u: e * self.t - r * self.w,
            w: self.u,
            t: self.u - self.p,
            p: m * self.w + r * self.t,
            exponent: self.exponent,
        }
    }

    /// The functional a distance `d` = q·(distance) further down in the same material.
    pub fn lowered(&self, material: &PlaneStrain<N>, d: f64) -> Self {
        let (cosh, sinh, bending) = hyperbolic_coefficients(d);
        let l1 = self.slope(material);
        let l2 = l1.slope(material);
        let l3 = l2.slope(material);
        let sum = |l0: N, l1: N, l2: N, l3: N| {
            l0 * cosh + (l2 - l0) * (0.5 * d * sinh) + l1 * sinh + (l3 - l1) * (0.5 * bending)
        };
        Self {
            u: sum(self.u, l1.u, l2.u, l3.u),
            w: sum(self.w, l1.w, l2.w, l3.w),
            t: sum(self.t, l1.t, l2.t, l3.t),
            p: sum(self.p, l1.p, l2.p, l3.p),
            exponent: self.exponent + d,
        }
    }

    /// The functional just below an interface that carries shear, in the units of the material below.
    pub fn below(self, interface: Interface, above: &PlaneStrain<N>, below: &PlaneStrain<N>, wavenumber: f64) -> Self {
        let [slip, closure] = interface.jumps(above.shear * wavenumber);
        let ratio = above.shear.over(below.shear);
        Self {
            u: ratio * self.u,
            w: ratio * self.w,
            t: self.t + slip * self.u,
            p: self.p + closure * self.w,
            exponent: self.exponent,
        }
    }
}

/// e^{−d} times cosh d, sinh d and d cosh d − sinh d.
fn hyperbolic_coefficients(d: f64) -> (f64, f64, f64) {
    let theta = (-2.0 * d).exp();
    let (cosh, sinh) = (0.5 * (1.0 + theta), -0.5 * (-2.0 * d).exp_m1());
    let bending = if d < 1.0 {
        // d cosh d − sinh d = Σ 2j d^{2j+1}/(2j+1)!
        let (mut power, mut sum, mut j) = (d * d * d / 6.0, 0.0, 1.0);
        while 2.0 * j * power > 1e-17 * sum {
            sum += 2.0 * j * power;
            power *= d * d / ((2.0 * j + 2.0) * (2.0 * j + 3.0));
            j += 1.0;
        }
        (-d).exp() * sum
    } else {
        d * cosh - sinh
    };
    (cosh, sinh, bending)
}
