//! The number that a modulus is: real, or complex with the loss modulus as its imaginary part.
//!
//! Distances and wavenumbers are real, so that moduli are added, multiplied, divided and nothing else: whatever is computed by these
//! operations is an analytic function of the moduli. A complex number without imaginary part gives the bits of the real one.

use rustfft::num_complex::Complex64;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that moduli are given by and displacements are computed in.
pub trait Number:
    Copy
    + Debug
    + Default
    + PartialEq
    + From<f64>
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// Quotient by another number, which is not zero.
    fn over(self, divisor: Self) -> Self;

    /// Largest magnitude of its parts: of the order of the absolute value, and cheaper.
    fn size(self) -> f64;
}

impl Number for f64 {
    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        self / divisor
    }

    #[inline(always)]
    fn size(self) -> f64 {
        self.abs()
    }
}

impl Number for Complex64 {
    /// R. L. Smith, Commun. ACM 5, 435 (1962): nothing is squared, so that nothing overflows and real numbers keep their bits.
    fn over(self, divisor: Self) -> Self {
        let Self { re, im } = divisor;
        if re.abs() < im.abs() {
            // By i: a quotient whose divisor has the larger part in front.
            return Self::new(self.im, -self.re).over(Self::new(im, -re));
        }
        let ratio = im / re;
        let scale = re + im * ratio;
        Self::new((self.re + self.im * ratio) / scale, (self.im - self.re * ratio) / scale)
    }

    fn size(self) -> f64 {
        self.re.abs().max(self.im.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers whose squares overflow or underflow are among them.
    #[test]
    fn a_quotient_times_its_divisor_is_the_number() {
        let parts = [(3.0, 0.0), (-2.0, 1e-30), (0.3, -7.0), (0.0, 1e-120), (1e160, 1e160), (-1e-118, 3e-119)];
        let numbers = parts.map(|(re, im)| Complex64::new(re, im));
        for (a, b) in numbers.into_iter().flat_map(|a| numbers.map(|b| (a, b))) {
            let quotient = a.over(b);
            assert!((quotient * b - a).size() < 1e-15 * a.size(), "{a} over {b}: {quotient}");
        }
    }

    #[test]
    fn a_number_without_imaginary_part_gives_the_bits_of_the_real_one() {
        for (a, b) in [(1.0, 3.0), (-0.7, 1e300), (1e-300, -7.0), (2.0 / 3.0, 1e-200f64)] {
            let complex = [a, b].map(Complex64::from);
            assert_eq!(complex[0].over(complex[1]), Complex64::from(a.over(b)));
            assert_eq!(complex[0] * complex[1], Complex64::from(a * b));
            assert_eq!(complex.map(Complex64::size), [a.size(), b.size()]);
        }
    }
}
