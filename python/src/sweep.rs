//! `percoat.sweep`: a case, solved for many settings of its keys.

use crate::case::{self, Memory, in_memory, with_memory};
use crate::errors::refused;
use crate::progress::Progress;
use crate::record::{from_python, to_python};
use crate::row::Row;
use crate::value::{text, value};
use crate::work::{self, room};
use percoat::case::Source;
use percoat::machine::available_memory;
use percoat::sweep::{self, Axis, Combination, Combinations, Description, Design, Group, Study, Task};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::collections::HashSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::{Table, Value};

/// The combinations of the values of some keys of a case, all of a sweep or a part of them.
#[pyclass(frozen, skip_from_py_object, module = "percoat._core")]
#[derive(Debug, Clone)]
pub struct Sweep {
    source: Arc<Source>,
    /// Settings of all combinations, `KEY=VALUE`.
    fixed: Vec<String>,
    combinations: Arc<Combinations>,
    task: Task,
}

/// Name, text, values, folder, and settings of a source, and what it has in memory.
type Sourced<'py> = (String, String, Option<String>, OsString, Vec<(String, String)>, Memory<'py>);

/// Settings, keys, and numbers with values of some combinations, and whether their limit loads are searched.
type Combined = (Vec<String>, Vec<String>, Vec<(usize, Vec<String>)>, bool);

#[pymethods]
impl Sweep {
    /// The combinations of the values of `set`, with `zip` only those of values at the same place of their lists; or with `vary`, texts
    /// `KEY=RANGE`, those of samples of uncertain keys.
    #[new]
    #[pyo3(signature = (case, set, zip = false, limit = false, vary = Vec::new(), samples = 128, seed = 0))]
    fn new(
        case: &Bound<'_, PyAny>,
        set: &Bound<'_, PyDict>,
        zip: bool,
        limit: bool,
        vary: Vec<String>,
        samples: usize,
        seed: u32,
    ) -> PyResult<Self> {
        let (mut source, _) = case::source(case)?;
        let (axes, fixed) = axes(set, &mut source)?;
        let task = if limit { Task::Limit } else { Task::Solve };
        if !vary.is_empty() {
            if zip || !axes.is_empty() {
                return Err(refused("vary takes one value of each other key, and no zip: sweep once for each value"));
            }
            let design = Design::new(&source, &fixed, &vary, samples, seed).map_err(refused)?;
            return Ok(Self { source: Arc::new(source), fixed, combinations: Arc::new(design.combinations()), task });
        }
        let groups = match zip && !axes.is_empty() {
            true => vec![Group::zip(&axes).map_err(refused)?],
            false => axes.iter().map(Group::of).collect(),
        };
        let combinations = Arc::new(Combinations::product(&groups).map_err(refused)?);
        Ok(Self { source: Arc::new(source), fixed, combinations, task })
    }

    fn __len__(&self) -> usize {
        self.combinations.all.len()
    }

    /// Solves all combinations here. `done` receives each row when its combination is done, in the order in which they end.
    #[pyo3(signature = (threads = None, done = None))]
    fn solve(&self, py: Python<'_>, threads: Option<i64>, done: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Row>> {
        let Self { source, fixed, combinations, task } = self.clone();
        work::try_run(py, threads, done, move |listener| {
            let study = Study::new(&source, &fixed, &combinations, task, room())?;
            let study = study.stopped_by(Arc::clone(listener.stop()));
            let mut rows = Vec::new();
            let ended = study.run(&HashSet::new(), Path::new("."), |row| {
                rows.push(Row::from(row));
                listener.row(rows[rows.len() - 1].clone());
                listener.check()
            });
            // The caller of a sweep that was stopped has raised already.
            drop(ended);
            Ok(rows)
        })
    }

    /// Reads and checks the case of every combination, for solutions elsewhere; the fingerprints, empty ones of refused cases.
    fn check(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let Self { source, fixed, combinations, task } = self.clone();
        work::try_run(py, None, None, move |_| {
            Ok(Study::elsewhere(&source, &fixed, &combinations, task, available_memory())?.fingerprints())
        })
    }

