//! One indenter alone on a bare half-space (Galin 1946; Sneddon, Int. J. Eng. Sci. 3 (1965) 47). A contact of the radius a has
//!
//! δ = a ∫₀ᵃ f′(r)/√(a² − r²) dr,  P = 2E* ∫₀ᵃ r² f′(r)/√(a² − r²) dr.
//!
//! A sphere is taken as a paraboloid, which it is where its contact is small.

use super::{MeasuredTip, Shape};
use std::f64::consts::{FRAC_PI_2, PI};

/// Part of its radius up to which the contact of a sphere is that of a paraboloid.
const SMALL: f64 = 1e-3;
/// Points of the quadrature over a measured profile.
const POINTS: u32 = 200;
/// Halvings of an interval between a radius and twice of it.
const HALVINGS: usize = 40;
/// Doublings within which a contact radius is searched for.
const DOUBLINGS: usize = 400;

/// Laws by which profiles have their forces and penetrations.
enum Law<'a> {
    /// Profile c rⁿ, by c and n.
    Power(f64, f64),
    /// Sphere that goes over into a cone.
    SpheroCone { radius: f64, slope: f64 },
    /// Measured profile.
    Measured(&'a MeasuredTip),
}

impl Shape {
    /// Penetration δ of the contact of the radius `a`, a length, and its force over E*, a length squared.
    pub fn on_half_space(&self, a: f64) -> [f64; 2] {
        match self.law() {
            Law::Power(c, n) => {
                let penetration = kappa(n) * c * a.powf(n);
                [penetration, 2.0 * penetration * a * n / (n + 1.0)]
            }
            Law::SpheroCone { radius, slope } => sphero_cone(radius, slope, a),
            Law::Measured(tip) => measured(tip, a),
        }
    }

    /// Contact radius under a force over E*, a length squared; a length.
    pub fn radius_under(&self, force: f64) -> f64 {
        match self.law() {
            Law::Power(c, n) => (force * (n + 1.0) / (2.0 * n * kappa(n) * c)).powf(1.0 / (n + 1.0)),
            Law::SpheroCone { .. } | Law::Measured(_) => self.radius_where(1, force),
        }
    }

    /// Contact radius at a penetration; lengths.
    pub fn radius_at(&self, penetration: f64) -> f64 {
        match self.law() {
            Law::Power(c, n) => (penetration / (kappa(n) * c)).powf(1.0 / n),
            Law::SpheroCone { .. } | Law::Measured(_) => self.radius_where(0, penetration),
        }
    }

    /// Law of the profile; a sphere is a paraboloid where its contact is small.
    fn law(&self) -> Law<'_> {
        match *self {
            Self::Paraboloid { radius } | Self::Sphere { radius } => Law::Power(0.5 / radius, 2.0),
            Self::Cone { slope } => Law::Power(slope, 1.0),
            Self::Power { coefficient, exponent } => Law::Power(coefficient, exponent),
            Self::SpheroCone { radius, slope } => Law::SpheroCone { radius, slope },
            Self::Measured(ref tip) => Law::Measured(tip),
        }
    }

    /// Radius at which an entry of [`on_half_space`](Self::on_half_space), which rises, has a value.
    fn radius_where(&self, entry: usize, value: f64) -> f64 {
        if value.is_nan() || value <= 0.0 {
            return 0.0;
        }
        let exceeds = |a: f64| self.on_half_space(a)[entry] > value;
        let mut low = match self {
            Self::SpheroCone { radius, .. } => *radius,
            Self::Measured(tip) => tip.range()[1],
            _ => 1.0,
        };
        for _ in 0..DOUBLINGS {
            match [exceeds(low), exceeds(2.0 * low)] {
                [true, _] => low *= 0.5,
                [_, false] => low *= 2.0,
                _ => break,
            }
        }
        let mut ends = [low, 2.0 * low];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (ends[0] + ends[1]);
            ends[usize::from(exceeds(middle))] = middle;
        }
        0.5 * (ends[0] + ends[1])
    }
}

