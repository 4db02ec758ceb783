//! A case: from a file, by its name, or from a dict.

use crate::errors::{no_case, refused, unreadable};
use crate::toml;
use crate::work;
use ::toml::Value;
use ndarray::ArrayD;
use numpy::{PyArrayDyn, PyArrayLikeDyn};
use percoat::case::resources::{Job, refusal};
use percoat::case::{self, Source, embedded};
use percoat::machine::{Capacity, available_memory, bytes};
use percoat::output::{self, Check};
use pyo3::exceptions::{PyMemoryError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyMapping, PyString, PyTuple};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Name under which a case has the heights of a dict, one that no file on disk has.
const HEIGHTS: &str = "<array>.npy";

/// A case that has been read, with every default resolved.
#[pyclass(frozen, skip_from_py_object, module = "percoat._core")]
#[derive(Debug, Clone)]
pub struct Case {
    pub own: Arc<case::Case>,
    pub name: String,
    /// What it was read from.
    pub source: Arc<Source>,
}

#[pymethods]
impl Case {
    /// The case that `case` stands for, changed by `set`.
    #[new]
    #[pyo3(signature = (case, set = None))]
    pub fn new(case: &Bound<'_, PyAny>, set: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let settings = toml::settings(set)?;
        let (source, name) = source(case)?;
        if let (Ok(known), true) = (case.cast::<Self>(), settings.is_empty()) {
            return Ok(known.get().clone());
        }
        Self::read(case.py(), source, settings, name)
    }

    /// Heights that are an array in memory, under the name that the case has for them.
    #[getter]
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        arrays(py, &self.source)
    }

    /// The whole case as JSON.
    #[getter]
    fn json(&self) -> String {
        serde_json::to_string(&*self.own).expect("a case is numbers and texts under names")
    }

    /// Vectors a₁ and a₂ of its cell.
    #[getter]
    fn cell(&self) -> [[f64; 2]; 2] {
        self.own.counterbody().cell().vectors()
    }

    /// What `percoat check` says, as JSON.
    #[pyo3(signature = (threads = None))]
    fn check(&self, py: Python<'_>, threads: Option<i64>) -> PyResult<String> {
        let Self { own, name, .. } = self.clone();
        let room = self.allow(Job::Keep)?;
        let checked = work::run(py, threads, None, move |_| {
            Check::of(&own, &name, room).map(|check| check.json().to_string()).map_err(|error| error.to_string())
        })?;
        checked.map_err(refused)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, case) = (slf.py(), slf.get());
        let own = case.clone();
        let source = work::run(py, None, None, move |_| own.portable())??;
        let (files, arrays) = (files(py, &source)?, arrays(py, &source)?);
        let state = (source.text, files, arrays, &case.name).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_restore")?, state))
    }

    #[staticmethod]
    fn _restore(
        text: String,
        files_of: &Bound<'_, PyDict>,
        arrays_of: &Bound<'_, PyDict>,
        name: String,
    ) -> PyResult<Self> {
        let file = |(name, bytes): (Bound<'_, PyAny>, Bound<'_, PyAny>)| -> PyResult<(String, Arc<[u8]>)> {
            Ok((name.extract()?, Arc::from(bytes.cast::<PyBytes>()?.as_bytes())))
        };
        let files = files_of.iter().map(file).collect::<PyResult<BTreeMap<_, _>>>()?;
        let heights = |(name, own): (Bound<'_, PyAny>, Bound<'_, PyAny>)| Ok((name.extract()?, array(&own)?));
        let arrays = arrays_of.iter().map(heights).collect::<PyResult<BTreeMap<_, _>>>()?;
        let source = Source { name: name.clone(), text, files, arrays, ..Source::default() };
        Self::read(files_of.py(), source, Vec::new(), name)
    }
}

/// The files of a source that are in memory.
fn files<'py>(py: Python<'py>, source: &Source) -> PyResult<Bound<'py, PyDict>> {
    let files = PyDict::new(py);
    for (name, bytes) in &source.files {
        files.set_item(name, PyBytes::new(py, bytes))?;
    }
    Ok(files)
}

