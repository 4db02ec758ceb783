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
use toml::Table;

/// Layers on a substrate, and their response to harmonic tractions.
#[pyclass(frozen, module = "percoat._core")]
#[derive(Debug)]
pub struct HalfSpace {
    half_space: percoat::HalfSpace,
    /// The sections `layers`, `substrate`, `units` and `materials` of a case.
    sections: Table,
}

/// Refuses wavenumbers that double precision does not carry.
fn checked(wavenumbers: &[f64]) -> PyResult<()> {
    match wavenumbers.iter().find(|q| !CARRIED.contains(q)) {
        Some(q) => Err(refused(format!("a wavenumber is a number greater than 0, between 1e-60 and 1e60, not {q}"))),
        None => Ok(()),
    }
}

#[pymethods]
impl HalfSpace {
    /// The half-space of a case, or of a dict with the sections of a half-space alone.
    #[new]
    fn new(sections: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (source, _) = case::source(sections)?;
        let half_space = match sections.cast::<case::Case>() {
            Ok(known) => known.get().case.half_space().clone(),
            Err(_) => half_space(&source).map_err(refused)?,
        };
        let mut sections = source.values.map_or_else(|| toml::from_str(&source.text), Ok).map_err(refused)?;
        sections.retain(|key, _| ["layers", "substrate", "units", "materials"].contains(&key));
        Ok(Self { half_space, sections })
    }

    /// ŵ/p̂ at wavenumbers (1/length, one axis), a length over a pressure.
    fn compliance<'py>(
        &self,
        py: Python<'py>,
        wavenumbers: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.of_each(py, &wavenumbers, LayeredResponse::compliance)
    }

    /// T at wavenumbers, the compliance over that of a half-space of the surface's material.
    fn correction<'py>(
        &self,
        py: Python<'py>,
        wavenumbers: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.of_each(py, &wavenumbers, LayeredResponse::correction)
    }

    /// The lines of `percoat kernel`, a dict a wavenumber.
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
        if let Some(z) = depths.iter().find(|&&z| self.half_space.depths(z).is_empty()) {
            return Err(refused(format!("the depth {z} is below the rigid base at {}", self.half_space.base_depth())));
        }
        let wavenumbers = wavenumbers.as_array().to_vec();
        checked(&wavenumbers)?;
        let line = |&q: &f64| output::kernel(self.half_space.response(), &self.half_space, q, &depths, traction);
        let lines: Vec<_> = py.detach(|| wavenumbers.iter().map(line).collect());
        to_python(py, &lines)
    }

    fn __str__(&self) -> String {
        self.half_space.to_string()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let sections = to_python(slf.py(), &slf.get().sections)?;
        Ok((slf.get_type().into_any(), (sections,).into_pyobject(slf.py())?))
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
        let response = self.half_space.response();
        let values: Vec<f64> = py.detach(|| wavenumbers.iter().map(|&q| value(response, q)).collect());
        Ok(values.into_pyarray(py))
    }
}
