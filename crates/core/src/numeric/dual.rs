//! Dual numbers: a complex number with its derivative. A result of the four operations has its derivative to rounding.
//!
//! (a, a′)(b, b′) = (ab, a′b + ab′),  (a, a′)/(b, b′) = (a/b, (a′ − (a/b)b′)/b).

use crate::numeric::number::Number;
use rustfft::num_complex::Complex64;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Value of a function of one complex variable, with its derivative.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dual {
    /// Value of the function.
    pub value: Complex64,
    /// Derivative of the function.
    pub slope: Complex64,
}

impl Dual {
    /// The variable itself, of slope one.
    pub fn variable(value: Complex64) -> Self {
        Self { value, slope: Complex64::from(1.0) }
    }

    fn map(self, f: impl Fn(Complex64) -> Complex64) -> Self {
        Self { value: f(self.value), slope: f(self.slope) }
    }
}

impl From<f64> for Dual {
    /// A constant.
    fn from(value: f64) -> Self {
        Self { value: value.into(), slope: Complex64::default() }
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self.map(|x| x * factor)
    }
}

impl Div<f64> for Dual {
    type Output = Self;
    fn div(self, divisor: f64) -> Self {
        self.map(|x| x / divisor)
    }
}

impl Number for Dual {
    fn over(self, divisor: Self) -> Self {
        let value = self.value.over(divisor.value);
        Self { value, slope: (self.slope - value * divisor.slope).over(divisor.value) }
    }

    /// Size of the value; the derivative has other units.
    fn size(self) -> f64 {
        self.value.size()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rational_function_has_its_derivative() {
        let x = Dual::variable(Complex64::new(0.3, -1.7));
        // (2x² − 1)/(4(x + 3)) has the slope (2x² + 12x + 1)/(4(x + 3)²).
        let found = (x * x * 2.0 - 1.0.into()).over(x + 3.0.into()) / 4.0;
        let shifted = x.value + 3.0;
        let slope = (2.0 * x.value * x.value + 12.0 * x.value + 1.0) / (4.0 * shifted * shifted);
        assert!((found.slope - slope).norm() < 1e-15 * slope.norm());
        assert_eq!((-found).slope, -found.slope);
    }
}