/// The arrays of a source that are in memory, copied.
fn arrays<'py>(py: Python<'py>, source: &Source) -> PyResult<Bound<'py, PyDict>> {
    let arrays = PyDict::new(py);
    for (name, heights) in &source.arrays {
        arrays.set_item(name, PyArrayDyn::from_array(py, heights))?;
    }
    Ok(arrays)
}

impl Case {
    /// Reads a case, where surfaces are made and files read, on threads of its own.
    fn read(py: Python<'_>, source: Source, settings: Vec<String>, name: String) -> PyResult<Self> {
        let (source, read) = work::run(py, None, None, move |_| {
            let read = case::Case::read(&source, &settings);
            (source, read)
        })?;
        Ok(Self { own: Arc::new(read.map_err(refused)?), name, source: Arc::new(source) })
    }

    /// Room for a job, which is refused where there is not enough.
    pub fn allow(&self, job: Job) -> PyResult<Capacity> {
        let room = Capacity { disk: u64::MAX, ..Capacity::on_this_machine(Path::new(".")) };
        refusal(&self.own, room, job).map_or(Ok(room), |why| Err(refused(why)))
    }

    /// The same case as text with all its files, to be read on any machine.
    fn portable(&self) -> PyResult<Source> {
        let mut source = Source {
            name: self.name.clone(),
            text: self.own.to_toml(),
            files: self.source.files.clone(),
            arrays: self.source.arrays.clone(),
            ..Source::default()
        };
        if let Some(heights) = self.own.surface.as_ref().and_then(|surface| surface.heights.as_ref())
            && !source.files.contains_key(heights)
            && !source.arrays.contains_key(heights)
        {
            let bytes = std::fs::read(heights).map_err(|error| unreadable(Path::new(heights), &error))?;
            source.files.insert(heights.clone(), bytes.into());
            let again = case::Case::read(&source, &[]).map_err(refused)?;
            if output::fingerprint(&again, "") != output::fingerprint(&self.own, "") {
                return Err(refused(format!(
                    "{heights} has changed since it was read: what was solved cannot be kept without it"
                )));
            }
        }
        Ok(source)
    }
}

/// Text or values that `case` stands for, and its name.
pub fn source(case: &Bound<'_, PyAny>) -> PyResult<(Source, String)> {
    if let Ok(known) = case.cast::<Case>() {
        let Case { own, name, source } = known.get();
        return Ok((Source { text: own.to_toml(), values: None, ..(**source).clone() }, name.clone()));
    }
    if let Ok(path) = case.extract::<PathBuf>() {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        return Ok((case::find(&path).map_err(no_case)?, name));
    }
    let Ok(mapping) = case.cast::<PyMapping>() else {
        let kind = case.get_type().name()?;
        return Err(PyTypeError::new_err(format!(
            "a case is a path, the name of an embedded case or a dict of the same shape as the file, not a {kind}"
        )));
    };
    let mut arrays = BTreeMap::new();
    let mut values = ::toml::Table::new();
    for pair in mapping.items()?.iter() {
        let (key, own): (Bound<'_, PyAny>, Bound<'_, PyAny>) = pair.extract()?;
        let heights = match (key.extract::<String>().as_deref(), own.cast::<PyMapping>()) {
            (Ok("surface"), Ok(section)) => {
                section.get_item("heights").ok().filter(|own| !own.is_none() && own.extract::<PathBuf>().is_err())
            }
            _ => None,
        };
        let Some(heights) = heights else {
            let single = PyDict::new(case.py());
            single.set_item(key, own)?;
            values.extend(toml::table(single.as_mapping(), "")?);
            continue;
        };
        arrays.insert(HEIGHTS.to_owned(), array(&heights)?);
        let section = PyDict::new(case.py());
        section.update(own.cast::<PyMapping>()?)?;
        section.set_item("heights", HEIGHTS)?;
        values.insert("surface".to_owned(), Value::Table(toml::table(section.as_mapping(), "surface")?));
    }
    Ok((Source { name: "dict".to_owned(), values: Some(values), arrays, ..Source::default() }, "dict".to_owned()))
}

