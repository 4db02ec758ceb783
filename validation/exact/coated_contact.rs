//! One paraboloid r²/(2R) alone on a coated half-space: the integral equation of the contact.
//!
//! For P̃(q) = ∫ p r J₀(qr) dr = ∫₀ᵃ φ(t) cos(qt) dt, Abel's transformation of w(r) = δ − r²/(2R), r < a, gives
//! (Sneddon 1965 for T = 1; Lebedev & Ufliand 1958 for a layer)
//!
//! φ(x) + (2/π) ∫₀ᵃ K(x,t) φ(t) dt = (E₁*/π)(δ − x²/R),  K = ∫₀^∞ [T(qh) − 1] cos(qx) cos(qt) dq,
//!
//! φ(a) = 0 for a smooth indenter, which fixes δ. Then P = 2π ∫φ dt and p(r) = −∫ φ′(t)/√(t² − r²) dt from r to a. Gauss–Legendre
//! quadrature makes it a small linear system; K varies over the thickness, so that a few points for each thickness in the
//! radius, besides a few tens, give nine digits (`validation/thin-coatings`).

use super::coating::Coating;
use super::gauss_between;
use percoat_core::numeric::linear;
use std::f64::consts::PI;

/// Points of the quadrature over the contact, and more for each thickness in the radius.
const POINTS: usize = 48;
const PER_THICKNESS: f64 = 2.6;
/// Points of each panel of the quadrature over the wavenumber, and its largest qh: T − 1 has fallen below 1e-15.
const PANEL: usize = 24;
const REACH: f64 = 24.0;

/// The contact of a paraboloid of radius R = 1 on a coating.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoatedContact {
    /// Contact radius a, a length.
    pub radius: f64,
    /// Load P, a force; for another R divide by it.
    pub load: f64,
    /// Penetration δ, a length; for another R divide by it.
    pub penetration: f64,
    /// Pressure p(0) on the axis; for another R divide by it.
    pub peak: f64,
}

/// The density φ over the contact, and what follows from it.
struct Density {
    scale: f64,
    penetration: f64,
    /// φ at the points of the rule, with their abscissae and weights.
    rule: Vec<[f64; 2]>,
    phi: Vec<f64>,
    /// q, and its weight times (T − 1) P̃(q).
    waves: Vec<[f64; 2]>,
}

impl Density {
    fn new(coating: &Coating, radius: f64) -> Option<Self> {
        let points = POINTS + (PER_THICKNESS * radius / coating.thickness()) as usize;
        let rule = gauss_between(0.0, radius, points);
        let waves = waves(coating, radius);
        let cosines = |x: f64| -> Vec<f64> { waves.iter().map(|[q, _]| (q * x).cos()).collect() };
        let weighted = |cosines: &[f64]| -> Vec<f64> { waves.iter().zip(cosines).map(|([_, w], c)| w * c).collect() };
        let dot = |u: &[f64], v: &[f64]| u.iter().zip(v).map(|(u, v)| u * v).sum::<f64>();
        let inside: Vec<Vec<f64>> = rule.iter().map(|[x, _]| cosines(*x)).collect();
        let scale = coating.modulus() / PI;
        // φ = δ φ₁ − φ₂ with the right-hand sides 1 and x².
        let row = |i: usize| {
            let weighted_cosines = weighted(&inside[i]);
            let entry = |(t, &[_, weight]): (usize, &[f64; 2])| {
                f64::from(u8::from(i == t)) + 2.0 / PI * weight * dot(&weighted_cosines, &inside[t])
            };
            rule.iter().enumerate().map(entry).collect()
        };
        let rows: Vec<Vec<f64>> = (0..rule.len()).map(row).collect();
        let flat = linear::solve(rows.clone(), vec![scale; points])?;
        let curved = linear::solve(rows, rule.iter().map(|[x, _]| scale * x * x).collect())?;
        // φ(a) = 0, φ(a) from the equation itself.
        let at_edge = weighted(&cosines(radius));
        let edge: Vec<f64> = rule.iter().zip(&inside).map(|([_, w], c)| 2.0 / PI * w * dot(&at_edge, c)).collect();
        let penetration = (scale * radius * radius - dot(&edge, &curved)) / (scale - dot(&edge, &flat));
        let phi: Vec<f64> = flat.iter().zip(&curved).map(|(flat, curved)| penetration * flat - curved).collect();
        let loads: Vec<f64> = rule.iter().zip(&phi).map(|([_, weight], phi)| weight * phi).collect();
        let transform = |k: usize| inside.iter().zip(&loads).map(|(cosines, load)| cosines[k] * load).sum::<f64>();
        let waves = waves.iter().enumerate().map(|(k, &[q, weight])| [q, weight * transform(k)]).collect();
        Some(Self { scale, penetration, rule, phi, waves })
    }

