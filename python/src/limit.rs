//! `percoat.limit`: the mean pressure at which something first fails.

use crate::case::Case;
use crate::errors::refused;
use crate::record::{from_python, to_python};
use crate::solve::Keeping;
use crate::work;
use percoat::case::plausibility;
use percoat::case::resources::Job;
use percoat::output::{Clock, LimitFile, table};
use pyo3::prelude::*;
use std::sync::Arc;

/// Looks for the limit loads: a dict with the keys of `limit.json`, and whether all has converged.
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
        let mut keeping = Keeping {
            case: &own,
            job,
            room,
            listener,
            clock: Clock::start(),
            unit: "load",
            of: 0,
            points: [0; 2],
            done: 0,
            surface: None,
            keeps: false,
            checkpoint: None,
            steps: Vec::new(),
        };
        let limits = run.limits(&mut keeping).map_err(|error| error.told())?;
        let warnings = [limits.warnings.clone(), plausibility::of_case(&own)].concat();
        Ok::<_, String>((LimitFile::new(&limits, &own, &warnings), limits.converged()))
    })?;
    let (limits, converged) = found.map_err(refused)?;
    Ok((to_python(py, &limits)?, converged))
}

/// The table of limit loads that the command line prints, of the dict that [`limit`] gives.
#[pyfunction]
pub fn limit_text(case: &Bound<'_, Case>, limits: &Bound<'_, PyAny>, width: usize) -> PyResult<String> {
    let file: LimitFile = from_python(limits)?;
    Ok(table::limited(&case.get().own, &file.limits(), width))
}
