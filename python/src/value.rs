//! Values of Python as those of a case: numbers, texts, lists and dicts, also those of NumPy.

use crate::errors::refused;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyMapping, PyString};
use toml::{Table, Value};

/// Parts of the longest path, beyond any of a case: a deeper one is that of a value within itself.
const DEEPEST: usize = 32;

/// The value at `path` of a case.
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
    // Numbers and arrays of NumPy, and paths.
    for method in ["tolist", "__fspath__"] {
        if object.hasattr(method)? {
            return value(&object.call_method0(method)?, path);
        }
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

/// The table at `path` of a case, that of the case itself at an empty one; keys whose value is `None` are left out.
pub fn table(mapping: &Bound<'_, PyMapping>, path: &str) -> PyResult<Table> {
    let (mut table, whole) = (Table::new(), if path.is_empty() { "case" } else { path });
    for pair in mapping.items()?.iter() {
        let (key, object): (Bound<'_, PyAny>, Bound<'_, PyAny>) = pair.extract()?;
        let key = text(&key, &format!("`{whole}`"))?;
        // Depth is counted by the path, to which an empty key adds nothing.
        if key.is_empty() {
            return Err(refused(format!("a key of `{whole}` is empty")));
        }
        if !object.is_none() {
            let value = value(&object, &join(path, &key))?;
            table.insert(key, value);
        }
    }
    Ok(table)
}

/// Values by their dotted keys, and texts `KEY=VALUE`.
type Settings = (Vec<(String, Value)>, Vec<String>);

/// The values of the argument `set` where it is a dict, its texts where it is a list of them.
pub fn settings(set: Option<&Bound<'_, PyAny>>) -> PyResult<Settings> {
    let Some(set) = set.filter(|set| !set.is_none()) else { return Ok(Default::default()) };
    if let Ok(text) = set.extract::<String>() {
        return Ok((Vec::new(), vec![text]));
    }
    if let Ok(mapping) = set.cast::<PyMapping>() {
        let pair = |pair: Bound<'_, PyAny>| {
            let (key, object): (Bound<'_, PyAny>, Bound<'_, PyAny>) = pair.extract()?;
            let key = text(&key, "set")?;
            let value = value(&object, &key)?;
            Ok((key, value))
        };
        return Ok((mapping.items()?.iter().map(pair).collect::<PyResult<_>>()?, Vec::new()));
    }
    let texts = set.extract().map_err(|_| {
        PyTypeError::new_err("set is a dict such as {\"layers.0.thickness\": 0.2}, or a list of texts KEY=VALUE")
    })?;
    Ok((Vec::new(), texts))
}

/// A key of `whole`.
pub fn text(key: &Bound<'_, PyAny>, whole: &str) -> PyResult<String> {
    key.extract().map_err(|_| PyTypeError::new_err(format!("a key of {whole} is no text: {key}")))
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}
