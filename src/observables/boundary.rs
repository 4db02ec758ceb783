//! Boundary of a contact spot under one indenter, between the samples.
//!
//! Near the edge p² vanishes linearly. With s = r² from the indenter's axis,
//!
//! p²(r, θ) ≈ Σ_k (α_k + β_k s) cos kθ + (α′_k + β′_k s) sin kθ + γ s²
//!
//! is fitted by least squares to the samples of an annulus inside the edge; its root s(θ) gives the radius ρ(θ) = √s and the area
//! ½∮ s dθ. For Hertz' pressure the form is exact. The outermost samples carry the discretisation error, which alternates from ring
//! to ring: their weight rises smoothly from zero half a spacing inside the edge to one three spacings further in. The annulus
//! narrows with the square root of the resolution, so that the radius converges faster than the spacing.

use crate::least_squares;
use std::f64::consts::{PI, TAU};

/// A contact sample seen from its indenter's axis.
#[derive(Debug, Clone, Copy)]
pub struct Polar {
    /// Distance from the axis, a length.
    pub r: f64,
    /// Angle from the x axis, radians.
    pub theta: f64,
    /// Pressure.
    pub p: f64,
}

/// A closed boundary ρ(θ) around an indenter's axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// Radii at equally spaced angles from θ = 0, lengths.
    pub radii: Vec<f64>,
}

/// Where the boundary is sought.
struct Annulus {
    /// Width over the radius.
    width: f64,
    /// Distance of neighbouring samples.
    spacing: f64,
    /// Radius of the disc with as many samples.
    scale: f64,
    /// Whether the fit contains γ s².
    curved: bool,
}

/// Angles at which a boundary is given.
const ANGLES: usize = 360;
/// Highest harmonic of the boundary.
const HARMONICS: usize = 6;
/// Fewest samples per radius for a fit, and for a fit with the term γ s².
const FEWEST: f64 = 4.0;
const FEWEST_CURVED: f64 = 16.0;
/// Distances from the edge, in spacings: where the weight of a sample starts, and over which it rises to one.
const MARGIN: f64 = 0.5;
const RISE: f64 = 3.0;

impl Boundary {
    /// Boundary of the contact made of `samples`, each standing for `sample_area`, neighbours at most `spacing` apart.
    ///
    /// `None` when the spot has too few samples for a fit, or no simple boundary around the axis.
    pub fn locate(samples: &[Polar], sample_area: f64, spacing: f64) -> Option<Self> {
        let counted = (samples.len() as f64 * sample_area / PI).sqrt();
        let resolution = counted / sample_area.sqrt();
        if resolution < FEWEST {
            return None;
        }
        let annulus = Annulus {
            width: 0.4 * (20.0 / resolution).sqrt().min(1.0),
            spacing,
            scale: counted,
            curved: resolution > FEWEST_CURVED,
        };
        let mut boundary = Self { radii: vec![counted; ANGLES] };
        for _ in 0..4 {
            boundary = boundary.refined(samples, &annulus)?;
        }
        Some(boundary)
    }

