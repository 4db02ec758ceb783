//! `percoat.life`: passes until something fails, and what is left after that.

use crate::case::Case;
use crate::errors::refused;
use crate::record::{from_python, to_python};
use crate::work;
use percoat::case::plausibility;
use percoat::case::resources::Job;
use percoat::output::{LifeFile, table};
use percoat::run::StepRecord;
use pyo3::prelude::*;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// A life: a dict with the keys of `life.json`, and whether its contacts have converged.
#[pyfunction]
#[pyo3(signature = (case, threads = None, progress = None))]
pub fn life<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, bool)> {
    case.get().allow(Job::Life { pictures: false })?;
    let own = Arc::clone(&case.get().own);
    let found = work::run(py, threads, progress, move |listener| {
        let task = own.life_task()?;
        task.check().map_err(|error| error.to_string())?;
        let stop = Arc::clone(listener.stop());
        let goes_on = || !stop.load(Ordering::Relaxed);
        let begun = task.beginning(&goes_on).map_err(|error| error.to_string())?;
        let mut state = task.unworn(&begun);
        while state.end.is_none() {
            state = task.advance(state, &begun, &goes_on).map_err(|error| error.to_string())?;
        }
        let converged = begun.step.report.stop.solved();
        let record =
            StepRecord { fatigue: begun.fatigue.clone(), ..StepRecord::new(&begun.step, begun.reading.clone()) };
        let warnings = plausibility::of_case(&own);
        Ok::<_, String>((LifeFile::new(&own, &task, (&begun, record), &state, &warnings), converged))
    })?;
    let (life, converged) = found.map_err(refused)?;
    Ok((to_python(py, &life)?, converged))
}

/// The text that the command line prints of this life, a dict of [`life`], in lines of `width` letters.
#[pyfunction]
pub fn life_text(case: &Bound<'_, Case>, life: &Bound<'_, PyAny>, width: usize) -> PyResult<String> {
    let file: LifeFile = from_python(life)?;
    Ok(table::life(&case.get().own, &file, width))
}
