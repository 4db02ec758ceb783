//! Estimated discretisation errors of readings, by the laws of [`Errors`].

use super::contact::edge;
use super::counted::CountedArea;
use super::rough::mean_gap;
use super::{Errors, LevelErrors, LevelReading, Reading, RoughReading};
use crate::counterbody::Topography;
use crate::load::Load;
use crate::numeric::sums;
use crate::spectral::{Contact, Step, adhesive_samples, zone_law};

/// Relative error of a peak pressure n samples away from the edge of contact, for profiles of an exponent.
fn peak_law(samples: f64, exponent: f64) -> f64 {
    if exponent >= 2.0 { 0.1 * samples.powi(-2) + samples.powi(-4) } else { 0.25 * samples.powf(1.0 - exponent) }
}

/// Relative error of the load under a prescribed penetration, for n samples along a contact radius.
pub(super) fn load_law(samples: f64) -> f64 {
    0.03 * samples.powi(-2) + 0.3 * samples.powi(-4)
}

/// Absolute error of a share of the load, for n samples along a contact radius.
fn share_law(samples: f64) -> f64 {
    0.002 * samples.powi(-2)
}

/// Relative error of the penetration of indenters, for n samples along a contact radius.
fn penetration_law(samples: f64) -> f64 {
    0.01 * samples.powi(-2)
}

/// Relative error of the elastic energy of indenters under a prescribed load, for n samples along a contact radius.
fn energy_law(samples: f64) -> f64 {
    0.03 * samples.powi(-2)
}

/// Relative error of penetration and elastic energy of a topography, for n samples along the radius of the typical spot.
fn topography_law(samples: f64) -> f64 {
    0.05 * samples.powi(-2)
}

/// Error of the centre of the pressure relative to the contact radius, for n samples along it.
fn centre_law(samples: f64) -> f64 {
    0.005 * samples.powi(-2)
}

/// Safety factors of the estimates: with them they hold in some 97 % of the seven hundred random cases from which these numbers
/// were read.
mod safety {
    pub const MEAN_PRESSURE: f64 = 2.0;
    pub const PENETRATION: f64 = 3.2;
    /// Factor for penetration, mean gap and elastic energy of a topography, whose coarser grids are measured from the same apex.
    pub const TOPOGRAPHY: f64 = 1.6;
    pub const LOAD: f64 = 3.0;
    pub const SHARE: f64 = 3.0;
    pub const PEAK: f64 = 2.2;
    pub const AREA: f64 = 2.0;
    pub const CENTRE: f64 = 2.0;
}

/// Weights of the changes against the coarser grids, the next coarser grid first.
const CHANGE_WEIGHTS: [f64; 2] = [1.0, 0.25];

/// `safety` times the largest of the error by the `law` and of the weighted changes of a `value` from those of the `coarser`
/// grids, the next coarser first; `None` for a grid without the value.
fn estimate(safety: f64, law: f64, value: f64, coarser: impl Iterator<Item = Option<f64>>) -> f64 {
    let changes = CHANGE_WEIGHTS.into_iter().zip(coarser);
    safety * changes.filter_map(|(weight, coarse)| Some(weight * (coarse? - value).abs())).fold(law, f64::max)
}

/// Estimated error of an area or of what is pressed in, from its `uncertainty` on one grid and its values on the coarser ones.
pub(super) fn of_area(uncertainty: f64, value: f64, coarser: impl Iterator<Item = Option<f64>>) -> f64 {
    estimate(safety::AREA, uncertainty, value, coarser)
}

impl Step {
    /// Reading of the step with its estimated discretisation errors.
    pub fn reading(&self) -> Reading {
        // One hand-over to the threads that share the work, not one for each part of it.
        rayon::scope(|_| self.reading_here())
    }

