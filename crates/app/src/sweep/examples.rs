//! Rows and results for tests.

use super::{Axis, Combinations, Group, Row, Status, SweepResult};
use percoat_core::load::LoadQuantity;
use percoat_core::reading::{Criterion, Governing, Reading, Utilisation};
use percoat_core::run::{At, Limit, SearchEnd, StepRecord};
use percoat_core::spectral::{Certificate, Route, Stop};

/// All combinations of the values of some keys, `KEY=VALUES` each.
pub fn product(axes: &[&str]) -> Combinations {
    let groups: Vec<Group> = axes.iter().map(|text| Group::of(&Axis::parse(text).unwrap())).collect();
    Combinations::product(&groups).unwrap()
}

/// A combination that is done, with its results.
pub fn row(combination: usize, settings: &[(&str, String)], results: Vec<SweepResult>) -> Row {
    Row {
        combination,
        settings: settings.iter().map(|(key, value)| ((*key).to_owned(), value.clone())).collect(),
        fingerprint: String::new(),
        status: Status::Done,
        reason: None,
        warnings: Vec::new(),
        results,
        seconds: 0.0,
        files: Default::default(),
    }
}

/// A load step under the mean pressure 0.1 with a peak pressure and its error; the penetration is as large as the peak.
pub fn step(max_pressure: f64, error: Option<f64>, contact_fraction: impl Into<Option<f64>>) -> StepRecord {
    StepRecord {
        reading: Reading {
            mean_pressure: Some(0.1),
            force: 0.1,
            contact_area: 0.1,
            penetration: max_pressure,
            contact_fraction: contact_fraction.into(),
            contact_fraction_uncertainty: 0.0,
            elastic_energy: 0.0,
            max_pressure,
            resolved_peak: None,
            errors: percoat_core::reading::Errors { max_pressure: error, ..Default::default() },
            peak_to_edge: 0.0,
            contact_spots: 1,
            spot_resolution: 0.0,
            levels: Vec::new(),
            boundaries: Vec::new(),
            fractions: Default::default(),
        },
        stop: Stop::Converged,
        route: Route::Direct,
        iterations: 1,
        convolutions: 1.0,
        residual: 0.0,
        certificate: Certificate::default(),
        points: [32, 32],
        contact_stiffness: None,
        contact_stiffness_error: None,
        rough: None,
        tapered: None,
        plastic: None,
        beneath: None,
        friction: None,
        tangential: None,
        adhesion: None,
        hysteresis: None,
        temperature: None,
        creep: None,
        stress: None,
        strength: Vec::new(),
        governing: None,
        fatigue: None,
        seconds: None,
    }
}

/// A load step of an isolated contact under a force.
pub fn isolated(force: f64, max_pressure: f64) -> StepRecord {
    let mut step = step(max_pressure, None, None);
    (step.reading.mean_pressure, step.reading.force, step.reading.contact_area) = (None, force, 0.5 * force);
    step
}

/// A load step with these utilisations of strengths.
pub fn strained(strength: Vec<Utilisation>) -> SweepResult {
    let governing = Governing::of(&strength);
    SweepResult::Step(Box::new(StepRecord { strength, governing, ..step(1.0, None, 0.5) }))
}

/// A limit at a mean pressure with its error.
pub fn reached(criterion: Criterion, mean_pressure: f64, error: f64) -> Limit {
    let interval = [mean_pressure - error, mean_pressure + error];
    let at = At::Load { load: mean_pressure, error: Some(error), interval, position: [0.0; 3] };
    Limit { criterion, quantity: LoadQuantity::MeanPressure, at }
}

/// A limit below a mean pressure.
pub fn below(criterion: Criterion, mean_pressure: f64) -> Limit {
    let at = At::Below { load: mean_pressure, utilisation: 2.0, position: [0.0; 3] };
    Limit { criterion, quantity: LoadQuantity::MeanPressure, at }
}

/// A limit that is not reached up to a mean pressure.
pub fn never(criterion: Criterion, up_to: f64) -> Limit {
    let at = At::Never { up_to, end: SearchEnd::CompleteContact, utilisation: 0.5, error: None, at: up_to };
    Limit { criterion, quantity: LoadQuantity::MeanPressure, at }
}
