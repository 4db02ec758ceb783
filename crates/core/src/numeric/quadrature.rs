//! Gauss–Legendre quadrature.

use std::f64::consts::PI;

/// Abscissae and weights of the rule of `n` points on [−1, 1]: roots of P_n by Newton's iteration.
pub fn gauss(n: usize) -> Vec<[f64; 2]> {
    let legendre = |x: f64| {
        let (mut before, mut value) = (0.0, 1.0);
        for k in 1..=n {
            let k = k as f64;
            (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
        }
        (value, n as f64 * (x * value - before) / (x * x - 1.0))
    };
    let point = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        for _ in 0..10 {
            let (value, slope) = legendre(x);
            x -= value / slope;
        }
        let (_, slope) = legendre(x);
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..n).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn n_points_integrate_powers_below_2n_exactly() {
        for n in [1, 2, 5, 10, 16, 60] {
            for power in [0, 1, n as i32, 2 * n as i32 - 1] {
                let sum: f64 = gauss(n).iter().map(|[x, weight]| 0.5 * weight * (1.5 + 0.5 * x).powi(power)).sum();
                let exact = (2f64.powi(power + 1) - 1.0) / f64::from(power + 1);
                assert!((sum / exact - 1.0).abs() < 1e-12, "{n} points, power {power}: {sum} {exact}");
            }
        }
    }
}
