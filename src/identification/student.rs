//! Student's distribution, by which intervals are as wide as few points make them.

/// Quantile 0.975 of Student's distribution, to 0.2 % (Abramowitz & Stegun 26.7.5).
pub fn quantile(freedom: usize) -> f64 {
    let z: f64 = 1.959_963_985;
    let n = freedom as f64;
    match freedom {
        1 => 12.7062,
        2 => 4.3027,
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
    use super::quantile;

    /// Abramowitz & Stegun, table 26.10.
    #[test]
    fn quantiles_are_those_of_the_table() {
        for (freedom, known) in [(1, 12.706), (2, 4.303), (3, 3.182), (5, 2.571), (10, 2.228), (30, 2.042), (120, 1.98)]
        {
            assert!((quantile(freedom) / known - 1.0).abs() < 2e-3, "{freedom}: {}", quantile(freedom));
        }
    }
}
