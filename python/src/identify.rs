//! `percoat.identify`: numbers of a case from a measured indentation curve.

use crate::case::{self, Case};
use crate::errors::{refused, unreadable};
use crate::progress::Progress;
use crate::record::to_python;
use crate::work;
use numpy::{PyArray1, PyReadonlyArray1, ToPyArray};
use percoat::case::{Document, IdentificationTask, known_instrument};
use percoat::measurements::{self, Curve, Segment};
use percoat::output::{self, identified};
use percoat::plain;
use percoat::task::Identify;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;

/// Record of what was found as a dict, the arrays of the curve and its fit, the table, and the warnings.
type Found<'py> = (Bound<'py, PyAny>, Bound<'py, PyDict>, String, Vec<String>);

/// The numbers of a case that are `asked` for, what the instrument is known to add as `offset=0.002`, and the segment of the test. Their values from a curve,
/// the path of a table or columns with their names: a dict with the keys of
/// `identification.json`, arrays of the curve and its fit, the table of the command line in lines of `width` letters, and warnings.
#[pyfunction]
#[pyo3(signature = (case, data, asked, width, threads = None, progress = None))]
pub fn identify<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    data: &Bound<'py, PyAny>,
    asked: (Vec<String>, Vec<String>, Option<String>),
    width: usize,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Found<'py>> {
    let resolved = Arc::clone(&case.get().case);
    let (free, known, segment) = asked;
    let unknown = || refused(format!("segment must be \"loading\" or None, not {segment:?}"));
    let segment = Segment::of(segment.as_deref()).ok_or_else(unknown)?;
    let Curve { measurement: measured, notes } = measured(data, segment, &resolved)?;
    let curve = measured.clone();
    let known = known_instrument(&known).map_err(|error| refused(format!("known: {error}")))?;
    let (source, _) = case::source(case.as_any())?;
    let (file, text, warnings, found) = work::try_run(py, threads, progress, move |listener| {
        let document = Document::new(&source, &[])?;
        let task = IdentificationTask::new(&document, &resolved, &free).map_err(|error| format!("free: {error}"))?;
        let task = Identify::new(task.with_instrument(known), work::room(), false)?.with_notes(notes);
        let result = task.find(&measured, &mut |trial| {
            let phase = output::trial(&resolved, trial);
            listener.tell(true, || Progress { done: trial.number, ..Progress::new("trial", phase) });
            if listener.stops() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        let file = result.file();
        let text = identified(&file, &result.best.units(), width);
        Ok((file, text, result.warnings, result.found))
    })?;
    let arrays = PyDict::new(py);
    let columns = [
        ("force", Some(curve.forces())),
        ("penetration", Some(curve.penetrations())),
        ("penetration_error", curve.deviations()),
        ("fitted", Some(&found.fitted[..])),
        ("fitted_error", Some(&found.band[..])),
    ];
    for (name, column) in columns {
        arrays.set_item(name, column.map(|column: &[f64]| -> Bound<'py, PyArray1<f64>> { column.to_pyarray(py) }))?;
    }
    Ok((to_python(py, &file)?, arrays, text, warnings))
}

/// The measured curve of a table, or of columns `(name, array)`.
fn measured(data: &Bound<'_, PyAny>, segment: Segment, case: &percoat::case::Case) -> PyResult<Curve> {
    if let Ok(path) = data.extract::<PathBuf>() {
        let table = std::fs::read(&path).map_err(|error| unreadable(&path, &error))?;
        let fault = |fault| refused(format!("{}: {fault}", plain::path(&path)));
        return measurements::read(&measurements::text(&table), segment, &case.units()).map_err(fault);
    }
    let columns: Vec<(String, PyReadonlyArray1<'_, f64>)> = data.extract()?;
    let columns: Vec<(String, Vec<f64>)> =
        columns.into_iter().map(|(name, values)| (name, values.as_array().to_vec())).collect();
    measurements::of_columns(&columns, segment, &case.units()).map_err(refused)
}
