//! The fit of one rim of a contact to the samples beside it, by iteration, and its error.

use super::beside::Beside;
use super::clearance::{SECTORS, clearance};
use super::constants::{COUNTED_ERROR, HARMONICS, MAX_ITERATIONS, MAX_SHIFT, MIN_RESOLUTION, WEIGHT_RISE};
use super::counted_rim::counted_rim;
use super::rim::Rim;
use super::spot::{ContactSamples, PolarSpot};
use crate::numeric::closed_line::{ANGLES, mean_radius};
use std::f64::consts::PI;

/// The samples and the terms of a fit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    /// Largest distance of a sample from the edge, a length.
    pub reach: f64,
    /// Weight of samples in contact; 0: the gap alone.
    pub inside: f64,
    /// Number of powers of d that modify φ and γ.
    pub powers: usize,
    /// Highest harmonic of the boundary.
    pub harmonics: usize,
    /// Distance over which samples lie open beside the rim in each of equal sectors, lengths.
    pub clearance: [f64; SECTORS],
}

/// Highest harmonics of the boundary, and the distance in spacings by which a sample may lie on its wrong side: the first that
/// leave none farther are taken. Contacts about to merge are polygons.
const HIGHEST_HARMONICS: [(usize, f64); 2] = [(HARMONICS, 0.5), (12, 1.0)];
/// Weight of the pressure's samples beside the gap's where both are fitted.
const PRESSURE_WEIGHT: f64 = 0.1;
/// Part of the way to the middle between two contacts over which the gap is that of one edge.
const ONE_EDGE: f64 = 0.4;
/// Part of the samples outside the edge that must be there for a fit of the gap alone.
const ENOUGH_OPEN: f64 = 0.6;
/// Iterations after which a fit may diverge: one that changes the boundary by more than [`DIVERGENT_CHANGE`] spacings and by more
/// than half as much as the one before.
const FREE_ITERATIONS: usize = 2;
/// Change of the boundary in one iteration, in spacings, from which on a fit may diverge.
const DIVERGENT_CHANGE: f64 = 0.5;
/// Change of the boundary in one iteration, in spacings, below which a fit has converged.
const TOLERANCE: f64 = 1e-4;
/// Term that an error estimate adds to the differences of readings, in spacings.
const ERROR_FLOOR: f64 = 0.01;

/// Radii of a rim, and the estimated error of their mean; lengths. `None` where no fit converges near the counted rim.
pub(super) fn located(spot: &PolarSpot<'_>, samples: &ContactSamples<'_>, rim: Rim) -> Option<(Vec<f64>, f64)> {
    let (start, radius) = counted_rim(spot, samples.sample_area, rim);
    if samples.resolution(radius) < MIN_RESOLUTION {
        return None;
    }
    let (reach, clearance) = (samples.reach(radius), clearance(spot, rim, &start, samples.spacing));
    let mut beside = Beside::new(spot, samples, rim, reach, &start);
    // No boundary that is near enough to the counted one leaves its samples on the right side.
    if beside.is_astray(&start, largest_shift(&start, samples.spacing) + samples.spacing) {
        return None;
    }
    HIGHEST_HARMONICS.into_iter().find_map(|(harmonics, astray)| {
        let whole = Fit { reach, inside: 0.0, powers: 2, harmonics, clearance };
        let (best, radii) = whole.best(&mut beside, &start)?;
        beside.follow(&radii);
        if beside.is_astray(&radii, astray * samples.spacing) {
            return None;
        }
        let error = if samples.errors { whole.error(best, &mut beside, &start, &radii) } else { 0.0 };
        Some((radii, error))
    })
}

/// Largest distance of a boundary from the counted one, a length: beyond it the fit is rejected.
fn largest_shift(counted: &[f64], spacing: f64) -> f64 {
    MAX_SHIFT * spacing + 0.1 * mean_radius(counted)
}

/// The largest distance of two lines, a length.
fn farthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

impl Fit {
    /// The readings of a rim, the best one first: from the gap alone, from gap and pressure, and from both without κ′.
    fn readings(self) -> [Self; 3] {
        let both = Self { inside: PRESSURE_WEIGHT, ..self };
        [self, both, Self { powers: 1, ..both }]
    }