    /// The description of the sweep before it is solved, a dict with the keys of `sweep.json`. It has the case as its files are now.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Self { source, fixed, combinations, task } = self.clone();
        let description = work::try_run(py, None, None, move |_| {
            let mut source = Source::clone(&source);
            // The text stands for a case that is refused without the keys that vary.
            if let Some(values) = &source.values {
                source.text = toml::to_string(values)?;
            }
            Ok(Description::of(&source, &fixed, &combinations, task))
        })?;
        to_python(py, &description)
    }

    /// One combination alone, by its place among all of them, from 0.
    fn part(&self, index: usize) -> PyResult<Self> {
        let combinations =
            self.combinations.alone(index).ok_or_else(|| PyIndexError::new_err("no such combination"))?;
        Ok(Self { combinations: Arc::new(combinations), ..self.clone() })
    }

    /// The row of the first combination, solved here on this number of threads; a failed one where it cannot be solved.
    fn solve_first(&self, py: Python<'_>, threads: i64) -> PyResult<Row> {
        let Self { source, fixed, combinations, task } = self.part(0)?;
        let failed = self.clone();
        let row = work::run(py, Some(threads), None, move |listener| {
            let study = Study::part(&source, &fixed, &combinations, task, room()).map_err(|error| error.to_string())?;
            let (study, mut solved) = (study.stopped_by(Arc::clone(listener.stop())), None);
            let _ = study.run(&HashSet::new(), Path::new("."), |row| {
                solved = Some(row);
                listener.check()
            });
            solved.ok_or_else(|| "it was stopped before its end".to_owned())
        })?;
        row.map_or_else(|reason| failed.failed(0, String::new(), reason), |row| Ok(row.into()))
    }

    /// The row of a combination without results, by its place among all of them, from 0.
    fn failed(&self, index: usize, fingerprint: String, reason: String) -> PyResult<Row> {
        let Self { combinations, .. } = self.part(index)?;
        let combination = &combinations.all[0];
        Ok(sweep::Row::failed(combination.number, combinations.named_values(combination), fingerprint, reason).into())
    }

    /// Progress after `done` combinations and a number of seconds, of which `row` is the last.
    fn told(&self, row: &Bound<'_, Row>, done: usize, seconds: f64) -> Progress {
        let row = row.get().row();
        let phase = format!("{} {}", row.named(), row.status.name());
        Progress { done, of: self.combinations.all.len(), seconds, ..Progress::new("combination", phase) }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, sweep) = (slf.py(), slf.get());
        let state = (sweep.sourced(py)?, sweep.combined()).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_restore")?, state))
    }

    #[staticmethod]
    fn _restore(sourced: Sourced<'_>, combined: Combined) -> PyResult<Self> {
        let (name, text, values, folder, set, memory) = sourced;
        let (fixed, keys, all, limit) = combined;
        let parsed = |text: String| text.parse::<Table>().map_err(refused);
        let set = set.into_iter().map(|(key, text)| Ok((key, parsed(text)?.remove(VALUE).ok_or_else(lost)?)));
        let set = set.collect::<PyResult<Vec<_>>>()?;
        let (values, folder) = (values.map(parsed).transpose()?, PathBuf::from(folder));
        let source = with_memory(Source { name, text, values, set, folder, ..Source::default() }, memory)?;
        let all = all.into_iter().map(|(number, values)| Combination { number, values }).collect();
        let task = if limit { Task::Limit } else { Task::Solve };
        Ok(Self {
            source: Arc::new(source),
            fixed,
            combinations: Arc::new(Combinations { keys, all, design: None }),
            task,
        })
    }
}

/// Key of a value that is pickled alone.
const VALUE: &str = "value";

fn lost() -> PyErr {
    refused("what was pickled of a sweep is not whole")
}

