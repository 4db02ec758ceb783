//! `percoat.sweep`: a case, solved for many settings of its keys.

use crate::case;
use crate::errors::refused;
use crate::progress::Progress;
use crate::record::to_python;
use crate::toml::{value, written};
use crate::work;
use ::toml::Value;
use percoat::machine::Capacity;
use percoat::sweep::{Axis, Combinations, Group, Row, Study, Task, columns};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashSet;
use std::path::Path;

/// A combination: its name, how it ended, why if not well, and what is doubtful about it.
type Told = (String, &'static str, String, Vec<String>);

/// The columns of the table of a sweep, each a name with a list of cells; and of each combination its name, status, reason and
/// warnings.
type Swept<'py> = (Bound<'py, PyAny>, Vec<Told>);

/// Solves the combinations of the values of `set`, those of several keys as pairs if `zip`: the columns of the table, and
/// name, status, reason and warnings of each combination.
#[pyfunction]
#[pyo3(signature = (case, set, zip = false, limit = false, threads = None, progress = None))]
pub fn sweep<'py>(
    py: Python<'py>,
    case: &Bound<'py, PyAny>,
    set: &Bound<'py, PyDict>,
    zip: bool,
    limit: bool,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Swept<'py>> {
    let (source, _) = case::source(case)?;
    let (mut fixed, mut axes) = (Vec::new(), Vec::new());
    for (key, values) in set.iter() {
        let key: String = key
            .extract()
            .map_err(|_| PyTypeError::new_err(format!("a key of what is swept over is no text: {key}")))?;
        // One value alone holds for all; a list of one is an axis like any other.
        match axis(&key, &values)? {
            (axis, false) => axes.push(axis),
            (axis, true) => fixed.extend(axis.settings()),
        }
    }
    let groups = match zip && !axes.is_empty() {
        true => vec![Group::zip(&axes).map_err(refused)?],
        false => axes.iter().map(Group::of).collect(),
    };
    let combinations = Combinations::product(&groups).map_err(refused)?;
    let task = if limit { Task::Limit } else { Task::Solve };
    let rows = work::run(py, threads, progress, move |listener| {
        let room = Capacity { disk: u64::MAX, ..Capacity::on_this_machine(Path::new(".")) };
        let study = Study::new(&source, &fixed, &combinations, task, room).map_err(|error| error.to_string())?;
        let study = study.stopped_by(listener.stop().clone());
        let (of, mut rows) = (combinations.all.len(), Vec::<Row>::new());
        let ended = study.run(&HashSet::new(), Path::new("."), |row| {
            let phase = format!("{} {}", row.named(), row.status.name());
            rows.push(row);
            let done = rows.len();
            listener.tell(true, |seconds| Progress {
                unit: "combination",
                done,
                of,
                points: None,
                iteration: 0,
                residual: f64::NAN,
                phase,
                seconds,
            });
            if listener.stops() { Err(()) } else { Ok(()) }
        });
        // Nobody hears of a sweep that was stopped.
        let _ = ended;
        Ok::<_, String>(rows)
    })?;
    let rows = rows.map_err(refused)?;
    let told =
        |row: &Row| (row.named(), row.status.name(), row.reason.clone().unwrap_or_default(), row.warnings.clone());
    Ok((to_python(py, &columns(&rows))?, rows.iter().map(told).collect()))
}

/// The values of a key: a list, a text as the command line takes it, or one value alone, which is told.
fn axis(key: &str, values: &Bound<'_, PyAny>) -> PyResult<(Axis, bool)> {
    if let Ok(text) = values.extract::<String>() {
        let axis = Axis::parse(&format!("{key}={text}")).map_err(refused)?;
        let alone = axis.values.len() == 1;
        return Ok((axis, alone));
    }
    let (values, alone): (Vec<String>, bool) = match value(values, key)? {
        Value::Array(items) => (items.iter().map(written).collect(), false),
        single => (vec![written(&single)], true),
    };
    if values.is_empty() {
        return Err(refused(format!("`{key}` has no values to sweep over")));
    }
    Ok((Axis { key: key.to_owned(), values }, alone))
}
