//! How far the highest point of a kinked surface may lie above the sum of waves through its samples.
//!
//! Between two samples, h apart, the sum runs below a ridge whose slope jumps by Δ, by up to 0.16 Δ h: most where the ridge is midway and Δ h/4
//! above both samples, nothing where it is at one of them. The jump is that of the samples themselves. Along a line, each is compared with
//! what the eight around it at odd distances say of it, the polynomial of seventh order through them:
//!
//! r(i) = h(i) − Σ w_k [h(i − k) + h(i + k)],  k = 1, 3, 5, 7,  w = (1225, −245, 49, −5)/2048
//!
//! (Lagrange's formula for the middle). Waves of sixteen samples and more leave 10⁻⁴ of their amplitude, second differences a hundred times more:
//! what remains is no curvature. Of a ridge between the samples i and i + 1, wherever between, r(i) + r(i + 1) = (1400/2048 − 1/2) Δ h.
//!
//! A ridge between samples rises by at most Δ h/4 above the higher of the two; of a tip, a summit of both directions, the rises add. The estimate
//! is [`ABOVE_WAVES`] of the largest height, with this rise, above the highest sample. Measured on ridges along and across the samples, tips of cones and
//! pyramids at any place between the samples: it holds from 32 samples on, and is at most a few times too wide.

use crate::numeric::parallel;
use ndarray::ArrayView2;

/// Weights w_k of the samples k = 1, 3, 5, 7 to both sides.
const WEIGHTS: [f64; 4] = [1225.0 / 2048.0, -245.0 / 2048.0, 49.0 / 2048.0, -5.0 / 2048.0];
/// r(i) + r(i + 1) of a ridge between them, over Δ h.
const OF_JUMP: f64 = 1400.0 / 2048.0 - 0.5;
/// Rise of a ridge above the higher of the two samples beside it, over Δ h.
const RISE: f64 = 0.25;
/// Part of the rise above the highest sample that the sum of waves may miss: 0.16/0.25, and a quarter more.
const ABOVE_WAVES: f64 = 0.8;

/// Largest height by which the apex of a surface with these `heights` at the samples of a cell may lie above the sum of waves through
/// them, a length ≥ 0; the smooth depths `below(i, j)` of a ball are taken off the heights.
pub(crate) fn above_waves(heights: ArrayView2<'_, f64>, below: impl Fn(usize, usize) -> f64 + Sync) -> f64 {
    let (n1, n2) = heights.dim();
    let highest_of = |of: &(dyn Fn(usize, usize) -> f64 + Sync)| {
        let row = |i: usize| (0..n2).map(|j| of(i, j)).fold(f64::NEG_INFINITY, f64::max);
        parallel::map(n1, row).into_iter().fold(f64::NEG_INFINITY, f64::max)
    };
    let height = |i: usize, j: usize| heights[[i, j]] - below(i, j);
    let with_rise = |i: usize, j: usize| {
        let [before, after] = [[(i + n1 - 1) % n1, (j + n2 - 1) % n2], [(i + 1) % n1, (j + 1) % n2]];
        let around = [height(before[0], j), height(after[0], j), height(i, before[1]), height(i, after[1])];
        // Only a summit of both lines may be the highest point.
        if around.into_iter().any(|other| other > height(i, j)) {
            return f64::NEG_INFINITY;
        }
        height(i, j) + RISE * (jump(n1, i, &|k| heights[[k, j]]) + jump(n2, j, &|k| heights[[i, k]]))
    };
    let rise = highest_of(&with_rise) - highest_of(&height);
    ABOVE_WAVES * rise.max(0.0)
}

