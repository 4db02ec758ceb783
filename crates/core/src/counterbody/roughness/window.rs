//! Tapers that make a surface periodic, with a border that runs out below every possible contact.
//!
//! h ← P + w₁(i) w₂(j) (h − P) − D (1 − w₁(i) w₂(j)), with the weights at the N samples of a direction at u = (k + ½)/N:
//!
//! - Hann: w = sin²(πu);
//! - Tukey: w = sin²(πu/2a) within a = 1/10 of either end, 1 between them.
//!
//! P is the mean plane, or the mean, of the surface weighted by w₁w₂. Then w₁w₂(h − P) has no mean and no slope. D = max(h − P) − min(h − P): the border lies as far below the deepest pit as the highest peak above P, and touches
//! nothing before all of the surface does.

use super::plane::MeanPlane;
use ndarray::Array2;
use serde::Serialize;
use std::f64::consts::{FRAC_PI_2, PI};

/// Window of a taper along both directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Window {
    /// Hann's window, over the whole length.
    Hann,
    /// Tukey's window, over a tenth of the length at either end.
    Tukey,
}

/// Part of the length over which Tukey's window rises, at either end.
const TUKEY_RISE: f64 = 0.1;

impl Window {
    /// Name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hann => "hann",
            Self::Tukey => "tukey",
        }
    }

    /// Weight at the part u of the length, between 0 and 1.
    fn weight(self, u: f64) -> f64 {
        let to_end = u.min(1.0 - u);
        match self {
            Self::Hann => (PI * to_end).sin().powi(2),
            Self::Tukey if to_end < TUKEY_RISE => (FRAC_PI_2 * to_end / TUKEY_RISE).sin().powi(2),
            Self::Tukey => 1.0,
        }
    }

    /// Weights at `n` samples, between 0 and 1.
    pub fn weights(self, n: usize) -> Vec<f64> {
        (0..n).map(|k| self.weight((k as f64 + 0.5) / n as f64)).collect()
    }
}

/// Run-out of a surface at the border of its cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunOut {
    /// Window of the taper.
    pub window: Window,
    /// Depth D of the border below P, a length.
    pub depth: f64,
    /// Number of samples along a₁ and a₂ that were tapered.
    pub points: [usize; 2],
}

impl RunOut {
    /// Weight w₁w₂ at fractions [s, t] of the cell vectors, sample \[0, 0\] at the origin.
    fn weight(&self, place: [f64; 2]) -> f64 {
        let [one, other] =
            [0, 1].map(|axis| self.window.weight((place[axis] + 0.5 / self.points[axis] as f64).rem_euclid(1.0)));
        one * other
    }

    /// Whether the window is below 1 at fractions [s, t] of the cell vectors, so that heights there differ from the surface's.
    pub fn is_tapered(&self, place: [f64; 2]) -> bool {
        self.weight(place) < 1.0
    }

    /// Tapered heights without the run-out: P + w₁w₂(h − P), lengths, on any grid of the same cell.
    pub fn undone(&self, mut heights: Array2<f64>) -> Array2<f64> {
        let (n1, n2) = heights.dim();
        for ((i, j), height) in heights.indexed_iter_mut() {
            *height += self.depth * (1.0 - self.weight([i as f64 / n1 as f64, j as f64 / n2 as f64]));
        }
        heights
    }
}

/// Heights tapered to their mean at the border and run out below it, lengths; with `level` tapered to their mean plane, which is then
/// subtracted. Mean and plane are weighted by the window.
pub fn tapered(mut heights: Array2<f64>, window: Window, level: bool) -> (Array2<f64>, RunOut) {
    let (n1, n2) = heights.dim();
    let weights = [window.weights(n1), window.weights(n2)];
    let fitted = MeanPlane::fit(heights.view(), &weights);
    let plane = if level { fitted } else { MeanPlane { slopes: [0.0; 2], ..fitted } };
    let kept = if level { 0.0 } else { plane.mean };
    for ((i, j), height) in heights.indexed_iter_mut() {
        *height -= plane.at([i, j]);
    }
    let depth = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max)
        - heights.iter().copied().fold(f64::INFINITY, f64::min);
    for ((i, j), height) in heights.indexed_iter_mut() {
        let weight = weights[0][i] * weights[1][j];
        *height = kept + weight * *height - depth * (1.0 - weight);
    }
    (heights, RunOut { window, depth, points: [n1, n2] })
}

#[cfg(test)]
mod tests {
    use super::super::border_jumps;
    use super::*;

    /// A tilted surface that is not periodic.
    fn surface() -> Array2<f64> {
        Array2::from_shape_fn((40, 30), |(i, j)| {
            let (x, y) = (i as f64 / 40.0, j as f64 / 30.0);
            5.0 + 3.0 * x - 2.0 * y + (7.0 * x + 1.0).sin() * (5.0 * y).cos() + (9.3 * x * y).sin()
        })
    }

    #[test]
    fn a_tapered_surface_is_periodic_and_keeps_its_mean_plane_but_for_its_run_out() {
        for window in [Window::Hann, Window::Tukey] {
            let (level, run_out) = tapered(surface(), window, true);
            assert!(border_jumps(surface().view()).iter().all(|jump| *jump > 3.0));
            assert!(border_jumps(level.view()).iter().all(|jump| *jump < 1.0));
            let uniform = [vec![1.0; 40], vec![1.0; 30]];
            let MeanPlane { mean, slopes, .. } = MeanPlane::fit(run_out.undone(level).view(), &uniform);
            assert!(mean.abs() < 1e-12 && slopes.iter().all(|slope| slope.abs() < 1e-12), "{mean} {slopes:?}");
            let weights = [window.weights(40), window.weights(30)];
            let kept = MeanPlane::fit(surface().view(), &weights).mean;
            let (heights, run_out) = tapered(surface(), window, false);
            assert!((run_out.undone(heights).mean().unwrap() - kept).abs() < 1e-12);
        }
    }

    #[test]
    fn the_border_lies_below_every_height_and_the_middle_is_left_as_it_is() {
        for window in [Window::Hann, Window::Tukey] {
            let (heights, run_out) = tapered(surface(), window, false);
            let lowest = surface().iter().copied().fold(f64::INFINITY, f64::min);
            let border = [heights.row(0), heights.row(39), heights.column(0), heights.column(29)];
            let highest = border.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
            assert!(highest < lowest, "{window:?}");
            let place = |(i, j): (usize, usize)| [i as f64 / 40.0, j as f64 / 30.0];
            let same = |(at, height): ((usize, usize), &f64)| (height - surface()[at]).abs() < 1e-12;
            assert!(heights.indexed_iter().all(|sample| run_out.is_tapered(place(sample.0)) || same(sample)));
            let whole = heights.indexed_iter().filter(|sample| !run_out.is_tapered(place(sample.0))).count();
            assert_eq!(whole, if window == Window::Tukey { 32 * 24 } else { 0 });
        }
    }

    #[test]
    fn weights_are_symmetric_and_tukeys_are_one_between_its_ends() {
        for window in [Window::Hann, Window::Tukey] {
            let weights = window.weights(50);
            assert!((0..50).all(|k| (weights[k] - weights[49 - k]).abs() < 1e-15 && weights[k] > 0.0));
        }
        assert!(Window::Tukey.weights(50)[5..45].iter().all(|weight| *weight == 1.0));
        // w = sin²(πu) sums to half the samples.
        assert!((Window::Hann.weights(50).iter().sum::<f64>() - 25.0).abs() < 1e-13);
    }
}
