//! Student's distribution, by which intervals are as wide as few points make them.

/// Quantile 0.9975 of the normal distribution.
pub const NORMAL: f64 = 2.807_033_768;

/// A probability of Student's distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantile {
    /// 0.975: 95 % lie between its negative and itself.
    TwoSided95,
    /// 0.99875: all but 1 of 400 lie between its negative and itself.
    TwoSided400,
}

/// Quantile of Student's distribution, to 0.2 % of the first and 5 % of the second probability (Abramowitz & Stegun 26.7.5).
pub fn quantile(of: Quantile, freedom: usize) -> f64 {
    // Quantiles of the normal distribution, and of one and two degrees of freedom.
    let (z, few): (f64, [f64; 2]) = match of {
        Quantile::TwoSided95 => (1.959_963_985, [12.7062, 4.3027]),
        Quantile::TwoSided400 => (3.023_341_440, [254.6466, 19.9625]),
    };
    let n = freedom as f64;
    match freedom {
        0 => f64::INFINITY,
        1 | 2 => few[freedom - 1],
        _ => {
            let g1 = (z.powi(3) + z) / 4.0;
            let g2 = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
            let g3 = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
            let g4 =
                (79.0 * z.powi(9) + 776.0 * z.powi(7) + 1482.0 * z.powi(5) - 1920.0 * z.powi(3) - 945.0 * z) / 92160.0;
            z + g1 / n + g2 / (n * n) + g3 / n.powi(3) + g4 / n.powi(4)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Quantile, quantile};

    /// Abramowitz & Stegun, table 26.10.
    #[test]
    fn quantiles_are_those_of_the_table() {
        for (freedom, known) in [(1, 12.706), (2, 4.303), (3, 3.182), (5, 2.571), (10, 2.228), (30, 2.042), (120, 1.98)]
        {
            let found = quantile(Quantile::TwoSided95, freedom);
            assert!((found / known - 1.0).abs() < 2e-3, "{freedom}: {found}");
        }
    }
}