/// Jump of the slope Δ h ≥ 0 at a ridge beside the sample `at` of a closed line of n, a length.
fn jump(n: usize, at: usize, line: &dyn Fn(usize) -> f64) -> f64 {
    let residual = |at: usize| {
        let around = |k: usize| line((at + k) % n) + line((at + 8 * n - k) % n);
        line(at) - (0..4).map(|m| WEIGHTS[m] * around(2 * m + 1)).sum::<f64>()
    };
    let beside = residual((at + 1) % n).max(residual((at + n - 1) % n));
    ((residual(at) + beside) / OF_JUMP).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::super::apex;
    use super::*;
    use crate::lattice::Cell;
    use ndarray::Array2;

    const FLAT: fn(usize, usize) -> f64 = |_, _| 0.0;

    /// Heights with the apex 0 at a place between the samples, on a square of side 1.
    fn sampled(n: usize, place: [f64; 2], of: &dyn Fn([f64; 2]) -> f64) -> Array2<f64> {
        let at = |k: usize, place: f64| {
            let x = (k as f64 + place) / n as f64;
            x - x.round()
        };
        Array2::from_shape_fn((n, n), |(i, j)| of([at(i, place[0]), at(j, place[1])]))
    }

    #[test]
    fn ridges_and_tips_between_the_samples_lie_within_the_estimate() {
        let roof = |[x, _]: [f64; 2]| -x.abs();
        let lopsided = |[x, _]: [f64; 2]| -(0.3 * x).max(-x).min(0.14);
        let vaulted = |[x, y]: [f64; 2]| -0.5 * x.abs() - x * x - y * y;
        let diagonal = |[x, y]: [f64; 2]| -(x + y - (x + y).round()).abs();
        let cone = |[x, y]: [f64; 2]| -x.hypot(y);
        let pyramid = |[x, y]: [f64; 2]| -x.abs().max(y.abs());
        let all: [&dyn Fn([f64; 2]) -> f64; 6] = [&roof, &lopsided, &vaulted, &diagonal, &cone, &pyramid];
        for (shape, n) in all.iter().flat_map(|shape| [32, 65, 128].map(|n| (shape, n))) {
            for place in [[0.5, 0.5], [0.25, 0.4], [0.1, 0.7], [0.0, 0.0]] {
                let heights = sampled(n, place, shape);
                let missed = -apex(Cell::square(1.0).unwrap(), heights.view()).unwrap();
                let estimate = above_waves(heights.view(), FLAT);
                // Above the sum of waves the surface may lie by less: the sum rings beside the kink.
                assert!(missed.abs() <= estimate && estimate < 0.9 / n as f64, "{n} {place:?}: {missed} {estimate}");
            }
        }
    }

    /// The part of its amplitude that a wave leaves falls with the eighth power of the samples in it.
    #[test]
    fn smooth_surfaces_have_no_jump() {
        for (samples, most) in [(16, 6e-4), (32, 3e-6)] {
            let wave = |x: f64| (std::f64::consts::TAU * 64.0 / f64::from(samples) * x).cos();
            let heights = sampled(64, [0.3, 0.4], &|[x, y]| wave(x) + wave(y));
            assert!(above_waves(heights.view(), FLAT) < most, "{samples}: {}", above_waves(heights.view(), FLAT));
        }
        // Few samples of a line that is the same all along it.
        let line = Array2::from_shape_fn((64, 2), |(i, _)| (std::f64::consts::TAU * (i as f64 + 0.3) / 64.0).cos());
        assert!(above_waves(line.view(), FLAT) < 1e-8);
    }

    #[test]
    fn a_ball_has_no_kink_and_that_of_a_lower_summit_is_not_seen() {
        let ball = |i: usize, j: usize| 1e-3 * ((i as f64 - 20.3).powi(2) + (j as f64 - 20.3).powi(2));
        assert!(above_waves(Array2::zeros((40, 40)).view(), ball) == 0.0);
        let lower = |[x, _]: [f64; 2]| -x.abs().min(0.1 + 2.0 * (x.abs() - 0.4).abs());
        let heights = sampled(64, [0.0; 2], &lower);
        assert!(above_waves(heights.view(), FLAT) < 0.41 / 64.0);
    }
}