    fn load(&self) -> f64 {
        2.0 * PI * self.rule.iter().zip(&self.phi).map(|([_, weight], phi)| weight * phi).sum::<f64>()
    }

    /// −φ′(x)/x = 2E₁*/π − (2/π) ∫ (T − 1) q² sin(qx)/(qx) P̃(q) dq.
    fn slope(&self, x: f64) -> f64 {
        let layer = self.waves.iter().map(|[q, p]| p * q * (q * x).sin() / x).sum::<f64>();
        2.0 * self.scale - 2.0 / PI * layer
    }

    /// p(r) = −∫ φ′(t)/√(t² − r²) dt from r to a, with s² = t² − r².
    fn pressure(&self, r: f64, radius: f64) -> f64 {
        if r >= radius {
            return 0.0;
        }
        let rule = gauss_between(0.0, (radius * radius - r * r).sqrt(), POINTS);
        rule.iter().map(|[s, weight]| weight * self.slope(s.hypot(r))).sum()
    }
}

impl CoatedContact {
    /// The contact of radius a (a length); `None` if its linear system is singular.
    pub fn new(coating: &Coating, radius: f64) -> Option<Self> {
        let density = Density::new(coating, radius)?;
        let (load, peak) = (density.load(), density.pressure(0.0, radius));
        Some(Self { radius, load, penetration: density.penetration, peak })
    }

    /// Pressures p(r) of the contact of radius a at distances r from the axis, of either sign; for another R divide by it.
    pub fn pressures(coating: &Coating, radius: f64, distances: &[f64]) -> Option<Vec<f64>> {
        let density = Density::new(coating, radius)?;
        Some(distances.iter().map(|r| density.pressure(r.abs(), radius)).collect())
    }
}

/// Wavenumbers q and their weights times T(qh) − 1: panels short against the period of cos(qa) and against 1/h.
fn waves(coating: &Coating, radius: f64) -> Vec<[f64; 2]> {
    let h = coating.thickness();
    let end = REACH / h;
    let panels = (end * (radius / 6.0 + h / 3.0)).ceil().max(4.0) as usize;
    let width = end / panels as f64;
    (0..panels)
        .flat_map(|panel| gauss_between(panel as f64 * width, (panel + 1) as f64 * width, PANEL))
        .map(|[q, weight]| [q, weight * (coating.correction(q * h) - 1.0)])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coating_of_the_substrates_material_gives_hertz() {
        let coating = Coating::new(1.0, [0.3, 0.3], 0.7).unwrap();
        let found = CoatedContact::new(&coating, 0.4).unwrap();
        let modulus = coating.modulus();
        assert!((found.load / (4.0 / 3.0 * modulus * 0.064) - 1.0).abs() < 1e-13, "{found:?}");
        assert!((found.penetration / 0.16 - 1.0).abs() < 1e-13);
        assert!((found.peak / (2.0 * modulus * 0.4 / PI) - 1.0).abs() < 1e-13);
        let pressures = CoatedContact::pressures(&coating, 0.4, &[0.0, -0.2, 0.4]).unwrap();
        assert!((pressures[1] / found.peak - 0.75f64.sqrt()).abs() < 1e-13 && pressures[2] == 0.0);
    }
}