    fn reading_here(&self) -> Reading {
        let coarser = self.compared();
        let edge = edge(&[&[self.finest()], &coarser[..]].concat());
        let mut reading = Reading::at_edge(self.finest(), &edge, true);
        let coarser: Vec<Reading> =
            coarser.into_iter().map(|contact| Reading::at_edge(contact, &edge, false)).collect();
        if coarser.is_empty() {
            return reading;
        }
        let fractions = reading.fractions;
        if let (Some(counted), Some(corrected)) = (&mut reading.fractions.counted, fractions.corrected()) {
            let coarser = coarser.iter().map(|coarse| Some(coarse.fractions.corrected()?.value));
            counted.error = Some(estimate(safety::AREA, corrected.uncertainty, corrected.value, coarser));
        }
        if reading.touches() {
            let levels = self.problem().levels();
            let exponents: Vec<f64> = levels.iter().map(|level| level.shape().exponent()).collect();
            let is_given = self.problem().kind().is_given;
            let hardness = self.finest().hardness();
            let apex = self.apex_error();
            let pull = self.pull();
            let grids = Grids { fine: &reading, coarser: &coarser, load: self.load, is_given, hardness, apex, pull };
            let of_levels: Vec<LevelErrors> =
                exponents.iter().enumerate().map(|(index, &exponent)| grids.level_errors(index, exponent)).collect();
            let by_apex = grids.by_apex();
            reading.errors = grids.errors(&of_levels, &exponents);
            reading.levels.iter_mut().zip(of_levels).for_each(|(level, errors)| level.errors = errors);
            if let Some((composite, error)) = self.problem().composite_hardness().zip(reading.errors.penetration) {
                reading.err_with_hardness(hardness, composite.error(reading.penetration, error));
            }
            let (fraction, error) = fractions.best(|fraction, of| {
                let coarser = coarser.iter().map(|coarse| Some(of(&coarse.fractions)?.value));
                estimate(safety::AREA, fraction.uncertainty, fraction.value, coarser)
            });
            let error = error + by_apex.area * fraction.value;
            let cell = self.grid().cell();
            reading.contact_fraction_uncertainty = fraction.uncertainty;
            reading.contact_area = fraction.value * cell.area();
            reading.errors.contact_area = Some(error * cell.area());
            reading.contact_fraction = cell.surroundings().per_cell(fraction.value);
            reading.errors.contact_fraction = cell.surroundings().per_cell(error);
        } else if self.finest().tensions().is_some() {
            // Surfaces that pull and do not touch.
            let pull = self.pull();
            let of = |law: f64, of: fn(&Reading) -> f64| {
                Some(estimate(safety::LOAD, law, of(&reading), coarser.iter().map(|coarse| Some(of(coarse)))))
            };
            let force = if self.load.is_load_control() { Some(0.0) } else { of(pull.force, |reading| reading.force) };
            let cell = self.grid().cell();
            reading.errors = Errors {
                force,
                mean_pressure: force.filter(|_| reading.mean_pressure.is_some()).map(|force| force / cell.area()),
                penetration: of(pull.penetration, |reading| reading.penetration),
                elastic_energy: of(0.0, |reading| reading.elastic_energy),
                ..Errors::default()
            };
        } else if self.load.is_load_control() && reading.penetration > 0.0 {
            // The penetration that earlier loads have left.
            let left = coarser.iter().map(|coarse| Some(coarse.penetration));
            reading.errors.penetration = Some(of_area(0.0, reading.penetration, left) + self.apex_error());
        }
        reading
    }

    /// Reading of the contact of a topography beside its [`reading`](Self::reading), with the estimated discretisation errors;
    /// `None` for indenters.
    pub fn rough_reading(&self, reading: &Reading) -> Option<RoughReading> {
        rayon::scope(|_| self.rough_reading_here(reading))
    }

    fn rough_reading_here(&self, reading: &Reading) -> Option<RoughReading> {
        let finest = self.finest();
        finest.problem().topography()?;
        let counted = reading.fractions.counted.unwrap_or_else(|| CountedArea::of(finest.grid(), finest.pressures()));
        let mut rough = RoughReading::with_counted(finest, &counted);
        let coarser = self.compared();
        if let Some(mean) = rough.mean_gap.filter(|_| !coarser.is_empty()) {
            // The mean gap is that to complete contact, less the penetration.
            let law = reading.penetration.abs() * topography_law(reading.spot_resolution.max(1.0));
            let coarser = coarser.iter().map(|coarse| Some(mean_gap(coarse)));
            let apex = if self.load.is_load_control() { 0.0 } else { self.apex_error() };
            rough.mean_gap_error = Some(estimate(safety::TOPOGRAPHY, law, mean, coarser) + apex);
        }
        Some(rough)
    }

    /// Height by which a kinked topography may exceed the apex from which the penetration counts, a length; 0 under indenters.
    pub(super) fn apex_error(&self) -> f64 {
        self.problem().topography().map_or(0.0, Topography::apex_error)
    }

    /// Errors of the tension of surfaces that adhere; zero of others.
    fn pull(&self) -> Pull {
        let contact = self.finest();
        let Some(tension) = contact.tensions() else { return Pull::default() };
        let (gap, f, penetration) = (contact.gaps(), contact.surface().gaps(), contact.penetration());
        let [sum] = sums::of(tension.len(), |i| [tension[i]]);
        let displaced = -sums::least(gap.len(), |i| -(gap[i] - f[i] + penetration).abs());
        let law = zone_law(adhesive_samples(self.problem(), contact.grid()));
        Pull { force: law * sum * contact.grid().sample_area(), penetration: law * displaced }
    }

