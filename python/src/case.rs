//! A case: from a file, by its name, or from a dict.

use crate::errors::{no_case, refused, unreadable};
use crate::record::to_python;
use crate::value::{settings, table};
use crate::work;
use ndarray::ArrayD;
use numpy::{PyArrayDyn, PyArrayLikeDyn};
use percoat::case::resources::{Job, refusal};
use percoat::case::{self, GivenSection, PhysicalSizes, Source, embedded};
use percoat::machine::{Capacity, available_memory, bytes};
use percoat::output::{self, Check};
use pyo3::exceptions::{PyMemoryError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyMapping, PyString, PyTuple};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::{Table, Value};

/// Name of the heights of a dict in its case, none of a file.
const HEIGHTS: &str = "<array>.npy";

/// A case that has been read, with every default resolved.
#[pyclass(frozen, skip_from_py_object, module = "percoat._core")]
#[derive(Debug, Clone)]
pub struct Case {
    pub case: Arc<case::Case>,
    pub name: String,
    /// The text or values from which it was read, with the files and arrays in memory.
    pub source: Arc<Source>,
}

#[pymethods]
impl Case {
    /// The case of a path, a name, a dict or a case, changed by `set`.
    #[new]
    #[pyo3(signature = (case, set = None))]
    pub fn new(case: &Bound<'_, PyAny>, set: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let (values, texts) = settings(set)?;
        let typed = texts.iter().map(|text| text.split_once('=').map_or(text.as_str(), |(key, _)| key));
        if let Some(key) = case::given_twice(values.iter().map(|(key, _)| key.as_str()).chain(typed)) {
            return Err(refused(format!("set has `{}` twice: give one value", key.trim())));
        }
        if let (Ok(known), true, true) = (case.cast::<Self>(), values.is_empty(), texts.is_empty()) {
            return Ok(known.get().clone());
        }
        let (source, name) = source(case)?;
        Self::read(case.py(), Source { set: values, ..source }, texts, name)
    }

    /// The case as a dict, complete with its defaults; heights in memory are an array.
    fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let dict = to_python(py, &*self.case)?;
        let heights = self.case.surface.as_ref().and_then(|surface| surface.heights.as_ref());
        if let Some(heights) = heights.and_then(|name| self.source.arrays.get(name)) {
            dict.get_item("surface")?.set_item("heights", PyArrayDyn::from_array(py, heights))?;
        }
        Ok(dict)
    }

    /// Vectors a₁ and a₂ of the cell, lengths.
    #[getter]
    fn cell(&self) -> [[f64; 2]; 2] {
        self.case.problem().cell().vectors()
    }

    /// The values of `percoat check` and its text, as a dict.
    #[pyo3(signature = (threads = None))]
    fn check<'py>(&self, py: Python<'py>, threads: Option<i64>) -> PyResult<Bound<'py, PyAny>> {
        let Self { case, name, .. } = self.clone();
        let room = self.allow(Job::Keep)?;
        let checked = work::try_run(py, threads, None, move |_| Ok(Check::of(&case, &name, room)?.json()))?;
        to_python(py, &checked)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, case) = (slf.py(), slf.get());
        let copy = case.clone();
        let source = work::run(py, None, None, move |_| copy.portable())??;
        let state = (to_python(py, &source.values)?, in_memory(py, &source)?, &case.name).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_restore")?, state))
    }

    #[staticmethod]
    fn _restore(values: &Bound<'_, PyDict>, memory: Memory<'_>, name: String) -> PyResult<Self> {
        let table = Some(table(values.as_mapping(), "")?);
        let source = with_memory(Source { name: name.clone(), values: table, ..Source::default() }, memory)?;
        Self::read(values.py(), source, Vec::new(), name)
    }
}

impl Case {
    /// The case of a source, changed by texts `KEY=VALUE`; read on a thread of its own, as files and random surfaces take time.
    fn read(py: Python<'_>, source: Source, texts: Vec<String>, name: String) -> PyResult<Self> {
        let (source, read) = work::run(py, None, None, move |_| {
            let read = case::Case::read(&source, &texts);
            (source, read)
        })?;
        Ok(Self { case: Arc::new(read.map_err(refused)?), name, source: Arc::new(source) })
    }

    /// Memory of this machine for a job, or the refusal of a job that needs more.
    pub fn allow(&self, job: Job) -> PyResult<Capacity> {
        let room = work::room();
        refusal(&self.case, room, job).map_or(Ok(room), |why| Err(refused(why)))
    }

