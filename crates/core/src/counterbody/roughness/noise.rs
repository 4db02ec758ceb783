//! Noise at the short-wave end of a spectrum.
//!
//! Over the last octave q_m/2 … q_m of the wavenumbers that are not aliased in any direction, the density is C(q) ∝ q^β:
//!
//! - self-affine roughness: β = −2 − 2H, between −2 and −4 for a Hurst exponent 0 ≤ H ≤ 1. Sampled down to the distance d of the points,
//!   a wave of q counts as one of 2π/d − q: at q_m as much again, at q_m/2 a part 3^β for either direction, which raises β by 1 at most;
//! - noise of the instrument, independent from sample to sample: β = 0.
//!
//! β > −½, half way, is noise. The mean of |ĥ|² over W waves, W/2 of them independent, scatters by √(2/W): the octave must hold waves
//! enough for a standard error of β of a sixth, 3 standard errors of the half. Where its parts differ by more than white or rising noise
//! does, single waves are there; and noise that has less than a hundredth of the mean square slope is of no account.

use super::Spectrum;

/// Parts of the octave, equal in the logarithm.
const PARTS: usize = 4;
/// Least exponent β of noise.
const LEAST: f64 = -0.5;
/// Largest standard error of β.
const ERROR: f64 = 1.0 / 6.0;
/// Largest quotient of the densities of the parts: that of β = 4, twice differentiated noise.
const QUOTIENT: f64 = 16.0;
/// Least part of the mean square slope.
const SHARE: f64 = 0.01;

/// Noise at the short-wave end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Wavenumber from which on the density does not fall, 1/length.
    pub from: f64,
    /// Exponent β of the density over the octave from there.
    pub exponent: f64,
    /// Part of the mean square slope from there on, between 0 and 1.
    pub share: f64,
}

/// Noise at the short-wave end of a spectrum; `None` where its density falls as that of a rough surface.
pub fn short_wave_noise(spectrum: &Spectrum) -> Option<Noise> {
    let from = 0.5 * spectrum.grid().least_aliased();
    /// Places of Σ q²|ĥ|² of the octave and of all waves, after number, Σ |ĥ|² and Σ ln q of the waves of each part.
    const OCTAVE: usize = 3 * PARTS;
    const ALL: usize = OCTAVE + 1;
    let sums: [f64; ALL + 1] = spectrum.sums(|sums, (q, square, waves)| {
        sums[ALL] += q * q * square;
        if q < from {
            return;
        }
        sums[OCTAVE] += q * q * square;
        let part = (PARTS as f64 * (q / from).log2()) as usize;
        if part < PARTS {
            let of_wave = [waves, square, waves * (q / from).ln()];
            sums[3 * part..][..3].iter_mut().zip(of_wave).for_each(|(sum, term)| *sum += term);
        }
    });
    let parts: [[f64; 3]; PARTS] = std::array::from_fn(|part| std::array::from_fn(|k| sums[3 * part + k]));
    let [slopes, all] = [sums[OCTAVE], sums[ALL]];
    let share = slopes / all;
    let densities = parts.map(|[waves, square, _]| square / waves);
    let (least, most) =
        densities.iter().fold((f64::INFINITY, 0.0f64), |(least, most), c| (least.min(*c), most.max(*c)));
    let total: f64 = parts.iter().map(|[waves, ..]| waves).sum();
    let place = parts.map(|[waves, _, logs]| logs / waves);
    let mean = parts.iter().map(|[_, _, logs]| logs).sum::<f64>() / total;
    let spread: f64 = parts.iter().zip(place).map(|([waves, ..], x)| waves * (x - mean).powi(2)).sum();
    let rise: f64 = (0..PARTS).map(|k| parts[k][0] * (place[k] - mean) * densities[k].ln()).sum();
    let exponent = rise / spread;
    let is_known = (2.0 / spread).sqrt() <= ERROR && least > 0.0 && most <= QUOTIENT * least;
    (is_known && exponent > LEAST && share >= SHARE).then_some(Noise { from, exponent, share })
}

#[cfg(test)]
mod tests {
    use super::super::{Rms, SelfAffine};
    use super::*;
    use crate::lattice::Cell;
    use ndarray::Array2;

    fn noise(heights: &Array2<f64>) -> Option<Noise> {
        short_wave_noise(&Spectrum::of(Cell::square(1.0).unwrap(), heights.view()).unwrap())
    }

    /// Numbers between −½ and ½ without correlation.
    fn white(points: usize, seed: u64) -> Array2<f64> {
        let mut state = seed;
        Array2::from_shape_simple_fn((points, points), || {
            // splitmix64.
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            (mixed ^ (mixed >> 31)) as f64 / u64::MAX as f64 - 0.5
        })
    }

    /// A self-affine surface on every second sample of a grid that resolves it: down to the distance of samples, with aliases.
    fn sampled(hurst: f64, points: usize, every: usize, seed: u64) -> Array2<f64> {
        let cell = Cell::square(1.0).unwrap();
        let shortest = 2.0 / (every * points) as f64 * 1.01;
        let surface = SelfAffine { hurst, longest: 1.0, rolloff: 0.5, shortest, rms: Rms::Height(1.0), seed };
        let fine = surface.spectrum(cell, [every * points; 2]).unwrap().into_heights();
        Array2::from_shape_fn((points, points), |(i, j)| fine[[every * i, every * j]])
    }

    #[test]
    fn self_affine_surfaces_down_to_their_samples_are_no_noise_and_instruments_noise_is() {
        for seed in 0..6 {
            // Noise of a density some ten times that of the surface where the last octave begins.
            for (hurst, amplitude) in [(0.01, 10.0), (0.3, 10.0), (0.8, 3.0), (1.0, 3.0)] {
                for every in [1, 2, 4] {
                    let found = noise(&sampled(hurst, 96, every, seed));
                    assert_eq!(found, None, "H = {hurst}, every {every}, seed {seed}");
                }
                let noisy = sampled(hurst, 96, 1, seed) + amplitude * white(96, seed);
                let found = noise(&noisy).unwrap_or_else(|| panic!("H = {hurst}, seed {seed}"));
                assert!(found.exponent.abs() < 0.5 && found.share > 0.3, "{found:?}");
            }
            assert!(noise(&white(64, seed)).is_some());
        }
    }

    #[test]
    fn flat_and_smooth_surfaces_and_single_waves_have_no_noise() {
        let wave = |k: f64, n: usize| {
            Array2::from_shape_fn((n, n), |(i, j)| (std::f64::consts::TAU * (k * i as f64 + j as f64) / n as f64).cos())
        };
        assert_eq!(noise(&Array2::zeros((64, 64))), None);
        assert_eq!(noise(&wave(3.0, 64)), None);
        assert_eq!(noise(&(wave(25.0, 64) + wave(2.0, 64))), None);
        // Too few waves to tell.
        assert_eq!(noise(&white(16, 1)), None);
    }
}
