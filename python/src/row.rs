//! A combination of a sweep that is done.

use crate::record::{from_python, to_python};
use percoat::sweep;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::Arc;

/// A combination that is done: its number, settings, results and ending.
#[pyclass(frozen, skip_from_py_object, module = "percoat._core")]
#[derive(Debug, Clone)]
pub struct Row(Arc<sweep::Row>);

impl From<sweep::Row> for Row {
    fn from(row: sweep::Row) -> Self {
        Self(Arc::new(row))
    }
}

impl Row {
    /// The row of the library.
    pub fn row(&self) -> &sweep::Row {
        &self.0
    }
}

#[pymethods]
impl Row {
    /// Number of the combination in the sweep, from 1.
    #[getter]
    fn combination(&self) -> usize {
        self.0.combination
    }

    /// Number and settings of the combination in words.
    #[getter]
    fn name(&self) -> String {
        self.0.named()
    }

    /// Fingerprint of the whole case and the task; empty where the case is refused.
    #[getter]
    fn fingerprint(&self) -> &str {
        &self.0.fingerprint
    }

    /// `done`, `not_converged` or `failed`.
    #[getter]
    fn status(&self) -> &'static str {
        self.0.status.name()
    }

    /// Why it failed or did not converge; empty where it is done.
    #[getter]
    fn reason(&self) -> &str {
        self.0.reason.as_deref().unwrap_or_default()
    }

    /// Doubts about the results.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings.clone()
    }

    /// Lines of the combination in the table of the sweep, each a list of names with their cells.
    fn lines<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.0.cells())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        // A row as in a log, which is read back bit for bit.
        let entries = to_python(slf.py(), slf.get().row())?;
        Ok((slf.get_type().getattr("_restore")?, (entries,).into_pyobject(slf.py())?))
    }

    #[staticmethod]
    fn _restore(entries: &Bound<'_, PyAny>) -> PyResult<Self> {
        from_python::<sweep::Row>(entries).map(Self::from)
    }
}