/// δ and P/E* under a sphere of the radius R that goes over into a cone of the slope s at b = R s/√(1 + s²), for a > b with S = √(R² − b²)
/// and T = √(a² − b²):
///
/// δ = a L + s a acos(b/a),  P/E* = (R² + a²) L − R a + S T + s (a² acos(b/a) + b T),  L = ln[(R + a)/(S + T)].
fn sphero_cone(radius: f64, slope: f64, a: f64) -> [f64; 2] {
    let rim = radius * slope / slope.hypot(1.0);
    // Where the terms cancel it is a paraboloid to 10⁻⁷.
    if a < rim.min(SMALL * radius) {
        return [a * a / radius, 4.0 / 3.0 * a.powi(3) / radius];
    }
    let b = rim.min(a);
    let [s, t] = [radius, a].map(|x| ((x - b) * (x + b)).sqrt());
    let logarithm = ((radius + a) / (s + t)).ln();
    let beside = slope * (b / a).acos();
    let penetration = a * (logarithm + beside);
    let force = (radius * radius + a * a) * logarithm - radius * a + s * t + a * a * beside + slope * b * t;
    [penetration, force]
}

/// δ and P/E* under a measured tip, with r = a sin θ.
fn measured(tip: &MeasuredTip, a: f64) -> [f64; 2] {
    let step = FRAC_PI_2 / f64::from(POINTS);
    let term = |k: u32| {
        let sine = ((f64::from(k) + 0.5) * step).sin();
        let slope = tip.slope(a * sine);
        [slope, 2.0 * sine * sine * slope]
    };
    let [penetration, force] = (0..POINTS).map(term).fold([0.0; 2], |sum, term| [sum[0] + term[0], sum[1] + term[1]]);
    [a * step * penetration, a * a * step * force]
}

/// κ_n = √π Γ(n/2 + 1)/Γ((n + 1)/2).
fn kappa(n: f64) -> f64 {
    PI.sqrt() * (libm::lgamma(0.5 * n + 1.0) - libm::lgamma(0.5 * (n + 1.0))).exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    /// Sneddon's integrals over r = a sin θ by many points.
    fn integrals(shape: &Shape, a: f64) -> [f64; 2] {
        let count = 200_000;
        let step = FRAC_PI_2 / f64::from(count);
        let mut sums = [0.0; 2];
        for theta in (0..count).map(|k| (f64::from(k) + 0.5) * step) {
            let slope = shape.slope(a * theta.sin());
            sums[0] += a * slope * step;
            sums[1] += 2.0 * a * a * theta.sin().powi(2) * slope * step;
        }
        sums
    }

    #[test]
    fn kappa_of_known_powers() {
        // κ of cone, paraboloid and r⁴: π/2, 2, 8/3; of √r: √π Γ(5/4)/Γ(3/4).
        for (n, expected) in [(0.5, 1.311_028_777), (1.0, FRAC_PI_2), (2.0, 2.0), (4.0, 8.0 / 3.0)] {
            assert!((kappa(n) / expected - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn closed_forms_are_sneddons_integrals() {
        let points: Vec<[f64; 2]> = [0.05, 0.1, 0.3, 0.7, 1.5].map(|h| [h, 24.5 * h * h + 3.0 * h]).to_vec();
        let tip = Shape::Measured(Arc::new(MeasuredTip::from_areas(&points).unwrap()));
        let blunt = Shape::SpheroCone { radius: 2.0, slope: 0.577 };
        for (shape, tolerance) in [
            (Shape::Paraboloid { radius: 0.7 }, 1e-6),
            (Shape::Cone { slope: 0.3 }, 1e-6),
            (Shape::Power { coefficient: 0.4, exponent: 2.6 }, 1e-6),
            (blunt.clone(), 1e-6),
            (tip, 1e-3),
        ] {
            for a in [0.05, 0.4, 0.99, 1.01, 3.0, 20.0] {
                let (found, known) = (shape.on_half_space(a), integrals(&shape, a));
                for k in 0..2 {
                    assert!((found[k] / known[k] - 1.0).abs() < tolerance, "{shape}, {a}: {found:?} {known:?}");
                }
                for radius in [shape.radius_under(found[1]), shape.radius_at(found[0])] {
                    assert!((radius / a - 1.0).abs() < 1e-9, "{shape}, {a}: {radius}");
                }
            }
        }
        // Near its apex a sphere as Hertz has it, far from it a cone.
        let [near, far] = [1e-3, 1e5].map(|a| blunt.on_half_space(a));
        assert!((near[0] / (1e-6 / 2.0) - 1.0).abs() < 1e-6 && (near[1] / (4.0 / 3.0 * 1e-9 / 2.0) - 1.0).abs() < 1e-6);
        assert!((far[0] / (FRAC_PI_2 * 0.577e5) - 1.0).abs() < 1e-4);
        assert_eq!(blunt.radius_under(0.0), 0.0);
    }
}
