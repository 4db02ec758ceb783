//! Estimated discretisation errors of what is read off a solution.
//!
//! [`Errors`] has the laws.

use super::{Errors, LevelErrors, LevelReading, Reading, RoughReading, peak};
use crate::load::Load;
use crate::spectral::Step;

/// What n samples between a peak pressure and the edge of contact leave open of it, relative to it, for profiles of an exponent.
fn peak_law(samples: f64, exponent: f64) -> f64 {
    if exponent >= 2.0 { 0.1 * samples.powi(-2) + samples.powi(-4) } else { 0.25 * samples.powf(1.0 - exponent) }
}

/// What n samples along a contact radius leave open of the load under a prescribed penetration,
pub(super) fn load_law(samples: f64) -> f64 {
    0.03 * samples.powi(-2) + 0.3 * samples.powi(-4)
}

/// for the share of the load,
fn share_law(samples: f64) -> f64 {
    0.002 * samples.powi(-2)
}

/// and for the penetration.
fn penetration_law(samples: f64) -> f64 {
    0.01 * samples.powi(-2)
}

/// The same for the centre of the pressure, relative to the contact radius.
fn centre_law(samples: f64) -> f64 {
    0.005 * samples.powi(-2)
}

impl Step {
    /// What a tribologist reads off the step, with its estimated discretisation errors.
    pub fn reading(&self) -> Reading {
        let mut reading = Reading::of(self.finest());
        let coarser: Vec<Reading> = self.coarser().iter().take(CHANGES.len()).map(Reading::of).collect();
        let levels = self.problem().counterbody().levels();
        let exponents: Vec<f64> = levels.iter().map(|level| level.shape().exponent()).collect();
        let (errors, of_levels) = between(&reading, &coarser, &exponents, self.load, apex_above_samples(self));
        reading.errors = errors;
        for (level, errors) in reading.levels.iter_mut().zip(of_levels) {
            level.errors = errors;
        }
        reading
    }

    /// What is read of the contact of a topography beside its [`reading`](Self::reading), with its estimated discretisation
    /// errors; `None` for indenters.
    pub fn rough_reading(&self, reading: &Reading) -> Option<RoughReading> {
        let mut rough = RoughReading::of(self.finest())?;
        let coarser: Vec<RoughReading> =
            self.coarser().iter().take(CHANGES.len()).filter_map(RoughReading::of).collect();
        if !coarser.is_empty() {
            let border = BORDER * (rough.counted_fraction - rough.corrected_fraction);
            let error = |safety: f64, open: f64, of: fn(&RoughReading) -> f64| {
                Some(widest(safety, open, of(&rough), coarser.iter().map(|coarse| Some(of(coarse)))))
            };
            let fraction = error(CORRECTED, border, |rough| rough.corrected_fraction);
            // The mean gap is that to complete contact, less the penetration.
            let depth = reading.penetration.abs() * penetration_law(reading.spot_resolution.max(1.0));
            let gap = error(PENETRATION, depth, |rough| rough.mean_gap);
            (rough.corrected_fraction_error, rough.mean_gap_error) = (fraction, gap);
        }
        Some(rough)
    }
}

/// How far the apex of a topography lies above its highest sample, from which the penetration is measured: a length. An
/// indenter's apex is known.
fn apex_above_samples(step: &Step) -> f64 {
    let (grid, surface) = (step.grid(), step.surface());
    if !surface.owners().is_empty() {
        return 0.0;
    }
    // Positive everywhere, as a pressure is.
    let lowest = surface.gaps().iter().copied().fold(0.0, f64::max) + surface.range();
    let height: Vec<f64> = surface.gaps().iter().map(|depth| lowest - depth).collect();
    // Another hill than that of the highest sample may rise higher between its own.
    let is_summit = |&index: &usize| grid.neighbours(index).all(|next| height[next] <= height[index]);
    let summits = (0..grid.len()).filter(is_summit);
    let apex = summits.map(|index| peak::interpolated(grid, &height, index)).fold(0.0, f64::max);
    let highest = height.iter().copied().fold(0.0, f64::max);
    (apex - highest).max(0.0)
}

/// By how much the largest of all is multiplied, so that the estimates hold in some 97 % of the cases from which these
/// numbers were read.
const MEAN_PRESSURE: f64 = 2.0;
const PENETRATION: f64 = 3.2;
const LOAD: f64 = 3.0;
const SHARE: f64 = 3.0;
const PEAK: f64 = 2.2;
const APEX: f64 = 1.25;
const AREA: f64 = 2.0;
const CORRECTED: f64 = 2.0;

/// Part of what the correction by the perimeter takes off that it leaves open: the factor of a border depends on its
/// directions.
const BORDER: f64 = 0.25;
const CENTRE: f64 = 2.0;

/// Parts of the changes against the coarser grids that count, the next coarser first.
const CHANGES: [f64; 2] = [1.0, 0.25];

/// `safety` times the largest of what the samples leave `open` and of the parts of the changes from the values of the coarser
/// grids, the next coarser first, that count; `None` for a grid without the value.
fn widest(safety: f64, open: f64, value: f64, coarser: impl Iterator<Item = Option<f64>>) -> f64 {
    let changes = CHANGES.into_iter().zip(coarser);
    safety * changes.filter_map(|(part, coarse)| Some(part * (coarse? - value).abs())).fold(open, f64::max)
}

