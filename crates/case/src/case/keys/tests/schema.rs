//! The schema admits every case that the reader admits, and refuses faults that a schema can express.

use super::super::schema;
use super::super::schema::WITH_UNIT;
use super::bases::Bases;
use crate::case::{Case, Source, embedded};
use serde_json::{Map, Value, json};
use std::path::Path;
use std::sync::LazyLock;

static SCHEMA: LazyLock<Value> = LazyLock::new(schema);

/// Whether the schema of a key accepts a value in TOML; what JSON does not have, no.
pub fn accepts(path: &str, value: &str) -> bool {
    let steps = path.split('.').fold(&*SCHEMA, |schema, name| {
        let inside = |schema: &'static Value| {
            let schema = schema.get("items").filter(|items| items.is_object()).unwrap_or(schema);
            schema.get("properties")?.get(name)
        };
        let forms = schema.get("anyOf").and_then(Value::as_array);
        inside(schema).or_else(|| forms?.iter().find_map(inside)).unwrap_or_else(|| panic!("{path} in the schema"))
    });
    let value: toml::Table = format!("value = {value}").parse().unwrap();
    // A date is an object in JSON, a number that is none is null.
    valid(steps, &serde_json::to_value(&value["value"]).unwrap())
}

/// Draft 7, as far as the schema uses it; every word that it uses must be known.
fn valid(schema: &Value, value: &Value) -> bool {
    let Value::Object(rules) = schema else { return schema == &json!(true) };
    rules.iter().all(|(word, rule)| follows(word, rule, rules, value))
}

fn follows(word: &str, rule: &Value, rules: &Map<String, Value>, value: &Value) -> bool {
    let number = |compare: fn(&f64, &f64) -> bool| match (value.as_f64(), rule.as_f64()) {
        (Some(value), Some(bound)) => compare(&value, &bound),
        _ => true,
    };
    let count = |compare: fn(&u64, &u64) -> bool, size: Option<usize>| {
        size.is_none_or(|size| compare(&(size as u64), &rule.as_u64().unwrap()))
    };
    let all = || rule.as_array().unwrap();
    let items = value.as_array().map(Vec::len);
    let letters = value.as_str().map(|text| text.chars().count());
    match word {
        "$schema" | "title" | "description" | "default" | "examples" | "then" => true,
        "type" => match rule.as_str().unwrap() {
            "object" => value.is_object(),
            "array" => value.is_array(),
            "string" => value.is_string(),
            "boolean" => value.is_boolean(),
            "number" => value.is_number(),
            "integer" => value.is_i64() || value.is_u64(),
            other => panic!("type {other}"),
        },
        "enum" => all().contains(value),
        "const" => rule == value,
        "pattern" => {
            assert_eq!(rule, WITH_UNIT, "the one pattern");
            value.as_str().is_none_or(|text| text.trim().starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)))
        }
        "minimum" => number(f64::ge),
        "maximum" => number(f64::le),
        "exclusiveMinimum" => number(f64::gt),
        "exclusiveMaximum" => number(f64::lt),
        "minItems" => count(u64::ge, items),
        "maxItems" => count(u64::le, items),
        "minLength" => count(u64::ge, letters),
        "maxLength" => count(u64::le, letters),
        "items" => value.as_array().is_none_or(|list| match rule {
            Value::Array(each) => list.iter().zip(each).all(|(item, rule)| valid(rule, item)),
            rule => list.iter().all(|item| valid(rule, item)),
        }),
        "properties" => value
            .as_object()
            .is_none_or(|object| object.iter().all(|(key, value)| rule.get(key).is_none_or(|rule| valid(rule, value)))),
        "additionalProperties" => {
            value.as_object().is_none_or(|object| object.keys().all(|key| rules["properties"].get(key).is_some()))
        }
        "required" => {
            value.as_object().is_none_or(|object| all().iter().all(|key| object.contains_key(key.as_str().unwrap())))
        }
        "allOf" => all().iter().all(|rule| valid(rule, value)),
        "anyOf" => all().iter().any(|rule| valid(rule, value)),
        "not" => !valid(rule, value),
        "if" => !valid(rule, value) || valid(&rules["then"], value),
        other => panic!("the schema says {other}"),
    }
}

fn takes(text: &str) -> bool {
    let case: toml::Table = text.parse().unwrap();
    valid(&SCHEMA, &serde_json::to_value(case).unwrap())
}

#[test]
fn every_case_that_is_read_follows_the_schema() {
    let bases = Bases::new();
    let rich = include_str!("../../../../../../tests/common/rich.toml").to_owned();
    let embedded = embedded::all().iter().map(|(_, text)| (*text).to_owned());
    for text in bases.all().chain(embedded).chain([rich]) {
        assert!(takes(&text), "{text}");
        // Complete with its defaults too.
        let written = bases.read(&text, &[]).unwrap_or_else(|error| panic!("{error}")).to_toml();
        assert!(takes(&written), "{written}");
    }
}

#[test]
fn unknown_and_misplaced_keys_and_those_that_exclude_each_other_do_not_follow_the_schema() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/refused");
    let mut count = 0;
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let text = std::fs::read_to_string(&path).unwrap();
        let source = Source { name: "case".to_owned(), text: text.clone(), ..Source::default() };
        let Err(error) = Case::read(&source, &[]) else { continue };
        let seen = ["unknown key", "has no place", "exclude each other", "poisson` is missing", "section ["];
        if seen.iter().any(|words| error.message().contains(words)) {
            assert!(!takes(&text), "{}", path.display());
            count += 1;
        }
    }
    assert!(count >= 10, "only {count} cases");
}
