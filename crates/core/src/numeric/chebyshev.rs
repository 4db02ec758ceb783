//! Chebyshev series of smooth functions on an interval.
//!
//! f(x) ≈ Σ c_j T_j(x), j < N, through the values at the nodes cos π(k+½)/N.

use std::f64::consts::PI;

/// A series of N terms on [−1, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chebyshev<const N: usize>([f64; N]);

impl<const N: usize> Chebyshev<N> {
    fn angle(k: usize) -> f64 {
        PI * (k as f64 + 0.5) / N as f64
    }

    /// The N nodes in [−1, 1], descending.
    pub fn nodes() -> [f64; N] {
        std::array::from_fn(|k| Self::angle(k).cos())
    }

    /// Series of the function with given values at the nodes.
    pub fn through(values: &[f64; N]) -> Self {
        Self(std::array::from_fn(|j| {
            let sum: f64 = values.iter().enumerate().map(|(k, value)| value * (j as f64 * Self::angle(k)).cos()).sum();
            sum * if j == 0 { 1.0 } else { 2.0 } / N as f64
        }))
    }

    /// Series of a function.
    pub fn of(f: impl Fn(f64) -> f64) -> Self {
        Self::through(&Self::nodes().map(f))
    }

    /// Series with given coefficients c_j.
    pub fn with(coefficients: [f64; N]) -> Self {
        Self(coefficients)
    }

    /// Coefficients c_j.
    pub fn coefficients(&self) -> &[f64; N] {
        &self.0
    }

    /// Value at x in [−1, 1], by Clenshaw's recurrence.
    pub fn at(&self, x: f64) -> f64 {
        let (mut one, mut two) = (0.0, 0.0);
        for &c in self.0[1..].iter().rev() {
            (one, two) = (2.0 * x * one - two + c, one);
        }
        x * one - two + self.0[0]
    }
}

/// T₀, T₁, … at x.
pub fn polynomials(x: f64) -> impl Iterator<Item = f64> {
    let mut pair = [1.0, x];
    std::iter::from_fn(move || {
        let value = pair[0];
        pair = [pair[1], 2.0 * x * pair[1] - value];
        Some(value)
    })
}

/// A number of nodes in [−1, 1], descending.
pub fn nodes(count: usize) -> Vec<f64> {
    (0..count).map(|k| (PI * (k as f64 + 0.5) / count as f64).cos()).collect()
}

/// The matrix from values at the nodes to the coefficients of T₀, T₁, …: a row each.
pub fn analysis(count: usize) -> Vec<Vec<f64>> {
    let at: Vec<Vec<f64>> = nodes(count).into_iter().map(|x| polynomials(x).take(count).collect()).collect();
    let factor = |order: usize| if order == 0 { 1.0 } else { 2.0 } / count as f64;
    (0..count).map(|order| at.iter().map(|values| values[order] * factor(order)).collect()).collect()
}

/// Coordinate in [−1, 1] of a place between `from` and `to`.
pub fn inside([from, to]: [f64; 2], place: f64) -> f64 {
    (2.0 * place - from - to) / (to - from)
}

/// Place between `from` and `to` of a coordinate x in [−1, 1].
pub fn place([from, to]: [f64; 2], x: f64) -> f64 {
    0.5 * ((to - from) * x + from + to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_function_is_met_between_the_nodes() {
        let ends = [0.3, 1.7];
        let series = Chebyshev::<16>::of(|x| place(ends, x).exp());
        for r in [0.3, 0.51, 1.0, 1.69] {
            assert!((series.at(inside(ends, r)) - r.exp()).abs() < 1e-14);
        }
    }
}
