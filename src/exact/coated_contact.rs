//! One paraboloid r²/(2R) alone on a coated half-space: the integral equation of the contact.
//!
//! With P̃(q) = ∫ p r J₀(qr) dr = ∫₀ᵃ φ(t) cos(qt) dt, Abel's transformation of w(r) = δ − r²/(2R), r < a, gives (Sneddon
//! 1965 for T = 1; Lebedev & Ufliand 1958 for a layer)
//!
//! φ(x) + (2/π) ∫₀ᵃ K(x,t) φ(t) dt = (E₁*/π)(δ − x²/R),  K = ∫₀^∞ [T(qh) − 1] cos(qx) cos(qt) dq,
//!
//! φ(a) = 0 for a smooth indenter, which fixes δ. Then P = 2π ∫φ dt and p(0) = −∫ φ′(t)/t dt. Gauss–Legendre
//! quadrature makes it a small linear system; K is smooth, so a few tens of points give ten digits.

use super::coating::Coating;
use super::linear;
use super::quadrature::rule;
use std::f64::consts::PI;

/// Points of the quadrature over the contact.
const POINTS: usize = 48;
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

impl CoatedContact {
    /// The contact of radius a (a length); `None` if its linear system is singular.
    pub fn new(coating: &Coating, radius: f64) -> Option<Self> {
        let rule = rule(0.0, radius, POINTS);
        let waves = waves(coating, radius);
        let kernel = |x: f64, t: f64| waves.iter().map(|[q, w]| w * (q * x).cos() * (q * t).cos()).sum::<f64>();
        let scale = coating.modulus() / PI;
        // φ = δ φ₁ − φ₂ with the right-hand sides 1 and x².
        let rows: Vec<Vec<f64>> = rule
            .iter()
            .map(|&[x, _]| {
                rule.iter().map(|&[t, weight]| f64::from(u8::from(x == t)) + 2.0 / PI * weight * kernel(x, t)).collect()
            })
            .collect();
        let flat = linear::solve(rows.clone(), vec![scale; POINTS])?;
        let curved = linear::solve(rows, rule.iter().map(|[x, _]| scale * x * x).collect())?;
        let integral = |phi: &[f64], f: &dyn Fn(f64) -> f64| -> f64 {
            rule.iter().zip(phi).map(|(&[t, weight], phi)| weight * phi * f(t)).sum()
        };
        // φ(a) = 0, φ(a) from the equation itself.
        let edge = |t: f64| 2.0 / PI * kernel(radius, t);
        let penetration = (scale * radius * radius - integral(&curved, &edge)) / (scale - integral(&flat, &edge));
        let phi: Vec<f64> = flat.iter().zip(&curved).map(|(flat, curved)| penetration * flat - curved).collect();
        // −φ′(x)/x = 2E₁*/π − (2/π) Σ_q (T − 1) q² sin(qx)/(qx) P̃(q).
        let transform: Vec<f64> = waves.iter().map(|[q, _]| integral(&phi, &|t| (q * t).cos())).collect();
        let slope = |x: f64| {
            let layer = waves.iter().zip(&transform).map(|([q, w], p)| w * p * q * (q * x).sin() / x).sum::<f64>();
            2.0 * scale - 2.0 / PI * layer
        };
        let peak = rule.iter().map(|&[x, weight]| weight * slope(x)).sum();
        Some(Self { radius, load: 2.0 * PI * integral(&phi, &|_| 1.0), penetration, peak })
    }
}

/// Wavenumbers q and their weights times T(qh) − 1: panels short against the period of cos(qa) and against 1/h.
fn waves(coating: &Coating, radius: f64) -> Vec<[f64; 2]> {
    let h = coating.thickness();
    let end = REACH / h;
    let panels = (end * (radius / 6.0 + h / 3.0)).ceil().max(4.0) as usize;
    let width = end / panels as f64;
    (0..panels)
        .flat_map(|panel| rule(panel as f64 * width, (panel + 1) as f64 * width, PANEL))
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
    }
}
