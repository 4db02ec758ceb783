//! Records as objects of Python, dicts with the keys that they have in files, and back.

use crate::errors::refused;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyList, PyTuple};
use pythonize::{depythonize, pythonize};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// A record as dicts, lists, numbers and texts; a number that is not finite is `None`, as it is null in a file.
pub fn to_python<'py>(py: Python<'py>, record: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    plain(pythonize(py, record)?)
}

/// The record whose keys are those of an object of Python.
pub fn from_python<T: DeserializeOwned>(object: &Bound<'_, PyAny>) -> PyResult<T> {
    depythonize(object).map_err(refused)
}

/// An object as JSON has it: lists for tuples, `None` for numbers that are not finite.
fn plain(object: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    let py = object.py();
    if let Ok(dict) = object.cast::<PyDict>() {
        let copy = PyDict::new(py);
        dict.iter().try_for_each(|(key, value)| copy.set_item(key, plain(value)?))?;
        return Ok(copy.into_any());
    }
    if object.is_instance_of::<PyTuple>() || object.is_instance_of::<PyList>() {
        let items = object.try_iter()?.map(|item| plain(item?)).collect::<PyResult<Vec<_>>>()?;
        return Ok(PyList::new(py, items)?.into_any());
    }
    let is_finite = object.cast::<PyFloat>().map_or(true, |number| number.value().is_finite());
    Ok(if is_finite { object } else { py.None().into_bound(py) })
}