    /// The best reading that converges: its index and the radii, lengths.
    fn best(self, beside: &mut Beside<'_>, start: &[f64]) -> Option<(usize, Vec<f64>)> {
        let mut readings = self.readings().into_iter().enumerate();
        readings.find_map(|(index, fit)| {
            Some((index, fit.has_samples(beside, start).then(|| fit.converged(beside, start))??))
        })
    }

    /// Error of the best reading, which has converged to `radii`: from its differences to two other readings, a length.
    fn error(self, best: usize, beside: &mut Beside<'_>, start: &[f64], radii: &[f64]) -> f64 {
        let spacing = beside.samples().spacing;
        let half = Self { reach: (0.5 * (self.reach + WEIGHT_RISE * spacing)).min(self.reach), powers: 1, ..self };
        let mean = mean_radius(radii);
        let mut difference = |other: Self| {
            let there = other.has_samples(beside, start).then(|| other.moved(beside, start, radii))??;
            Some((mean_radius(&there) - mean).abs())
        };
        // A reading that fails counts as one that errs as a counted radius does.
        let spread = [Some(half), self.readings().get(best + 1).copied()]
            .map(|other| other.and_then(&mut difference).unwrap_or(COUNTED_ERROR * spacing));
        1.5 * spread[0].max(spread[1]) + ERROR_FLOOR * spacing
    }

    /// Radii of the converged fit, iterated from the `counted` ones; `None` if it moves far from these or diverges.
    fn converged(&self, beside: &mut Beside<'_>, counted: &[f64]) -> Option<Vec<f64>> {
        let spacing = beside.samples().spacing;
        let (mut radii, mut amplitude, mut last) = (counted.to_vec(), Vec::new(), f64::INFINITY);
        for iteration in 0..MAX_ITERATIONS {
            let before = std::mem::take(&mut radii);
            radii = self.iterate(beside, counted, &before, &mut amplitude)?;
            let change = farthest(&radii, &before);
            if change < TOLERANCE * spacing {
                return Some(radii);
            }
            if iteration >= FREE_ITERATIONS && change > (DIVERGENT_CHANGE * spacing).max(0.5 * last) {
                return None;
            }
            last = change;
        }
        Some(radii)
    }

    /// Radii of the nearly converged fit, from those of another one: changes below the floor of the error do not count.
    fn moved(&self, beside: &mut Beside<'_>, counted: &[f64], from: &[f64]) -> Option<Vec<f64>> {
        let mut amplitude = Vec::new();
        let radii = self.iterate(beside, counted, from, &mut amplitude)?;
        if farthest(&radii, from) < ERROR_FLOOR * beside.samples().spacing {
            return Some(radii);
        }
        self.iterate(beside, counted, &radii, &mut amplitude)
    }

    /// One iteration: the boundary fitted around `radii`; `None` if it moves far from the `counted` one.
    fn iterate(
        &self,
        beside: &mut Beside<'_>,
        counted: &[f64],
        radii: &[f64],
        amplitude: &mut Vec<f64>,
    ) -> Option<Vec<f64>> {
        beside.follow(radii);
        let radii = self.refined(beside, radii, amplitude)?;
        let bound = largest_shift(counted, beside.samples().spacing);
        // A radius that is not a number counts as far.
        radii.iter().zip(counted).all(|(radius, counted)| (radius - counted).abs() < bound).then_some(radii)
    }

    /// Distance outside the edge over which the gap at an angle, given by its index, is that of this edge; a length.
    pub(super) fn one_edge_reach(&self, index: usize) -> f64 {
        self.reach.min(ONE_EDGE * self.clearance[index * SECTORS / ANGLES])
    }

    /// Whether there are samples enough: those in contact take part, or most of the places outside the edge within reach have
    /// samples, and these are open.
    fn has_samples(&self, beside: &Beside<'_>, radii: &[f64]) -> bool {
        if self.inside > 0.0 {
            return true;
        }
        let (mean, sign) = (mean_radius(radii), beside.rim().sign());
        let whole = sign * PI * ((mean + sign * self.reach).powi(2) - mean * mean);
        let near = |sector: usize| {
            let range = 0.0..self.one_edge_reach(sector);
            beside.points(sector, true).iter().filter(|point| range.contains(&beside.distance(point, radii))).count()
        };
        beside.filled().iter().map(|&sector| near(sector)).sum::<usize>() as f64 * beside.samples().sample_area
            > ENOUGH_OPEN * whole
    }
}
