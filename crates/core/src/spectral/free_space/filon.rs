//! Products of a smooth function on the zone of the grid with the waves of all offsets, exact for its interpolant (Filon):
//!
//! A_{qm} = (1/d) ∫₀^π ℓ_q(κ) trig(κm) dκ = (π/2d) w_q Σ_{a<D} (2a+1) P_a(ξ_q) trig(π(m+a)/2) j_a(πm/2),
//!
//! trig the cosine or the sine, ℓ_q the Lagrange polynomial of the node κ_q = π(1 + ξ_q)/2 of D Gauss–Legendre points ξ_q with
//! the weights w_q, P_a Legendre polynomials, j_a spherical Bessel functions. However many periods a wave has on the zone, it is
//! integrated exactly: the error is that of the interpolation, the same for every offset m.

use crate::numeric::parallel;
use crate::numeric::quadrature::gauss;
use std::f64::consts::{FRAC_PI_2, PI};

/// The wave that a function is multiplied with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wave {
    Cosine,
    Sine,
}

/// A_{qm} d along one side of the zone.
#[derive(Debug)]
pub(super) struct Filon {
    /// κ_q/π, the nodes over the side of the zone.
    pub nodes: Vec<f64>,
    /// A_{qm} d, offset by offset.
    weights: Vec<f64>,
}

impl Filon {
    /// Weights of D = `nodes` nodes for the offsets 0 ≤ m < `offsets`.
    pub fn new(nodes: usize, offsets: usize, wave: Wave) -> Self {
        let rule = gauss(nodes);
        let legendre: Vec<Vec<f64>> = rule.iter().map(|&[x, weight]| scaled_legendre(x, weight, nodes)).collect();
        let mut weights = vec![0.0; nodes * offsets];
        parallel::each_chunk(&mut weights, nodes, |m, weights| {
            let bessel = spherical_bessel(m, nodes);
            // a ≡ m (mod 2) for the cosine, else for the sine: the others vanish.
            let first = (m + usize::from(wave == Wave::Sine)) % 2;
            for (weight, legendre) in weights.iter_mut().zip(&legendre) {
                *weight = (first..nodes).step_by(2).map(|a| quarter(wave, m + a) * legendre[a] * bessel[a]).sum();
            }
        });
        Self { nodes: rule.iter().map(|[x, _]| 0.5 * (1.0 + x)).collect(), weights }
    }

    /// A_{qm} d of all nodes q at each offset m.
    pub fn offsets(&self) -> std::slice::ChunksExact<'_, f64> {
        self.weights.chunks_exact(self.nodes.len())
    }
}

/// (π/2) w (2a + 1) P_a(x) for a < `count`.
fn scaled_legendre(x: f64, weight: f64, count: usize) -> Vec<f64> {
    let (mut before, mut value) = (0.0, 1.0);
    let next = |a: usize| {
        let (legendre, k) = (value, a as f64);
        (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
        FRAC_PI_2 * weight * (2.0 * k + 1.0) * legendre
    };
    (0..count).map(next).collect()
}

/// cos(πn/2) or sin(πn/2).
fn quarter(wave: Wave, n: usize) -> f64 {
    match (wave, n % 4) {
        (Wave::Cosine, 0) | (Wave::Sine, 1) => 1.0,
        (Wave::Cosine, 2) | (Wave::Sine, 3) => -1.0,
        _ => 0.0,
    }
}

/// j_a(πm/2) for a < `count`: upward where a < πm/2, beyond by the ratios j_a/j_{a−1} of the downward recurrence.
fn spherical_bessel(m: usize, count: usize) -> Vec<f64> {
    let mut values = vec![0.0; count];
    if m == 0 {
        values[0] = 1.0;
        return values;
    }
    let x = PI * m as f64 / 2.0;
    let (sine, cosine) = (quarter(Wave::Sine, m), quarter(Wave::Cosine, m));
    let (mut before, mut value) = (cosine / x, sine / x);
    // The first order whose value all lower ones lead to: positive, as j_a has no zero below a.
    let turn = x.ceil() as usize;
    for a in 0..count.min(turn + 1) {
        values[a] = value;
        (before, value) = (value, (2 * a + 1) as f64 / x * value - before);
    }
    if count > turn + 1 {
        let mut ratio = 0.0;
        for a in (turn + 1..count + 40 + 10 * x.cbrt() as usize).rev() {
            ratio = x / ((2 * a + 1) as f64 - x * ratio);
            if a < count {
                values[a] = ratio;
            }
        }
        for a in turn + 1..count {
            values[a] *= values[a - 1];
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    /// j_a at πm/2 by the integral ½ i^{−a} ∫ P_a(t) e^{ixt} dt.
    #[test]
    fn spherical_bessel_functions_are_their_integrals() {
        let rule = gauss(300);
        for m in [0, 1, 2, 3, 17, 50, 51, 101, 150] {
            let x = PI * m as f64 / 2.0;
            let found = spherical_bessel(m, 160);
            for a in [0, 1, 2, 5, 26, 27, 77, 80, 81, 159] {
                let wave = |t: f64| if a % 2 == 0 { (x * t).cos() } else { (x * t).sin() };
                let term = |&[t, w]: &[f64; 2]| 0.5 * scaled_legendre(t, w, a + 1)[a] * wave(t);
                let sum: f64 = rule.iter().map(term).sum::<f64>() / (FRAC_PI_2 * (2 * a + 1) as f64);
                let expected = if a % 4 < 2 { sum } else { -sum };
                assert!((found[a] - expected).abs() < 3e-15, "j_{a}(π{m}/2): {} {expected}", found[a]);
            }
        }
    }

    /// ∫₀^π e^{−κ} cos κm dκ and the sine, exact, whatever m.
    #[test]
    fn every_offset_has_the_same_error() {
        for (wave, factor) in [(Wave::Cosine, 1.0), (Wave::Sine, 0.0)] {
            let filon = Filon::new(24, 5000, wave);
            for (m, weights) in filon.offsets().enumerate() {
                let sum: f64 = weights.iter().zip(&filon.nodes).map(|(w, node)| w * (-PI * node).exp()).sum();
                let (k, end) = (m as f64, if m % 2 == 0 { 1.0 } else { -1.0 } * (-PI).exp());
                let exact = (factor + (1.0 - factor) * k) * (1.0 - end) / (1.0 + k * k);
                assert!((sum - exact).abs() < 3e-15, "{wave:?} {m}: {sum} {exact}");
            }
        }
    }
}