    /// The contacts on the coarser grids that estimates compare with, the next coarser first.
    fn compared(&self) -> Vec<&Contact> {
        self.coarser().iter().take(CHANGE_WEIGHTS.len()).collect()
    }
}

impl Reading {
    /// Gives the largest pressures that are a hardness, a pressure, its error.
    fn err_with_hardness(&mut self, hardness: f64, error: f64) {
        let levels = self.levels.iter_mut().map(|level| (level.max_pressure, &mut level.errors.max_pressure));
        let all = levels.chain([(self.max_pressure, &mut self.errors.max_pressure)]);
        all.filter(|(pressure, _)| *pressure >= hardness).for_each(|(_, estimated)| *estimated = Some(error));
    }
}

/// The readings of a step on its finest grid and on coarser ones.
struct Grids<'a> {
    fine: &'a Reading,
    /// The next coarser grid first; at least one.
    coarser: &'a [Reading],
    /// The prescribed load.
    load: Load,
    /// Whether the pressure is given, and its largest value with it.
    is_given: bool,
    /// Hardness of the softer surface; infinite without one.
    hardness: f64,
    /// Height by which a kinked topography may exceed its apex, a length.
    apex: f64,
    /// Errors of the tension of surfaces that adhere.
    pull: Pull,
}

/// Errors by the samples across the zone in which surfaces that adhere pull beside contact; zero of others.
#[derive(Clone, Copy, Default)]
struct Pull {
    force: f64,
    penetration: f64,
}

/// Changes under a prescribed penetration by the error of the apex from which it counts.
#[derive(Clone, Copy, Default)]
struct ByApex {
    force: f64,
    energy: f64,
    /// Over the area.
    area: f64,
    pressure: f64,
}

