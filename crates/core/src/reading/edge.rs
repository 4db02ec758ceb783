//! Pressure and gap near the edge of a contact of layered half-spaces.
//!
//! Close to its edge a contact is a straight one, 0 < x < ∞, without a length of its own but those of the body. With the compliance
//! 2T(q)/(E*q) written as a product, T(q) = T₊T₋, T₊ without zeros and poles where Im q > 0 (Wiener & Hopf), the pressure
//! at a distance x inside and the gap at a distance y outside of a smooth contact are
//!
//! p = A φ(x),  φ̂(s) = Γ(3/2) s^{−3/2}/T₊(is),   3E*g/4 = A γ(y),  γ̂(s) = Γ(5/2) s^{−5/2} T₊(is),
//! T₊(is) = exp[(s/π) ∫₀^∞ ln T(q)/(q² + s²) dq],
//!
//! Laplace transforms with one amplitude A. A bare half-space has φ = √x and γ = y^{3/2}; so has a coated one with
//! T → 1 closer to the edge than the coating is thick, and with other amplitudes farther away. The transforms are
//! inverted by the Euler sum of J. Abate & W. Whitt, INFORMS J. Comput. 18 (2006) 408.
//!
//! **Under coupled friction** the traction displaces the surface too: with f = μ **e**·**n**, **n** the outward normal of the
//! edge, and K/C the [coupling over the compliance](Bodies::coupling_ratio), T becomes T (1 + ifK/C), whose phase
//! α(q) = atan(fK/C) is odd. Both transforms then have the factor
//!
//! exp[(1/π) ∫₀^∞ α(q) q/(q² + s²) dq],
//!
//! and T the modulus √(1 + (fK/C)²): on a bare half-space p ~ x^{½ + α/π} and g ~ y^{3/2 + α/π}, the exponents of
//! [`Friction::edge_exponent`]. They are tabulated for the normal across the direction of sliding, along and against it; in
//! between the logarithms are those of the parabola through the three.

use super::edge_transforms::{EdgeTransforms, Wave, euler};
use crate::body::Bodies;
use crate::friction::Friction;
use crate::numeric::parallel;

/// Pressure and gap near the edge, tabulated over the distance.
#[derive(Debug, Clone)]
pub struct ContactEdge {
    /// Shortest distance of the tables, a length.
    shortest: f64,
    /// φ/√x and γ/y^{3/2} at the distances `shortest`·e^{k LOG_STEP}.
    ratios: Vec<[f64; 2]>,
    /// φ/√x and γ/y^{3/2}, each with its slope over the logarithm, at equal steps of √x from √`shortest` on.
    roots: Vec<[[f64; 2]; 2]>,
    /// First of these roots, √length.
    first: f64,
    /// One over the step of the roots.
    per_step: f64,
    sliding: Option<SlidingEdge>,
}

/// The edge under coupled friction.
#[derive(Debug, Clone)]
struct SlidingEdge {
    /// Direction in which the counterbody slides, a unit vector.
    direction: [f64; 2],
    /// φ/√x and γ/y^{3/2} at the distances of the table, for normals along the direction and against it.
    ratios: [Vec<[f64; 2]>; 2],
}

/// Step of the table in the logarithm of the distance.
const LOG_STEP: f64 = 0.06;
/// Number of steps of the table in the root of the distance.
const ROOT_STEPS: usize = 1024;
/// Step of the quadrature over ln q.
const QUADRATURE_STEP: f64 = 0.05;
/// Ratio of the largest and the smallest q to the inverse distances.
const WAVENUMBER_REACH: f64 = 100.0;

