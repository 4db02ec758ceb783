//! Waves of any frequency, summed at equally spaced points: the non-uniform transform of type 1, by Gaussian gridding
//! (Dutt & Rokhlin 1993, Greengard & Lee 2004).
//!
//! For F_j = Σ c e^{2πi xj/M}, x any numbers, each c is spread over the neighbours m of its x with the weights
//! e^{−b(x−m)²}; the transform of the sums on the M numbers m, divided by that of the Gaussian, is F. With W neighbours on each
//! side and |j| ≤ P/2 the Gaussian is cut off at e^{−bW²}, and the aliases on the M numbers are of the order
//! e^{−π²(1−P/M)/b}: both are equal for b = (π/W)√(1−P/M), 10⁻¹⁴ for W = 12 and M = 4P.

use crate::numeric::lanes::{LANES, vectorised};
use fearless_simd::{f64x8, prelude::*};
use percoat_fft::FftDirection;
use rustfft::num_complex::Complex64;
use std::f64::consts::PI;

/// Neighbours on each side, W.
const SIDE: usize = 12;
/// Groups of eight neighbours on both sides.
const GROUPS: usize = 2 * SIDE / LANES;
/// Oversampling M/P.
const OVERSAMPLING: usize = 4;

/// Sums of waves at equally spaced points, K at a time.
pub struct Nonuniform<const K: usize> {
    /// Number of points, P.
    points: usize,
    /// M.
    numbers: usize,
    /// b.
    decay: f64,
    /// e^{−bl²}, −W < l ≤ W.
    gaussian: [f64; 2 * SIDE],
    /// Sums on the numbers −W ≤ m < M + W: K real and K imaginary parts.
    gathered: Vec<f64>,
}

impl<const K: usize> Nonuniform<K> {
    /// No waves yet, at a number of points; the one with the index `points`/2 is the origin.
    pub fn new(points: usize) -> Self {
        let numbers = super::fast_points((OVERSAMPLING * points).max(2 * SIDE));
        let decay = PI / SIDE as f64 * (1.0 - points as f64 / numbers as f64).sqrt();
        let gaussian = std::array::from_fn(|k| {
            let l = k as f64 - (SIDE - 1) as f64;
            (-decay * l * l).exp()
        });
        Self { points, numbers, decay, gaussian, gathered: vec![0.0; 2 * K * (numbers + 2 * SIDE)] }
    }

    /// Adds waves c e^{2πi νj}, given as ν and c.
    pub fn add(&mut self, waves: impl Iterator<Item = (f64, [Complex64; K])>) {
        vectorised!(simd => gather(simd, self, waves));
    }

    /// The real parts of the sums at the points.
    pub fn real_parts(self) -> Vec<[f64; K]> {
        let Self { points, numbers, decay, ref gathered, .. } = self;
        let fft = percoat_fft::complex(numbers, FftDirection::Inverse);
        let restored = |point: usize| {
            let damping = PI * (point as f64 - (points / 2) as f64) / numbers as f64;
            (decay / PI).sqrt() * (damping * damping / decay).exp()
        };
        let restored: Vec<f64> = (0..points).map(restored).collect();
        let mut results = vec![[0.0; K]; points];
        let mut line = vec![Complex64::default(); numbers];
        let mut scratch = vec![Complex64::default(); fft.get_inplace_scratch_len()];
        let (re, im) = gathered.split_at(gathered.len() / 2);
        let size = numbers + 2 * SIDE;
        for (k, (re, im)) in re.chunks_exact(size).zip(im.chunks_exact(size)).enumerate() {
            line.fill(Complex64::default());
            for (place, (&re, &im)) in re.iter().zip(im).enumerate() {
                line[(place + numbers - SIDE) % numbers] += Complex64::new(re, im);
            }
            fft.process_with_scratch(&mut line, &mut scratch);
            for (point, (result, restored)) in results.iter_mut().zip(&restored).enumerate() {
                result[k] = restored * line[(point + numbers - points / 2) % numbers].re;
            }
        }
        results
    }
}

