//! Boundary of a contact spot under one indenter, between the samples.
//!
//! At a distance d inside the edge p = A√d, at a distance d outside the gap is g = (4A/3E*) d^{3/2} (E* of the surface
//! material): the edge of any smooth contact. Both sides together measure the signed distance from the edge,
//!
//! ψ = p²/A² inside,  ψ = −(3E*g/4A)^{2/3} outside,
//!
//! so that the edge is **interpolated** between samples on both sides. With d = r − ρ(θ), the distance from the present
//! boundary,
//!
//! ψ ≈ Σ_k [(α_k + β_k d) cos kθ + (α′_k + β′_k d) sin kθ] + γ d² + γ′ d|d|
//!
//! is fitted by least squares and ρ moves to the root, until it stands. The samples next to the edge carry the
//! discretisation error, which alternates from ring to ring: their weight rises smoothly with the distance. The fit
//! reaches a number of spacings that grows with the square root of the resolution, so that the radius converges faster
//! than the spacing.

use crate::least_squares;
use std::f64::consts::{PI, TAU};

/// A sample near a contact seen from its indenter's axis.
#[derive(Debug, Clone, Copy)]
pub struct Polar {
    /// Distance from the axis, a length.
    pub r: f64,
    /// Angle from the x axis, radians.
    pub theta: f64,
    /// Pressure, 0 outside contact.
    pub p: f64,
    /// Gap over the contact modulus of the surface material, 3E*g/4: a pressure times a length.
    pub opening: f64,
}

/// A closed boundary ρ(θ) around an indenter's axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// Radii at equally spaced angles from θ = 0, lengths.
    pub radii: Vec<f64>,
}

/// Angles at which a boundary is given.
const ANGLES: usize = 360;
/// Highest harmonic of the boundary.
const HARMONICS: usize = 6;
/// Fewest samples per radius for a fit.
const FEWEST: f64 = 3.0;
/// Distance from the edge, in spacings, over which the weight of a sample rises from zero to one.
const RISE: f64 = 2.5;
/// Largest distance of a located boundary from the counted radius, in spacings: beyond it the fit is not believed.
const BELIEF: f64 = 2.0;
/// Growth of the reach of a fit with the square root of the samples per radius, in spacings.
const REACH_GROWTH: f64 = 1.0;
/// Fits, each from the boundary of the last.
const ROUNDS: usize = 6;

impl Boundary {
    /// Boundary of the contact among `samples` (in contact and around it), each standing for `sample_area`, neighbours
    /// at most `spacing` apart.
    ///
    /// `None` when the spot has too few samples for a fit, or no simple boundary around the axis.
    pub fn locate(samples: &[Polar], sample_area: f64, spacing: f64) -> Option<Self> {
        let count = samples.iter().filter(|sample| sample.p > 0.0).count() as f64;
        let counted = (count * sample_area / PI).sqrt();
        let resolution = counted / sample_area.sqrt();
        if resolution < FEWEST {
            return None;
        }
        let reach = (RISE + REACH_GROWTH * resolution.sqrt()).min(0.6 * resolution) * spacing;
        let mut boundary = Self { radii: vec![counted; ANGLES] };
        for _ in 0..ROUNDS {
            boundary = boundary.refined(samples, reach, spacing)?;
            if boundary.radii.iter().any(|r| (r - counted).abs() > BELIEF * spacing + 0.3 * counted) {
                return None;
            }
        }
        Some(boundary)
    }

