//! An edge of contact smoothed by a Gaussian.
//!
//! A pressure that ends like p = A√d, smoothed by a Gaussian of width w, becomes p̃ = A√w P(u), u = d/w, with
//!
//! P(u) = ∫₀^∞ √t φ(u − t) dt,  φ the normal density.
//!
//! p̃/(w|∇p̃|) = P/P′ increases with u on both sides of the edge: it gives the distance from the edge without A, and
//! whatever lies below the surface. √u/P(u) is then the ratio of the pressure to the smoothed one. A cusp A√d on the other side of
//! the edge becomes P − P″/2 under the smoothing of fourth order.

use std::sync::OnceLock;

/// Distances covered by the table, in widths.
const TABLE_SPAN: [f64; 2] = [-4.0, 12.0];
/// Number of intervals of the table.
const TABLE_INTERVALS: usize = 320;

/// Tables of P, P/P′ and P − P″/2.
#[derive(Debug)]
pub(super) struct SmoothedEdge {
    smoothed: Vec<f64>,
    ratio: Vec<f64>,
    fourth: Vec<f64>,
}

impl SmoothedEdge {
    /// The tables, computed at first use.
    pub fn shared() -> &'static Self {
        static SHARED: OnceLock<SmoothedEdge> = OnceLock::new();
        SHARED.get_or_init(Self::new)
    }

    fn new() -> Self {
        let place = |k: usize| TABLE_SPAN[0] + (TABLE_SPAN[1] - TABLE_SPAN[0]) * k as f64 / TABLE_INTERVALS as f64;
        let responses: Vec<[f64; 3]> = (0..=TABLE_INTERVALS).map(|k| response(place(k))).collect();
        Self {
            smoothed: responses.iter().map(|[p, ..]| *p).collect(),
            ratio: responses.iter().map(|[p, slope, _]| p / slope).collect(),
            fourth: responses.iter().map(|[p, _, curvature]| p - 0.5 * curvature).collect(),
        }
    }

    /// Distance u from the ratio P/P′, in widths, positive inside contact; clamped to the table.
    pub fn distance(&self, ratio: f64) -> f64 {
        let above = self.ratio.partition_point(|&r| r < ratio);
        if above == 0 || above > TABLE_INTERVALS {
            return if above == 0 { TABLE_SPAN[0] } else { TABLE_SPAN[1] };
        }
        let (low, high) = (self.ratio[above - 1], self.ratio[above]);
        let place = (above - 1) as f64 + (ratio - low) / (high - low);
        TABLE_SPAN[0] + (TABLE_SPAN[1] - TABLE_SPAN[0]) * place / TABLE_INTERVALS as f64
    }

    /// Whether |u| of the ratio P/P′ is less than `most`.
    pub fn is_within(&self, most: f64, ratio: f64) -> bool {
        let index =
            |u: f64| ((u - TABLE_SPAN[0]) / (TABLE_SPAN[1] - TABLE_SPAN[0]) * TABLE_INTERVALS as f64).round() as usize;
        self.ratio[index(-most)] < ratio && ratio < self.ratio[index(most)]
    }

    /// Ratio √u/P(u) of the pressure to the smoothed one at the distance u; 0 outside contact.
    pub fn sharp(&self, u: f64) -> f64 {
        if u <= 0.0 {
            return 0.0;
        }
        if u >= TABLE_SPAN[1] {
            return 1.0;
        }
        u.sqrt() / between(&self.smoothed, u)
    }

    /// Difference of a cusp √(−u)₊ A√w and the cusp under the smoothing of fourth order, over the smoothed pressure; within four
    /// widths of the edge.
    pub fn cusp(&self, u: f64) -> f64 {
        let u = u.clamp(TABLE_SPAN[0], -TABLE_SPAN[0]);
        ((-u).max(0.0).sqrt() - between(&self.fourth, -u)) / between(&self.smoothed, u)
    }
}

/// Value of a table at the distance u, linear between its entries.
fn between(table: &[f64], u: f64) -> f64 {
    let place = (u - TABLE_SPAN[0]) / (TABLE_SPAN[1] - TABLE_SPAN[0]) * TABLE_INTERVALS as f64;
    let k = (place as usize).min(TABLE_INTERVALS - 1);
    let rest = place - k as f64;
    (1.0 - rest) * table[k] + rest * table[k + 1]
}

/// P(u), P′(u) and P″(u): with t = s² the integrand is smooth, and the trapezoidal rule exact.
fn response(u: f64) -> [f64; 3] {
    const STEPS: usize = 600;
    let last = (u.max(0.0) + 9.0).sqrt();
    let step = last / STEPS as f64;
    let (mut value, mut slope, mut curvature) = (0.0, 0.0, 0.0);
    for k in 1..=STEPS {
        let s = k as f64 * step;
        let x = u - s * s;
        let weight = 2.0 * s * s * (-0.5 * x * x).exp();
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
        let edge = SmoothedEdge::new();
        // P(0) = ∫ √t φ dt = 2^{−3/4} Γ(3/4)/√π; linear interpolation in a table of steps 0.05 errs by some 1e-4.
        let [at_edge, ..] = response(0.0);
        assert!((at_edge - 0.411_089_5).abs() < 1e-6, "{at_edge}");
        for u in [-3.0, -1.01, -0.02, 0.33, 1.0, 2.72, 7.0] {
            let [p, slope, _] = response(u);
            assert!((edge.distance(p / slope) - u).abs() < 1e-3, "{u}: {}", edge.distance(p / slope));
            assert!((p * edge.sharp(u) - u.max(0.0).sqrt()).abs() < 1e-3, "{u}");
        }
        for u in [-2.0f64, -0.3, 0.0, 0.4, 1.7] {
            let ([p, ..], [q, _, curvature]) = (response(u), response(-u));
            let cusp = (-u).max(0.0).sqrt() - (q - 0.5 * curvature);
            assert!((p * edge.cusp(u) - cusp).abs() < 2e-3, "{u}: {} for {cusp}", p * edge.cusp(u));
        }
        assert_eq!((edge.distance(0.0), edge.distance(f64::INFINITY)), (TABLE_SPAN[0], TABLE_SPAN[1]));
    }
}
