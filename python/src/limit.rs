//! `percoat.limit`: the mean pressure or force at which something first fails.

use crate::case::Case;
use crate::errors::refused;
use crate::record::{from_python, to_python};
use crate::solve::Keeping;
use crate::work;
use percoat::case::plausibility;
use percoat::case::resources::Job;
use percoat::output::{LimitFile, table};
use pyo3::prelude::*;
use std::sync::Arc;

/// The limit loads: a dict with the keys of `limit.json`, and whether all loads have converged.
#[pyfunction]
#[pyo3(signature = (case, threads = None, progress = None))]
pub fn limit<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, bool)> {
    let job = Job::Limit { pictures: false };
    let room = case.get().allow(job)?;
    let own = Arc::clone(&case.get().own);
    let found = work::run(py, threads, progress, move |listener| {
        let run = own.run();
        let mut keeping = Keeping::new(&own, job, room, listener, ("load", 0));
        let limits = run.limits(&mut keeping).map_err(|error| error.told())?;
        let warnings = [limits.warnings.clone(), plausibility::of_case(&own)].concat();
        Ok::<_, String>((LimitFile::new(&limits, &own, &warnings), limits.converged()))
    })?;
    let (limits, converged) = found.map_err(refused)?;
    Ok((to_python(py, &limits)?, converged))
}

/// The table that the command line prints of these limit loads, a dict of [`limit`], in lines of `width` letters.
#[pyfunction]
pub fn limit_text(case: &Bound<'_, Case>, limits: &Bound<'_, PyAny>, width: usize) -> PyResult<String> {
    let file: LimitFile = from_python(limits)?;
    Ok(table::limited(&case.get().own, &file.limits(), width))
}
