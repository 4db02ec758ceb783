//! `percoat.sweep`: a case, solved for many settings of its keys.

use crate::case;
use crate::errors::refused;
use crate::progress::Progress;
use crate::toml::{value, written};
use crate::work;
use ::toml::Value;
use percoat::case::Room;
use percoat::sweep::{Axis, Combinations, Group, Row, Status, Study, Task, table};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashSet;
use std::path::Path;

/// A combination that did not end well: its name, how it ended, and why.
type Unsettled = (String, &'static str, String);

/// Solves the combinations of the values of `set`, those of several keys as pairs if `zip`: the table as CSV, and of what
/// did not end well its name and why.
#[pyfunction]
#[pyo3(signature = (case, set, zip = false, limit = false, threads = None, progress = None))]
pub fn sweep(
    py: Python<'_>,
    case: &Bound<'_, PyAny>,
    set: &Bound<'_, PyDict>,
    zip: bool,
    limit: bool,
    threads: Option<i64>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Vec<Unsettled>)> {
    let (source, _) = case::source(case)?;
    let axes =
        set.iter().map(|(key, values)| axis(&key.extract::<String>()?, &values)).collect::<PyResult<Vec<_>>>()?;
    let (fixed, axes): (Vec<Axis>, Vec<Axis>) = axes.into_iter().partition(|axis| axis.values.len() == 1);
    let fixed: Vec<String> = fixed.iter().flat_map(Axis::settings).collect();
    let groups = match zip && !axes.is_empty() {
        true => vec![Group::zip(&axes).map_err(refused)?],
        false => axes.iter().map(Group::of).collect(),
    };
    let combinations = Combinations::product(&groups).map_err(refused)?;
    let task = if limit { Task::Limit } else { Task::Solve };
    let rows = work::run(py, threads, progress, move |listener| {
        let room = Room { disk: u64::MAX, ..Room::on_this_machine(Path::new(".")) };
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
    let unsettled = rows.iter().filter(|row| row.status != Status::Done);
    let told = |row: &Row| (row.named(), row.status.name(), row.reason.clone().unwrap_or_default());
    let unsettled = unsettled.map(told).collect();
    Ok((table(&rows), unsettled))
}

/// The values of a key: a list, a text as the command line takes it, or one value alone.
fn axis(key: &str, values: &Bound<'_, PyAny>) -> PyResult<Axis> {
    if let Ok(text) = values.extract::<String>() {
        return Axis::parse(&format!("{key}={text}")).map_err(refused);
    }
    let values = match value(values, key)? {
        Value::Array(items) => items.iter().map(written).collect(),
        single => vec![written(&single)],
    };
    if values.is_empty() {
        return Err(refused(format!("`{key}` has no values to sweep over")));
    }
    Ok(Axis { key: key.to_owned(), values })
}
