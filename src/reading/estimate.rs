//! Estimated discretisation errors of what is read off a solution.
//!
//! [`Errors`] has the laws.

use super::contact::edge;
use super::fraction::Fraction;
use super::rough::{corrected_fraction, mean_gap};
use super::{Errors, LevelErrors, LevelReading, Reading, RoughReading};
use crate::load::Load;
use crate::spectral::{Contact, Step};

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

/// The same for penetration and elastic energy of a topography.
fn topography_law(samples: f64) -> f64 {
    0.05 * samples.powi(-2)
}

/// The same for the centre of the pressure, relative to the contact radius.
fn centre_law(samples: f64) -> f64 {
    0.005 * samples.powi(-2)
}

impl Step {
    /// What a tribologist reads off the step, with its estimated discretisation errors.
    pub fn reading(&self) -> Reading {
        // Once among the threads that share the work, not anew for each part of it.
        rayon::scope(|_| self.reading_here())
    }

    fn reading_here(&self) -> Reading {
        let coarser: Vec<&Contact> = self.coarser().iter().take(CHANGES.len()).collect();
        let edge = edge(&[&[self.finest()], &coarser[..]].concat());
        let mut reading = Reading::at_edge(self.finest(), &edge, true);
        let coarser: Vec<Reading> =
            coarser.into_iter().map(|contact| Reading::at_edge(contact, &edge, false)).collect();
        let levels = self.problem().counterbody().levels();
        let exponents: Vec<f64> = levels.iter().map(|level| level.shape().exponent()).collect();
        let (errors, of_levels) = between(&reading, &coarser, &exponents, self.load);
        reading.errors = errors;
        if !coarser.is_empty() && reading.mean_pressure > 0.0 {
            let (fraction, error) = best_fraction(&reading, &coarser);
            (reading.contact_fraction, reading.contact_fraction_uncertainty) = (fraction.value, fraction.uncertainty);
            reading.errors.contact_fraction = Some(error);
        }
        for (level, errors) in reading.levels.iter_mut().zip(of_levels) {
            level.errors = errors;
        }
        reading
    }

    /// What is read of the contact of a topography beside its [`reading`](Self::reading), with its estimated discretisation
    /// errors; `None` for indenters.
    pub fn rough_reading(&self, reading: &Reading) -> Option<RoughReading> {
        rayon::scope(|_| self.rough_reading_here(reading))
    }

    fn rough_reading_here(&self, reading: &Reading) -> Option<RoughReading> {
        let mut rough = RoughReading::of(self.finest())?;
        let coarser: Vec<&Contact> = self.coarser().iter().take(CHANGES.len()).collect();
        if !coarser.is_empty() {
            let error = |safety: f64, open: f64, value: f64, of: fn(&Contact) -> f64| {
                Some(widest(safety, open, value, coarser.iter().map(|coarse| Some(of(coarse)))))
            };
            let border = reading.fractions.corrected.map_or(0.0, |corrected| corrected.fraction.uncertainty);
            let corrected = |contact: &Contact| corrected_fraction(contact.grid(), contact.pressures()).fraction.value;
            let fraction = error(AREA, border, rough.corrected_fraction, corrected);
            // The mean gap is that to complete contact, less the penetration.
            let depth = reading.penetration.abs() * topography_law(reading.spot_resolution.max(1.0));
            let gap = error(TOPOGRAPHY, depth, rough.mean_gap, mean_gap);
            (rough.corrected_fraction_error, rough.mean_gap_error) = (fraction, gap);
        }
        Some(rough)
    }
}

/// By how much the largest of all is multiplied, so that the estimates hold in some 97 % of the cases from which these
/// numbers were read.
const MEAN_PRESSURE: f64 = 2.0;
const PENETRATION: f64 = 3.2;
/// Of penetration, mean gap and elastic energy of a topography, whose coarser grids are measured from the same apex.
const TOPOGRAPHY: f64 = 1.6;
const LOAD: f64 = 3.0;
const SHARE: f64 = 3.0;
const PEAK: f64 = 2.2;
const AREA: f64 = 2.0;
const CENTRE: f64 = 2.0;

/// Parts of the changes against the coarser grids that count, the next coarser first.
const CHANGES: [f64; 2] = [1.0, 0.25];

/// `safety` times the largest of what the samples leave `open` and of the parts of the changes from the values of the coarser
/// grids, the next coarser first, that count; `None` for a grid without the value.
fn widest(safety: f64, open: f64, value: f64, coarser: impl Iterator<Item = Option<f64>>) -> f64 {
    let changes = CHANGES.into_iter().zip(coarser);
    safety * changes.filter_map(|(part, coarse)| Some(part * (coarse? - value).abs())).fold(open, f64::max)
}

/// The fraction in contact with the smaller error, and that.
fn best_fraction(fine: &Reading, coarser: &[Reading]) -> (Fraction, f64) {
    fine.fractions.best(|own, of| {
        let coarser = coarser.iter().map(|coarse| Some(of(&coarse.fractions)?.value));
        widest(AREA, own.uncertainty, own.value, coarser)
    })
}

/// Errors of `fine` from the readings of the coarser grids, but that of the fraction in contact, which decides what that is.
fn between(fine: &Reading, coarser: &[Reading], exponents: &[f64], load: Load) -> (Errors, Vec<LevelErrors>) {
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
        let peak = own.grid_peak() * peak_law(own.uncertainty.peak_to_edge.max(1.0), exponent);
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
            asymmetry: radius(relative, |level| level.asymmetry),
            centre: [
                of(CENTRE, own.contact_radius.unwrap_or(0.0) * centre_law(samples), |level| Some(level.centre?[0])),
                of(CENTRE, own.contact_radius.unwrap_or(0.0) * centre_law(samples), |level| Some(level.centre?[1])),
            ],
        }
    };
    let prescribed = |free: Option<f64>, prescribed: bool| if prescribed { Some(0.0) } else { free };
    let load = fine.mean_pressure * load_law(largest);
    let mean_pressure = estimate(MEAN_PRESSURE, load, &|reading| Some(reading.mean_pressure));
    let [depth, safety] = match fine.levels.is_empty() {
        true => [topography_law(largest), TOPOGRAPHY],
        false => [penetration_law(largest), PENETRATION],
    };
    let penetration = estimate(safety, fine.penetration.abs() * depth, &|reading| Some(reading.penetration));
    let [stored, safety] = if by_load { [depth, safety] } else { [load_law(largest), MEAN_PRESSURE] };
    let energy = estimate(safety, fine.elastic_energy * stored, &|reading| Some(reading.elastic_energy));
    let peak = fine.grid_peak() * peak_law(fine.peak_to_edge.min(smallest).max(1.0), sharpest);
    let levels: Vec<LevelErrors> = fine.levels.iter().zip(exponents).enumerate().map(level).collect();
    // The highest of all may be that of any level that reaches as high within its own error.
    let peaks =
        fine.levels.iter().zip(&levels).filter_map(|(own, errors)| Some(own.finite_peak()? + errors.max_pressure?));
    let beyond = peaks.fold(0.0, f64::max) - fine.grid_peak();
    let errors = Errors {
        mean_pressure: prescribed(mean_pressure, by_load),
        penetration: prescribed(penetration, !by_load),
        contact_fraction: None,
        elastic_energy: energy,
        max_pressure: estimate(PEAK, peak, &|reading| reading.finite_peak()).map(|error| error.max(beyond)),
    };
    (errors, levels)
}
