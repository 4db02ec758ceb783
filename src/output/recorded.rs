//! What `summary.json` and `limit.json` say, read back as the records they were written from.
//!
//! A number that is not finite is null in JSON: it comes back as infinite where the file calls it singular, as no number
//! elsewhere. What the files do not hold (boundaries, what a reading says of its own errors) stays empty.

use super::Timing;
use crate::reading::{
    Criterion, Errors, Histogram, LevelErrors, LevelReading, Reading, RoughReading, StressReading, Utilisation,
};
use crate::run::{At, Limit, Limits, StepRecord};
use crate::spectral::{Certificate, Report, Route, Stop};
use crate::stress::Peak;
use crate::stress::maxima::{Carried, Extremes};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};
use serde_json::Value;

/// Why a result cannot be read back: what is missing or of another kind.
#[derive(Debug, thiserror::Error)]
#[error("{what}: {reason}")]
pub struct Unreadable {
    what: String,
    reason: String,
}

fn read<T: DeserializeOwned>(what: &str, value: &Value) -> Result<T, Unreadable> {
    T::deserialize(value).map_err(|error| Unreadable { what: what.to_owned(), reason: error.to_string() })
}

/// The load steps under `steps`.
///
/// # Errors
/// [`Unreadable`] with the first step that is not as this version writes it.
pub fn steps_of(file: &Value) -> Result<Vec<StepRecord>, Unreadable> {
    let steps: Vec<Value> = read("`steps`", &file["steps"])?;
    (1..)
        .zip(&steps)
        .map(|(number, step): (usize, _)| Ok(record(read::<StepKeys>(&format!("step {number}"), step)?)))
        .collect()
}

/// A load step as a line of `steps.jsonl` tells it.
pub(super) fn step(value: &Value) -> Result<StepRecord, Unreadable> {
    Ok(record(read::<StepKeys>("a step", value)?))
}

/// Where the time of a run went; `None` where the file does not say.
///
/// # Errors
/// [`Unreadable`] when it says so in another way.
pub fn timing_of(file: &Value) -> Result<Option<Timing>, Unreadable> {
    file.get("timing").map(|timing| read("`timing`", timing)).transpose()
}

/// The limit loads of `limit.json`, without what is shown of the first and how a refinement ended.
///
/// # Errors
/// [`Unreadable`] with what is not as this version writes it.
pub fn limits_of(file: &Value) -> Result<Limits, Unreadable> {
    let keys: LimitsKeys = read("limit loads", file)?;
    let limits = keys.limits.iter().map(|limit| {
        let criterion = criterion(limit.criterion.as_str(), limit.material, limit.interface);
        let at = limit.at();
        criterion.zip(at).map(|(criterion, at)| Limit { criterion, at }).ok_or_else(|| Unreadable {
            what: format!("the limit of {}", limit.criterion),
            reason: format!("reached {:?} is not known with these keys", limit.reached),
        })
    });
    Ok(Limits {
        limits: limits.collect::<Result<_, _>>()?,
        steps: steps_of(file)?,
        shown: None,
        complete: keys.complete_contact.unwrap_or(f64::INFINITY),
        change: keys.change,
        end: None,
        warnings: keys.warnings,
    })
}

#[derive(Deserialize)]
struct LimitsKeys {
    warnings: Vec<String>,
    complete_contact: Option<f64>,
    change: Option<f64>,
    limits: Vec<LimitKeys>,
}

#[derive(Deserialize)]
struct LimitKeys {
    criterion: String,
    material: Option<usize>,
    interface: Option<usize>,
    mean_pressure: Option<f64>,
    error: Option<f64>,
    x: Option<f64>,
    y: Option<f64>,
    z: Option<f64>,
    reached: String,
    below: Option<f64>,
    up_to: Option<f64>,
    utilisation: Option<f64>,
    utilisation_at: Option<f64>,
}

