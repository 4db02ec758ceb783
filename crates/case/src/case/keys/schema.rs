//! The keys as a JSON schema (draft 7), for completion, hints and checks in TOML editors.
//!
//! Rules between keys and files are checked by the reader alone. The schema refuses no valid case, with one exception: JSON does not
//! distinguish 8.0 from the integer 8.

use std::ops::Bound;

use serde_json::{Map, Value, json};

use super::key::{Absent, Form, Key, Keys};
use super::range::Range;
use super::unit::Unit;
use crate::case::model::CASE;

/// Pattern of a number with a unit.
pub(super) const WITH_UNIT: &str = r"^\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?\s*[^\s0-9]";

/// The schema of a case file.
pub fn schema() -> Value {
    let mut schema = json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "percoat case",
        "description": "Periodic contact of coated bodies: any consistent units",
    });
    extend(&mut schema, table(&CASE));
    schema
}

fn table(keys: &'static Keys) -> Value {
    let properties: Map<String, Value> = keys.all.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let mut table = json!({ "type": "object", "additionalProperties": false, "properties": properties });
    let required: Vec<&str> = keys
        .all
        .iter()
        .filter(|key| is_required(key) && keys.instead(key.name).is_empty())
        .map(|key| key.name)
        .collect();
    if !required.is_empty() {
        table["required"] = required.into();
    }
    let rules: Vec<Value> = exclusions(keys).into_iter().chain(kinds(keys)).collect();
    if !rules.is_empty() {
        table["allOf"] = rules.into();
    }
    table
}

fn property(key: &'static Key) -> Value {
    let forms: Vec<Value> = key.forms.iter().map(|form| self::form(form, key.unit)).collect();
    let mut property = json!({ "description": description(key), "examples": [value(key.example)] });
    if let Absent::Value(default) = key.absent {
        property["default"] = value(default);
    }
    match <[Value; 1]>::try_from(forms) {
        Ok([form]) => extend(&mut property, form),
        Err(forms) => property["anyOf"] = forms.into(),
    }
    property
}

/// Meaning and kind of a key, in one line.
fn description(key: &Key) -> String {
    let rule = key.rule.map_or(String::new(), |rule| format!("; {rule}"));
    let kinds = if key.kinds.is_empty() { String::new() } else { format!("{}: ", key.kinds.join(", ")) };
    let absent = match key.absent {
        Absent::Means(means) => format!("; when not given: {means}"),
        _ => String::new(),
    };
    format!("{kinds}{} ({}){rule}{absent}", key.what, key.value())
}

/// A form of a value whose numbers have a unit; with one that is written they are texts, which the reader converts.
fn form(form: &Form, unit: Unit) -> Value {
    match form {
        Form::Number(range) if !unit.is_converted() => number(*range),
        Form::Number(range) => {
            json!({ "anyOf": [number(*range), { "type": "string", "pattern": WITH_UNIT }] })
        }
        Form::Integer(low, high) if *high < i64::MAX as usize => {
            json!({ "type": "integer", "minimum": low, "maximum": high })
        }
        Form::Integer(low, _) => json!({ "type": "integer", "minimum": low }),
        Form::Boolean => json!({ "type": "boolean" }),
        Form::Word(words) => json!({ "type": "string", "enum": words }),
        Form::Text(_) => json!({ "type": "string" }),
        Form::Name(_, most) => json!({ "type": "string", "minLength": 1, "maxLength": most }),
        Form::Tuple(_, items) => {
            let count = items.len();
            let items: Vec<Value> = items.iter().map(|item| self::form(item, unit)).collect();
            json!({ "type": "array", "items": items, "minItems": count, "maxItems": count })
        }
        Form::List { of, count: [least, most] } => {
            json!({ "type": "array", "items": self::form(of, unit), "minItems": least, "maxItems": most })
        }
        Form::Table(keys) => table(keys),
        Form::Sections(keys, most) => json!({ "type": "array", "items": table(keys), "maxItems": most }),
    }
}

fn number(range: Range) -> Value {
    let mut number = json!({ "type": "number" });
    let (low, high) = range.outer();
    for (bound, included, excluded) in [(low, "minimum", "exclusiveMinimum"), (high, "maximum", "exclusiveMaximum")] {
        match bound {
            Bound::Included(x) => number[included] = x.into(),
            Bound::Excluded(x) => number[excluded] = x.into(),
            Bound::Unbounded => {}
        }
    }
    number
}

/// Rules for keys that exclude each other: not both, and one of them where it is required.
fn exclusions(keys: &'static Keys) -> Vec<Value> {
    let mut rules = Vec::new();
    for (index, key) in keys.all.iter().enumerate() {
        let later = keys.all[index + 1..].iter().filter(|other| key.kinds.is_empty() && key.excludes(other));
        rules.extend(later.map(|other| exclusion(key, other)));
        let others = keys.instead(key.name);
        if is_required(key) && !others.is_empty() {
            let one: Vec<Value> =
                std::iter::once(key.name).chain(others).map(|name| json!({ "required": [name] })).collect();
            rules.push(json!({ "anyOf": one }));
        }
    }
    rules
}

/// Not both keys; a switch excludes others where it is on.
fn exclusion(key: &Key, other: &Key) -> Value {
    let mut both = json!({ "required": [key.name, other.name] });
    for switch in [key, other].into_iter().filter(|key| matches!(key.forms, [Form::Boolean])) {
        both["properties"] = json!({ switch.name: { "const": true } });
    }
    json!({ "not": both })
}

/// Required and excluded keys of a table of each kind.
fn kinds(keys: &'static Keys) -> Vec<Value> {
    let Some(Form::Word(words)) = keys.all.first().and_then(|key| key.forms.first()) else { return Vec::new() };
    let name = keys.all[0].name;
    let rule = |word: &&str| {
        let of_kind: Vec<&Key> = keys.all.iter().filter(|key| !key.kinds.is_empty()).collect();
        let (allowed, others): (Vec<&Key>, Vec<&Key>) = of_kind.into_iter().partition(|key| key.kinds.contains(word));
        let required: Vec<&str> =
            allowed.iter().filter(|key| key.absent == Absent::Refused).map(|key| key.name).collect();
        let others: Map<String, Value> = others.iter().map(|key| (key.name.to_owned(), false.into())).collect();
        json!({
            "if": { "properties": { name: { "const": word } }, "required": [name] },
            "then": { "required": required, "properties": others },
        })
    };
    if keys.all.iter().all(|key| key.kinds.is_empty()) { Vec::new() } else { words.iter().map(rule).collect() }
}

/// Whether every table needs the key or an alternative.
fn is_required(key: &Key) -> bool {
    key.absent == Absent::Refused && key.kinds.is_empty()
}

/// A TOML value as JSON.
fn value(text: &str) -> Value {
    let parsed = format!("value = {text}").parse::<toml::Table>().ok();
    parsed.and_then(|table| serde_json::to_value(&table["value"]).ok()).unwrap_or_default()
}

fn extend(value: &mut Value, by: Value) {
    if let (Some(object), Value::Object(by)) = (value.as_object_mut(), by) {
        object.extend(by);
    }
}
