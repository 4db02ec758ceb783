//! Statistics of a result over the samples of a sweep: moments, quantiles and Sobol indices of its inputs, with intervals by bootstrap.
//!
//! A sample has the values f(**a**), f(**b**) and f(**ab**ᵢ), where **ab**ᵢ is **a** with the i-th input of **b**. With the variance V of f, and f
//! centred on its mean, both over all **a** and **b**, the part of V that an input makes by itself, and with all its interactions, is
//!
//! Sᵢ = ⟨f(**b**) (f(**ab**ᵢ) − f(**a**))⟩ / V,  Tᵢ = ⟨(f(**a**) − f(**ab**ᵢ))²⟩ / 2V
//!
//! (A. Saltelli et al., *Comput. Phys. Commun.* 181 (2010) 259–270; T by M. J. W. Jansen, *ibid.* 117 (1999) 35–43).
//!
//! Intervals are those of samples drawn from these with replacement. The points of a sequence spread more evenly than such draws, so that the
//! intervals are rather too wide.

use rayon::prelude::*;
use sobol_burley::parts::hash;

/// Parts of all values that lie below the quantiles.
const QUANTILES: [f64; 3] = [0.05, 0.5, 0.95];
/// Ends of an interval that holds 95 % of the replicates.
const INTERVAL: [f64; 2] = [0.025, 0.975];
/// Draws of samples by which intervals are estimated.
const REPLICATES: u32 = 400;
/// Deviation over mean up to which a result counts as constant: the tolerance of the solver makes as much.
const CONSTANT: f64 = 1e-7;
/// Numbers before the indices: mean, deviation, quantiles.
const BEFORE: usize = 2 + QUANTILES.len();

/// A number with the 95 % interval of its sampling; NaN where it is not known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The number; a quantile is infinite where it is a value beyond what was searched.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// Statistics of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct Statistics {
    /// Mean of the finite values.
    pub mean: Estimate,
    /// Standard deviation of the finite values.
    pub deviation: Estimate,
    /// 5, 50 and 95 % quantile of all values.
    pub quantiles: [Estimate; 3],
    /// First-order and total index of each input, by the samples whose values are all finite; NaN of a constant result.
    pub indices: Vec<[Estimate; 2]>,
}

impl Estimate {
    /// Half of the interval.
    pub fn half(&self) -> f64 {
        0.5 * (self.high - self.low)
    }
}

impl Statistics {
    /// Whether the finite values differ by no more than rounding and the tolerance of the solver make.
    pub fn is_constant(&self) -> bool {
        is_constant(self.mean.value, self.deviation.value)
    }

    /// Statistics of values, sample after sample with `block` values each. A value that is not known is NaN, one beyond all that was
    /// searched infinite.
    pub fn of(values: &[f64], block: usize) -> Self {
        let count = values.len() / block;
        let numbers = numbers(values, block, 0..count);
        let drawn = |replicate: u32| {
            let start = hash(replicate);
            let draw = move |k: usize| ((u64::from(hash(start ^ hash(k as u32))) * count as u64) >> 32) as usize;
            self::numbers(values, block, (0..count).map(draw))
        };
        let replicates: Vec<Vec<f64>> = (0..REPLICATES).into_par_iter().map(drawn).collect();
        let estimate = |at: usize| {
            let [low, high] = quantiles(replicates.iter().map(|replicate| replicate[at]).collect(), INTERVAL);
            Estimate { value: numbers[at], low, high }
        };
        Self {
            mean: estimate(0),
            deviation: estimate(1),
            quantiles: [2, 3, 4].map(estimate),
            indices: (0..block - 2).map(|input| [0, 1].map(|kind| estimate(BEFORE + 2 * input + kind))).collect(),
        }
    }
}

