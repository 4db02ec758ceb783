//! Pressure inside and gap outside a straight edge of contact on layers, relative to those of a bare body.
//!
//! The only lengths of a straight edge are those of the layers. With the transfer function's factor that is regular in the upper half
//! of the complex q plane (Wiener & Hopf), on the imaginary axis
//!
//! T₊(is) = exp[(s/π) ∫₀^∞ ln T(q)/(q² + s²) dq],
//!
//! the Laplace transforms of pressure and gap are s^{−3/2}/T₊(is) and s^{−5/2} T₊(is) times constants. On a bare body
//! these are d^{1/2} and d^{3/2}. The ratios to them are smooth in ln d, and the inversion by H. Stehfest, Commun. ACM 13 (1970)
//! 47, which needs real s alone, errs by 1e-3 of the layers' effect.
//!
//! The spectral readings invert the transforms by a formula of their own, so that each checks the other.

use super::point::PointKernel;
use std::f64::consts::{LN_2, PI};

/// Table of the ratios of pressure inside and gap outside an edge to those of a bare body of the surface material, over the
/// logarithm of the distance d.
#[derive(Debug, Clone)]
pub struct EdgeRatios {
    shortest: f64,
    /// Both ratios at d = `shortest`·e^{k LOG_STEP}; empty on a bare body.
    ratios: Vec<[f64; 2]>,
}

/// Step of the table in ln d.
const LOG_STEP: f64 = 0.1;
/// Number of terms of Stehfest's sum: more lose more digits by cancellation than they gain.
const STEHFEST_TERMS: usize = 12;
/// Step of the sum over ln q.
const WAVE_LOG_STEP: f64 = 0.05;
/// Shortest distance of the table, in thicknesses of the first layer.
const SHORTEST: f64 = 1e-3;
/// Longest distance of the table, in thicknesses of the first layer.
const LONGEST: f64 = 1e4;

impl EdgeRatios {
    /// Ratios on the half-space of `kernel`.
    pub fn new(kernel: &PointKernel) -> Self {
        let Some(thickness) = kernel.thickness() else { return Self::bare() };
        // ln T between the wavenumbers where T is T(0) and where it is 1.
        let lowest = 1e-4 / (LONGEST * thickness);
        let count = ((kernel.layer_cutoff() / lowest).ln() / WAVE_LOG_STEP).ceil() as usize;
        let wave = |k: usize| {
            let q = lowest * (k as f64 * WAVE_LOG_STEP).exp();
            // T of layers is positive.
            (q, (1.0 + kernel.excess(q)).max(f64::MIN_POSITIVE).ln())
        };
        let waves: Vec<(f64, f64)> = (0..=count).map(wave).collect();
        // ln T₊(is), with T of the first wave below it.
        let factor = |s: f64| {
            let below = (lowest / s).atan() * waves[0].1;
            let part = |(k, (q, log)): (usize, &(f64, f64))| {
                let end = if k == 0 || k == count { 0.5 } else { 1.0 };
                end * WAVE_LOG_STEP * log * q * s / (q * q + s * s)
            };
            (below + waves.iter().enumerate().map(part).sum::<f64>()) / PI
        };
        let weights = stehfest();
        let ratios = |k: usize| {
            let d = SHORTEST * thickness * (k as f64 * LOG_STEP).exp();
            let (mut found, mut bare) = ([0.0; 2], [0.0; 2]);
            for (j, weight) in (1..).zip(&weights) {
                let beta = f64::from(j) * LN_2;
                let log = factor(beta / d);
                for (i, power) in [-1.5, -2.5].into_iter().enumerate() {
                    let term = weight * beta.powf(power);
                    found[i] += term * if i == 0 { -log } else { log }.exp();
                    bare[i] += term;
                }
            }
            [found[0] / bare[0], found[1] / bare[1]]
        };
        let last = ((LONGEST / SHORTEST).ln() / LOG_STEP).ceil() as usize;
        Self { shortest: SHORTEST * thickness, ratios: (0..=last).map(ratios).collect() }
    }

    /// Ratios on a bare body: 1.
    pub fn bare() -> Self {
        Self { shortest: 1.0, ratios: Vec::new() }
    }

    /// Ratio of the pressure at the distance d inside the edge, a length, to that of a bare body with the same √d term.
    pub fn pressure(&self, distance: f64) -> f64 {
        self.at(distance)[0]
    }

    /// Ratio of the gap at the distance d outside the edge, a length, to that of a bare body with the same d^{3/2} term.
    pub fn opening(&self, distance: f64) -> f64 {
        self.at(distance)[1]
    }

    fn at(&self, distance: f64) -> [f64; 2] {
        if self.ratios.is_empty() {
            return [1.0; 2];
        }
        let last = self.ratios.len() - 1;
        let place = ((distance / self.shortest).max(f64::MIN_POSITIVE).ln() / LOG_STEP).clamp(0.0, last as f64 - 1e-9);
        let (k, rest) = (place as usize, place.fract());
        [0, 1].map(|i| self.ratios[k][i] + rest * (self.ratios[k + 1][i] - self.ratios[k][i]))
    }
}

/// Weights V of f(t) ≈ (ln 2/t) Σ_j V_j f̂(j ln 2/t).
fn stehfest() -> [f64; STEHFEST_TERMS] {
    let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
    let half = STEHFEST_TERMS / 2;
    std::array::from_fn(|index| {
        let j = index + 1;
        let term = |k: usize| {
            (k as f64).powi(half as i32) * factorial(2 * k)
                / (factorial(half - k) * factorial(k) * factorial(k - 1) * factorial(j - k) * factorial(2 * k - j))
        };
        let sum: f64 = (j.div_ceil(2)..=j.min(half)).map(term).sum();
        if (half + j).is_multiple_of(2) { sum } else { -sum }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};

    /// Close to the edge the coating is alone, far from it T is T(0) = E₁*/E₂*: pressures fall by √T(0), gaps grow by it.
    /// The first order of T in qh displaces the edge by lengths of some ten h.
    #[test]
    fn a_coating_is_alone_close_to_the_edge_and_left_behind_far_from_it() {
        for young in [0.05f64, 0.5, 4.0, 50.0] {
            let [coating, substrate] = [young, 1.0].map(|young| Material::from_young(young, 0.3).unwrap());
            for interface in [Interface::Bonded, Interface::Frictionless] {
                let layer = Layer::new(coating, 0.02, interface).unwrap();
                let kernel = PointKernel::new(HalfSpace::new(vec![layer], substrate), 1.0);
                let edge = EdgeRatios::new(&kernel);
                let root = young.sqrt();
                let near = [edge.pressure(2e-5), edge.opening(2e-5)];
                let far = [edge.pressure(190.0) * root, edge.opening(190.0) / root];
                println!("{young}: {near:?} {far:?}");
                assert!(near.iter().all(|ratio| (ratio - 1.0).abs() < 0.01), "{young}: {near:?}");
                assert!(far.iter().all(|ratio| (ratio - 1.0).abs() < 0.02), "{young}: {far:?}");
            }
        }
    }
}