    /// The case as values with all its files in memory, which any machine can read.
    fn portable(&self) -> PyResult<Source> {
        let mut source = Source {
            name: self.name.clone(),
            values: Some(values(&self.case)),
            files: self.source.files.clone(),
            arrays: self.source.arrays.clone(),
            sizes: self.source.sizes.clone(),
            ..Source::default()
        };
        let mut case = case::Case::clone(&self.case);
        if let Some((_, name)) = file(&mut case)
            && !source.files.contains_key(name)
            && !source.arrays.contains_key(name)
        {
            let bytes = std::fs::read(&*name).map_err(|error| unreadable(Path::new(name), &error))?;
            source.files.insert(name.clone(), bytes.into());
            let again = case::Case::read(&source, &[]).map_err(refused)?;
            if output::fingerprint(&again, "") != output::fingerprint(&self.case, "") {
                return Err(refused(format!(
                    "{name} has changed since it was read: what was solved cannot be kept without it"
                )));
            }
        }
        Ok(source)
    }
}

/// Content of the file of a case, `heights` or `pressure`, and its name in the case; `None` of a case without a file.
pub fn file(case: &mut case::Case) -> Option<(&'static str, &mut String)> {
    if let Some(heights) = case.surface.as_mut().and_then(|surface| surface.heights.as_mut()) {
        return Some(("heights", heights));
    }
    match &mut case.load.pressure {
        Some(GivenSection::File(name)) => Some(("pressure", name)),
        _ => None,
    }
}

/// Files, arrays, and sizes of the arrays of a source in memory, by their names.
pub type Memory<'py> = (Bound<'py, PyDict>, Bound<'py, PyDict>, BTreeMap<String, ([f64; 2], Option<String>)>);

/// Files and arrays that a source has in memory, as they are pickled.
pub fn in_memory<'py>(py: Python<'py>, source: &Source) -> PyResult<Memory<'py>> {
    let (files, arrays) = (PyDict::new(py), PyDict::new(py));
    for (name, bytes) in &source.files {
        files.set_item(name, PyBytes::new(py, bytes))?;
    }
    for (name, heights) in &source.arrays {
        arrays.set_item(name, PyArrayDyn::from_array(py, heights))?;
    }
    let sizes = source.sizes.iter().map(|(name, sizes)| (name.clone(), (sizes.sides, sizes.unit.clone())));
    Ok((files, arrays, sizes.collect()))
}

/// The source with what is [in memory](in_memory).
pub fn with_memory(source: Source, (files, arrays, sizes): Memory<'_>) -> PyResult<Source> {
    let file = |(name, bytes): (Bound<'_, PyAny>, Bound<'_, PyAny>)| -> PyResult<(String, Arc<[u8]>)> {
        Ok((name.extract()?, Arc::from(bytes.cast::<PyBytes>()?.as_bytes())))
    };
    let heights = |(name, values): (Bound<'_, PyAny>, Bound<'_, PyAny>)| Ok((name.extract()?, array(&values)?));
    let files = files.iter().map(file).collect::<PyResult<_>>()?;
    let arrays = arrays.iter().map(heights).collect::<PyResult<_>>()?;
    let sizes = sizes.into_iter().map(|(name, (sides, unit))| (name, PhysicalSizes { sides, unit })).collect();
    Ok(Source { files, arrays, sizes, ..source })
}

/// A case as the values of its keys.
fn values(case: &case::Case) -> Table {
    Table::try_from(case).expect("a case is numbers and texts under names")
}

