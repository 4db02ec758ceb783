//! `compare.json`: spectral and localized solution side by side.

use crate::comparison::{CircleComparison, Comparison, Deviation, StressPair};
use crate::localized::{CircleRadius, Stop};
use crate::reading::LevelReading;
use crate::run::StepRecord;
use crate::stress::State;
use serde::Serialize;

/// A comparison as it stands in `compare.json`.
#[derive(Debug, Serialize)]
pub struct CompareFile<'a, C: Serialize> {
    percoat: &'static str,
    title: &'a str,
    case: &'a C,
    /// Load step of the case that is compared, from 1.
    step: usize,
    spectral: StepRecord,
    spectral_error: Deviation,
    rule: CircleRadius,
    mutual_effect: bool,
    elements: usize,
    localized: Vec<Circle<'a>>,
    other_rule: Option<OtherRule<'a>>,
    lattice_sum: Option<Circle<'a>>,
    stresses: Vec<Stresses>,
}

#[derive(Debug, Serialize)]
struct OtherRule<'a> {
    rule: CircleRadius,
    localized: Vec<Circle<'a>>,
}

#[derive(Debug, Serialize)]
struct Circle<'a> {
    indenters: usize,
    /// An infinite radius is written as null.
    radius: &'a [f64],
    converged: bool,
    stop_reason: String,
    penetration: f64,
    additional_displacement: f64,
    levels: Vec<CircleLevel>,
    difference: Deviation,
    mesh_error: Deviation,
}

#[derive(Debug, Serialize)]
struct CircleLevel {
    level: usize,
    load: f64,
    load_share: f64,
    max_pressure: f64,
    contact_radius: Option<f64>,
    ring: bool,
}

/// Stresses of both methods at a point.
#[derive(Debug, Serialize)]
struct Stresses {
    x: f64,
    y: f64,
    z: f64,
    side: usize,
    spectral: Tensor,
    localized: Tensor,
}

#[derive(Debug, Serialize)]
struct Tensor {
    xx: f64,
    yy: f64,
    zz: f64,
    xy: f64,
    xz: f64,
    yz: f64,
}

impl<'a, C: Serialize> CompareFile<'a, C> {
    /// From a comparison of the load step `step` (from 1) of a case.
    pub fn new(comparison: &'a Comparison, title: &'a str, case: &'a C, step: usize) -> Self {
        let circles = |circles: &'a [CircleComparison]| circles.iter().map(Circle::from).collect::<Vec<_>>();
        let Comparison { rule, mutual_effect, elements, grid_error, .. } = *comparison;
        let other = OtherRule { rule: rule.other(), localized: circles(&comparison.other_rule) };
        Self {
            percoat: env!("CARGO_PKG_VERSION"),
            title,
            case,
            step,
            spectral: comparison.spectral(),
            spectral_error: grid_error,
            rule,
            mutual_effect,
            elements,
            localized: circles(&comparison.circles),
            other_rule: Some(other).filter(|other| !other.localized.is_empty()),
            lattice_sum: comparison.lattice_sum.as_ref().map(Circle::from),
            stresses: comparison.stresses.iter().map(Stresses::from).collect(),
        }
    }

    /// As indented JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a comparison is numbers and texts under names") + "\n"
    }
}

impl<'a> From<&'a CircleComparison> for Circle<'a> {
    fn from(circle: &'a CircleComparison) -> Self {
        Self {
            indenters: circle.indenters,
            radius: &circle.radii,
            converged: circle.stop == Stop::Converged,
            stop_reason: circle.stop.to_string(),
            penetration: circle.answer.penetration,
            additional_displacement: circle.additional_displacement,
            levels: circle.answer.levels.iter().map(CircleLevel::from).collect(),
            difference: circle.difference,
            mesh_error: circle.mesh_error,
        }
    }
}

impl From<&LevelReading> for CircleLevel {
    fn from(reading: &LevelReading) -> Self {
        let LevelReading { level, load, load_share, max_pressure, contact_radius, ring, .. } = *reading;
        Self { level, load, load_share, max_pressure, contact_radius, ring }
    }
}

impl From<&StressPair> for Stresses {
    fn from(pair: &StressPair) -> Self {
        let ([x, y], depth) = (pair.place, pair.depth);
        let [spectral, localized] = [&pair.spectral, &pair.localized].map(Tensor::from);
        Self { x, y, z: depth.z, side: depth.material, spectral, localized }
    }
}

impl From<&State> for Tensor {
    fn from(state: &State) -> Self {
        let State { xx, yy, zz, xy, xz, yz, .. } = *state;
        Self { xx, yy, zz, xy, xz, yz }
    }
}
