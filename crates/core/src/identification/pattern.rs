//! Whether residuals are scatter: their runs and their ranks, in the order of the force.
//!
//! The number of runs of one sign among n₁ residuals above and n₂ below 0 has a known distribution where they are
//! independent (Wald and Wolfowitz, Ann. Math. Stat. 11 (1940) 147); Σ(Rᵢ − Rᵢ₊₁)²/Σ(Rᵢ − R̄)² of their ranks R lies
//! about 2, with the variance 4(n − 2)(5n² − 2n − 9)/(5n(n + 1)(n − 1)²) (Bartels, J. Am. Stat. Assoc. 77 (1982) 40). A
//! trend, an arch or a hysteresis has few runs and a small ratio. Neither needs the size of the scatter; residuals of a
//! fit tend to more runs than independent ones, on the safe side.

use super::student::NORMAL;

/// Probability, under independent residuals, of as few runs, and of as small a ratio, from which on they are a pattern: 1 in 400 each.
pub const LEVEL: f64 = 0.0025;

/// Runs and ranks of residuals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pattern {
    /// Runs of residuals of one sign.
    pub runs: usize,
    /// Mean number of runs of independent residuals with as many of each sign.
    pub expected: f64,
    /// Probability of as few runs under independent residuals.
    pub probability: f64,
    /// Bartels' ratio less its mean, in its standard deviations.
    pub ranks: f64,
}

impl Pattern {
    /// The pattern of residuals in an order; those that are 0 have no sign.
    pub fn of(residuals: &[f64]) -> Self {
        let signs: Vec<bool> = residuals.iter().filter(|r| **r != 0.0).map(|r| *r > 0.0).collect();
        let above = signs.iter().filter(|is| **is).count();
        let (n1, n2) = (above, signs.len() - above);
        let runs = usize::from(!signs.is_empty()) + signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let expected = 1.0 + 2.0 * (n1 * n2) as f64 / (signs.len().max(1)) as f64;
        Self { runs, expected, probability: as_few(runs, [n1, n2]), ranks: bartels(residuals) }
    }

    /// Whether independent residuals have such a pattern in less than two of [`LEVEL`].
    pub fn is_systematic(&self) -> bool {
        self.probability < LEVEL || self.ranks < -NORMAL
    }
}

/// Probability of at most `runs` runs of independent signs, n₁ of one and n₂ of the other kind.
fn as_few(runs: usize, [n1, n2]: [usize; 2]) -> f64 {
    if n1 == 0 || n2 == 0 {
        return 1.0;
    }
    let mut factorials = vec![0.0f64];
    for k in 1..=n1 + n2 {
        factorials.push(factorials[k - 1] + (k as f64).ln());
    }
    let choose = |n: usize, k: usize| match k > n {
        true => f64::NEG_INFINITY,
        false => factorials[n] - factorials[k] - factorials[n - k],
    };
    let all = choose(n1 + n2, n1);
    let both = |a: usize, b: usize| (choose(n1 - 1, a) + choose(n2 - 1, b) - all).exp();
    let exactly = |runs: usize| match runs / 2 {
        half if runs.is_multiple_of(2) => 2.0 * both(half - 1, half - 1),
        half => both(half, half - 1) + both(half - 1, half),
    };
    (2..=runs).map(exactly).sum::<f64>().min(1.0)
}

/// Bartels' ratio of ranks less its mean, in its standard deviations; 0 of less than four residuals.
fn bartels(residuals: &[f64]) -> f64 {
    let count = residuals.len();
    if count < 4 {
        return 0.0;
    }
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| residuals[a].total_cmp(&residuals[b]));
    let mut ranks = vec![0.0; count];
    order.iter().zip(0u32..).for_each(|(&index, rank)| ranks[index] = f64::from(rank));
    let middle = 0.5 * (count as f64 - 1.0);
    let steps: f64 = ranks.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    let squares: f64 = ranks.iter().map(|rank| (rank - middle).powi(2)).sum();
    let n = count as f64;
    let variance = 4.0 * (n - 2.0) * (5.0 * n * n - 2.0 * n - 9.0) / (5.0 * n * (n + 1.0) * (n - 1.0).powi(2));
    (steps / squares - 2.0) / variance.sqrt()
}
