//! `percoat.life`: passes until something fails, and what is left after that.

use crate::case::Case;
use crate::errors::refused;
use crate::progress::Progress;
use crate::record::{from_python, to_python};
use crate::work::{self, Listener};
use percoat::output::{LifeFile, number, table};
use percoat::task::FollowLife;
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
    let case = Arc::clone(&case.get().case);
    let found = work::run(py, threads, progress, move |listener| {
        let task = FollowLife::new(&case, work::room(), false).map_err(|error| error.to_string())?;
        tell(listener, 0, None, "damage of the first pass".to_owned());
        let stop = Arc::clone(listener.stop());
        let goes_on = || !stop.load(Ordering::Relaxed);
        let followed = task.follow(None, &goes_on, &mut |state, begun| {
            let [n1, n2] = begun.step.grid().points();
            let phase = format!("{} passes, {} events", number(state.passes), state.events.len());
            tell(listener, state.solved, Some((n1, n2)), phase);
            listener.check()
        });
        let followed = followed.map_err(|error| error.to_string())?;
        let converged = followed.converged();
        Ok::<_, String>((followed.file, converged))
    })?;
    let (life, converged) = found.map_err(refused)?;
    Ok((to_python(py, &life)?, converged))
}

/// Reports the `done` loads of a life.
fn tell(listener: &mut Listener, done: usize, points: Option<(usize, usize)>, phase: String) {
    let (unit, of, iteration, residual) = ("load", 0, 0, f64::NAN);
    listener.tell(true, |seconds| Progress { unit, done, of, points, iteration, residual, phase, seconds });
}

/// The text that the command line prints of this life, a dict of [`life`], in lines of `width` letters.
#[pyfunction]
pub fn life_text(case: &Bound<'_, Case>, life: &Bound<'_, PyAny>, width: usize) -> PyResult<String> {
    let file: LifeFile = from_python(life)?;
    Ok(table::life(&case.get().case, &file, width))
}
