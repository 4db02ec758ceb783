//! `percoat.limit`: the mean pressure or force at which something first fails.

use crate::case::Case;
use crate::record::{from_python, to_python};
use crate::solve::Keeping;
use crate::work;
use percoat::output::{LimitFile, table};
use percoat::task::FindLimits;
use pyo3::prelude::*;
use std::sync::Arc;

/// The limit loads: a dict with the keys of `limit.json`, and whether all loads have converged.
#[pyfunction]
#[pyo3(signature = (case, up_to = None, threads = None, progress = None))]
pub fn limit<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    up_to: Option<&str>,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, bool)> {
    let case = Arc::clone(&case.get().case);
    let up_to = up_to.map(str::to_owned);
    let (limits, converged) = work::try_run(py, threads, progress, move |listener| {
        let task = FindLimits::new(&case, work::room(), false)?;
        let task = match &up_to {
            Some(load) => task.up_to(load)?,
            None => task,
        };
        let mut keeping = Keeping::new(&case, false, listener, ("load", 0));
        let found = task.find(&mut keeping).map_err(|error| error.told())?;
        Ok((found.file(), found.limits.converged()))
    })?;
    Ok((to_python(py, &limits)?, converged))
}

/// The table that the command line prints of these limit loads, a dict of [`limit`], in lines of `width` letters.
#[pyfunction]
pub fn limit_text(case: &Bound<'_, Case>, limits: &Bound<'_, PyAny>, width: usize) -> PyResult<String> {
    let file: LimitFile = from_python(limits)?;
    Ok(table::limited(&case.get().case, &file.limits(), width))
}
