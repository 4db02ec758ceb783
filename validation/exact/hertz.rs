//! A paraboloid r²/(2R) on a half-space: Hertz' contact and the stresses under it (Hertz 1882; Huber, Ann. Phys. 319
//! (1904) 153).
//!
//! a³ = 3PR/(4E*),  δ = a²/R,  p = p₀√(1 − r²/a²),  p₀ = 2E*a/(πR) = 3P/(2πa²).
//!
//! With lengths over a, stresses over p₀ and 2u = r² + z² − 1 + √((r² + z² − 1)² + 4z²), t = z/√u:
//!
//! σ_r = (1−2ν)(1−t³)/(3r²) + t³u/(u²+z²) + t[u(1−ν)/(1+u) + (1+ν)√u atan(1/√u) − 2],
//! σ_θ = −(1−2ν)(1−t³)/(3r²) − t[2ν + u(1−ν)/(1+u) − (1+ν)√u atan(1/√u)],
//! σ_z = −t³u/(u²+z²),  τ_rz = −rz²√u/[(1+u)(u²+z²)].

use std::f64::consts::PI;

/// Hertz' contact of a paraboloid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hertz {
    /// Contact radius a, a length.
    pub radius: f64,
    /// Load P, a force.
    pub load: f64,
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Largest pressure p₀.
    pub peak: f64,
}

impl Hertz {
    /// Contact of a paraboloid of radius R (a length) under the load P (a force) on a half-space with contact modulus E*.
    pub fn loaded(curvature_radius: f64, load: f64, modulus: f64) -> Self {
        let radius = (0.75 * load * curvature_radius / modulus).cbrt();
        Self {
            radius,
            load,
            penetration: radius * radius / curvature_radius,
            peak: 1.5 * load / (PI * radius * radius),
        }
    }
}

/// Stresses under Hertz' pressure, over p₀, positive in tension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stresses {
    /// σ_r.
    pub radial: f64,
    /// σ_θ.
    pub hoop: f64,
    /// σ_z.
    pub axial: f64,
    /// τ_rz.
    pub shear: f64,
}

impl Stresses {
    /// Stresses at the radius r ≥ 0 and the depth z ≥ 0, both over a, for Poisson's ratio ν.
    pub fn at(r: f64, z: f64, nu: f64) -> Self {
        let s = r * r + z * z - 1.0;
        let root = (s * s + 4.0 * z * z).sqrt();
        // On the surface inside the contact u = 0: t = √(1 − r²), t³u/(u² + z²) = t.
        let inside = z == 0.0 && r <= 1.0;
        // The form that does not cancel.
        let u = match s {
            _ if inside => 0.0,
            s if s > 0.0 => 0.5 * (s + root),
            s => 2.0 * z * z / (root - s),
        };
        let root = u.sqrt();
        let t = if inside { (1.0 - r * r).sqrt() } else { z / root };
        let fall = if inside { t } else { t.powi(3) * u / (u * u + z * z) };
        let spread = if inside { 0.0 } else { (1.0 + nu) * root * (1.0 / root).atan() };
        // (1 − t³)/(3r²) near the axis: t² = 1 − r²/(1 + z²) + ….
        let bulge = if r < 1e-4 {
            0.5 * (1.0 - 2.0 * nu) / (1.0 + z * z)
        } else {
            (1.0 - 2.0 * nu) / 3.0 * (1.0 - t.powi(3)) / (r * r)
        };
        let middle = u * (1.0 - nu) / (1.0 + u);
        let shear = if z == 0.0 { 0.0 } else { -r * z * z * root / ((1.0 + u) * (u * u + z * z)) };
        Self {
            radial: bulge + fall + t * (middle + spread - 2.0),
            hoop: -bulge - t * (2.0 * nu + middle - spread),
            axial: -fall,
            shear,
        }
    }

    /// Principal shear stress τ₁.
    pub fn tau1(&self) -> f64 {
        let (mean, half) = (0.5 * (self.radial + self.axial), 0.5 * (self.radial - self.axial));
        let arm = half.hypot(self.shear);
        let largest = (mean + arm).max(self.hoop);
        let least = (mean - arm).min(self.hoop);
        0.5 * (largest - least)
    }
}

