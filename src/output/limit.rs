//! `limit.json`: the mean pressure at which each criterion is reached, the first of them, and every load that was solved.

use crate::case::Case;
use crate::run::{At, Limit, Limits};
use serde_json::{Map, Value, json};

/// The limit loads of a case, as indented JSON.
pub fn limit_json(limits: &Limits, case: &Case, warnings: &[String]) -> String {
    let file = json!({
        "percoat": env!("CARGO_PKG_VERSION"),
        "title": case.title,
        "case": case,
        "warnings": warnings,
        "first": limits.first().map(limit),
        "limits": limits.limits.iter().map(limit).collect::<Value>(),
        "steps": limits.steps,
    });
    format!("{file:#}\n")
}

fn limit(limit: &Limit) -> Value {
    let mut entries = Map::new();
    let criterion = json!(limit.criterion);
    entries.extend(criterion.as_object().cloned().unwrap_or_default());
    let at = match limit.at {
        At::Rest => json!({ "mean_pressure": 0.0, "reached": "by residual stress alone" }),
        At::Load { mean_pressure, error, position: [x, y, z] } => {
            json!({ "mean_pressure": mean_pressure, "error": error, "x": x, "y": y, "z": z, "reached": "under load" })
        }
        At::Below { mean_pressure } => {
            json!({ "mean_pressure": null, "below": mean_pressure, "reached": "by a contact of a few samples" })
        }
        At::Never { up_to, utilisation } => {
            json!({ "mean_pressure": null, "up_to": up_to, "utilisation": utilisation, "reached": "never" })
        }
    };
    entries.extend(at.as_object().cloned().unwrap_or_default());
    Value::Object(entries)
}