impl Grids<'_> {
    /// Estimated error of a value of the reading, from the error by its law and the changes from grid to grid; `None` where the
    /// finest grid has no value.
    fn error(&self, safety: f64, law: f64, value: &dyn Fn(&Reading) -> Option<f64>) -> Option<f64> {
        Some(estimate(safety, law, value(self.fine)?, self.coarser.iter().map(value)))
    }

    /// Estimated errors of the scalars of the whole contact but that of the fraction in contact, from those of the levels and the
    /// `exponents` of the levels' profiles.
    fn errors(&self, of_levels: &[LevelErrors], exponents: &[f64]) -> Errors {
        let (fine, by_apex) = (self.fine, self.by_apex());
        let by_load = self.load.is_load_control();
        let [largest, smallest] = self.resolutions();
        let prescribed = |free: Option<f64>, prescribed: bool| if prescribed { Some(0.0) } else { free };
        let load = fine.force.abs() * load_law(largest) + self.pull.force;
        let force = prescribed(self.error(safety::MEAN_PRESSURE, load, &|reading| Some(reading.force)), by_load);
        let area = fine.mean_pressure.map(|mean| fine.force / mean);
        let [depth, safety] = match fine.levels.is_empty() {
            true => [topography_law(largest), safety::TOPOGRAPHY],
            false => [penetration_law(largest), safety::PENETRATION],
        };
        let depth = fine.penetration.abs() * depth + self.pull.penetration;
        let penetration = self.error(safety, depth, &|reading| Some(reading.penetration));
        let stored = if fine.levels.is_empty() { topography_law(largest) } else { energy_law(largest) };
        let [stored, safety] = if by_load { [stored, safety] } else { [load_law(largest), safety::MEAN_PRESSURE] };
        let energy = self.error(safety, fine.elastic_energy * stored, &|reading| Some(reading.elastic_energy));
        let [force, penetration, energy] = [(force, by_apex.force), (penetration, self.apex), (energy, by_apex.energy)]
            .map(|(error, more)| error.map(|error| error + more));
        let loaded = fine.levels.iter().zip(exponents).filter(|(level, _)| level.touches());
        let sharpest = loaded.map(|(_, &exponent)| exponent).fold(2.0, f64::min);
        let peak = fine.grid_peak().abs() * peak_law(fine.peak_to_edge.min(smallest).max(1.0), sharpest);
        // The highest of all may be that of any level that reaches as high within its own error.
        let peaks = fine.levels.iter().zip(of_levels);
        let peaks = peaks.filter_map(|(level, errors)| Some(level.finite_peak()? + errors.max_pressure?));
        let beyond = peaks.fold(f64::NEG_INFINITY, f64::max) - fine.grid_peak();
        Errors {
            mean_pressure: force.zip(area).map(|(force, area)| force / area),
            force,
            penetration: prescribed(penetration, !by_load),
            contact_area: None,
            contact_fraction: None,
            elastic_energy: energy,
            max_pressure: self.unless_known(fine.max_pressure, || {
                let grid_error = self.error(safety::PEAK, peak, &|reading| reading.finite_peak());
                grid_error.map(|error| error.max(beyond) + by_apex.pressure)
            }),
        }
    }

    /// Changes under a prescribed penetration δ that counts from another apex; none under a load. With dU/dδ = F and F ~ δᵐ the energy is
    /// U = Fδ/(m + 1) and dF/dδ = m F/δ. The area grows like δ^{2(m − 1)} below one asperity and like the force below many, so like δᵐ at most,
    /// and the pressure like δ at most.
    fn by_apex(&self) -> ByApex {
        let Reading { force, penetration, elastic_energy, .. } = *self.fine;
        if self.apex == 0.0 || self.load.is_load_control() || !(elastic_energy > 0.0 && penetration > 0.0) {
            return ByApex::default();
        }
        let exponent = (force * penetration / elastic_energy - 1.0).max(1.0);
        let part = self.apex / penetration;
        ByApex {
            force: part * exponent * force,
            energy: self.apex * force,
            area: part * exponent,
            pressure: part * self.fine.grid_peak(),
        }
    }

    /// An error of a largest pressure; none where that is given, or the hardness, which no pressure exceeds.
    fn unless_known(&self, pressure: f64, error: impl FnOnce() -> Option<f64>) -> Option<f64> {
        if self.is_given || self.hardness.is_finite() && pressure >= self.hardness { Some(0.0) } else { error() }
    }

    /// Samples along the radius of the largest and of the smallest contact, at least one: the penetration is as certain as the
    /// largest contact, the highest peak as the least resolved one. A topography has its typical spot.
    fn resolutions(&self) -> [f64; 2] {
        let mut touching: Vec<f64> =
            self.fine.levels.iter().filter(|level| level.touches()).map(|level| level.resolution).collect();
        if self.fine.levels.is_empty() {
            touching.push(self.fine.spot_resolution);
        }
        let largest = touching.iter().copied().fold(1.0, f64::max);
        [largest, touching.iter().copied().fold(f64::INFINITY, f64::min).max(1.0)]
    }

    /// Estimated errors of the scalars of a level, by its index from 0, whose profile has an exponent.
    fn level_errors(&self, index: usize, exponent: f64) -> LevelErrors {
        let level = &self.fine.levels[index];
        if !level.touches() {
            return LevelErrors::default();
        }
        let by_load = self.load.is_load_control();
        // The laws hold from one sample on.
        let samples = level.resolution.max(1.0);
        let of = |safety: f64, law: f64, value: fn(&LevelReading) -> Option<f64>| {
            self.error(safety, law, &|reading| reading.levels.get(index).and_then(value))
        };
        // A single level carries the whole load.
        let share = if self.fine.levels.len() == 1 { 0.0 } else { share_law(samples) };
        let load =
            level.load.abs() * if by_load { share / level.load_share } else { load_law(samples) } + self.pull.force;
        let peak = level.grid_peak().abs() * peak_law(level.uncertainty.peak_to_edge.max(1.0), exponent);
        let centre = level.contact_radius.unwrap_or(0.0) * centre_law(samples);
        let radius = |error: Option<f64>, value: fn(&LevelReading) -> Option<f64>| of(safety::AREA, error?, value);
        let relative = level.uncertainty.boundary.zip(level.radius_max).map(|(error, largest)| error / largest);
        LevelErrors {
            load: of(safety::LOAD, load, |level| Some(level.load)),
            load_share: of(safety::SHARE, share, |level| Some(level.load_share)),
            max_pressure: self.unless_known(level.max_pressure, || of(safety::PEAK, peak, LevelReading::finite_peak)),
            contact_area: of(safety::AREA, level.uncertainty.area, |level| Some(level.contact_area)),
            contact_radius: radius(level.uncertainty.radius, |level| level.contact_radius),
            radius_inner: radius(level.uncertainty.hole, |level| level.radius_inner),
            radius_outer: radius(level.uncertainty.boundary, |level| level.radius_outer),
            radius_min: radius(level.uncertainty.boundary, |level| level.radius_min),
            radius_max: radius(level.uncertainty.boundary, |level| level.radius_max),
            asymmetry: radius(relative, |level| level.asymmetry),
            centre: [
                of(safety::CENTRE, centre, |level| Some(level.centre?[0])),
                of(safety::CENTRE, centre, |level| Some(level.centre?[1])),
            ],
        }
    }
}