/// The text or the values of a path, a name, a dict or a case, and what the case is called.
pub fn source(case: &Bound<'_, PyAny>) -> PyResult<(Source, String)> {
    if let Ok(known) = case.cast::<Case>() {
        let Case { case, name, source } = known.get();
        let (text, values, set) = (String::new(), Some(values(case)), Vec::new());
        return Ok((Source { text, values, set, ..(**source).clone() }, name.clone()));
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
    let (sections, surface) = (PyDict::new(case.py()), PyDict::new(case.py()));
    let (mut arrays, mut sizes) = (BTreeMap::new(), BTreeMap::new());
    sections.update(mapping)?;
    if let Some(section) = sections.get_item("surface")?
        && let Ok(section) = section.cast::<PyMapping>()
    {
        surface.update(section)?;
        let is_array = |heights: &Bound<'_, PyAny>| !heights.is_none() && heights.extract::<PathBuf>().is_err();
        if let Some(heights) = surface.get_item("heights")?.filter(is_array) {
            let heights = match physical_sizes(&heights)? {
                Some(physical) => {
                    sizes.insert(HEIGHTS.to_owned(), physical);
                    heights.call_method0("heights")?
                }
                None => heights,
            };
            arrays.insert(HEIGHTS.to_owned(), array(&heights)?);
            surface.set_item("heights", HEIGHTS)?;
            sections.set_item("surface", surface)?;
        }
    }
    let values = Some(table(sections.as_mapping(), "")?);
    Ok((Source { name: "dict".to_owned(), values, arrays, sizes, ..Source::default() }, "dict".to_owned()))
}

/// Sizes of a topography of another library, which has `heights()` along x and y, `physical_sizes` and perhaps a `unit` of both.
fn physical_sizes(heights: &Bound<'_, PyAny>) -> PyResult<Option<PhysicalSizes>> {
    if !heights.hasattr("physical_sizes")? || !heights.hasattr("heights")? {
        return Ok(None);
    }
    let given = heights.getattr("physical_sizes")?;
    let sides: [f64; 2] = given.extract().map_err(|_| {
        PyTypeError::new_err(format!(
            "`surface.heights` has the physical sizes {given}: a surface has two, along x and y"
        ))
    })?;
    let unit = if heights.hasattr("unit")? { heights.getattr("unit")?.extract().ok() } else { None };
    Ok(Some(PhysicalSizes { sides, unit }))
}

/// Heights as an array of the case, copied; NaN where they are masked.
fn array(heights: &Bound<'_, PyAny>) -> PyResult<Arc<ArrayD<f64>>> {
    if heights.hasattr("dtype")? && heights.getattr("dtype")?.getattr("kind")?.eq("c")? {
        return Err(PyTypeError::new_err("`surface.heights` is complex: heights are real numbers"));
    }
    has_room(&sizes(heights)?)?;
    let py = heights.py();
    // A table of another library, as a sequence, is that of its columns.
    let is_table = heights.hasattr("__array__")?;
    let is_masked = heights.is_instance(&py.import("numpy.ma")?.getattr("MaskedArray")?)?;
    // Arrays out of the memory of a message may begin at any byte.
    let aligned = || py.import("numpy")?.call_method1("require", (heights, py.None(), "A"));
    let heights = match (is_masked, is_table) {
        (true, _) => heights.call_method1("astype", ("f8",))?.call_method1("filled", (f64::NAN,))?,
        (_, true) => aligned()?,
        _ => heights.clone(),
    };
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

/// Samples along each axis of an array or of a list of lists.
fn sizes(heights: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
    if let Ok(shape) = heights.getattr("shape") {
        return Ok(shape.extract().unwrap_or_default());
    }
    let (mut sizes, mut part) = (Vec::new(), heights.clone());
    // No array of NumPy has more axes.
    while let (true, Ok(size)) = (sizes.len() < 64 && !part.is_instance_of::<PyString>(), part.len()) {
        sizes.push(size);
        match part.get_item(0) {
            Ok(first) => part = first,
            Err(_) => break,
        }
    }
    Ok(sizes)
}

/// Most copies of the heights in memory at once: in another type, as an array of the case, as a surface, and its waves.
const COPIES: u64 = 4;

/// Refuses heights of which memory does not hold the copies, before any is made.
fn has_room(sizes: &[usize]) -> PyResult<()> {
    let samples = sizes.iter().fold(1_u64, |samples, &size| samples.saturating_mul(size as u64));
    let (needed, available) = (samples.saturating_mul(8 * COPIES), available_memory());
    let mut all: Vec<u8> = Vec::new();
    // The process may have a limit below the memory of the machine.
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
    // The title stands in the text; to read the case would make its surface.
    let title = |text: &str| -> PyResult<String> {
        let table: Table = toml::from_str(text).map_err(refused)?;
        Ok(table.get("title").and_then(Value::as_str).unwrap_or_default().to_owned())
    };
    embedded::all().iter().map(|(name, text)| Ok((*name, title(text)?))).collect()
}

/// The text of `percoat explain`.
#[pyfunction]
#[pyo3(signature = (key = None))]
pub fn explain(key: Option<&str>) -> PyResult<String> {
    let Some(key) = key else { return Ok(case::overview()) };
    let told = case::explain(key).map_err(refused)?;
    Ok(told.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}

/// The JSON schema of a case.
#[pyfunction]
pub fn schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    to_python(py, &case::schema())
}
