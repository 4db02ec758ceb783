//! An edge of contact smoothed by a Gaussian.
//!
//! A pressure that ends like p = A dˢ, smoothed by a Gaussian of width w, becomes p̃ = A wˢ P(u), u = d/w, with
//!
//! P(u) = ∫₀^∞ tˢ φ(u − t) dt,  φ the normal density.
//!
//! p̃/(w|∇p̃|) = P/P′ increases with u on both sides of the edge: it gives the distance from the edge without A, and
//! whatever lies below the surface. uˢ/P(u) is then the ratio of the pressure to the smoothed one. A traction in proportion to the
//! pressure makes the cusp A c(d), minus the Hilbert transform of dˢ,
//!
//! c = |d|ˢ/sin πs outside (d < 0),  c = dˢ cot πs inside,
//!
//! which under the smoothing of fourth order becomes F(−u)/sin πs + F(u) cot πs, F = P − P″/2.
//!
//! The exponent is s = ½ but for coupled friction: s = ½ − η **e**·**n** at an edge with the outward normal **n**
//! ([`Friction::edge_exponent`](crate::Friction::edge_exponent)). The tables are those of **e**·**n** = −1, 0 and 1; between them lies
//! a parabola.

use std::f64::consts::PI;

/// Distances covered by the table, in widths.
const TABLE_SPAN: [f64; 2] = [-4.0, 12.0];
/// Number of intervals of the table.
const TABLE_INTERVALS: usize = 320;

/// Tables of the edges of all normals.
#[derive(Debug)]
pub(super) struct SmoothedEdge {
    across: EdgeTable,
    /// Tables of the trailing and the leading edge, where their exponents are others.
    sliding: Option<[EdgeTable; 2]>,
}

/// Tables of P, P/P′ and P − P″/2 of an exponent.
#[derive(Debug)]
struct EdgeTable {
    exponent: f64,
    smoothed: Vec<f64>,
    ratio: Vec<f64>,
    fourth: Vec<f64>,
}

impl SmoothedEdge {
    /// Edges of the exponents ½ + η to ½ − η.
    pub fn new(eta: f64) -> Self {
        let sliding = (eta != 0.0).then(|| [0.5 + eta, 0.5 - eta].map(EdgeTable::new));
        Self { across: EdgeTable::new(0.5), sliding }
    }

    /// Distance u from the ratio P/P′, in widths, positive inside contact; clamped to the table. `along`: **e**·**n**.
    pub fn distance(&self, ratio: f64, along: f64) -> f64 {
        self.at(along, |table| table.distance(ratio))
    }

    /// Whether |u| of the ratio P/P′ is less than `most`.
    pub fn is_within(&self, most: f64, ratio: f64) -> bool {
        self.across.is_within(most, ratio)
    }

    /// Ratio uˢ/P(u) of the pressure to the smoothed one at the distance u; 0 outside contact.
    pub fn sharp(&self, u: f64, along: f64) -> f64 {
        self.at(along, |table| table.sharp(u))
    }

    /// Difference of a cusp and the cusp under the smoothing of fourth order, over the smoothed pressure; within four widths of the edge.
    pub fn cusp(&self, u: f64, along: f64) -> f64 {
        self.at(along, |table| table.cusp(u))
    }

    /// A value at an edge whose normal has the component `along` the sliding.
    fn at(&self, along: f64, of: impl Fn(&EdgeTable) -> f64) -> f64 {
        let across = of(&self.across);
        let Some([trailing, leading]) = &self.sliding else { return across };
        let [before, after] = [of(trailing), of(leading)];
        across + 0.5 * along * (after - before) + 0.5 * along * along * (after + before - 2.0 * across)
    }
}

impl EdgeTable {
    fn new(exponent: f64) -> Self {
        let place = |k: usize| TABLE_SPAN[0] + (TABLE_SPAN[1] - TABLE_SPAN[0]) * k as f64 / TABLE_INTERVALS as f64;
        let responses: Vec<[f64; 3]> = (0..=TABLE_INTERVALS).map(|k| response(exponent, place(k))).collect();
        Self {
            exponent,
            smoothed: responses.iter().map(|[p, ..]| *p).collect(),
            ratio: responses.iter().map(|[p, slope, _]| p / slope).collect(),
            fourth: responses.iter().map(|[p, _, curvature]| p - 0.5 * curvature).collect(),
        }
    }

    fn distance(&self, ratio: f64) -> f64 {
        let above = self.ratio.partition_point(|&r| r < ratio);
        if above == 0 || above > TABLE_INTERVALS {
            return if above == 0 { TABLE_SPAN[0] } else { TABLE_SPAN[1] };
        }
        let (low, high) = (self.ratio[above - 1], self.ratio[above]);
        let place = (above - 1) as f64 + (ratio - low) / (high - low);
        TABLE_SPAN[0] + (TABLE_SPAN[1] - TABLE_SPAN[0]) * place / TABLE_INTERVALS as f64
    }

    fn is_within(&self, most: f64, ratio: f64) -> bool {
        let index =
            |u: f64| ((u - TABLE_SPAN[0]) / (TABLE_SPAN[1] - TABLE_SPAN[0]) * TABLE_INTERVALS as f64).round() as usize;
        self.ratio[index(-most)] < ratio && ratio < self.ratio[index(most)]
    }

