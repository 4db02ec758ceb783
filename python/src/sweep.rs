//! `percoat.sweep`: a case, solved for many settings of its keys.

use crate::case;
use crate::errors::refused;
use crate::progress::Progress;
use crate::record::to_python;
use crate::value::{text, value};
use crate::work;
use percoat::case::Source;
use percoat::machine::Capacity;
use percoat::sweep::{Axis, Combinations, Group, Row, Study, Task, columns};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashSet;
use std::path::Path;
use toml::Value;

/// Of a combination its name, its status, the reason where it is not `done`, and its warnings.
type Told = (String, &'static str, String, Vec<String>);

/// The columns of the table of a sweep, each a name with a list of cells; and name, status, reason and warnings of each combination.
type Swept<'py> = (Bound<'py, PyAny>, Vec<Told>);

/// Solves the combinations of the values of `set`, with `zip` only those of values at the same place of their lists.
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
    let (mut source, _) = case::source(case)?;
    let (axes, fixed) = axes(set, &mut source)?;
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
        // The caller of a sweep that was stopped has raised already.
        let _ = ended;
        Ok::<_, String>(rows)
    })?;
    let rows = rows.map_err(refused)?;
    let told =
        |row: &Row| (row.named(), row.status.name(), row.reason.clone().unwrap_or_default(), row.warnings.clone());
    Ok((to_python(py, &columns(&rows))?, rows.iter().map(told).collect()))
}

/// The keys with lists of values, and `KEY=VALUE` of those with one value, in their order. Without a text among these they are
/// set in the source instead, as the values that they are.
fn axes(set: &Bound<'_, PyDict>, source: &mut Source) -> PyResult<(Vec<Axis>, Vec<String>)> {
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