impl ContactEdge {
    /// The edge between the bodies, at distances from `shortest` to `longest` (lengths).
    pub fn new(bodies: &Bodies, friction: Option<&Friction>, shortest: f64, longest: f64) -> Self {
        let first = (1.0 / (WAVENUMBER_REACH * longest)).ln();
        let count = ((WAVENUMBER_REACH * WAVENUMBER_REACH * longest / shortest).ln() / QUADRATURE_STEP).ceil() as usize;
        let distances = (longest / shortest).ln() / LOG_STEP;
        let sum = euler();
        let table = |along: f64| -> Vec<[f64; 2]> {
            let wave = |k: usize| {
                let wavenumber = (first + k as f64 * QUADRATURE_STEP).exp();
                // T of any layered half-space is positive.
                let log = bodies.correction(wavenumber).max(f64::MIN_POSITIVE).ln();
                if along == 0.0 {
                    return Wave { wavenumber, log, phase: 0.0 };
                }
                let ratio = along * bodies.coupling_ratio(wavenumber);
                Wave { wavenumber, log: log + 0.5 * (ratio * ratio).ln_1p(), phase: ratio.atan() }
            };
            let waves: Vec<Wave> = (0..=count).map(wave).collect();
            let transforms = EdgeTransforms::new(&waves, QUADRATURE_STEP, longest);
            let entries = distances.ceil() as usize + 2;
            if transforms.is_bare() {
                return vec![[1.0; 2]; entries];
            }
            let ratios = |k: usize| transforms.ratios(&sum, shortest * (k as f64 * LOG_STEP).exp());
            parallel::map(entries, ratios)
        };
        let sliding = friction.filter(|friction| friction.couples()).map(|friction| SlidingEdge {
            direction: friction.direction(),
            ratios: [1.0, -1.0].map(|sign| table(sign * friction.coefficient())),
        });
        let first = shortest.sqrt();
        let step = (longest.sqrt() - first) / ROOT_STEPS as f64;
        let per_step = step.recip();
        let mut edge = Self { shortest, ratios: table(0.0), roots: Vec::new(), first, per_step, sliding };
        let root = |k: usize| (first + k as f64 * step).powi(2);
        edge.roots =
            (0..=ROOT_STEPS).map(|k| [0, 1].map(|side| edge.logarithmic(&edge.ratios, root(k), side))).collect();
        edge
    }

    /// Component of the outward normal (cos θ, sin θ) of an edge along the direction of sliding; 0 without coupled friction.
    pub fn along(&self, theta: f64) -> f64 {
        self.sliding.as_ref().map_or(0.0, |SlidingEdge { direction: [x, y], .. }| x * theta.cos() + y * theta.sin())
    }

    /// φ and its slope at the distance x inside an edge whose normal has the component [`along`](Self::along) the sliding.
    pub fn pressure(&self, x: f64, along: f64) -> [f64; 2] {
        let root = x.sqrt();
        let [ratio, slope] = self.at(x, root, along, 0);
        [ratio * root, (0.5 * ratio + slope) / root]
    }

    /// γ and its slope at the distance y outside an edge whose normal has the component [`along`](Self::along) the sliding.
    pub fn opening(&self, y: f64, along: f64) -> [f64; 2] {
        let root = y.sqrt();
        let [ratio, slope] = self.at(y, root, along, 1);
        [ratio * y * root, (1.5 * ratio + slope) * root]
    }

    /// Ratio at a distance and its slope over the logarithm, of the pressure (`side` 0) or of the gap (1).
    fn at(&self, distance: f64, root: f64, along: f64, side: usize) -> [f64; 2] {
        let place = ((root - self.first) * self.per_step).clamp(0.0, ROOT_STEPS as f64 - 0.001);
        let k = place as usize;
        let rest = place - k as f64;
        let (node, next) = (self.roots[k][side], self.roots[k + 1][side]);
        let across = [0, 1].map(|c| node[c] + rest * (next[c] - node[c]));
        let Some(SlidingEdge { ratios, .. }) = self.sliding.as_ref().filter(|_| along != 0.0) else { return across };
        let all = [across, self.logarithmic(&ratios[0], distance, side), self.logarithmic(&ratios[1], distance, side)];
        if all.iter().any(|[ratio, _]| *ratio <= 0.0) {
            return across;
        }
        let weights = [1.0 - along * along, 0.5 * along * (along + 1.0), 0.5 * along * (along - 1.0)];
        let sum = |of: fn([f64; 2]) -> f64| -> f64 { all.into_iter().zip(weights).map(|(pair, w)| w * of(pair)).sum() };
        let ratio = sum(|[ratio, _]| ratio.ln()).exp();
        [ratio, ratio * sum(|[ratio, slope]| slope / ratio)]
    }