/// Mean, deviation, quantiles, and both indices of each input over some of the samples.
fn numbers(values: &[f64], block: usize, samples: impl Iterator<Item = usize> + Clone) -> Vec<f64> {
    let samples = samples.map(|sample| &values[sample * block..(sample + 1) * block]);
    let draws: Vec<f64> = samples.clone().flat_map(|sample| [sample[0], sample[1]]).collect();
    let (mean, variance) = moments(draws.iter().copied().filter(|value| value.is_finite()));
    let mut numbers = vec![mean, variance.sqrt()];
    numbers.extend(quantiles(draws, QUANTILES));
    let whole = || samples.clone().filter(|sample| sample.iter().all(|value| value.is_finite()));
    let (mean, variance) = moments(whole().flat_map(|sample| [sample[0], sample[1]]));
    for input in 2..block {
        let mut sums = [0.0; 3];
        for sample in whole() {
            let [a, b, ab] = [0, 1, input].map(|place| sample[place] - mean);
            sums = [sums[0] + b * (ab - a), sums[1] + (a - ab).powi(2), sums[2] + 1.0];
        }
        let [first, total, count] = sums;
        let over = if is_constant(mean, variance.sqrt()) { f64::NAN } else { count * variance };
        numbers.extend([first / over, 0.5 * total / over]);
    }
    numbers
}

fn is_constant(mean: f64, deviation: f64) -> bool {
    deviation <= CONSTANT * mean.abs()
}

/// Mean and variance; NaN of nothing.
fn moments(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    (mean, values.map(|value| (value - mean).powi(2)).sum::<f64>() / count)
}

/// Values below which these parts of the known ones lie, linear between neighbours; NaN without any.
fn quantiles<const N: usize>(values: Vec<f64>, parts: [f64; N]) -> [f64; N] {
    let mut sorted = values;
    sorted.retain(|value| !value.is_nan());
    sorted.sort_unstable_by(f64::total_cmp);
    parts.map(|part| {
        let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
        let place = part * last as f64;
        let (below, above) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
        if below == above || below.is_infinite() { below } else { below + place.fract() * (above - below) }
    })
}

#[cfg(test)]
mod tests {
    use super::super::design::{Design, Distribution, Varied};
    use super::*;
    use std::f64::consts::PI;

    /// Statistics of a function of inputs, by the combinations of a design.
    fn of(distributions: &[Distribution], samples: usize, seed: u32, f: impl Fn(&[f64]) -> f64) -> Statistics {
        let keys = (0..).zip(distributions);
        let keys = keys.map(|(k, &distribution)| Varied { key: format!("x{k}"), distribution }).collect();
        let design = Design { keys, samples, seed };
        let value = |values: &Vec<String>| f(&values.iter().map(|text| text.parse().unwrap()).collect::<Vec<f64>>());
        let values: Vec<f64> = design.combinations().all.iter().map(|combination| value(&combination.values)).collect();
        Statistics::of(&values, design.block())
    }

    fn assert_within(found: Estimate, exact: f64, tolerance: f64) {
        assert!((found.value - exact).abs() < tolerance, "{found:?} is not {exact}");
        assert!(found.low - tolerance < exact && exact < found.high + tolerance, "{found:?} does not hold {exact}");
    }

    const ANGLE: Distribution = Distribution::Uniform { from: -PI, to: PI };

