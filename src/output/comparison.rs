//! `compare.json`: spectral and localized solution side by side.

use super::summary::units;
use crate::case::Case;
use crate::comparison::{CircleComparison, Comparison, StressPair};
use crate::localized::Stop;
use crate::reading::LevelReading;
use crate::stress::StressState;
use serde_json::{Value, json};

/// A comparison of the load step `step` (from 1) of a case, as indented JSON. What is infinite is null.
pub fn compare_json(comparison: &Comparison, case: &Case, step: usize) -> String {
    let task = &comparison.task;
    let circles = |circles: &[CircleComparison]| circles.iter().map(circle).collect::<Value>();
    let other = json!({ "rule": task.rule.other(), "localized": circles(&comparison.other_rule) });
    let file = json!({
        "percoat": env!("CARGO_PKG_VERSION"),
        "title": case.title,
        "case": case,
        "units": units(case),
        "step": step,
        "spectral": comparison.spectral,
        "spectral_error": comparison.grid_error,
        "rule": task.rule,
        "mutual_effect": task.mutual_effect,
        "elements": task.elements,
        "localized": circles(&comparison.circles),
        "other_rule": Some(other).filter(|_| !comparison.other_rule.is_empty()),
        "lattice_sum": comparison.lattice_sum.as_ref().map(circle),
        "stresses": comparison.stresses.iter().map(pair).collect::<Value>(),
    });
    format!("{file:#}\n")
}

fn circle(circle: &CircleComparison) -> Value {
    let level = |reading: &LevelReading| {
        json!({
            "level": reading.level,
            "load": reading.load,
            "load_share": reading.load_share,
            "max_pressure": reading.finite_peak(),
            "contact_radius": reading.contact_radius,
            "ring": reading.ring,
        })
    };
    json!({
        "indenters": circle.indenters,
        "radius": circle.radii,
        "converged": circle.stop == Stop::Converged,
        "stop_reason": circle.stop.to_string(),
        "penetration": circle.answer.penetration,
        "additional_displacement": circle.additional_displacement,
        "levels": circle.answer.levels.iter().map(level).collect::<Value>(),
        "difference": circle.difference,
        "mesh_error": circle.mesh_error,
    })
}

/// Stresses of both methods at a point.
fn pair(pair: &StressPair) -> Value {
    let ([x, y], depth) = (pair.place, pair.depth);
    let tensor = |StressState { xx, yy, zz, xy, xz, yz, .. }: &StressState| json!({ "xx": xx, "yy": yy, "zz": zz, "xy": xy, "xz": xz, "yz": yz });
    json!({
        "x": x,
        "y": y,
        "z": depth.z,
        "side": depth.material,
        "spectral": tensor(&pair.spectral),
        "localized": tensor(&pair.localized),
    })
}
