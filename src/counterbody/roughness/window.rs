//! Tapers that make a surface periodic which is not.
//!
//! h ← P + w₁(i) w₂(j) (h − P), with the weights at the N samples of a direction at u = (k + ½)/N:
//!
//! - Hann: w = sin²(πu);
//! - Tukey: w = sin²(πu/2a) within a = 1/10 of either end, 1 between them.
//!
//! P is the plane, or the mean, that fits the surface best in squares weighted by w₁w₂. Then w₁w₂(h − P) has no mean and no
//! slope: the mean plane of the tapered surface is P.

use super::plane::Plane;
use ndarray::Array2;
use std::f64::consts::{FRAC_PI_2, PI};

/// A taper along either direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "lowercase"))]
pub enum Window {
    /// Over the whole length.
    Hann,
    /// Over a tenth of the length at either end.
    Tukey,
}

/// Part of the length over which Tukey's window rises.
const RISE: f64 = 0.1;

impl Window {
    /// Its name in a case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hann => "hann",
            Self::Tukey => "tukey",
        }
    }

    /// The weights at `n` samples, between 0 and 1.
    pub fn weights(self, n: usize) -> Vec<f64> {
        let weight = |k: usize| {
            let u = (k as f64 + 0.5) / n as f64;
            let to_end = u.min(1.0 - u);
            match self {
                Self::Hann => (PI * to_end).sin().powi(2),
                Self::Tukey if to_end < RISE => (FRAC_PI_2 * to_end / RISE).sin().powi(2),
                Self::Tukey => 1.0,
            }
        };
        (0..n).map(weight).collect()
    }
}

/// Heights drawn toward their mean at the border; with `level` toward their mean plane, which is then taken away.
pub fn tapered(mut heights: Array2<f64>, window: Window, level: bool) -> Array2<f64> {
    let (n1, n2) = heights.dim();
    let weights = [window.weights(n1), window.weights(n2)];
    let fitted = Plane::fit(heights.view(), &weights);
    let plane = if level { fitted } else { Plane { slopes: [0.0; 2], ..fitted } };
    let kept = if level { 0.0 } else { plane.mean };
    for ((i, j), height) in heights.indexed_iter_mut() {
        *height = kept + weights[0][i] * weights[1][j] * (*height - plane.at([i, j]));
    }
    heights
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
    fn a_tapered_surface_is_periodic_and_keeps_its_mean_plane() {
        for window in [Window::Hann, Window::Tukey] {
            let level = tapered(surface(), window, true);
            let uniform = [vec![1.0; 40], vec![1.0; 30]];
            let Plane { mean, slopes, .. } = Plane::fit(level.view(), &uniform);
            assert!(mean.abs() < 1e-13 && slopes.iter().all(|slope| slope.abs() < 1e-13), "{mean} {slopes:?}");
            assert!(border_jumps(surface().view()).iter().all(|jump| *jump > 3.0));
            assert!(border_jumps(level.view()).iter().all(|jump| *jump < 1.0));
            let weights = [window.weights(40), window.weights(30)];
            let kept = Plane::fit(surface().view(), &weights).mean;
            let own = tapered(surface(), window, false);
            assert!((own.mean().unwrap() - kept).abs() < 1e-13);
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