impl LimitKeys {
    fn at(&self) -> Option<At> {
        let position = || Some([self.x?, self.y?, self.z?]);
        Some(match (self.reached.as_str(), self.below, self.up_to) {
            (_, Some(mean_pressure), _) => {
                At::Below { mean_pressure, utilisation: self.utilisation?, position: position()? }
            }
            (_, _, Some(up_to)) => At::Never { up_to, utilisation: self.utilisation?, at: self.utilisation_at? },
            ("by residual stress alone", ..) => At::Rest,
            ("under a tip however small the load", ..) => At::Tip { position: position()? },
            ("under load", ..) => {
                At::Load { mean_pressure: self.mean_pressure?, error: self.error, position: position()? }
            }
            _ => return None,
        })
    }
}

fn criterion(name: &str, material: Option<usize>, interface: Option<usize>) -> Option<Criterion> {
    Some(match name {
        "yield" => Criterion::Yield { material: material? },
        "cracking" => Criterion::Cracking { material: material? },
        "delamination" => Criterion::Delamination { interface: interface? },
        _ => return None,
    })
}

#[derive(Deserialize)]
struct StepKeys {
    mean_pressure: Option<f64>,
    penetration: Option<f64>,
    contact_fraction: Option<f64>,
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

#[derive(Deserialize)]
struct StressKeys {
    materials: Vec<ExtremesKeys>,
    faces: Vec<ExtremesKeys>,
    interfaces: Vec<CarriedKeys>,
    surface_error: Option<f64>,
}

#[derive(Deserialize)]
struct ExtremesKeys {
    max_tau1: PeakKeys,
    max_tension: PeakKeys,
    max_mises: PeakKeys,
}

#[derive(Deserialize)]
struct CarriedKeys {
    interface: usize,
    max_normal: PeakKeys,
    max_shear: PeakKeys,
}

#[derive(Deserialize)]
struct PeakKeys {
    value: Option<f64>,
    error: Option<f64>,
    singular: bool,
    #[serde(deserialize_with = "or_none")]
    x: f64,
    #[serde(deserialize_with = "or_none")]
    y: f64,
    #[serde(deserialize_with = "or_none")]
    z: f64,
    material: usize,
    direction: [Option<f64>; 3],
}

#[derive(Deserialize)]
struct UtilisationKeys {
    criterion: String,
    material: Option<usize>,
    interface: Option<usize>,
    utilisation: Option<f64>,
    singular: bool,
    error: Option<f64>,
    #[serde(deserialize_with = "or_none")]
    x: f64,
    #[serde(deserialize_with = "or_none")]
    y: f64,
    #[serde(deserialize_with = "or_none")]
    z: f64,
}

/// A number, infinite, or none.
fn value(x: Option<f64>, singular: bool) -> f64 {
    x.unwrap_or(if singular { f64::INFINITY } else { f64::NAN })
}

fn plain(x: Option<f64>) -> f64 {
    value(x, false)
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

/// A number that must be there, null for none.
fn or_none<'de, D: Deserializer<'de>>(number: D) -> Result<f64, D::Error> {
    Option::deserialize(number).map(plain)
}

fn record(keys: StepKeys) -> StepRecord {
    // "not a number" is what a record says itself of numbers that are none.
    let stop = Stop::ALL.into_iter().find(|stop| stop.to_string() == keys.stop_reason).unwrap_or(Stop::Stalled);
    let mut levels: Vec<LevelReading> = keys.levels.into_iter().map(level).collect();
    let singular = levels.iter().any(|level| level.singular);
    let mut max_pressure = value(keys.max_pressure, singular);
    let peaks = std::iter::once(&mut max_pressure).chain(levels.iter_mut().map(|level| &mut level.max_pressure));
    peaks.zip(keys.peaks).for_each(|(peak, own)| *peak = plain(own));
    StepRecord {
        reading: Reading {
            mean_pressure: plain(keys.mean_pressure),
            penetration: plain(keys.penetration),
            contact_fraction: plain(keys.contact_fraction),
            contact_fraction_uncertainty: 0.0,
            max_pressure,
            contact_spots: keys.contact_spots,
            spot_resolution: keys.spot_resolution,
            levels,
            boundaries: Vec::new(),
            errors: keys.errors,
        },
        report: Report {
            stop,
            route: route(&keys.route, keys.trials).unwrap_or(Route::Direct),
            iterations: keys.iterations,
            outer: keys.friction.as_ref().map_or(0, |sliding| sliding.outer_iterations),
            residual: plain(keys.residual),
        },
        certificate: keys.certificate,
        slides: keys.friction.is_some(),
        convolutions: keys.convolutions,
        points: keys.points,
        rough: keys.rough.map(|rough| RoughReading { histograms: keys.histograms, ..rough }),
        stress: keys.stress.map(stress),
        strength: keys.strength.into_iter().filter_map(utilisation).collect(),
        seconds: keys.seconds,
    }
}

/// A route by its name.
pub(super) fn route(name: &str, trials: usize) -> Option<Route> {
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

fn stress(keys: StressKeys) -> StressReading {
    let all = |list: Vec<ExtremesKeys>| {
        let one = |keys: ExtremesKeys| Extremes {
            tau1: peak(&keys.max_tau1),
            tension: peak(&keys.max_tension),
            mises: peak(&keys.max_mises),
        };
        list.into_iter().map(one).collect()
    };
    let carried = |keys: CarriedKeys| Carried {
        interface: keys.interface,
        normal: peak(&keys.max_normal),
        shear: peak(&keys.max_shear),
        delamination: None,
    };
    StressReading {
        materials: all(keys.materials),
        faces: all(keys.faces),
        interfaces: keys.interfaces.into_iter().map(carried).collect(),
        // Infinite where it cannot be told.
        surface_error: keys.surface_error.unwrap_or(f64::INFINITY),
    }
}

fn peak(keys: &PeakKeys) -> Peak {
    Peak {
        value: value(keys.value, keys.singular),
        position: [keys.x, keys.y, keys.z],
        material: keys.material,
        direction: keys.direction.map(plain),
        error: keys.error,
    }
}

/// `None` for a criterion of a later version.
fn utilisation(keys: UtilisationKeys) -> Option<Utilisation> {
    Some(Utilisation {
        criterion: criterion(&keys.criterion, keys.material, keys.interface)?,
        value: value(keys.utilisation, keys.singular),
        error: keys.error,
        position: [keys.x, keys.y, keys.z],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::counterbody::Topography;
    use crate::lattice::Cell;
    use crate::load::Load;
    use crate::problem::Problem;
    use crate::spectral::{Settings, Solver};
    use ndarray::Array2;
    use serde_json::json;

    #[test]
    fn a_step_that_stopped_as_no_number_comes_back_as_one() {
        let heights = Array2::from_shape_fn([8; 2], |(i, j)| if i + j == 0 { 1.0 } else { 0.0 });
        let surface = Topography::new(Cell::square(8.0).unwrap(), heights).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let mut solver = Solver::new(Problem::new(surface, body), [8; 2], Settings::default()).unwrap();
        let step = solver.solve(Load::MeanPressure(1e-3));
        let mut record = StepRecord::new(&step, step.reading());
        let nan = f64::NAN;
        record.certificate = Certificate { energy_gap: nan, penetration: nan, load: nan };
        (record.reading.penetration, record.reading.spot_resolution) = (nan, nan);
        let file: Value = serde_json::from_str(&json!({ "steps": [record] }).to_string()).unwrap();
        let read = steps_of(&file).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read[0].stop_reason(), "not a number");
        assert!(read[0].certificate.energy_gap.is_nan() && read[0].reading.spot_resolution.is_nan());
        assert_eq!(read[0].reading.mean_pressure, record.reading.mean_pressure);
    }
}