    fn sharp(&self, u: f64) -> f64 {
        if u <= 0.0 {
            return 0.0;
        }
        if u >= TABLE_SPAN[1] {
            return 1.0;
        }
        u.powf(self.exponent) / between(&self.smoothed, u)
    }

    fn cusp(&self, u: f64) -> f64 {
        let u = u.clamp(TABLE_SPAN[0], -TABLE_SPAN[0]);
        let (sine, cosine) = (PI * self.exponent).sin_cos();
        // At ½ only the outer part is left, whatever the rounding.
        let cosine = if self.exponent == 0.5 { 0.0 } else { cosine };
        let sharp = |u: f64| if u > 0.0 { u.powf(self.exponent) } else { 0.0 };
        let difference = |u: f64| sharp(u) - between(&self.fourth, u);
        (difference(-u) + cosine * difference(u)) / (sine * between(&self.smoothed, u))
    }
}

/// Value of a table at the distance u, linear between its entries.
fn between(table: &[f64], u: f64) -> f64 {
    let place = (u - TABLE_SPAN[0]) / (TABLE_SPAN[1] - TABLE_SPAN[0]) * TABLE_INTERVALS as f64;
    let k = (place as usize).min(TABLE_INTERVALS - 1);
    let rest = place - k as f64;
    (1.0 - rest) * table[k] + rest * table[k + 1]
}

/// P(u), P′(u) and P″(u): with t = s² the integrand is smooth for the exponent ½, and the trapezoidal rule exact.
fn response(exponent: f64, u: f64) -> [f64; 3] {
    const STEPS: usize = 600;
    let last = (u.max(0.0) + 9.0).sqrt();
    let step = last / STEPS as f64;
    let (mut value, mut slope, mut curvature) = (0.0, 0.0, 0.0);
    for k in 1..=STEPS {
        let s = k as f64 * step;
        let x = u - s * s;
        let weight = 2.0 * s.powf(2.0 * exponent + 1.0) * (-0.5 * x * x).exp();
        value += weight;
        slope -= x * weight;
        curvature += (x * x - 1.0) * weight;
    }
    let scale = step / std::f64::consts::TAU.sqrt();
    [value, slope, curvature].map(|sum| scale * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_is_found_at_its_distance_and_sharpened_to_its_square_root() {
        let edge = SmoothedEdge::new(0.0);
        // P(0) = ∫ √t φ dt = 2^{−3/4} Γ(3/4)/√π; linear interpolation in a table of steps 0.05 errs by some 1e-4.
        let [at_edge, ..] = response(0.5, 0.0);
        assert!((at_edge - 0.411_089_5).abs() < 1e-6, "{at_edge}");
        for u in [-3.0, -1.01, -0.02, 0.33, 1.0, 2.72, 7.0] {
            let [p, slope, _] = response(0.5, u);
            assert!((edge.distance(p / slope, 0.0) - u).abs() < 1e-3, "{u}: {}", edge.distance(p / slope, 0.0));
            assert!((p * edge.sharp(u, 0.0) - u.max(0.0).sqrt()).abs() < 1e-3, "{u}");
        }
        for u in [-2.0f64, -0.3, 0.0, 0.4, 1.7] {
            let ([p, ..], [q, _, curvature]) = (response(0.5, u), response(0.5, -u));
            let cusp = (-u).max(0.0).sqrt() - (q - 0.5 * curvature);
            assert!((p * edge.cusp(u, 0.0) - cusp).abs() < 2e-3, "{u}: {} for {cusp}", p * edge.cusp(u, 0.0));
        }
        assert_eq!((edge.distance(0.0, 0.0), edge.distance(f64::INFINITY, 0.0)), (TABLE_SPAN[0], TABLE_SPAN[1]));
    }

    /// Distance, sharp pressure and cusp of the trailing, a lateral and the leading edge, each with its own exponent.
    #[test]
    fn a_sliding_edge_has_the_exponent_and_the_cusp_of_its_normal() {
        let edge = SmoothedEdge::new(-0.08);
        for (along, exponent) in [(-1.0, 0.42), (0.0, 0.5), (1.0, 0.58)] {
            let [at_edge, slope, _] = response(exponent, 0.0);
            assert!((at_edge - known_at_edge(exponent)).abs() < 2e-5, "{exponent}: {at_edge}");
            for u in [-1.5, 0.0, 0.8, 3.0f64] {
                let [p, slope, _] = response(exponent, u);
                assert!((edge.distance(p / slope, along) - u).abs() < 1e-3 && slope > 0.0);
                assert!((p * edge.sharp(u, along) - u.max(0.0).powf(exponent)).abs() < 1e-3);
            }
            // At the edge the sharp cusp is zero, the smoothed one (1/sin + cot) F(0).
            let [_, _, curvature] = response(exponent, 0.0);
            let (sine, cosine) = (PI * exponent).sin_cos();
            let cusp = -(1.0 + cosine) / sine * (at_edge - 0.5 * curvature) / at_edge;
            assert!((edge.cusp(0.0, along) - cusp).abs() < 1e-3 && slope > 0.0, "{along}: {cusp}");
        }
    }

    /// P(0) = 2^{s/2} Γ((s+1)/2)/(2√π).
    fn known_at_edge(exponent: f64) -> f64 {
        2f64.powf(0.5 * exponent) * libm::tgamma(0.5 * (exponent + 1.0)) / (2.0 * PI.sqrt())
    }
}