    /// The boundary fitted to the samples within `reach` of this one.
    fn refined(&self, samples: &[Polar], reach: f64, spacing: f64) -> Option<Self> {
        let near: Vec<(&Polar, f64)> = samples
            .iter()
            .map(|sample| (sample, (sample.r - self.radius(sample.theta)) / reach))
            .filter(|(_, d)| d.abs() < 1.0)
            .collect();
        // Four samples per unknown at least.
        let harmonics = HARMONICS.min(near.len() / 16);
        let waves = |theta: f64| {
            let pair = move |k: usize| <[f64; 2]>::from((k as f64 * theta).sin_cos());
            (1..=harmonics).flat_map(pair)
        };
        // A² from the samples in contact: p² ≈ −A² d (1 + κd), in units of the reach; A² varies around the spot.
        let inside = near.iter().filter(|(sample, _)| sample.p > 0.0);
        let slope_rows = inside.map(|(sample, d)| {
            let row = [d * d, d * d * d].into_iter().chain(waves(sample.theta).map(|wave| d * d * wave));
            (row.collect(), sample.p * sample.p * d)
        });
        let slopes = least_squares::fit(2 + 2 * harmonics, slope_rows)?;
        let square = |theta: f64| -slopes[0] - waves(theta).zip(&slopes[2..]).map(|(wave, c)| wave * c).sum::<f64>();
        let distance = |sample: &Polar| {
            let square = square(sample.theta);
            if sample.p > 0.0 {
                sample.p * sample.p / square
            } else {
                // (3E*g/4A)^{2/3} with A² = square/reach, over the reach.
                -(sample.opening.max(0.0) / (square.sqrt() * reach)).powf(2.0 / 3.0)
            }
        };
        if near.iter().any(|(sample, _)| square(sample.theta) <= 0.0) {
            return None;
        }
        let basis = |d: f64, theta: f64| -> Vec<f64> {
            let isotropic = [1.0, d, d * d, d * d.abs()];
            isotropic.into_iter().chain(waves(theta)).chain(waves(theta).map(|wave| d * wave)).collect()
        };
        let rise = RISE * spacing / reach;
        let rows = near.iter().map(|(sample, d)| {
            let weight = (d.abs() / rise).min(1.0);
            (basis(*d, sample.theta).into_iter().map(|x| weight * x).collect(), weight * distance(sample))
        });
        let c = least_squares::fit(4 + 4 * harmonics, rows)?;
        let (values, slopes) = c[4..].split_at(2 * harmonics);
        let sum = |constant: f64, coefficients: &[f64], theta: f64| -> f64 {
            constant + waves(theta).zip(coefficients).map(|(wave, c)| wave * c).sum::<f64>()
        };
        let shift = |index: usize| {
            let theta = TAU * index as f64 / ANGLES as f64;
            let (value, slope) = (sum(c[0], values, theta), sum(c[1], slopes, theta));
            // ψ falls outwards, about as −d.
            (slope < -0.2).then(|| -value / slope * reach)
        };
        let shifts = (0..ANGLES).map(shift).collect::<Option<Vec<f64>>>()?;
        // One round moves the edge by one spacing at most; all of it in proportion, so that it stays smooth.
        let largest = shifts.iter().fold(0.0, |most: f64, shift| most.max(shift.abs()));
        let part = (spacing / largest).min(1.0);
        Some(Self { radii: self.radii.iter().zip(shifts).map(|(radius, shift)| radius + part * shift).collect() })
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

    /// Samples of a contact with E* = 1 and a boundary `edge`(θ), pressure and gap of Hertz' contact of radius 1
    /// stretched onto it.
    fn spot(spacing: f64, edge: impl Fn(f64) -> f64) -> Vec<Polar> {
        let reach = (2.0 / spacing) as i32;
        let mut samples = Vec::new();
        for (i, j) in (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j))) {
            let (x, y) = ((f64::from(i) + 0.31) * spacing, (f64::from(j) - 0.17) * spacing);
            let (r, theta) = (x.hypot(y), y.atan2(x));
            let s = r / edge(theta);
            let (p, gap) = if s < 1.0 {
                (2.0 / PI * (1.0 - s * s).sqrt(), 0.0)
            } else {
                (0.0, 0.5 * s * s - 1.0 + ((2.0 - s * s) * (1.0 / s).asin() + (s * s - 1.0).sqrt()) / PI)
            };
            // A² goes as 1/edge, so that the gap goes as √edge⁻¹ d^{3/2}.
            samples.push(Polar { r, theta, p, opening: 0.75 * edge(theta) * gap });
        }
        samples
    }

    #[test]
    fn a_hertzian_contact_has_its_boundary() {
        for (spacing, tolerance) in [(0.25, 2e-2), (0.1, 2e-3), (0.05, 5e-4), (0.0125, 3e-5)] {
            let boundary = Boundary::locate(&spot(spacing, |_| 1.0), spacing * spacing, spacing).unwrap();
            assert!((boundary.area() / PI - 1.0).abs() < tolerance, "{spacing}: {}", boundary.area() / PI - 1.0);
        }
    }

    #[test]
    fn a_three_lobed_boundary_is_recovered() {
        let edge = |theta: f64| 1.0 + 0.03 * (3.0 * theta + 0.4).cos();
        let boundary = Boundary::locate(&spot(0.02, edge), 4e-4, 0.02).unwrap();
        for theta in [0.0, 1.0, 2.5, 4.4] {
            let error = boundary.radius(theta) / edge(theta) - 1.0;
            assert!(error.abs() < 5e-4, "{theta}: {error:e}");
        }
        let (least, largest) = boundary.extremes();
        assert!((least - 0.97).abs() < 5e-4 && (largest - 1.03).abs() < 5e-4);
    }

    #[test]
    fn a_spot_of_few_samples_has_no_located_boundary() {
        assert_eq!(Boundary::locate(&spot(0.5, |_| 1.0), 0.25, 0.5), None);
    }
}
