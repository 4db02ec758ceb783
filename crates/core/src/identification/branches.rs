//! Signs that a record is not elastic loading: a force that falls, and a hold under which the penetration goes on.
//!
//! Noise of a record x₁, x₂, … is read off its second differences: σ = median|xᵢ₊₁ − 2xᵢ + xᵢ₋₁|/(0.6745 √6), which a few turns do not
//! change. A fall below the largest force before is none of noise where it exceeds √2 σ z with z of the probability α/n² of each pair.
//! In a hold the penetration rises by more than the force explains: δ is concave in P, so that elastic contact has dδ/dP ≤ δ/P.

use super::measurement_error::MeasurementError;

/// Median of |x| of a normal distribution of the deviation 1.
const MEDIAN: f64 = 0.6745;
/// Probability that noise of a monotone force is taken for a fall.
const FALSE_ALARM: f64 = 1e-3;
/// Least fall and largest spread of forces in a hold, of the largest force.
const LEAST: f64 = 1e-3;
/// Fewest points of a hold.
const FEWEST: usize = 6;
/// Least penetration that a hold adds: part of the largest penetration, and times its standard error.
const ADDED: [f64; 2] = [0.01, 5.0];

/// Refuses records with unloading or with a hold.
pub(super) fn check(forces: &[f64], penetrations: &[f64]) -> Result<(), MeasurementError> {
    let noise = [forces, penetrations].map(noise);
    match fall(forces, noise[0]).or_else(|| hold(forces, penetrations, noise)) {
        Some(found) => Err(found),
        None => Ok(()),
    }
}

/// Standard deviation of the noise of a record; 0 of one with less than three points.
fn noise(record: &[f64]) -> f64 {
    let mut second: Vec<f64> =
        record.windows(3).map(|triple| (triple[2] - 2.0 * triple[1] + triple[0]).abs()).collect();
    second.sort_by(f64::total_cmp);
    second.get(second.len() / 2).map_or(0.0, |median| median / (MEDIAN * 6f64.sqrt()))
}

/// The deepest fall of the force below the largest one before it, where that is none of noise.
fn fall(forces: &[f64], noise: f64) -> Option<MeasurementError> {
    let largest = forces.iter().copied().fold(0.0, f64::max);
    let count = forces.len() as f64;
    // The tail of a normal distribution is below e^{−z²/2}.
    let least = 2.0 * noise * (count * count / FALSE_ALARM).ln().sqrt() + LEAST * largest;
    let (mut top, mut deepest) = (0, None::<(usize, usize, f64)>);
    for (index, &force) in forces.iter().enumerate() {
        if force > forces[top] {
            top = index;
        }
        let by = forces[top] - force;
        if by > least && deepest.is_none_or(|(.., most)| by > most) {
            deepest = Some((top, index, by));
        }
    }
    deepest.map(|(from, to, _)| MeasurementError::Unloading { from, to, forces: [forces[from], forces[to]] })
}

/// The first hold: points one after the other at one force, between whose first and last third the penetration rises.
fn hold(forces: &[f64], penetrations: &[f64], [noise, scatter]: [f64; 2]) -> Option<MeasurementError> {
    let size = |all: &[f64]| all.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let spread = (LEAST * size(forces)).max(6.0 * noise);
    let mut start = 0;
    while start < forces.len() {
        let length = forces[start..].iter().take_while(|force| (**force - forces[start]).abs() <= spread).count();
        let (end, third) = (start + length, length / 3);
        if length >= FEWEST {
            let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
            let [first, last] = [start..start + third, end - third..end];
            let rise = |of: &[f64]| mean(&of[last.clone()]) - mean(&of[first.clone()]);
            // δ/P is no bound of the slope where a zero was missed: from the least penetration on it is.
            let top = mean(&penetrations[last.clone()]);
            let least = penetrations.iter().copied().fold(f64::INFINITY, f64::min);
            let slope = top.abs().max(top - least) / mean(&forces[last.clone()]);
            let error = (2.0 / third as f64).sqrt() * scatter.hypot(slope * noise);
            let (risen, explained) = (rise(penetrations), slope * rise(forces).abs());
            if risen.abs() - explained > ADDED[1] * error + ADDED[0] * size(penetrations) {
                return Some(MeasurementError::Hold { from: start, to: end - 1, force: forces[start], by: risen });
            }
        }
        start += length.max(1);
    }
    None
}