    /// Ratio at a distance and its slope over the logarithm, linear in a table of `ratios` over the logarithm.
    fn logarithmic(&self, ratios: &[[f64; 2]], distance: f64, side: usize) -> [f64; 2] {
        let place = ((distance / self.shortest).ln() / LOG_STEP).clamp(0.0, ratios.len() as f64 - 1.001);
        let k = place as usize;
        let (a, b) = (ratios[k][side], ratios[k + 1][side]);
        [a + (place - k as f64) * (b - a), (b - a) / LOG_STEP]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use std::f64::consts::PI;

    fn coated(young: f64, thickness: f64) -> HalfSpace {
        let [coating, substrate] = [young, 1.0].map(|young| Material::from_young(young, 0.3).unwrap());
        let layer = Layer::new(coating, thickness, Interface::Bonded).unwrap();
        HalfSpace::new(vec![layer], substrate)
    }

    #[test]
    fn a_bare_edge_is_that_of_hertz() {
        let bare = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let edge = ContactEdge::new(&bare.into(), None, 0.01, 1.0);
        for x in [0.01f64, 0.2, 0.9] {
            let ([phi, slope], [gamma, steepness]) = (edge.pressure(x, 0.0), edge.opening(x, 0.0));
            assert!((phi / x.sqrt() - 1.0).abs() < 1e-6 && (slope * x.sqrt() - 0.5).abs() < 1e-6, "{phi} {slope}");
            assert!((gamma / x.powf(1.5) - 1.0).abs() < 1e-6 && (steepness / x.sqrt() - 1.5).abs() < 1e-6);
        }
    }

    /// Before and behind a contact on a bare half-space, and obliquely: p = x^{½+α/π}, g ~ y^{3/2+α/π}, tan α = f β. Between
    /// the three normals of the table the parabola errs by the third order of α. The table's steps of 0.06 in the logarithm
    /// leave (0.06 α)²/8 of a ratio, less than 1e-5, and 0.03 α² of a slope.
    #[test]
    fn a_sliding_edge_has_the_exponents_of_its_friction() {
        let material = Material::from_young(1.0, 0.1).unwrap();
        let friction = Friction::new(0.8, [3.0, 4.0]).unwrap();
        let bare = HalfSpace::new(vec![], material);
        let edge = ContactEdge::new(&bare.into(), Some(&friction), 0.01, 1.0);
        for (turned, tolerance) in [(0.0f64, 1e-5), (1.1, 2e-3), (0.5 * PI, 1e-5), (2.3, 2e-3), (PI, 1e-5)] {
            let along = edge.along(4.0f64.atan2(3.0) + turned);
            assert!((along - turned.cos()).abs() < 1e-12);
            let alpha = (0.8 * turned.cos() * 0.8 / 1.8).atan() / PI;
            if turned == 0.0 {
                assert!((alpha + friction.edge_exponent(0.4 / 0.9)).abs() < 1e-12);
            }
            for (near, far) in [(0.02f64, 0.3f64), (0.1, 0.9)] {
                let pressure = (edge.pressure(far, along)[0] / edge.pressure(near, along)[0]).ln() / (far / near).ln();
                let opening = (edge.opening(far, along)[0] / edge.opening(near, along)[0]).ln() / (far / near).ln();
                assert!((pressure - 0.5 - alpha).abs() < tolerance, "{turned}: {pressure} {alpha}");
                assert!((opening - 1.5 - alpha).abs() < tolerance, "{turned}: {opening} {alpha}");
                let [value, slope] = edge.opening(near, along);
                assert!((slope * near / value - 1.5 - alpha).abs() < 3e-3, "{turned}: {slope}");
            }
        }
    }

    /// Far from the edge T is T(0) = E₁/E₂: φ → √(x/T(0)), γ → y^{3/2} √T(0); with T's first-order term (qh) the edge
    /// looks displaced by lengths of the order h T′(0)/T(0) ln(x/h), here below 0.03 and 0.04 of x.
    #[test]
    fn a_coating_is_left_behind_far_from_the_edge_and_alone_close_to_it() {
        for young in [0.5, 4.0] {
            let edge = ContactEdge::new(&coated(young, 1.0).into(), None, 1e-4, 1e4);
            let root = young.sqrt();
            let near = [edge.pressure(2e-4, 0.0)[0] / 2e-4f64.sqrt(), edge.opening(2e-4, 0.0)[0] / 2e-4f64.powf(1.5)];
            let far = [
                edge.pressure(5e3, 0.0)[0] / 5e3f64.sqrt() * root,
                edge.opening(5e3, 0.0)[0] / 5e3f64.powf(1.5) / root,
            ];
            assert!(near.iter().all(|ratio| (ratio - 1.0).abs() < 1e-3), "{near:?}");
            assert!(far.iter().all(|ratio| (ratio - 1.0).abs() < 5e-3), "{far:?}");
        }
    }
}
