//! The apex of a topography: the highest point of the sum of waves through its samples.
//!
//! h(s, t) = h̄ + Σ ĥ_κ e^{2πi(κ₁s + κ₂t)}, s and t fractions of **a**₁ and **a**₂, is defined between the samples. Newton's method
//! starts from the highest of the samples that at most one of their eight neighbours exceeds, and from those that are highest by
//! the paraboloid through the nine: with waves down to two samples the highest hill may have lower samples than others,
//! and none that exceeds all its neighbours. All starts iterate together: each round takes one sum over the waves.
//! Where −∇∇h is not positive definite, as along a ridge, its absolute value is used; no step is longer than a spacing,
//! and a step that leads down is repeated with a quarter of its length. A start is dropped when it would stay below the
//! best one even if it rose by many times what its paraboloid predicts.
//!
//! Contact begins at the apex, on every grid that holds the waves: the highest sample lies below it by up to the square of a spacing
//! times half the curvature.

use super::Spectrum;
use super::jet::{Jet, WaveRows};
use crate::lattice::{Cell, LatticeError};
use crate::numeric::paraboloid;
use crate::numeric::{parallel, sums};
use ndarray::ArrayView2;

/// Largest number of starts, by either measure.
const MAX_STARTS: usize = 32;
/// Largest number of rounds of Newton's method.
const MAX_ROUNDS: usize = 24;
/// Rise above the highest sample that is rounding, over the range of the heights.
const ROUNDING: f64 = 1e-13;
/// Curvature that counts as zero, over the largest curvature.
const FLAT_CURVATURE: f64 = 1e-10;
/// Largest rise of a climber that is allowed for, over the rise that its paraboloid predicts. Of twelve thousand random surfaces,
/// rough down to two samples, a value of 1 lost two apexes and 2 none; eight times that costs little.
const RISE_ALLOWANCE: f64 = 16.0;

/// A climber: one iteration of Newton's method.
#[derive(Debug, Clone, Copy)]
struct Climber {
    place: [f64; 2],
    jet: Jet,
    /// Next step; `None` once the climber has converged or is dropped.
    step: Option<NewtonStep>,
}

/// A step of Newton's method.
#[derive(Debug, Clone, Copy)]
struct NewtonStep {
    /// Step in fractions of a₁ and a₂.
    along: [f64; 2],
    /// Predicted rise, a length: to the top of the paraboloid, or to its highest point within a spacing where the top is farther.
    gain: f64,
}

/// Height of the apex of the surface with these `heights` at the samples of a cell, a length.
///
/// # Errors
/// [`LatticeError`] when there are none.
pub(crate) fn apex(cell: Cell, heights: ArrayView2<'_, f64>) -> Result<f64, LatticeError> {
    apex_within(&Spectrum::of(cell, heights)?, heights, RISE_ALLOWANCE)
}

/// Height of the apex of the surface with this `spectrum`, a length; `heights` are its samples.
pub(crate) fn apex_by(spectrum: &Spectrum, heights: ArrayView2<'_, f64>) -> Result<f64, LatticeError> {
    apex_within(spectrum, heights, RISE_ALLOWANCE)
}

