//! The edge of contact seen through a Gaussian.
//!
//! A pressure that ends like p = A√d, smoothed by a Gaussian of width w, becomes p̃ = A√w P(u), u = d/w, with
//!
//! P(u) = ∫₀^∞ √t φ(u − t) dt,  φ the normal density.
//!
//! p̃/(w|∇p̃|) = P/P′ grows with u on both sides of the edge: it tells the distance from the edge without A, and whatever
//! lies below the surface. √u/P(u) is then what the pressure itself is of the smoothed one.

/// Distances covered, in widths.
const SPAN: [f64; 2] = [-4.0, 12.0];
/// Intervals of the table.
const INTERVALS: usize = 320;

/// P and P/P′ as tables.
#[derive(Debug)]
pub(super) struct Edge {
    smoothed: Vec<f64>,
    ratio: Vec<f64>,
}

impl Edge {
    pub fn new() -> Self {
        let place = |k: usize| SPAN[0] + (SPAN[1] - SPAN[0]) * k as f64 / INTERVALS as f64;
        let (smoothed, slope): (Vec<f64>, Vec<f64>) = (0..=INTERVALS).map(|k| response(place(k))).unzip();
        let ratio = smoothed.iter().zip(slope).map(|(p, slope)| p / slope).collect();
        Self { smoothed, ratio }
    }

    /// u, positive inside contact, from P/P′; clamped to the table.
    pub fn distance(&self, ratio: f64) -> f64 {
        let above = self.ratio.partition_point(|&r| r < ratio);
        if above == 0 || above > INTERVALS {
            return if above == 0 { SPAN[0] } else { SPAN[1] };
        }
        let (low, high) = (self.ratio[above - 1], self.ratio[above]);
        let place = (above - 1) as f64 + (ratio - low) / (high - low);
        SPAN[0] + (SPAN[1] - SPAN[0]) * place / INTERVALS as f64
    }

    /// Whether the distance that belongs to P/P′ is less than `most` either way.
    pub fn is_within(&self, most: f64, ratio: f64) -> bool {
        let index = |u: f64| ((u - SPAN[0]) / (SPAN[1] - SPAN[0]) * INTERVALS as f64).round() as usize;
        self.ratio[index(-most)] < ratio && ratio < self.ratio[index(most)]
    }

    /// The pressure over the smoothed one at the distance u: √u/P(u), and 0 outside.
    pub fn sharp(&self, u: f64) -> f64 {
        if u <= 0.0 {
            return 0.0;
        }
        if u >= SPAN[1] {
            return 1.0;
        }
        let place = (u - SPAN[0]) / (SPAN[1] - SPAN[0]) * INTERVALS as f64;
        let (k, rest) = (place as usize, place.fract());
        u.sqrt() / ((1.0 - rest) * self.smoothed[k] + rest * self.smoothed[k + 1])
    }
}

/// P(u) and P′(u): with t = s² the integrand is smooth, and the trapezoidal rule exact.
fn response(u: f64) -> (f64, f64) {
    const STEPS: usize = 600;
    let last = (u.max(0.0) + 9.0).sqrt();
    let step = last / STEPS as f64;
    let (mut value, mut slope) = (0.0, 0.0);
    for k in 1..=STEPS {
        let s = k as f64 * step;
        let x = u - s * s;
        let weight = 2.0 * s * s * (-0.5 * x * x).exp();
        value += weight;
        slope -= x * weight;
    }
    let scale = step / std::f64::consts::TAU.sqrt();
    (scale * value, scale * slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_is_found_at_its_distance_and_sharpened_to_its_square_root() {
        let edge = Edge::new();
        // P(0) = ∫ √t φ dt = 2^{−3/4} Γ(3/4)/√π; linear interpolation in a table of steps 0.05 errs by some 1e-4.
        let (at_edge, _) = response(0.0);
        assert!((at_edge - 0.411_089_5).abs() < 1e-6, "{at_edge}");
        for u in [-3.0, -1.01, -0.02, 0.33, 1.0, 2.72, 7.0] {
            let (p, slope) = response(u);
            assert!((edge.distance(p / slope) - u).abs() < 1e-3, "{u}: {}", edge.distance(p / slope));
            assert!((p * edge.sharp(u) - u.max(0.0).sqrt()).abs() < 1e-3, "{u}");
        }
        assert_eq!((edge.distance(0.0), edge.distance(f64::INFINITY)), (SPAN[0], SPAN[1]));
    }
}
