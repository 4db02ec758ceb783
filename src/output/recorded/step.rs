//! Load steps.

use super::due::complete;
use super::number::{or_none, plain, value};
use super::stress::{StressKeys, UtilisationKeys, stress, utilisation};
use super::unreadable::{Unreadable, read};
use crate::reading::{Errors, Histogram, LevelErrors, LevelReading, Reading, RoughReading};
use crate::run::{StepRecord, Tapered};
use crate::spectral::{Certificate, Report, Route, Stop};
use serde::{Deserialize, Deserializer};
use serde_json::Value;

/// The load steps under `steps`.
///
/// # Errors
/// [`Unreadable`] with the first step that is not as this version writes it.
pub fn steps_of(file: &Value) -> Result<Vec<StepRecord>, Unreadable> {
    let steps: Vec<Value> = read("`steps`", &file["steps"])?;
    (1..).zip(&steps).map(|(number, step): (usize, _)| of_keys(&format!("step {number}"), step)).collect()
}

/// A load step as a line of `steps.jsonl` tells it.
pub(in crate::output) fn step(value: &Value) -> Result<StepRecord, Unreadable> {
    of_keys("a step", value)
}

/// The step that a value tells of, called `what`.
fn of_keys(what: &str, value: &Value) -> Result<StepRecord, Unreadable> {
    record(read(what, value)?).map_err(|reason| Unreadable { what: what.to_owned(), reason })
}

#[derive(Deserialize)]
struct StepKeys {
    mean_pressure: Option<f64>,
    penetration: Option<f64>,
    contact_fraction: Option<f64>,
    /// Absent from what earlier versions wrote.
    elastic_energy: Option<f64>,
    max_pressure: Option<f64>,
    errors: Errors,
    stop_reason: String,
    route: String,
    trials: usize,
    iterations: usize,
    convolutions: f64,
    residual: Option<f64>,
    #[serde(deserialize_with = "certificate")]
    certificate: Certificate,
    points: [usize; 2],
    contact_spots: usize,
    #[serde(deserialize_with = "or_none")]
    spot_resolution: f64,
    levels: Vec<LevelKeys>,
    friction: Option<Sliding>,
    stress: Option<StressKeys>,
    #[serde(default)]
    strength: Vec<UtilisationKeys>,
    seconds: Option<f64>,
    rough: Option<RoughReading>,
    tapered: Option<Tapered>,
    /// Of an unfinished run.
    #[serde(default)]
    histograms: Vec<Histogram>,
    /// The same, largest pressures on the grid.
    #[serde(default)]
    peaks: Vec<Option<f64>>,
}

#[derive(Deserialize)]
struct Sliding {
    outer_iterations: usize,
}

#[derive(Deserialize)]
struct LevelKeys {
    level: usize,
    load: Option<f64>,
    load_share: Option<f64>,
    max_pressure: Option<f64>,
    singular: bool,
    contact_area: Option<f64>,
    contact_radius: Option<f64>,
    ring: bool,
    radius_inner: Option<f64>,
    radius_outer: Option<f64>,
    radius_min: Option<f64>,
    radius_max: Option<f64>,
    centre: [Option<f64>; 2],
    merged: bool,
    #[serde(deserialize_with = "or_none")]
    resolution: f64,
    errors: LevelErrors,
}

/// Of a pressure that is not a number nothing is.
fn certificate<'de, D: Deserializer<'de>>(keys: D) -> Result<Certificate, D::Error> {
    #[derive(Deserialize)]
    struct Keys {
        #[serde(deserialize_with = "or_none")]
        energy_gap: f64,
        #[serde(deserialize_with = "or_none")]
        penetration: f64,
        #[serde(deserialize_with = "or_none")]
        load: f64,
    }
    let Keys { energy_gap, penetration, load } = Keys::deserialize(keys)?;
    Ok(Certificate { energy_gap, penetration, load })
}

fn record(keys: StepKeys) -> Result<StepRecord, String> {
    // What a record says itself of numbers that are none.
    let is_none = keys.stop_reason == "not a number";
    let stop = Stop::ALL.into_iter().find(|stop| stop.to_string() == keys.stop_reason);
    let stop = stop.or(is_none.then_some(Stop::Stalled));
    let stop = stop.ok_or_else(|| format!("stop_reason {:?} is not known", keys.stop_reason))?;
    let route = route(&keys.route, keys.trials).ok_or_else(|| format!("route {:?} is not known", keys.route))?;
    let strength = keys.strength.into_iter().map(utilisation).collect::<Result<_, _>>()?;
    let mut levels: Vec<LevelReading> = keys.levels.into_iter().map(level).collect();
    let singular = levels.iter().any(|level| level.singular);
    let mut max_pressure = value(keys.max_pressure, singular);
    let peaks = std::iter::once(&mut max_pressure).chain(levels.iter_mut().map(|level| &mut level.max_pressure));
    peaks.zip(keys.peaks).for_each(|(peak, own)| *peak = plain(own));
    let record = StepRecord {
        reading: Reading {
            mean_pressure: plain(keys.mean_pressure),
            penetration: plain(keys.penetration),
            contact_fraction: plain(keys.contact_fraction),
            contact_fraction_uncertainty: 0.0,
            elastic_energy: plain(keys.elastic_energy),
            max_pressure,
            peak_to_edge: 0.0,
            contact_spots: keys.contact_spots,
            spot_resolution: keys.spot_resolution,
            levels,
            boundaries: Vec::new(),
            errors: keys.errors,
            fractions: Default::default(),
        },
        report: Report {
            stop,
            route,
            iterations: keys.iterations,
            outer: keys.friction.as_ref().map_or(0, |sliding| sliding.outer_iterations),
            residual: plain(keys.residual),
        },
        certificate: keys.certificate,
        slides: keys.friction.is_some(),
        convolutions: keys.convolutions,
        points: keys.points,
        rough: keys.rough.map(|rough| RoughReading { histograms: keys.histograms, ..rough }),
        tapered: keys.tapered,
        stress: keys.stress.map(stress),
        strength,
        seconds: keys.seconds,
    };
    if !is_none {
        complete(&record)?;
    }
    Ok(record)
}

/// A route by its name.
pub(in crate::output) fn route(name: &str, trials: usize) -> Option<Route> {
    let named = [
        Route::Direct,
        Route::Outer,
        Route::Baseline,
        Route::WithoutContinuation,
        Route::BaselineAfterStall,
        Route::LoadSearch { trials },
    ];
    named.into_iter().find(|route| route.name() == name)
}

fn level(keys: LevelKeys) -> LevelReading {
    let LevelKeys { level, contact_radius, ring, radius_inner, radius_outer, radius_min, radius_max, .. } = keys;
    let [x, y] = keys.centre;
    LevelReading {
        level,
        load: plain(keys.load),
        load_share: plain(keys.load_share),
        max_pressure: value(keys.max_pressure, keys.singular),
        singular: keys.singular,
        contact_area: plain(keys.contact_area),
        contact_radius,
        ring,
        radius_inner,
        radius_outer,
        radius_min,
        radius_max,
        centre: x.zip(y).map(|(x, y)| [x, y]),
        merged: keys.merged,
        resolution: keys.resolution,
        uncertainty: Default::default(),
        errors: keys.errors,
    }
}