/// Height of the apex, a length, where a climber may rise by up to `allowance` times the predicted rise.
fn apex_within(spectrum: &Spectrum, heights: ArrayView2<'_, f64>, allowance: f64) -> Result<f64, LatticeError> {
    let grid = spectrum.grid();
    let heights = heights.as_standard_layout();
    let heights = heights.as_slice().expect("in standard layout");
    let [lowest, highest] = [1.0, -1.0].map(|sign| sign * sums::least(heights.len(), |i| sign * heights[i]));
    let enough = ROUNDING * (highest - lowest);
    let places: Vec<[f64; 2]> = starts(grid.points(), heights).into_iter().map(|index| grid.fractions(index)).collect();
    let points = grid.points().map(|n| n as f64);
    let waves = WaveRows::of(spectrum);
    let mut climbers: Vec<Climber> = waves
        .jets(&places)
        .into_iter()
        .zip(places)
        .map(|(jet, place)| Climber { place, jet, step: upward(&jet, points, enough) })
        .collect();
    for _ in 0..MAX_ROUNDS {
        let best = climbers.iter().map(|climber| climber.jet.height).fold(f64::NEG_INFINITY, f64::max);
        for climber in &mut climbers {
            climber.step = climber.step.filter(|step| climber.jet.height + allowance * step.gain > best);
        }
        let goals: Vec<[f64; 2]> = climbers.iter().filter_map(Climber::goal).collect();
        if goals.is_empty() {
            break;
        }
        let under_way = climbers.iter_mut().filter(|climber| climber.step.is_some());
        for (climber, (jet, place)) in under_way.zip(waves.jets(&goals).into_iter().zip(goals)) {
            climber.step = if jet.height >= climber.jet.height {
                (climber.place, climber.jet) = (place, jet);
                upward(&jet, points, enough)
            } else {
                // Converged where the predicted rise is rounding.
                let shorter = climber.step.map(|step| NewtonStep { along: step.along.map(|x| 0.25 * x), ..step });
                shorter.filter(|step| climber.jet.rise(step.along) > enough)
            };
        }
    }
    let rise = climbers.iter().map(|climber| spectrum.common() + climber.jet.height - highest).fold(0.0, f64::max);
    Ok(if rise > enough && rise.is_finite() { highest + rise } else { highest })
}

/// Flat indices of the starts: the highest of the samples that at most one of their eight neighbours exceeds, by their heights and
/// by the paraboloids around them.
fn starts([n1, n2]: [usize; 2], heights: &[f64]) -> Vec<usize> {
    let next = |k: usize, n: usize| [if k == 0 { n - 1 } else { k - 1 }, k, if k + 1 == n { 0 } else { k + 1 }];
    let around = |i: usize, j: usize| next(i, n1).map(|row| next(j, n2).map(|column| heights[row * n2 + column]));
    let is_high = |i: usize, j: usize| {
        let height = heights[i * n2 + j];
        around(i, j).as_flattened().iter().filter(|other| **other > height).count() <= 1
    };
    let of_row = |i: usize| -> Vec<(f64, usize)> {
        (0..n2).filter(|&j| is_high(i, j)).map(|j| (heights[i * n2 + j], i * n2 + j)).collect()
    };
    let mut high = parallel::map(n1, of_row).concat();
    let samples = highest(&mut high).to_vec();
    let enough = samples.iter().map(|(height, _)| *height).fold(f64::INFINITY, f64::min);
    let lifted = |&(height, index): &(f64, usize)| {
        let nine = around(index / n2, index % n2);
        let (low, top) = nine.as_flattened().iter().fold((height, height), |(a, b), x| (a.min(*x), b.max(*x)));
        // Within a spacing the paraboloid rises by less than half of the range of the nine values, which are made positive.
        let above = |i: i32, j: i32| nine[(i + 1) as usize][(j + 1) as usize] - (2.0 * low - top);
        let hopeful = height + 0.5 * (top - low) >= enough;
        hopeful.then(|| (height + paraboloid::rise(1, above).unwrap_or(0.0), index))
    };
    let mut lifted: Vec<(f64, usize)> = parallel::map_items(&high, lifted).into_iter().flatten().collect();
    let mut starts: Vec<usize> = samples.iter().chain(highest(&mut lifted)).map(|(_, index)| *index).collect();
    starts.sort_unstable();
    starts.dedup();
    starts
}