/// Largest principal shear stress τ₁/p₀ and its depth z/a: it stands on the axis, found there by golden sections.
pub fn largest_shear(nu: f64) -> [f64; 2] {
    let tau1 = |z: f64| Stresses::at(0.0, z, nu).tau1();
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let [mut low, mut high] = [0.2, 1.0];
    for _ in 0..60 {
        let [left, right] = [high - golden * (high - low), low + golden * (high - low)];
        if tau1(left) > tau1(right) {
            high = right;
        } else {
            low = left;
        }
    }
    let depth = 0.5 * (low + high);
    [tau1(depth), depth]
}

/// Largest tension over p₀: σ_r at the edge of contact, (1 − 2ν)/3.
pub fn edge_tension(nu: f64) -> f64 {
    (1.0 - 2.0 * nu) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_the_edge_and_the_outside_have_their_simpler_forms() {
        let nu = 0.3;
        for z in [0.1f64, 0.5, 2.0] {
            let found = Stresses::at(0.0, z, nu);
            let fall = 1.0 / (1.0 + z * z);
            let lateral = -(1.0 + nu) * (1.0 - z * (1.0 / z).atan()) + 0.5 * fall;
            assert!((found.axial + fall).abs() < 1e-14, "z = {z}: {found:?}");
            assert!((found.radial - lateral).abs() < 1e-14 && (found.hoop - lateral).abs() < 1e-14);
        }
        let edge = Stresses::at(1.0, 0.0, nu);
        assert!((edge.radial - edge_tension(nu)).abs() < 1e-14 && (edge.hoop + edge.radial).abs() < 1e-14);
        let outside = Stresses::at(1.5, 0.0, nu);
        assert!((outside.radial - edge_tension(nu) / 2.25).abs() < 1e-14, "{outside:?}");
        assert!((outside.hoop + outside.radial).abs() < 1e-14 && outside.axial == 0.0);
        let centre = Stresses::at(0.0, 0.0, nu);
        assert!((centre.radial + 0.5 * (1.0 + 2.0 * nu)).abs() < 1e-14 && (centre.axial + 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_surface_is_the_limit_from_below() {
        for r in [0.3, 0.7, 0.99, 1.01, 1.7] {
            let [on, below] = [0.0, 1e-9].map(|z| Stresses::at(r, z, 0.25));
            for (a, b) in [(on.radial, below.radial), (on.hoop, below.hoop), (on.axial, below.axial)] {
                assert!((a - b).abs() < 1e-6, "r = {r}: {on:?} {below:?}");
            }
        }
    }

    #[test]
    fn stresses_balance() {
        // ∂σ_r/∂r + ∂τ/∂z + (σ_r − σ_θ)/r = 0, ∂τ/∂r + ∂σ_z/∂z + τ/r = 0 by central differences.
        let step = 1e-5;
        for [r, z] in [[0.4, 0.3], [1.0, 0.2], [1.6, 0.9]] {
            let at = |dr: f64, dz: f64| Stresses::at(r + dr * step, z + dz * step, 0.3);
            let [e, w, s, n] = [at(1.0, 0.0), at(-1.0, 0.0), at(0.0, 1.0), at(0.0, -1.0)];
            let here = at(0.0, 0.0);
            let slope = |a: f64, b: f64| (a - b) / (2.0 * step);
            let radial = slope(e.radial, w.radial) + slope(s.shear, n.shear) + (here.radial - here.hoop) / r;
            let axial = slope(e.shear, w.shear) + slope(s.axial, n.axial) + here.shear / r;
            assert!(radial.abs() < 1e-7 && axial.abs() < 1e-7, "({r}, {z}): {radial:e} {axial:e}");
        }
    }

    #[test]
    fn the_largest_shear_has_its_tabulated_values() {
        // Maximum of the closed axis stresses, found in high precision. ν, τ₁/p₀, z/a.
        for [nu, tau1, depth] in [
            [0.20, 0.333648, 0.447810],
            [0.25, 0.321678, 0.464313],
            [0.30, 0.310021, 0.480864],
            [0.40, 0.287607, 0.514175],
            [0.50, 0.266349, 0.547868],
        ] {
            let [found, at] = largest_shear(nu);
            assert!((found - tau1).abs() < 1e-6 && (at - depth).abs() < 1e-6, "ν = {nu}: {found} at {at}");
        }
    }
}
