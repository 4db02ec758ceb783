//! Records as objects of Python, dicts of the keys that they have in files, and back.

use crate::errors::refused;
use pyo3::prelude::*;
use pythonize::{depythonize, pythonize};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// A record as an object of Python; a number that is not finite is `None`, as it is null in a file.
pub fn to_python<'py>(py: Python<'py>, record: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let value = serde_json::to_value(record).map_err(refused)?;
    Ok(pythonize(py, &value)?)
}

/// The record that an object of Python has the keys of.
pub fn from_python<T: DeserializeOwned>(object: &Bound<'_, PyAny>) -> PyResult<T> {
    depythonize(object).map_err(refused)
}