/// The highest of some samples in any order; of equally high ones those of the lowest indices.
fn highest(samples: &mut [(f64, usize)]) -> &[(f64, usize)] {
    let count = samples.len().min(MAX_STARTS);
    if count < samples.len() {
        samples.select_nth_unstable_by(count - 1, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    }
    &samples[..count]
}

impl Climber {
    fn goal(&self) -> Option<[f64; 2]> {
        self.step.map(|step| [0, 1].map(|k| self.place[k] + step.along[k]))
    }
}

/// The next step; `None` where the predicted rise is less than `enough`.
fn upward(jet: &Jet, [n1, n2]: [f64; 2], enough: f64) -> Option<NewtonStep> {
    // In units of the spacings; the longest step is 1.
    let [g1, g2] = [jet.slope[0] / n1, jet.slope[1] / n2];
    let [h11, h12, h22] = [jet.curvature[0] / (n1 * n1), jet.curvature[1] / (n1 * n2), jet.curvature[2] / (n2 * n2)];
    let (mean, half) = (0.5 * (h11 + h22), 0.5 * (h11 - h22));
    let radius = half.hypot(h12);
    let largest = mean.abs() + radius;
    // Directions of the principal curvatures.
    let angle = 0.5 * h12.atan2(half);
    let axes = [([angle.cos(), angle.sin()], mean + radius), ([-angle.sin(), angle.cos()], mean - radius)];
    let mut step = [0.0; 2];
    for ([x, y], curvature) in axes {
        let slope = g1 * x + g2 * y;
        if curvature.abs() > FLAT_CURVATURE * largest {
            let length = slope / curvature.abs();
            step = [step[0] + length * x, step[1] + length * y];
        }
    }
    let length = step[0].hypot(step[1]);
    let part = if length > 1.0 { 1.0 / length } else { 1.0 };
    let rise = part * (g1 * step[0] + g2 * step[1]);
    let has_top = mean + radius < 0.0 && length <= 1.0;
    let gain = if has_top { 0.5 * rise } else { g1.hypot(g2) + 0.5 * (mean + radius).max(0.0) };
    (rise > enough).then_some(NewtonStep { along: [part * step[0] / n1, part * step[1] / n2], gain })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counterbody::roughness::{Rms, SelfAffine};
    use ndarray::Array2;
    use std::f64::consts::TAU;

    /// Waves κ of amplitude and phase.
    fn sampled(waves: &[([f64; 2], f64, f64)], [n1, n2]: [usize; 2]) -> Array2<f64> {
        Array2::from_shape_fn((n1, n2), |(i, j)| height(waves, [i as f64 / n1 as f64, j as f64 / n2 as f64]))
    }

    fn height(waves: &[([f64; 2], f64, f64)], [s, t]: [f64; 2]) -> f64 {
        waves.iter().map(|([k1, k2], size, phase)| size * (TAU * (k1 * s + k2 * t) + phase).cos()).sum()
    }

    fn apex_of(cell: Cell, heights: &Array2<f64>) -> f64 {
        apex(cell, heights.view()).unwrap()
    }

    fn cells() -> [Cell; 3] {
        [Cell::square(2.0), Cell::hexagonal(1.5), Cell::new([1.0, 0.1], [-0.3, 1.4])].map(Result::unwrap)
    }

    /// Surfaces of many hills, against a fine mesh of places and a paraboloid through the best of them.
    #[test]
    fn the_apex_is_the_highest_place_of_the_sum_of_waves_on_any_grid() {
        let waves = [
            ([1.0, 2.0], 1.0, 0.3),
            ([-2.0, 1.0], 0.5, 1.1),
            ([3.0, 0.0], 0.2, -0.4),
            ([0.0, 3.0], 0.3, 2.0),
            ([2.0, 3.0], 0.4, 0.9),
        ];
        let fine = 1500;
        let places = (0..fine * fine).map(|k| [(k / fine) as f64 / fine as f64, (k % fine) as f64 / fine as f64]);
        let mut best = places.max_by(|a, b| height(&waves, *a).total_cmp(&height(&waves, *b))).unwrap();
        for level in 1..24 {
            let h = 0.5f64.powi(level) / fine as f64;
            let around = (0..9).map(|k| [best[0] + h * f64::from(k / 3 - 1), best[1] + h * f64::from(k % 3 - 1)]);
            best = around.max_by(|a, b| height(&waves, *a).total_cmp(&height(&waves, *b))).unwrap();
        }
        let exact = height(&waves, best);
        for cell in cells() {
            for points in [[9, 8], [10, 14], [24, 24], [31, 64]] {
                let heights = sampled(&waves, points);
                let found = apex_of(cell, &heights);
                let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                assert!(
                    (found - exact).abs() < 1e-12 && found > highest + 1e-4,
                    "{points:?}: {found} {exact} {highest}"
                );
            }
        }
    }

    /// Random surfaces with waves down to two and three samples, whose highest place need not lie beside the highest sample;
    /// exactly from the same waves on five times the points.
    #[test]
    fn surfaces_rough_down_to_the_grid_have_the_apex_of_finer_grids() {
        for (number, (seed, n)) in (1..=20).flat_map(|seed| [24, 60].map(|n| (seed, n))).enumerate() {
            let cell = cells()[number % 3];
            let (hurst, shortest) = ([0.2, 0.5, 0.8][number % 3], [2.0, 2.5, 3.0, 4.0][number % 4] / n as f64);
            let surface =
                SelfAffine { hurst, longest: 0.5, rolloff: 0.5, shortest: 1.5 * shortest, rms: Rms::Slope(0.1), seed };
            let heights = surface.heights(cell, [n; 2]).unwrap();
            let finer = Spectrum::of(cell, heights.view()).unwrap().resampled([5 * n; 2]).unwrap();
            let range = heights.iter().copied().fold(0.0, f64::max) - heights.iter().copied().fold(0.0, f64::min);
            let (found, exact) = (apex_of(cell, &heights), apex_of(cell, &finer));
            assert!((found - exact).abs() < 1e-9 * range, "{n}, {seed}: {found} {exact}");
        }
    }

    /// Surfaces whose highest hill has no high sample that exceeds all eight around; exactly from five times the points.
    #[test]
    fn a_hill_between_samples_is_found_from_a_sample_that_one_exceeds() {
        for (hurst, seed) in [(0.0, 151), (0.0, 295), (0.4, 170), (0.8, 41), (0.8, 217)] {
            let (cell, n) = (cells()[seed as usize % 3], 24);
            let surface =
                SelfAffine { hurst, longest: 0.5, rolloff: 0.5, shortest: 2.0 / n as f64, rms: Rms::Slope(0.1), seed };
            let heights = surface.heights(cell, [n; 2]).unwrap();
            let finer = Spectrum::of(cell, heights.view()).unwrap().resampled([5 * n; 2]).unwrap();
            let (found, exact) = (apex_of(cell, &heights), apex_of(cell, &finer));
            assert!((found / exact - 1.0).abs() < 1e-9, "{seed}: {found} {exact}");
        }
    }

    /// Against all that climb to the end.
    #[test]
    fn climbers_that_are_dropped_do_not_lose_the_apex() {
        for seed in 1..=200 {
            let (cell, n) = (cells()[seed as usize % 3], [16, 25, 48][seed as usize / 3 % 3]);
            let (hurst, shortest) = ([0.0, 0.4, 0.8][seed as usize / 9 % 3], [2.0, 2.5, 3.0][seed as usize / 27 % 3]);
            let shortest = shortest / n as f64;
            let surface = SelfAffine { hurst, longest: 0.5, rolloff: 0.5, shortest, rms: Rms::Slope(0.1), seed };
            let heights = surface.heights(cell, [n; 2]).unwrap();
            let range = heights.iter().copied().fold(0.0, f64::max) - heights.iter().copied().fold(0.0, f64::min);
            let (found, all) = (
                apex_of(cell, &heights),
                apex_within(&Spectrum::of(cell, heights.view()).unwrap(), heights.view(), f64::INFINITY).unwrap(),
            );
            assert!((found - all).abs() < 1e-12 * range, "{n}, {seed}: {found} {all}");
        }
    }

    #[test]
    fn a_crest_along_a_line_a_plane_and_an_apex_on_a_sample_are_exact() {
        let cell = Cell::square(1.0).unwrap();
        let ridge = sampled(&[([1.0, 0.0], 0.7, 0.123)], [16, 12]);
        assert!((apex_of(cell, &ridge) - 0.7).abs() < 1e-14);
        let oblique = sampled(&[([1.0, -2.0], 0.7, 0.123)], [16, 12]);
        assert!((apex_of(cell, &oblique) - 0.7).abs() < 1e-14);
        assert_eq!(apex_of(cell, &Array2::from_elem((6, 5), 3.25)), 3.25);
        let crest = sampled(&[([1.0, 0.0], 1.0, 0.0), ([0.0, 1.0], 1.0, 0.0)], [16, 16]);
        assert_eq!(apex_of(cell, &crest), 2.0);
    }
}