impl Sweep {
    /// The source, from which any process that finds the same files under the same paths reads the same cases.
    fn sourced<'py>(&self, py: Python<'py>) -> PyResult<Sourced<'py>> {
        let Source { name, text, values, set, folder, .. } = &*self.source;
        let written = |table: &Table| toml::to_string(table).map_err(refused);
        let alone = |value: &Value| written(&Table::from_iter([(VALUE.to_owned(), value.clone())]));
        let set = set.iter().map(|(key, value)| Ok((key.clone(), alone(value)?))).collect::<PyResult<_>>()?;
        let folder = std::env::current_dir()?.join(folder).into_os_string();
        let values = values.as_ref().map(written).transpose()?;
        Ok((name.clone(), text.clone(), values, folder, set, in_memory(py, &self.source)?))
    }

    fn combined(&self) -> Combined {
        let all =
            self.combinations.all.iter().map(|combination| (combination.number, combination.values.clone())).collect();
        (self.fixed.clone(), self.combinations.keys.clone(), all, self.task == Task::Limit)
    }
}

/// The columns of the table of a sweep, each a name with a list of cells, by ascending combination.
#[pyfunction]
pub fn columns<'py>(py: Python<'py>, rows: Vec<PyRef<'py, Row>>) -> PyResult<Bound<'py, PyAny>> {
    let rows: Vec<sweep::Row> = rows.iter().map(|row| row.row().clone()).collect();
    to_python(py, &sweep::columns(&rows))
}

/// The columns of the uncertainty of a sweep with its description, a row for each result; none of a sweep over given values.
#[pyfunction]
pub fn uncertainty<'py>(
    py: Python<'py>,
    description: &Bound<'py, PyAny>,
    rows: Vec<PyRef<'py, Row>>,
) -> PyResult<Bound<'py, PyAny>> {
    let description: Description = from_python(description)?;
    let rows: Vec<sweep::Row> = rows.iter().map(|row| row.row().clone()).collect();
    let cells = work::run(py, None, None, move |_| description.uncertainty(&rows).map(|found| found.cells()))?;
    to_python(py, &sweep::columns_of(|| cells.iter().flatten().cloned()))
}

/// The keys with lists of values, and `KEY=VALUE` of those with one value, in their order. Without a text among these they are
/// set in the source instead, as the values that they are.
fn axes(set: &Bound<'_, PyDict>, source: &mut Source) -> PyResult<(Vec<Axis>, Vec<String>)> {
    let keys = set.keys().iter().map(|key| text(&key, "what is swept over")).collect::<PyResult<Vec<String>>>()?;
    sweep::keys_once(keys.iter().map(String::as_str)).map_err(refused)?;
    let (mut axes, mut single, mut fixed) = (Vec::new(), Vec::new(), Vec::new());
    for (key, values) in set.iter() {
        let key = text(&key, "what is swept over")?;
        if let Ok(text) = values.extract::<String>() {
            let axis = Axis::parse(&format!("{key}={text}")).map_err(refused)?;
            if axis.values.len() == 1 {
                single.push((key, None));
                fixed.extend(axis.settings());
            } else {
                axes.push(axis);
            }
            continue;
        }
        match value(&values, &key)? {
            Value::Array(items) if items.is_empty() => {
                return Err(refused(format!("`{key}` has no values to sweep over")));
            }
            Value::Array(items) => axes.push(Axis { key, values: items.iter().map(written).collect() }),
            value => {
                fixed.push(format!("{key}={}", written(&value)));
                single.push((key, Some(value)));
            }
        }
    }
    // The text of a value is read with the command line's rules: one text among them makes texts of all, which keeps their order.
    if let Some(values) = single.into_iter().map(|(key, value)| Some((key, value?))).collect::<Option<Vec<_>>>() {
        source.set.extend(values);
        fixed.clear();
    }
    Ok((axes, fixed))
}

/// A value as the command line takes it, the text by which rows, columns and logs of a sweep name it.
fn written(value: &Value) -> String {
    match value {
        // 2e-7 is shorter than 0.0000002.
        Value::Float(x) if x.is_finite() && *x != 0.0 && !(1e-3..1e6).contains(&x.abs()) => format!("{x:e}"),
        Value::String(text) if is_word(text) => text.clone(),
        other => other.to_string(),
    }
}

/// Whether a text needs no quotes: a letter before letters, digits, `-` and `_`, and no value of TOML.
fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c))
        && !["true", "false", "inf", "nan"].contains(&text)
}
