//! `percoat.identify`: numbers of a case from measured indentation curves.

use crate::case::{self, Case};
use crate::errors::{refused, unreadable};
use crate::progress::Progress;
use crate::record::to_python;
use crate::work;
use numpy::{PyArray1, PyReadonlyArray1, ToPyArray};
use percoat::case::{Document, Found as FoundNumbers, IdentificationTask, Known};
use percoat::identification::Unloading;
use percoat::measurements::{self, Curves, Segment, Source, Taken};
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

/// What is asked for: numbers of the case, what is known as `offset=0.002`, the segment of the tests, and the part that is fitted of unloading.
type Asked = (Vec<String>, Vec<String>, Option<String>, Option<Vec<f64>>);

/// The numbers of a case that are `asked` for. Their values from curves, each
/// the path of a table or columns with their names: a dict with the keys of
/// `identification.json`, arrays of the curves and their fit, the table of the command line in lines of `width` letters, and warnings.
#[pyfunction]
#[pyo3(signature = (case, data, asked, width, threads = None, progress = None))]
pub fn identify<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    data: Vec<Bound<'py, PyAny>>,
    asked: Asked,
    width: usize,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Found<'py>> {
    let resolved = Arc::clone(&case.get().case);
    let (free, known, segment, part) = asked;
    let segment = Segment::of(segment.as_deref(), part.as_deref()).map_err(refused)?;
    let measured = taken(&data, segment, &resolved)?;
    let known = Known::of(&known).and_then(|known| known.for_segment(segment));
    let known = known.map_err(|error| refused(format!("known: {error}")))?;
    let (source, _) = case::source(case.as_any())?;
    let (file, text, warnings, columns) = work::try_run(py, threads, progress, move |listener| {
        let document = Document::new(&source, &[])?;
        let task = IdentificationTask::new(&document, &resolved, &free).map_err(|error| format!("free: {error}"))?;
        let task = Identify::new(task.with_known(known), work::room(), false)?;
        let result = task.find(&measured, &mut |trial| {
            let phase = output::trial(&resolved, trial);
            listener.tell(true, || Progress { done: trial.number, ..Progress::new("trial", phase) });
            if listener.stops() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        let file = result.file();
        let text = identified(&file, &result.best.units(), width);
        let columns = columns(&result.measured.curves, &result.found);
        Ok((file, text, result.warnings, columns))
    })?;
    let arrays = PyDict::new(py);
    for (name, column) in columns {
        arrays.set_item(name, column.map(|column| -> Bound<'py, PyArray1<f64>> { column.to_pyarray(py) }))?;
    }
    Ok((to_python(py, &file)?, arrays, text, warnings))
}

/// Names of the arrays of curves and fit, and the arrays; `None` of what is not known.
type Columns = [(&'static str, Option<Vec<f64>>); 6];

/// The arrays of measured curves and of their fit: of unloadings the fitted points with their power law.
fn columns(measured: &Curves, found: &FoundNumbers) -> Columns {
    let [force, penetration, deviation, fitted, band, curve] = match (measured, found) {
        (Curves::Loading(measured), FoundNumbers::Loading(found)) => [
            Some(measured.forces().to_vec()),
            Some(measured.penetrations().to_vec()),
            measured.deviations().map(<[f64]>::to_vec),
            Some(found.fitted.clone()),
            Some(found.band.clone()),
            Some((0..measured.forces().len()).map(|i| measured.curve_of(i) as f64).collect()),
        ],
        (Curves::Unloading(unloadings), _) => {
            let joined = |of: &dyn Fn(&Unloading) -> &Vec<f64>| Some(unloadings.iter().flat_map(of).copied().collect());
            let curves = unloadings.iter().enumerate();
            let curve = curves.flat_map(|(curve, unloading)| vec![curve as f64; unloading.forces.len()]).collect();
            let unknown = Some(vec![f64::NAN; unloadings.iter().map(|unloading| unloading.forces.len()).sum()]);
            let penetration = joined(&|unloading| &unloading.penetrations);
            [
                joined(&|unloading| &unloading.forces),
                penetration,
                None,
                joined(&|unloading| &unloading.fitted),
                unknown,
                Some(curve),
            ]
        }
        (Curves::Retraction(measured), FoundNumbers::Retraction(found)) => [
            Some(measured.forces().to_vec()),
            Some(measured.penetrations().to_vec()),
            None,
            Some(found.fitted.clone()),
            Some(found.band.clone()),
            None,
        ],
        _ => [const { None }; 6],
    };
    [
        ("force", force),
        ("penetration", penetration),
        ("penetration_error", deviation),
        ("fitted", fitted),
        ("fitted_error", band),
        ("curve", curve),
    ]
}

/// The measured curves of tables, or of columns `(name, array)`.
fn taken(data: &[Bound<'_, PyAny>], segment: Segment, case: &percoat::case::Case) -> PyResult<Taken> {
    let read = |data: &Bound<'_, PyAny>| -> PyResult<(String, Read)> {
        if let Ok(path) = data.extract::<PathBuf>() {
            let table = std::fs::read(&path).map_err(|error| unreadable(&path, &error))?;
            return Ok((plain::path(&path), Read::Text(measurements::text(&table).into_owned())));
        }
        let columns: Vec<(String, PyReadonlyArray1<'_, f64>)> = data.extract()?;
        let columns = columns.into_iter().map(|(name, values)| (name, values.as_array().to_vec())).collect();
        Ok((String::new(), Read::Columns(columns)))
    };
    let all: Vec<(String, Read)> = data.iter().map(read).collect::<PyResult<_>>()?;
    let sources: Vec<(&str, Source<'_>)> = all.iter().map(|(name, read)| (name.as_str(), read.source())).collect();
    Taken::new(&sources, segment, &case.units()).map_err(refused)
}

/// A curve as it was given.
enum Read {
    Text(String),
    Columns(Vec<(String, Vec<f64>)>),
}

impl Read {
    fn source(&self) -> Source<'_> {
        match self {
            Self::Text(text) => Source::Text(text),
            Self::Columns(columns) => Source::Columns(columns),
        }
    }
}