/// Errors of `fine` from the readings of the coarser grids; `apex`: see [`apex_above_samples`].
fn between(
    fine: &Reading,
    coarser: &[Reading],
    exponents: &[f64],
    load: Load,
    apex: f64,
) -> (Errors, Vec<LevelErrors>) {
    if coarser.is_empty() || fine.mean_pressure <= 0.0 {
        return (Errors::default(), vec![LevelErrors::default(); fine.levels.len()]);
    }
    // What the samples leave open, and what the coarser grids say.
    let estimate = |safety: f64, open: f64, of: &dyn Fn(&Reading) -> Option<f64>| -> Option<f64> {
        Some(widest(safety, open, of(fine)?, coarser.iter().map(of)))
    };
    let mut touching: Vec<f64> =
        fine.levels.iter().filter(|level| level.load > 0.0).map(|level| level.resolution).collect();
    if fine.levels.is_empty() {
        touching.push(fine.spot_resolution);
    }
    // Below one sample the laws say no more than there. The whole is as good as the largest contact, the highest peak as
    // the least resolved one; a topography has its typical spot.
    let largest = touching.iter().copied().fold(1.0, f64::max);
    let smallest = touching.iter().copied().fold(f64::INFINITY, f64::min).max(1.0);
    let loaded = fine.levels.iter().zip(exponents).filter(|(level, _)| level.load > 0.0);
    let sharpest = loaded.map(|(_, &exponent)| exponent).fold(2.0, f64::min);
    let by_load = load.is_mean_pressure();
    let level = |(index, (own, &exponent)): (usize, (&LevelReading, &f64))| -> LevelErrors {
        if own.load <= 0.0 {
            return LevelErrors::default();
        }
        let samples = own.resolution.max(1.0);
        let of = |safety: f64, open: f64, value: fn(&LevelReading) -> Option<f64>| {
            estimate(safety, open, &|reading| reading.levels.get(index).and_then(value))
        };
        // A single level carries the whole load.
        let share = if fine.levels.len() == 1 { 0.0 } else { share_law(samples) };
        let own_load = own.load * if by_load { share / own.load_share } else { load_law(samples) };
        let peak = own.max_pressure * peak_law(own.uncertainty.peak_to_edge.max(1.0), exponent);
        let radius = |error: Option<f64>, value: fn(&LevelReading) -> Option<f64>| of(AREA, error?, value);
        let relative = own.uncertainty.boundary.zip(own.radius_max).map(|(error, largest)| error / largest);
        LevelErrors {
            load: of(LOAD, own_load, |level| Some(level.load)),
            load_share: of(SHARE, share, |level| Some(level.load_share)),
            max_pressure: of(PEAK, peak, LevelReading::finite_peak),
            contact_area: of(AREA, own.uncertainty.area, |level| Some(level.contact_area)),
            contact_radius: radius(own.uncertainty.radius, |level| level.contact_radius),
            radius_inner: radius(own.uncertainty.hole, |level| level.radius_inner),
            radius_outer: radius(own.uncertainty.boundary, |level| level.radius_outer),
            radius_min: radius(own.uncertainty.boundary, |level| level.radius_min),
            radius_max: radius(own.uncertainty.boundary, |level| level.radius_max),
            asymmetry: radius(relative, LevelReading::asymmetry),
            centre: [
                of(CENTRE, own.contact_radius.unwrap_or(0.0) * centre_law(samples), |level| Some(level.centre?[0])),
                of(CENTRE, own.contact_radius.unwrap_or(0.0) * centre_law(samples), |level| Some(level.centre?[1])),
            ],
        }
    };
    let prescribed = |free: Option<f64>, prescribed: bool| if prescribed { Some(0.0) } else { free };
    let apex = APEX * apex;
    let load = fine.mean_pressure * load_law(largest);
    let depth = fine.penetration.abs() * penetration_law(largest);
    let mean_pressure = estimate(MEAN_PRESSURE, load, &|reading| Some(reading.mean_pressure));
    let penetration = estimate(PENETRATION, depth, &|reading| Some(reading.penetration));
    let peak = fine.max_pressure * peak_law(fine.peak_to_edge.min(smallest).max(1.0), sharpest);
    let levels: Vec<LevelErrors> = fine.levels.iter().zip(exponents).enumerate().map(level).collect();
    // The highest of all may be that of any level that reaches as high within its own error.
    let peaks =
        fine.levels.iter().zip(&levels).filter_map(|(own, errors)| Some(own.finite_peak()? + errors.max_pressure?));
    let beyond = peaks.fold(0.0, f64::max) - fine.max_pressure;
    let errors = Errors {
        mean_pressure: prescribed(mean_pressure, by_load),
        penetration: prescribed(penetration, !by_load).map(|error| error + apex),
        contact_fraction: estimate(AREA, fine.contact_fraction_uncertainty, &|reading| Some(reading.contact_fraction)),
        max_pressure: estimate(PEAK, peak, &|reading| reading.finite_peak()).map(|error| error.max(beyond)),
    };
    (errors, levels)
}
