//! The edge of a contact on a layered half-space: how pressure and gap leave it.
//!
//! Close to its edge a contact is a straight one, 0 < x < ∞, without a scale but the body's own. With the compliance
//! 2T(q)/(E*q) written as a product, T(q) = T₊T₋, T₊ without zeros and poles where Im q > 0 (Wiener & Hopf), the pressure
//! at a distance x inside and the gap at a distance y outside of a smooth contact are
//!
//! p = A φ(x),  φ̂(s) = Γ(3/2) s^{−3/2}/T₊(is),   3E*g/4 = A γ(y),  γ̂(s) = Γ(5/2) s^{−5/2} T₊(is),
//! T₊(is) = exp[(s/π) ∫₀^∞ ln T(q)/(q² + s²) dq],
//!
//! Laplace transforms with one amplitude A. A bare half-space has φ = √x and γ = y^{3/2}; so has a coated one with
//! T → 1 closer to the edge than the coating is thick, and with other amplitudes farther away. The transforms are
//! inverted by the Euler sum of J. Abate & W. Whitt, INFORMS J. Comput. 18 (2006) 408.

use crate::body::TransferFunction;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::f64::consts::{LN_10, PI};

/// Pressure and gap at the edge, tabulated over the logarithm of the distance.
#[derive(Debug, Clone)]
pub struct Edge {
    shortest: f64,
    /// φ/√x and γ/y^{3/2} at the distances `shortest`·e^{k STEP}.
    ratios: Vec<[f64; 2]>,
}

/// Step of the table in the logarithm of the distance.
const STEP: f64 = 0.06;
/// Terms of the Euler sum: it errs by 10^{−0.6 TERMS}.
const TERMS: usize = 13;
/// Step of the quadrature over ln q, and how far q reaches beyond the inverse distances.
const RULE: f64 = 0.05;
const BEYOND: f64 = 100.0;

impl Edge {
    /// The edge on a half-space, at distances from `shortest` to `longest` (lengths).
    pub fn new(transfer: &TransferFunction, shortest: f64, longest: f64) -> Self {
        let first = (1.0 / (BEYOND * longest)).ln();
        let count = ((BEYOND * BEYOND * longest / shortest).ln() / RULE).ceil() as usize;
        let wave = |k: usize| {
            let q = (first + k as f64 * RULE).exp();
            // The rule's weight in q; T of any layered half-space is positive.
            (q, transfer.correction(q).max(f64::MIN_POSITIVE).ln())
        };
        let waves: Vec<(f64, f64)> = (0..=count).map(wave).collect();
        let distances = (longest / shortest).ln() / STEP;
        let sum = euler();
        let ratios = (0..=distances.ceil() as usize + 1)
            .into_par_iter()
            .map(|k| ratios(&waves, &sum, shortest * (k as f64 * STEP).exp()))
            .collect();
        Self { shortest, ratios }
    }

    /// φ and its slope at the distance x inside the edge.
    pub fn pressure(&self, x: f64) -> [f64; 2] {
        let ([ratio, _], [slope, _]) = self.at(x);
        [ratio * x.sqrt(), (0.5 * ratio + slope) / x.sqrt()]
    }

    /// γ and its slope at the distance y outside the edge.
    pub fn opening(&self, y: f64) -> [f64; 2] {
        let ([_, ratio], [_, slope]) = self.at(y);
        [ratio * y * y.sqrt(), (1.5 * ratio + slope) * y.sqrt()]
    }

    /// Ratios at a distance, linear in its logarithm, and their slopes over the logarithm.
    fn at(&self, distance: f64) -> ([f64; 2], [f64; 2]) {
        let place = ((distance / self.shortest).ln() / STEP).clamp(0.0, self.ratios.len() as f64 - 1.001);
        let (k, rest) = (place as usize, place.fract());
        let (a, b) = (self.ratios[k], self.ratios[k + 1]);
        ([0, 1].map(|i| a[i] + rest * (b[i] - a[i])), [0, 1].map(|i| (b[i] - a[i]) / STEP))
    }
}

/// φ/√x and γ/x^{3/2} at the distance x.
fn ratios(waves: &[(f64, f64)], sum: &[(Complex64, f64)], x: f64) -> [f64; 2] {
    let mut ratios = [0.0; 2];
    for &(beta, weight) in sum {
        let s = beta / x;
        let square = s * s;
        let mut integral = Complex64::default();
        for (k, &(q, log)) in waves.iter().enumerate() {
            let end = if k == 0 || k + 1 == waves.len() { 0.5 } else { 1.0 };
            integral += end * RULE * log * q / (square + q * q);
        }
        // Beyond its ends the rule takes T as constant.
        let ((low, first), (high, last)) = (waves[0], waves[waves.len() - 1]);
        let below = (low / s).atan() * first;
        let above = ((high / s).atan() - 0.5 * PI) * -last;
        let factor = ((integral * s + below + above) / PI).exp();
        let root = beta.sqrt();
        // Γ(3/2) s^{−3/2} = Γ(3/2) x^{3/2} β^{−3/2}; the sum is divided by x, the ratio by √x.
        ratios[0] += weight * (0.5 * PI.sqrt() / (beta * root) / factor).re;
        ratios[1] += weight * (0.75 * PI.sqrt() / (beta * beta * root) * factor).re;
    }
    ratios
}

/// Points β and weights η of f(x) = Σ η Re f̂(β/x)/x.
fn euler() -> Vec<(Complex64, f64)> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};

    fn coated(young: f64, thickness: f64) -> TransferFunction {
        let [coating, substrate] = [young, 1.0].map(|young| Material::from_young(young, 0.3).unwrap());
        let layer = Layer::new(coating, thickness, Interface::Bonded).unwrap();
        TransferFunction::new(&HalfSpace::new(vec![layer], substrate))
    }

    #[test]
    fn a_bare_edge_is_that_of_hertz() {
        let bare = TransferFunction::new(&HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()));
        let edge = Edge::new(&bare, 0.01, 1.0);
        for x in [0.01f64, 0.2, 0.9] {
            let ([phi, slope], [gamma, steepness]) = (edge.pressure(x), edge.opening(x));
            assert!((phi / x.sqrt() - 1.0).abs() < 1e-6 && (slope * x.sqrt() - 0.5).abs() < 1e-6, "{phi} {slope}");
            assert!((gamma / x.powf(1.5) - 1.0).abs() < 1e-6 && (steepness / x.sqrt() - 1.5).abs() < 1e-6);
        }
    }

    /// Far from the edge T is T(0) = E₁/E₂: φ → √(x/T(0)), γ → y^{3/2} √T(0); with T's first-order term (qh) the edge
    /// looks displaced by lengths of the order h T′(0)/T(0) ln(x/h), here below 0.03 and 0.04 of x.
    #[test]
    fn a_coating_is_left_behind_far_from_the_edge_and_alone_close_to_it() {
        for young in [0.5, 4.0] {
            let edge = Edge::new(&coated(young, 1.0), 1e-4, 1e4);
            let root = young.sqrt();
            let near = [edge.pressure(2e-4)[0] / 2e-4f64.sqrt(), edge.opening(2e-4)[0] / 2e-4f64.powf(1.5)];
            let far = [edge.pressure(5e3)[0] / 5e3f64.sqrt() * root, edge.opening(5e3)[0] / 5e3f64.powf(1.5) / root];
            assert!(near.iter().all(|ratio| (ratio - 1.0).abs() < 1e-3), "{near:?}");
            assert!(far.iter().all(|ratio| (ratio - 1.0).abs() < 5e-3), "{far:?}");
        }
    }
}
