//! Self-affine surfaces h(x) = c Σ k^{−(1+H)} cos(2π **k**·**x** + φ_**k**), one wave for each pair ±**k** of integers
//! with `lowest` ≤ k ≤ `highest`; H = 0.8 (power spectrum ∝ k^{−2(1+H)}).
//!
//! Phases are a hash of the seed and **k**: a wave has the same phase on every grid. The factor c makes the rms slope 1,
//! ⟨|∇h|²⟩ = ½ c² Σ (2πk)² k^{−2(1+H)}.

use ndarray::Array2;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

const HURST: f64 = 0.8;
const SEED: u64 = 2019;

/// The band of a rough surface, waves per cell.
#[derive(Debug, Clone, Copy)]
pub struct Rough {
    lowest: f64,
    highest: f64,
}

impl Rough {
    /// From 4 to 64 waves per cell.
    pub fn band() -> Self {
        Self { lowest: 4.0, highest: 64.0 }
    }

    /// From 4 waves per cell to all that n points hold.
    pub fn down_to_grid(n: usize) -> Self {
        Self { lowest: 4.0, highest: (n / 2 - 1) as f64 }
    }

    /// Heights on n × n samples of the unit square.
    pub fn heights(self, n: usize) -> Array2<f64> {
        let reach = self.highest as i64;
        assert!(reach < n as i64 / 2, "{n} points do not hold {reach} waves");
        let index = |k: i64| k.rem_euclid(n as i64) as usize;
        let mut spectrum = vec![Complex64::default(); n * n];
        let mut slope = 0.0;
        for k1 in -reach..=reach {
            for k2 in 0..=reach {
                let k = (k1 as f64).hypot(k2 as f64);
                if (k2 > 0 || k1 > 0) && (self.lowest..=self.highest).contains(&k) {
                    let size = k.powf(-1.0 - HURST);
                    slope += 0.5 * (TAU * k * size).powi(2);
                    spectrum[index(k1) * n + index(k2)] = Complex64::from_polar(size, TAU * phase(k1, k2));
                }
            }
        }
        let transform = FftPlanner::new().plan_fft_inverse(n);
        transform.process(&mut spectrum);
        let mut columns = transposed(&spectrum, n);
        transform.process(&mut columns);
        Array2::from_shape_fn([n, n], |(i, j)| columns[j * n + i].re / slope.sqrt())
    }
}

/// Uniform in [0, 1): splitmix64 of the seed and the wave.
fn phase(k1: i64, k2: i64) -> f64 {
    let wave = ((k1 as u64) << 32) ^ (k2 as u64 & 0xffff_ffff);
    let mut z = SEED.wrapping_add(wave.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

fn transposed(rows: &[Complex64], n: usize) -> Vec<Complex64> {
    (0..n * n).map(|index| rows[(index % n) * n + index / n]).collect()
}
