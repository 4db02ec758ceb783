//! The library of materials, and files of one's own.

use crate::errors::{no_case, refused};
use crate::record::to_python;
use percoat::case::{LibraryMaterial, MaterialsError, library, materials_of_file};
use pyo3::prelude::*;
use std::path::PathBuf;

/// The materials of a file, if any, and of the library, each a dict.
#[pyfunction]
#[pyo3(signature = (file = None))]
pub fn materials(py: Python<'_>, file: Option<PathBuf>) -> PyResult<Bound<'_, PyAny>> {
    let of_file = file.map_or(Ok(Vec::new()), |path| {
        materials_of_file(&path).map_err(|error| match error {
            MaterialsError::File(error) => no_case(error),
            MaterialsError::Fault(error) => refused(error),
        })
    })?;
    let all: Vec<&LibraryMaterial> = of_file.iter().chain(library()).collect();
    to_python(py, &all)
}