    /// The boundary fitted to the annulus inside this one.
    fn refined(&self, samples: &[Polar], annulus: &Annulus) -> Option<Self> {
        let weight = |sample: &Polar| {
            let edge = self.radius(sample.theta);
            let inside = (edge - sample.r) / annulus.spacing - MARGIN;
            let inner = (1.0 - annulus.width) * edge - MARGIN * annulus.spacing;
            if sample.r > inner { (inside / RISE).clamp(0.0, 1.0) } else { 0.0 }
        };
        let window: Vec<(&Polar, f64)> =
            samples.iter().map(|sample| (sample, weight(sample))).filter(|(_, weight)| *weight > 0.0).collect();
        // Four samples per unknown at least.
        let harmonics = (window.len() as i64 / 4 - 3) / 4;
        let harmonics = HARMONICS.min(usize::try_from(harmonics).ok()?);
        let radial = if annulus.curved { 3 } else { 2 };
        let scale = annulus.scale;
        let basis = |r: f64, theta: f64| {
            let s = (r / scale).powi(2) - 1.0;
            let mut row = [1.0, s, s * s][..radial].to_vec();
            for k in 1..=harmonics {
                let (sine, cosine) = (k as f64 * theta).sin_cos();
                row.extend([cosine, s * cosine, sine, s * sine]);
            }
            row
        };
        let peak = window.iter().map(|(sample, _)| sample.p).fold(0.0, f64::max);
        let rows = window.iter().map(|(sample, weight)| {
            let row = basis(sample.r, sample.theta).into_iter().map(|x| weight * x).collect();
            (row, weight * (sample.p / peak).powi(2))
        });
        let c = least_squares::fit(radial + 4 * harmonics, rows)?;
        let radii = (0..ANGLES)
            .map(|index| {
                let theta = TAU * index as f64 / ANGLES as f64;
                // c₀ + c₁s + c₂s² at this angle, and its root nearest to zero, falling outwards.
                let (at_zero, at_one) = (basis(scale, theta), basis(scale * 2f64.sqrt(), theta));
                let value = |row: &[f64]| -> f64 { row.iter().zip(&c).map(|(x, c)| x * c).sum() };
                let (c0, c2) = (value(&at_zero), if annulus.curved { c[2] } else { 0.0 });
                let c1 = value(&at_one) - c0 - c2;
                let discriminant = c1 * c1 - 4.0 * c0 * c2;
                if c1 >= 0.0 || discriminant < 0.0 {
                    return None;
                }
                let s = 2.0 * c0 / (-c1 + discriminant.sqrt());
                (s > -0.9 && s < 3.0).then(|| scale * (1.0 + s).sqrt())
            })
            .collect::<Option<Vec<f64>>>()?;
        Some(Self { radii })
    }

    /// ρ(θ), linear between the angles.
    pub fn radius(&self, theta: f64) -> f64 {
        let count = self.radii.len();
        let place = theta.rem_euclid(TAU) / TAU * count as f64;
        let (before, rest) = (place as usize % count, place.fract());
        (1.0 - rest) * self.radii[before] + rest * self.radii[(before + 1) % count]
    }

    /// Area ½∮ρ² dθ.
    pub fn area(&self) -> f64 {
        PI * self.radii.iter().map(|r| r * r).sum::<f64>() / self.radii.len() as f64
    }

    /// Smallest and largest radius.
    pub fn extremes(&self) -> (f64, f64) {
        let least = self.radii.iter().copied().fold(f64::INFINITY, f64::min);
        (least, self.radii.iter().copied().fold(0.0, f64::max))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(spacing: f64, pressure: impl Fn(f64, f64) -> f64) -> Vec<Polar> {
        let reach = (1.5 / spacing) as i32;
        let mut samples = Vec::new();
        for (i, j) in (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j))) {
            let (x, y) = ((f64::from(i) + 0.31) * spacing, (f64::from(j) - 0.17) * spacing);
            let (r, theta) = (x.hypot(y), y.atan2(x));
            let p = pressure(r, theta);
            if p > 0.0 {
                samples.push(Polar { r, theta, p });
            }
        }
        samples
    }

    #[test]
    fn a_hertzian_pressure_has_its_exact_boundary() {
        let samples = spot(0.1, |r, _| (1.0 - r * r).max(0.0).sqrt());
        let boundary = Boundary::locate(&samples, 0.01, 0.1).unwrap();
        assert!((boundary.area() / PI - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_three_lobed_boundary_is_recovered() {
        let edge = |theta: f64| 1.0 + 0.03 * (3.0 * theta + 0.4).cos();
        let samples = spot(0.02, |r, theta| (1.0 - (r / edge(theta)).powi(2)).max(0.0).sqrt());
        let boundary = Boundary::locate(&samples, 4e-4, 0.02).unwrap();
        for theta in [0.0, 1.0, 2.5, 4.4] {
            assert!((boundary.radius(theta) / edge(theta) - 1.0).abs() < 1e-3);
        }
        let (least, largest) = boundary.extremes();
        assert!((least - 0.97).abs() < 1e-3 && (largest - 1.03).abs() < 1e-3);
    }

    #[test]
    fn a_spot_of_few_samples_has_no_located_boundary() {
        let samples = spot(0.4, |r, _| (1.0 - r * r).max(0.0).sqrt());
        assert_eq!(Boundary::locate(&samples, 0.16, 0.4), None);
    }
}
