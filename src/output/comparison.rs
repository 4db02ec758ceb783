//! `compare.json`: spectral and localized solution side by side.

use crate::comparison::{CircleComparison, Comparison, Deviation, StressPair};
use crate::localized::{CircleRadius, Stop};
use crate::reading::LevelReading;
use crate::run::StepRecord;
use serde::Serialize;
use serde_json::{Value, json};

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
    localized: Vec<Value>,
    other_rule: Value,
    lattice_sum: Option<Value>,
    stresses: Vec<Value>,
}

impl<'a, C: Serialize> CompareFile<'a, C> {
    /// From a comparison of the load step `step` (from 1) of a case under a rule.
    pub fn new(
        comparison: &Comparison,
        title: &'a str,
        case: &'a C,
        step: usize,
        rule: CircleRadius,
        mutual_effect: bool,
    ) -> Self {
        let circles = |circles: &[CircleComparison]| circles.iter().map(circle).collect::<Vec<_>>();
        let other = circles(&comparison.other_rule);
        Self {
            percoat: env!("CARGO_PKG_VERSION"),
            title,
            case,
            step,
            spectral: StepRecord::new(&comparison.step, comparison.reading.clone()),
            spectral_error: comparison.grid_error,
            rule,
            mutual_effect,
            elements: comparison.elements,
            localized: circles(&comparison.circles),
            other_rule: if other.is_empty() {
                Value::Null
            } else {
                json!({ "rule": rule.other(), "localized": other })
            },
            lattice_sum: comparison.lattice_sum.as_ref().map(circle),
            stresses: comparison.stresses.iter().map(stress).collect(),
        }
    }

    /// As indented JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

fn circle(circle: &CircleComparison) -> Value {
    let level = |level: &LevelReading| {
        json!({
            "level": level.level,
            "load": level.load,
            "load_share": level.load_share,
            "max_pressure": level.max_pressure,
            "contact_radius": level.contact_radius,
            "ring": level.ring,
        })
    };
    let radius: Vec<Option<f64>> = circle.radii.iter().map(|&radius| Some(radius).filter(|r| r.is_finite())).collect();
    json!({
        "indenters": circle.indenters,
        "radius": radius,
        "converged": circle.stop == Stop::Converged,
        "stop_reason": circle.stop.to_string(),
        "penetration": circle.answer.penetration,
        "additional_displacement": circle.additional_displacement,
        "levels": circle.answer.levels.iter().map(level).collect::<Vec<_>>(),
        "difference": circle.difference,
        "mesh_error": circle.mesh_error,
    })
}

fn stress(pair: &StressPair) -> Value {
    let state = |state: &crate::stress::State| json!({ "xx": state.xx, "yy": state.yy, "zz": state.zz, "xy": state.xy, "xz": state.xz, "yz": state.yz });
    json!({
        "x": pair.place[0],
        "y": pair.place[1],
        "z": pair.depth.z,
        "side": pair.depth.material,
        "spectral": state(&pair.spectral),
        "localized": state(&pair.localized),
    })
}