/// Heights as an array of their own.
fn array(heights: &Bound<'_, PyAny>) -> PyResult<Arc<ArrayD<f64>>> {
    let masked = heights.py().import("numpy.ma")?.getattr("MaskedArray")?;
    if heights.is_instance(&masked)? {
        return Err(refused(
            "`surface.heights` is masked: a surface has a height everywhere; fill what was not measured",
        ));
    }
    if heights.hasattr("dtype")? && heights.getattr("dtype")?.getattr("kind")?.eq("c")? {
        return Err(PyTypeError::new_err("`surface.heights` is complex: heights are real numbers"));
    }
    has_room(&sizes(heights)?)?;
    let py = heights.py();
    // A table of another library says itself which array it is: taken as a sequence it is that of its columns.
    let is_table = heights.hasattr("__array__")?;
    let heights = if is_table { py.import("numpy")?.call_method1("asarray", (heights,))? } else { heights.clone() };
    let heights: PyArrayLikeDyn<'_, f64, numpy::AllowTypeChange> = heights.extract().map_err(|error: PyErr| {
        if error.is_instance_of::<PyMemoryError>(py) {
            return error;
        }
        PyTypeError::new_err("`surface.heights` is an array of numbers, one period of the cell")
    })?;
    let view = heights.as_array();
    has_room(view.shape())?;
    Ok(Arc::new(view.to_owned()))
}

/// The sizes of an array or of a list of lists, before anything of it is copied.
fn sizes(heights: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
    if let Ok(shape) = heights.getattr("shape") {
        return Ok(shape.extract().unwrap_or_default());
    }
    let (mut sizes, mut own) = (Vec::new(), heights.clone());
    // No array of NumPy has more axes.
    while let (true, Ok(size)) = (sizes.len() < 64 && !own.is_instance_of::<PyString>(), own.len()) {
        sizes.push(size);
        match own.get_item(0) {
            Ok(first) => own = first,
            Err(_) => break,
        }
    }
    Ok(sizes)
}

/// Copies of the heights that are there at once at most: in another type, as an array of the case, and as a surface with its waves.
const COPIES: u64 = 4;

/// Refuses heights that memory does not hold before any is taken for them.
fn has_room(sizes: &[usize]) -> PyResult<()> {
    let samples = sizes.iter().fold(1_u64, |samples, &size| samples.saturating_mul(size as u64));
    let (needed, available) = (samples.saturating_mul(8 * COPIES), available_memory());
    let mut all: Vec<u8> = Vec::new();
    // A limit of the process refuses what it would not survive.
    let is_given =
        needed <= available && usize::try_from(needed).is_ok_and(|needed| all.try_reserve_exact(needed).is_ok());
    if is_given {
        return Ok(());
    }
    let sizes: Vec<String> = sizes.iter().map(ToString::to_string).collect();
    Err(PyMemoryError::new_err(format!(
        "`surface.heights` of {} samples takes about {} of memory, and {} are available: give fewer of them",
        sizes.join(" × "),
        bytes(needed),
        bytes(available)
    )))
}

/// Names and titles of the embedded cases.
#[pyfunction]
pub fn cases() -> PyResult<Vec<(&'static str, String)>> {
    // Their surfaces need not be made.
    let title = |text: &str| -> PyResult<String> {
        let table: ::toml::Table = ::toml::from_str(text).map_err(refused)?;
        Ok(table.get("title").and_then(Value::as_str).unwrap_or_default().to_owned())
    };
    embedded::all().iter().map(|(name, text)| Ok((*name, title(text)?))).collect()
}

/// What `percoat explain` says.
#[pyfunction]
#[pyo3(signature = (key = None))]
pub fn explain(key: Option<&str>) -> PyResult<String> {
    let Some(key) = key else { return Ok(case::overview()) };
    let told = case::explain(key).map_err(refused)?;
    Ok(told.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}

/// The JSON schema of a case.
#[pyfunction]
pub fn schema() -> String {
    case::schema().to_string()
}
