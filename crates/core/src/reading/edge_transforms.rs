//! The Laplace transforms of pressure and gap near an edge, and their inversion.
//!
//! T₊(is) = exp[(s/π) ∫₀^∞ ln T(q)/(q² + s²) dq], the phase factor exp[(1/π) ∫₀^∞ α(q) q/(q² + s²) dq] and the transforms of
//! [`edge`](super::edge) are inverted by the Euler sum of J. Abate & W. Whitt, INFORMS J. Comput. 18 (2006) 408.

use crate::numeric::lanes::{LANES, Real, splat, vectorised};
use fearless_simd::Simd;
use rustfft::num_complex::Complex64;
use std::f64::consts::{LN_10, PI};

/// Terms of the Euler sum: it errs by 10^{−0.6 TERMS}.
const TERMS: usize = 13;

/// Modulus and phase of the compliance at a wavenumber.
#[derive(Debug, Clone, Copy)]
pub struct Wave {
    /// Wavenumber q, 1/length.
    pub wavenumber: f64,
    /// ln |T|.
    pub log: f64,
    /// Phase α, radians.
    pub phase: f64,
}

/// The Laplace transforms of φ and γ, with their integrals by the trapezoidal rule over ln q.
pub struct EdgeTransforms {
    /// q² of each wave.
    squares: Vec<f64>,
    /// Weights of ln |T| of each wave.
    logs: Vec<f64>,
    /// Weights of α q of each wave.
    phases: Vec<f64>,
    /// The first wave and the last one.
    ends: [Wave; 2],
    /// s² for which the factor of the phase is 1, 1/length².
    reference: f64,
    /// Integral of the phase for s² = `reference`.
    whole: f64,
}

impl EdgeTransforms {
    /// Transforms from waves at equal steps of ln q, for distances up to the `longest`, a length.
    pub fn new(waves: &[Wave], step: f64, longest: f64) -> Self {
        let reference = longest.powi(-2);
        let weight = |k: usize| if k == 0 || k + 1 == waves.len() { 0.5 * step } else { step };
        let each =
            |of: fn(&Wave) -> f64| -> Vec<f64> { waves.iter().enumerate().map(|(k, w)| weight(k) * of(w)).collect() };
        let squares: Vec<f64> = waves.iter().map(|wave| wave.wavenumber * wave.wavenumber).collect();
        let phases = each(|wave| wave.phase * wave.wavenumber * wave.wavenumber);
        let whole = phases.iter().zip(&squares).map(|(phase, square)| phase / (square + reference)).sum();
        let logs = each(|wave| wave.log * wave.wavenumber);
        Self { squares, logs, phases, ends: [waves[0], waves[waves.len() - 1]], reference, whole }
    }

    /// Whether T is 1 and nothing slides: φ = √x and γ = y^{3/2}.
    pub fn is_bare(&self) -> bool {
        self.logs.iter().chain(&self.phases).all(|&part| part == 0.0)
    }

    /// ∫ ln T/(q² + s²) dq, and ∫ α q/(q² + s²) dq less that at the reference, over the waves, for the square of s.
    fn at(&self, square: Complex64) -> [Complex64; 2] {
        let (a, b) = (square.re, square.im);
        let mut sums = [[0.0; LANES]; 4];
        vectorised!(simd => self.summed(simd, [a, b], &mut sums));
        let [log_re, log_im, phase_re, phase_im] = sums.map(|lanes| lanes.iter().sum::<f64>());
        [Complex64::new(log_re, -b * log_im), Complex64::new(phase_re - self.whole, -b * phase_im)]
    }

    /// Real and imaginary parts of both integrals, lane by lane, by 1/(q² + a + ib) = (q² + a − ib)/((q² + a)² + b²).
    #[inline(always)]
    fn summed<S: Simd>(&self, simd: S, [a, b]: [f64; 2], sums: &mut [[f64; LANES]; 4]) {
        let mut totals = [splat(simd, 0.0); 4];
        let [a, square] = [a, b * b].map(|x| splat(simd, x));
        let mut at = 0;
        while at < self.squares.len() {
            let real = f64::group(simd, &self.squares, at, 1.0) + a;
            let norm = real * real + square;
            let log = f64::group(simd, &self.logs, at, 0.0) / norm;
            let phase = f64::group(simd, &self.phases, at, 0.0) / norm;
            totals[0] += log * real;
            totals[1] += log;
            totals[2] += phase * real;
            totals[3] += phase;
            at += LANES;
        }
        for (sum, total) in sums.iter_mut().zip(totals) {
            sum.copy_from_slice(total.as_slice());
        }
    }

    /// φ/√x and γ/x^{3/2} at the distance x, by the points and weights of an Euler sum.
    pub fn ratios(&self, sum: &[(Complex64, f64)], x: f64) -> [f64; 2] {
        let mut ratios = [0.0; 2];
        let [low, high] = self.ends;
        for &(beta, weight) in sum {
            let s = beta / x;
            let square = s * s;
            let [integral, mut phase] = self.at(square);
            // Beyond the first and the last wave T is constant.
            let below = (low.wavenumber / s).atan() * low.log;
            let above = ((high.wavenumber / s).atan() - 0.5 * PI) * -high.log;
            if high.phase != 0.0 || low.phase != 0.0 {
                let log = |q: f64| 0.5 * ((q * q + square) / (q * q + self.reference)).ln();
                let origin = 0.5 * (square / self.reference).ln();
                phase += low.phase * (log(low.wavenumber) - origin) - high.phase * log(high.wavenumber);
            }
            let factor = ((integral * s + below + above) / PI).exp();
            let phase = (phase / PI).exp();
            let root = beta.sqrt();
            // Γ(3/2) s^{−3/2} = Γ(3/2) x^{3/2} β^{−3/2}; the sum is divided by x, the ratio by √x.
            ratios[0] += weight * (0.5 * PI.sqrt() / (beta * root) * phase / factor).re;
            ratios[1] += weight * (0.75 * PI.sqrt() / (beta * beta * root) * phase * factor).re;
        }
        ratios
    }
}

/// Points β and weights η of the Euler sum f(x) = Σ η Re f̂(β/x)/x.
pub fn euler() -> Vec<(Complex64, f64)> {
    let mut weights = vec![1.0; 2 * TERMS + 1];
    weights[0] = 0.5;
    let last = 0.5f64.powi(TERMS as i32);
    weights[2 * TERMS] = last;
    let mut binomial = 1.0;
    for k in 1..TERMS {
        binomial *= (TERMS - k + 1) as f64 / k as f64;
        weights[2 * TERMS - k] = weights[2 * TERMS - k + 1] + last * binomial;
    }
    let scale = 10f64.powf(TERMS as f64 / 3.0);
    let point = |(k, weight): (usize, f64)| {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        (Complex64::new(TERMS as f64 * LN_10 / 3.0, PI * k as f64), sign * scale * weight)
    };
    weights.into_iter().enumerate().map(point).collect()
}
