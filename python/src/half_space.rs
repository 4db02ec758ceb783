//! The layered half-space alone: its response to harmonic tractions.

use crate::case;
use crate::errors::refused;
use crate::record::to_python;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use percoat::body::LayeredResponse;
use percoat::case::half_space;
use percoat::output::{self, Traction};
use percoat::units::CARRIED;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Layers on a substrate, and their response to harmonic tractions.
#[pyclass(frozen, module = "percoat._core")]
#[derive(Debug)]
pub struct HalfSpace {
    own: percoat::HalfSpace,
    /// The sections it was read from.
    text: String,
}

/// Wavenumbers that double precision carries.
fn checked(wavenumbers: &[f64]) -> PyResult<()> {
    match wavenumbers.iter().find(|q| !CARRIED.contains(q)) {
        Some(q) => Err(refused(format!("a wavenumber is a number greater than 0, between 1e-60 and 1e60, not {q}"))),
        None => Ok(()),
    }
}

#[pymethods]
impl HalfSpace {
    /// Of a case, or of a dict with the sections `layers` and `substrate` alone.
    #[new]
    fn new(sections: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (source, _) = case::source(sections)?;
        if let Ok(known) = sections.cast::<case::Case>() {
            let own = known.get().own.half_space().clone();
            let mut sections: toml::Table = toml::from_str(&source.text).map_err(refused)?;
            sections.retain(|key, _| ["layers", "substrate"].contains(&key));
            let text = toml::to_string(&sections).map_err(refused)?;
            return Ok(Self { own, text });
        }
        let own = half_space(&source).map_err(refused)?;
        let text = match &source.values {
            Some(values) => toml::to_string(values).map_err(refused)?,
            None => source.text,
        };
        Ok(Self { own, text })
    }

    /// ŵ/p̂ at wavenumbers, a length over a pressure.
    fn compliance<'py>(
        &self,
        py: Python<'py>,
        wavenumbers: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.of_each(py, &wavenumbers, LayeredResponse::compliance)
    }

    /// T, the compliance over that of a half-space of the surface's material.
    fn correction<'py>(
        &self,
        py: Python<'py>,
        wavenumbers: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.of_each(py, &wavenumbers, LayeredResponse::correction)
    }

    /// The lines of `percoat kernel`, as dicts.
    fn kernel<'py>(
        &self,
        py: Python<'py>,
        wavenumbers: PyReadonlyArray1<'py, f64>,
        depths: Vec<f64>,
        traction: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let traction = match traction {
            "normal" => Traction::Normal,
            "along" => Traction::Along,
            "across" => Traction::Across,
            other => return Err(refused(format!("traction is \"normal\", \"along\" or \"across\", not {other:?}"))),
        };
        if let Some(z) = depths.iter().find(|z| !(**z == 0.0 || CARRIED.contains(z))) {
            return Err(refused(format!("a depth is a number not less than 0, at most 1e60, not {z}")));
        }
        let wavenumbers = wavenumbers.as_array().to_vec();
        checked(&wavenumbers)?;
        let line = |&q: &f64| output::kernel(self.own.response(), &self.own, q, &depths, traction);
        let lines: Vec<_> = py.detach(|| wavenumbers.iter().map(line).collect());
        to_python(py, &lines)
    }

    fn __str__(&self) -> String {
        self.own.to_string()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        Ok((slf.get_type().getattr("_restore")?, (&slf.get().text,).into_pyobject(slf.py())?))
    }

    #[staticmethod]
    fn _restore(text: String) -> PyResult<Self> {
        let source = percoat::case::Source { name: "half-space".to_owned(), text, ..Default::default() };
        let own = half_space(&source).map_err(refused)?;
        Ok(Self { own, text: source.text })
    }
}

impl HalfSpace {
    fn of_each<'py>(
        &self,
        py: Python<'py>,
        wavenumbers: &PyReadonlyArray1<'py, f64>,
        value: impl Fn(&LayeredResponse, f64) -> f64 + Send + Sync,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let wavenumbers = wavenumbers.as_array().to_vec();
        checked(&wavenumbers)?;
        let response = self.own.response();
        let values: Vec<f64> = py.detach(|| wavenumbers.iter().map(|&q| value(response, q)).collect());
        Ok(values.into_pyarray(py))
    }
}