    /// f = sin x₁ + a sin² x₂ + b x₃⁴ sin x₁ (T. Ishigami & T. Homma, 1990). By integration over −π … π: mean a/2, V₁ = ½ (1 + bπ⁴/5)²,
    /// V₂ = a²/8, V₁₃ = b²π⁸ (1/18 − 1/50), and nothing else.
    #[test]
    fn the_indices_of_ishigamis_function_are_those_of_its_integrals() {
        let (a, b) = (7.0, 0.1);
        let f = |x: &[f64]| x[0].sin() + a * x[1].sin().powi(2) + b * x[2].powi(4) * x[0].sin();
        let v1 = 0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2);
        let (v2, v13) = (a * a / 8.0, b * b * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0));
        let v = v1 + v2 + v13;
        let error = |samples: usize| {
            let found = of(&[ANGLE; 3], samples, 1, f);
            assert_within(found.mean, 0.5 * a, 8.0 / samples as f64);
            assert_within(found.deviation, v.sqrt(), 32.0 / samples as f64);
            let exact = [[v1 / v, (v1 + v13) / v], [v2 / v, v2 / v], [0.0, v13 / v]];
            let pairs = found.indices.iter().flatten().zip(exact.iter().flatten());
            pairs.map(|(found, exact)| (found.value - exact).abs()).fold(0.0, f64::max)
        };
        let [coarse, fine] = [256, 8192].map(error);
        assert!(coarse < 0.1 && fine < 0.006, "{coarse} {fine}");
    }

    /// f = Σ cᵢ xᵢ has the parts cᵢ² Vᵢ of its variance and no interactions; sums of normal numbers are normal.
    #[test]
    fn inputs_of_a_sum_have_the_parts_of_their_variances() {
        let normal = |mean: f64, deviation: f64| Distribution::Normal { mean, deviation };
        let found =
            of(&[normal(1.0, 0.1), normal(-2.0, 0.2), normal(5.0, 0.05)], 4096, 0, |x| x[0] + 2.0 * x[1] - 4.0 * x[2]);
        let parts = [0.01, 0.16, 0.04];
        let variance: f64 = parts.iter().sum();
        for (indices, part) in found.indices.iter().zip(parts) {
            indices.iter().for_each(|index| assert_within(*index, part / variance, 0.01));
        }
        let deviation = variance.sqrt();
        assert_within(found.mean, -23.0, 1e-3);
        assert_within(found.deviation, deviation, 2e-3);
        // 1.6449 is the tabulated 95 % quantile of the normal distribution.
        for (found, exact) in found.quantiles.iter().zip([-1.6449, 0.0, 1.6449]) {
            assert_within(*found, -23.0 + exact * deviation, 0.01);
        }
    }

    /// The product of uniform numbers: every moment is that of its factors, so that V = Π(μᵢ² + Vᵢ) − Πμᵢ².
    #[test]
    fn interactions_are_in_the_total_indices_alone() {
        let uniform = Distribution::Uniform { from: 0.0, to: 2.0 };
        let found = of(&[uniform; 2], 4096, 3, |x| x[0] * x[1]);
        let v = (4.0_f64 / 3.0).powi(2) - 1.0;
        for [first, total] in found.indices {
            assert_within(first, 1.0 / 3.0 / v, 0.01);
            assert_within(total, (1.0 / 3.0 + 1.0 / 9.0) / v, 0.01);
        }
    }

    /// About 95 in 100 intervals hold the exact index: more than that, since the points are more even than random ones.
    #[test]
    fn intervals_hold_the_exact_numbers() {
        let uniform = Distribution::Uniform { from: 0.0, to: 1.0 };
        let held = (0..60).map(|seed| {
            let found = of(&[uniform; 2], 64, seed, |x| x[0] + 0.5 * x[1]);
            let holds = |estimate: Estimate, exact: f64| estimate.low <= exact && exact <= estimate.high;
            usize::from(holds(found.indices[0][1], 0.8)) + usize::from(holds(found.mean, 0.75))
        });
        let held: usize = held.sum();
        assert!(held >= 112, "{held} of 120");
    }

    #[test]
    fn what_lies_beyond_the_search_counts_in_quantiles_and_nowhere_else() {
        let uniform = Distribution::Uniform { from: 0.0, to: 1.0 };
        let found = of(&[uniform], 1024, 0, |x| if x[0] > 0.9 { f64::INFINITY } else { x[0] });
        let [low, median, high] = found.quantiles.map(|quantile| quantile.value);
        assert!((low - 0.05).abs() < 0.01 && (median - 0.5).abs() < 0.01 && high == f64::INFINITY);
        assert!((found.mean.value - 0.45).abs() < 0.01, "{:?}", found.mean);
        let nothing = of(&[uniform], 8, 0, |_| f64::NAN);
        assert!(nothing.mean.value.is_nan() && nothing.quantiles[1].value.is_nan());
        let constant = of(&[uniform], 8, 0, |_| 3.0);
        assert!(constant.indices[0][0].value.is_nan() && constant.quantiles[2].value == 3.0);
    }
}
