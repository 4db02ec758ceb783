//! Values of Python as TOML: numbers, texts, lists and dicts, also those of NumPy.

use crate::errors::refused;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyMapping, PyString};
use toml::{Table, Value};

/// Parts of the longest path: nothing of a case lies so deep but what has itself within.
const DEEPEST: usize = 32;

/// A value that stands at `path` in a case.
pub fn value(object: &Bound<'_, PyAny>, path: &str) -> PyResult<Value> {
    if path.matches('.').count() > DEEPEST {
        return Err(refused("no value of a case is nested so deeply: does it contain itself?"));
    }
    if object.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(object.extract()?));
    }
    if object.is_instance_of::<PyInt>() {
        let whole: PyResult<i64> = object.extract();
        return whole.map(Value::Integer).map_err(|_| refused(format!("`{path}` is too large a number: {object}")));
    }
    if object.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(object.extract()?));
    }
    if object.is_instance_of::<PyString>() {
        return Ok(Value::String(object.extract()?));
    }
    if let Ok(mapping) = object.cast::<PyMapping>() {
        return table(mapping, path).map(Value::Table);
    }
    // Numbers and arrays of NumPy know what they are in Python.
    if object.hasattr("tolist")? {
        return value(&object.call_method0("tolist")?, path);
    }
    if object.hasattr("__fspath__")? {
        return value(&object.call_method0("__fspath__")?, path);
    }
    let Ok(items) = object.try_iter() else {
        let kind = object.get_type().name()?;
        let message =
            format!("`{path}` is a {kind}: a case has numbers, texts, true and false, lists and dicts of them");
        return Err(PyTypeError::new_err(message));
    };
    items
        .enumerate()
        .map(|(index, item)| value(&item?, &join(path, &index.to_string())))
        .collect::<PyResult<_>>()
        .map(Value::Array)
}

/// A dict at `path`; what is `None` is left out.
pub fn table(mapping: &Bound<'_, PyMapping>, path: &str) -> PyResult<Table> {
    let mut table = Table::new();
    for pair in mapping.items()?.iter() {
        let (key, own): (Bound<'_, PyAny>, Bound<'_, PyAny>) = pair.extract()?;
        let key: String = key
            .extract()
            .map_err(|_| PyTypeError::new_err(format!("a key of `{}` is no text: {key}", or_case(path))))?;
        // No path would tell how deep what it has lies.
        if key.is_empty() {
            return Err(refused(format!("a key of `{}` is empty", or_case(path))));
        }
        if !own.is_none() {
            table.insert(key.clone(), value(&own, &join(path, &key))?);
        }
    }
    Ok(table)
}

/// The settings `KEY=VALUE` that `set` stands for: a dict of keys and values, or texts as the command line takes them.
pub fn settings(set: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
    let Some(set) = set.filter(|set| !set.is_none()) else { return Ok(Vec::new()) };
    if let Ok(text) = set.extract::<String>() {
        return Ok(vec![text]);
    }
    if let Ok(mapping) = set.cast::<PyMapping>() {
        let pair = |pair: Bound<'_, PyAny>| {
            let (key, own): (Bound<'_, PyAny>, Bound<'_, PyAny>) = pair.extract()?;
            let key: String =
                key.extract().map_err(|_| PyTypeError::new_err(format!("a key of set is no text: {key}")))?;
            Ok(format!("{key}={}", written(&value(&own, &key)?)))
        };
        return mapping.items()?.iter().map(pair).collect();
    }
    set.extract().map_err(|_| {
        PyTypeError::new_err("set is a dict such as {\"layers.0.thickness\": 0.2}, or a list of texts KEY=VALUE")
    })
}

/// A value as it stands behind a key.
pub fn written(value: &Value) -> String {
    match value {
        // Shorter than 0.0000002, and the same number.
        Value::Float(x) if x.is_finite() && *x != 0.0 && !(1e-3..1e6).contains(&x.abs()) => format!("{x:e}"),
        // A word needs no quotes, and stands in tables without them.
        Value::String(text) if is_word(text) => text.clone(),
        other => other.to_string(),
    }
}

/// Whether nothing else than a text can be meant: a letter before letters, digits, `-` and `_`, and no value of TOML.
fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c))
        && !["true", "false", "inf", "nan"].contains(&text)
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

fn or_case(path: &str) -> &str {
    if path.is_empty() { "case" } else { path }
}
