//! `percoat.limit`: the mean pressure at which something first fails.

use crate::case::Case;
use crate::errors::refused;
use crate::solve::Keeping;
use crate::work;
use percoat::case::plausibility;
use percoat::case::resources::Job;
use percoat::output::{Clock, limit_json, limits_of, table};
use pyo3::prelude::*;
use std::sync::Arc;

/// Looks for the limit loads: `limit.json`.
#[pyfunction]
#[pyo3(signature = (case, threads = None, progress = None))]
pub fn limit(
    py: Python<'_>,
    case: &Bound<'_, Case>,
    threads: Option<i64>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, bool)> {
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
        Ok::<_, String>((limit_json(&limits, &own, &warnings), limits.converged()))
    })?;
    found.map_err(refused)
}

/// The table of limit loads that the command line prints, of `limit.json`.
#[pyfunction]
pub fn limit_text(case: &Bound<'_, Case>, limits: &str, width: usize) -> PyResult<String> {
    let file: serde_json::Value = serde_json::from_str(limits).map_err(refused)?;
    let limits = limits_of(&file).map_err(refused)?;
    Ok(table::limited(&case.get().own, &limits, width))
}
