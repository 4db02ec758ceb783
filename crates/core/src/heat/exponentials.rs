//! Functions of decaying exponentials that neither cancel nor overflow.

use crate::numeric::number::Number;
use rustfft::num_complex::Complex64;

/// Exponent from which on e^{−x} is 0 in double precision.
const MAX_EXPONENT: f64 = 800.0;

/// e^{−x}, Re x ≥ 0.
pub(super) fn decay(x: Complex64) -> Complex64 {
    if x.re > MAX_EXPONENT { Complex64::default() } else { (-x).exp() }
}

/// 1 − e^{−x}, Re x ≥ 0: e^{−r}·2 sin²(i/2) − (e^{−r} − 1) and ie^{−r} sin i with x = r + i·i.
pub(super) fn loss(x: Complex64) -> Complex64 {
    if x.re > MAX_EXPONENT {
        return Complex64::from(1.0);
    }
    let (size, half) = ((-x.re).exp(), (0.5 * x.im).sin());
    Complex64::new(2.0 * half * half * size - (-x.re).exp_m1(), size * x.im.sin())
}

/// (1 − e^{−x})/x, Re x ≥ 0; 1 at 0.
pub(super) fn mean_decay(x: Complex64) -> Complex64 {
    if x.size() == 0.0 { Complex64::from(1.0) } else { loss(x).over(x) }
}

/// tanh x, Re x ≥ 0.
pub(super) fn tanh(x: Complex64) -> Complex64 {
    loss(x * 2.0).over(decay(x * 2.0) + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Series Σ xⁿ/(n+1)! against the quotient on both sides of where either is used, and the limits.
    #[test]
    fn the_mean_decay_is_its_series() {
        for angle in [-0.25, 0.0, 0.1, 0.5] {
            for size in [1e-12, 1e-5, 1e-2, 0.3, 1.0, 2.0] {
                let x = Complex64::from_polar(size, angle * std::f64::consts::PI);
                let (mut term, mut series) = (Complex64::from(1.0), Complex64::default());
                for n in 1..40 {
                    series += term;
                    term *= -x / f64::from(n + 1);
                }
                let error = (mean_decay(x) - series).norm() / series.norm();
                assert!(error < 4.0 * f64::EPSILON, "{x}: {error:e}");
                assert!((tanh(x) - x.tanh()).norm() < 4.0 * f64::EPSILON * x.tanh().norm());
            }
        }
        assert_eq!(mean_decay(Complex64::default()), Complex64::from(1.0));
        assert_eq!(tanh(Complex64::new(1e300, -1e300)), Complex64::from(1.0));
        assert_eq!(decay(Complex64::new(f64::INFINITY, -1.0)), Complex64::default());
    }
}