/// Spreads each wave over its neighbours, with e^{−b(f−l)²} = e^{−bf²} e^{2bfl} e^{−bl²}, f the fraction of its x.
#[inline(always)]
fn gather<S: Simd, const K: usize>(
    simd: S,
    sums: &mut Nonuniform<K>,
    waves: impl Iterator<Item = (f64, [Complex64; K])>,
) {
    let size = sums.numbers + 2 * SIDE;
    let (mut gaussian, mut weights) = ([f64x8::splat(simd, 0.0); GROUPS], [f64x8::splat(simd, 0.0); GROUPS]);
    for group in 0..GROUPS {
        gaussian[group] = f64x8::from_slice(simd, &sums.gaussian[group * LANES..][..LANES]);
    }
    for (frequency, c) in waves {
        // A frequency slightly below zero may be rounded to 1.
        let x = (frequency - frequency.floor()) * sums.numbers as f64;
        let number = (x as usize).min(sums.numbers - 1);
        let f = x - number as f64;
        let (first, g1) = ((-sums.decay * f * f).exp(), (2.0 * sums.decay * f).exp());
        let (g2, g3) = (g1 * g1, g1 * g1 * g1);
        let (g4, g8) = (g2 * g2, g2 * g2 * g2 * g2);
        let powers = f64x8::from_slice(simd, &[1.0, g1, g2, g3, g4, g4 * g1, g4 * g2, g4 * g3]);
        let mut power = first / (g8 * g3);
        for group in 0..GROUPS {
            weights[group] = powers * gaussian[group] * power;
            power *= g8;
        }
        for (k, c) in c.iter().enumerate() {
            for (part, value) in [(k, c.re), (K + k, c.im)] {
                let neighbours = &mut sums.gathered[part * size + number + 1..][..2 * SIDE];
                let value = f64x8::splat(simd, value);
                for group in 0..GROUPS {
                    let lanes = &mut neighbours[group * LANES..][..LANES];
                    weights[group].mul_add(value, f64x8::from_slice(simd, lanes)).store_slice(lanes);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn frequencies_a_hair_beside_whole_ones_are_those() {
        let sum = |turns: f64| {
            let mut sums = Nonuniform::new(60);
            sums.add([(turns, [Complex64::new(0.6, 0.8)])].into_iter());
            sums.real_parts()
        };
        // The error is that of the test below.
        let error = 1.4e-14 + PI * 60.0 * f64::EPSILON / 2.0;
        for turns in [0.0, -0.0, -1e-17, -f64::EPSILON / 4.0, 1.0 - f64::EPSILON / 2.0, 3.0, -2.0] {
            assert!(sum(turns).iter().all(|[value]| (value - 0.6).abs() < error), "{turns:e}");
        }
    }

    #[test]
    fn sums_of_waves_are_those_term_by_term() {
        for points in [1, 2, 17, 60, 401] {
            // Frequencies of few digits, whose phases the direct sum has without rounding.
            let part = |k: i32, seed: i32| f64::from((k * k * 31 + k * seed) % 4099) / 1024.0 - 2.0;
            let complex = |k: i32, seed: i32| Complex64::new(part(k, seed), part(k, 2 * seed));
            let waves: Vec<(f64, [Complex64; 2])> =
                (0..300).map(|k| (part(k, 5), [complex(k, 3), complex(k, 7)])).collect();
            let mut sums = Nonuniform::new(points);
            sums.add(waves.iter().copied());
            for (point, sum) in sums.real_parts().into_iter().enumerate() {
                let j = point as f64 - (points / 2) as f64;
                for k in 0..2 {
                    let term =
                        |(turns, c): &(f64, [Complex64; 2])| (c[k] * Complex64::cis(TAU * (turns * j).fract())).re;
                    let exact: f64 = waves.iter().map(term).sum();
                    // The cut-off, the aliases, and x rounded to 2⁻⁵³ of M.
                    let scale: f64 = waves.iter().map(|(_, c)| c[k].norm()).sum();
                    let error = scale * (1.4e-14 + PI * points as f64 * f64::EPSILON / 2.0);
                    assert!((sum[k] - exact).abs() < error, "{points} {point}: {} {exact}", sum[k]);
                }
            }
        }
    }
}
