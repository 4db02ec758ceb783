//! `limit.json`: the mean pressure at which each criterion is reached, the first of them, and every load that was solved.

use super::summary::units;
use crate::case::Case;
use crate::run::{At, Limit, Limits, StepRecord};
use serde_json::{Map, Value, json};

/// The limit loads of a case, as indented JSON.
pub fn limit_json(limits: &Limits, case: &Case, warnings: &[String]) -> String {
    let file = json!({
        "percoat": env!("CARGO_PKG_VERSION"),
        "title": case.title,
        "case": case,
        "units": units(case),
        "warnings": warnings,
        "first": first(limits),
        "searched": searched(limits),
        "complete_contact": Some(limits.complete).filter(|pressure| pressure.is_finite()),
        "change": limits.change,
        "limits": limits.limits.iter().map(|own| limit(limits, own)).collect::<Value>(),
        "steps": limits.steps,
    });
    format!("{file:#}\n")
}

/// The first limit and all of them as one object: under `first`, and under their names (`yield_of_material_2`). Where none is
/// reached, and some are undecided, `first` has these as `rivals` and no criterion.
pub fn limits_json(limits: &Limits) -> Value {
    let first = match (first(limits), limits.rivals()) {
        (Value::Null, rivals) if !rivals.is_empty() => {
            json!({ "criterion": null, "reached": "undecided", "rivals": rivals })
        }
        (first, _) => first,
    };
    let first = ("first".to_owned(), first);
    let named = limits.limits.iter().map(|own| {
        let mut entries = limit(limits, own);
        if let Some(entries) = entries.as_object_mut() {
            // Its name says it.
            ["criterion", "material", "interface"].iter().for_each(|key| drop(entries.shift_remove(*key)));
        }
        (own.criterion.to_string().replace(' ', "_"), entries)
    });
    Value::Object([first].into_iter().chain(named).collect())
}

/// The first limit with what may come before it by the errors of both; null where none is reached.
fn first(limits: &Limits) -> Value {
    let Some(first) = limits.first() else { return Value::Null };
    let mut entries = limit(limits, first);
    if let Some(entries) = entries.as_object_mut() {
        entries.insert("rivals".to_owned(), json!(limits.rivals()));
    }
    entries
}

/// The least and the largest mean pressure that were solved.
fn searched(limits: &Limits) -> Value {
    let pressure = |step: &StepRecord| step.reading.mean_pressure;
    json!(limits.steps.first().zip(limits.steps.last()).map(|(first, last)| [pressure(first), pressure(last)]))
}

/// Every limit has the same keys: what is not known of it is null.
fn limit(limits: &Limits, limit: &Limit) -> Value {
    let mut entries = Map::new();
    let criterion = json!(limit.criterion);
    entries.extend(criterion.as_object().cloned().unwrap_or_default());
    let (reached, error) = match limit.at {
        At::Rest => ("by residual stress alone", Some(0.0)),
        At::Tip { .. } => ("under a tip however small the load", Some(0.0)),
        At::Load { error, .. } => ("under load", error),
        At::Below { .. } => ("by a contact of a few samples", None),
        At::Never { up_to, .. } if limits.is_complete(up_to) => ("not up to complete contact", None),
        At::Never { .. } => ("not up to the largest load", None),
        At::Undecided { .. } => ("undecided", None),
    };
    let is_number = !matches!(limit.at, At::Below { .. } | At::Never { .. } | At::Undecided { .. });
    let interval = limit.interval().map(|load| Some(load).filter(|load| load.is_finite()));
    let interval = Some(interval).filter(|_| !matches!(limit.at, At::Never { .. }));
    let [x, y, z] = limit.position().map_or([None; 3], |position| position.map(Some));
    let at = json!({
        "mean_pressure": is_number.then(|| limit.mean_pressure()), "error": error, "interval": interval, "x": x, "y": y, "z": z, "reached": reached,
    });
    entries.extend(at.as_object().cloned().unwrap_or_default());
    match limit.at {
        At::Below { mean_pressure, utilisation, .. } => {
            entries.insert("below".to_owned(), json!(mean_pressure));
            entries.insert("utilisation".to_owned(), json!(utilisation));
        }
        At::Never { up_to, utilisation, error, at } | At::Undecided { up_to, utilisation, error, at, .. } => {
            entries.insert("up_to".to_owned(), json!(up_to));
            entries.insert("utilisation".to_owned(), json!(utilisation));
            entries.insert("utilisation_error".to_owned(), json!(error));
            entries.insert("utilisation_at".to_owned(), json!(at));
        }
        At::Rest | At::Tip { .. } | At::Load { .. } => (),
    }
    Value::Object(entries)
}
