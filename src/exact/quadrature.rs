//! Gauss–Legendre quadrature.

use std::f64::consts::PI;

/// Abscissae and weights of the rule with `points` points on [from, to], by Newton's method on the Legendre polynomial.
pub fn rule(from: f64, to: f64, points: usize) -> Vec<[f64; 2]> {
    let n = points as f64;
    (1..=points)
        .map(|i| {
            let mut x = (PI * (i as f64 - 0.25) / (n + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..10 {
                let (mut p, mut before) = (x, 1.0);
                for k in 2..=points {
                    let k = k as f64;
                    (p, before) = (((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k, p);
                }
                slope = n * (x * p - before) / (x * x - 1.0);
                x -= p / slope;
            }
            [0.5 * (from + to - (to - from) * x), (to - from) / ((1.0 - x * x) * slope * slope)]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::rule;

    #[test]
    fn polynomials_are_integrated_exactly() {
        let sum: f64 = rule(1.0, 3.0, 5).iter().map(|[x, weight]| weight * x.powi(9)).sum();
        assert!((sum / ((3f64.powi(10) - 1.0) / 10.0) - 1.0).abs() < 1e-14);
    }
}
