//! Stresses of eight waves at a time, as vectors, and the terms of their expansion.

use fearless_simd::{f64x8, prelude::*};

/// Number of stress components: xx, yy, zz, xy, xz, yz.
pub(super) const STRESSES: usize = 6;
/// Number of terms 1, d_x, d_y, d_x², d_x d_y, d_y² of an expansion at one depth, then d_z, d_x d_z, d_y d_z, d_z².
pub(super) const TERMS: usize = 10;

/// Stresses by the terms of an expansion.
pub(super) type TaylorTerms = [[f64; STRESSES]; TERMS];

/// Eight waves of a row.
pub(super) struct EightWaves<S: Simd> {
    /// Real and imaginary part of c e^{i**q**·**x**}.
    pub value: [f64x8<S>; 2],
    /// q_x, q_y.
    pub q: [f64x8<S>; 2],
    /// **n** = **q**/q.
    pub n: [f64x8<S>; 2],
    /// n_x n_x, n_x n_y, n_y n_y.
    pub nn: [f64x8<S>; 3],
    /// q.
    pub wavenumber: f64x8<S>,
    /// ν.
    pub nu: f64x8<S>,
    /// F and its derivatives by qz under a pressure.
    pub normal: [f64x8<S>; 4],
    /// F and its derivatives by qz under a traction along the wavevector.
    pub along: [f64x8<S>; 4],
    /// v and −v′ under a traction across the wavevector.
    pub across: [f64x8<S>; 2],
}

impl<S: Simd> EightWaves<S> {
    /// xx, yy, zz, xy, xz, yz of σ_zz, σ_qz, σ_qq, σ_tt.
    #[inline(always)]
    pub fn cartesian(&self, [zz, qz, qq, tt]: [f64x8<S>; 4]) -> [f64x8<S>; STRESSES] {
        let ([nx, ny], [nxx, nxy, nyy]) = (self.n, self.nn);
        [nxx * qq + nyy * tt, nyy * qq + nxx * tt, zz, nxy * (qq - tt), nx * qz, ny * qz]
    }

    /// σ_zz, σ_qz, σ_qq, σ_tt of F, or their derivatives in depth of the given order.
    #[inline(always)]
    pub fn stresses(&self, &[f0, f1, f2, f3]: &[f64x8<S>; 4], order: usize) -> [f64x8<S>; 4] {
        let (nu, q) = (self.nu, self.wavenumber);
        match order {
            0 => [-f0, f1, f2, nu * (f2 - f0)],
            1 => [-f1 * q, f2 * q, f3 * q, nu * (f3 - f1) * q],
            _ => {
                let square = q * q;
                [-f2 * square, f3 * square, (f2 + f2 - f0) * square, nu * (f2 - f0) * square]
            }
        }
    }

    /// Adds the terms of one order of d_z, of stresses `even` and `odd` in **q**: c(E − iT) where a pressure's stress is even,
    /// c(T − iE) where it is odd.
    #[inline(always)]
    pub fn add<const SLIDES: bool>(
        &self,
        sums: &mut [[f64x8<S>; STRESSES]; TERMS],
        even: &[f64x8<S>; STRESSES],
        odd: &[f64x8<S>; STRESSES],
        order: usize,
    ) {
        let ([p, q], [x, y]) = (self.value, self.q);
        let squares = [x * x, x * y, y * y];
        for k in 0..STRESSES {
            let (e, t) = if k < 4 { (even[k], odd[k]) } else { (odd[k], even[k]) };
            let (re, im) = if SLIDES || k >= 4 { (p * e + q * t, q * e - p * t) } else { (p * e, q * e) };
            match order {
                0 => {
                    sums[0][k] += re;
                    sums[1][k] -= x * im;
                    sums[2][k] -= y * im;
                    for term in 0..3 {
                        sums[3 + term][k] -= squares[term] * re;
                    }
                }
                1 => {
                    sums[6][k] += re;
                    sums[7][k] -= x * im;
                    sums[8][k] -= y * im;
                }
                _ => sums[9][k] += re,
            }
        }
    }
}
