//! `percoat.life`: passes until something fails, and what is left after that.

use crate::case::Case;
use crate::progress::Progress;
use crate::record::{from_python, to_python};
use crate::work;
use percoat::output::{LifeFile, number, table};
use percoat::task::FollowLife;
use pyo3::prelude::*;
use std::sync::Arc;

/// A life: a dict with the keys of `life.json`, and whether its contacts have converged.
#[pyfunction]
#[pyo3(signature = (case, threads = None, progress = None))]
pub fn life<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, bool)> {
    let case = Arc::clone(&case.get().case);
    let (life, converged) = work::try_run(py, threads, progress, move |listener| {
        let task = FollowLife::new(&case, work::room(), false)?;
        listener.tell(true, || Progress::new("load", "damage of the first pass".to_owned()));
        let goes_on = listener.goes_on();
        let followed = task.follow(None, &goes_on, &mut |state, begun| {
            let [n1, n2] = begun.step.grid().points();
            let phase = format!("{} passes, {} events", number(state.passes), state.events.len());
            let (done, points) = (state.solved, Some((n1, n2)));
            listener.tell(true, || Progress { done, points, ..Progress::new("load", phase) });
            listener.check()
        })?;
        let converged = followed.converged();
        Ok((followed.file, converged))
    })?;
    Ok((to_python(py, &life)?, converged))
}

/// The text that the command line prints of this life, a dict of [`life`], in lines of `width` letters.
#[pyfunction]
pub fn life_text(case: &Bound<'_, Case>, life: &Bound<'_, PyAny>, width: usize) -> PyResult<String> {
    let file: LifeFile = from_python(life)?;
    Ok(table::life(&case.get().case, &file, width))
}
