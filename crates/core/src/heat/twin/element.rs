//! Chebyshev points of an interval of depths, and the derivative of the polynomial through values at them.

use std::f64::consts::PI;

/// Polynomial degree of an element.
pub const DEGREE: usize = 20;

/// Part of a material with its Chebyshev points.
pub struct Element {
    /// Number of the material, from 0.
    pub material: usize,
    /// Depths, lengths.
    pub nodes: Vec<f64>,
    /// Matrix of the derivative by z at the nodes.
    pub slope: Vec<Vec<f64>>,
}

impl Element {
    /// Element of a material between two depths, lengths.
    pub fn new(material: usize, from: f64, to: f64) -> Self {
        let n = DEGREE;
        let x: Vec<f64> = (0..=n).map(|j| -(PI * j as f64 / n as f64).cos()).collect();
        let weight = |j: usize| if j == 0 || j == n { 2.0 } else { 1.0 };
        let mut slope = vec![vec![0.0; n + 1]; n + 1];
        for (i, row) in slope.iter_mut().enumerate() {
            for j in (0..=n).filter(|&j| j != i) {
                let sign = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
                // Differences of cosines by sines, which do not cancel.
                let sum = PI * (i + j) as f64 / (2 * n) as f64;
                let difference = PI * (i as f64 - j as f64) / (2 * n) as f64;
                let distance = 2.0 * sum.sin() * difference.sin();
                row[j] = weight(i) / weight(j) * sign / distance * 2.0 / (to - from);
            }
            row[i] = -row.iter().sum::<f64>();
        }
        let nodes = x.iter().map(|x| from + 0.5 * (to - from) * (1.0 + x)).collect();
        Self { material, nodes, slope }
    }
}
