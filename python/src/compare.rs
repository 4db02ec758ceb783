//! `percoat.compare`: the spectral and the localized solution side by side.

use crate::case::Case;
use crate::progress::Progress;
use crate::record::to_python;
use crate::tables::{Shown, compared as tables_of};
use crate::work::{self, Stopped};
use percoat::output::table;
use percoat::run::Recorder;
use percoat::task::Compare;
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The recorder of a refinement: keeps no step, and ends where the caller stops it.
struct Stopping<'a>(&'a AtomicBool);

impl Recorder for Stopping<'_> {
    type Error = Stopped;

    fn iteration(&mut self, _progress: percoat::Progress) -> Result<(), Stopped> {
        if self.0.load(Ordering::Relaxed) { Err(Stopped) } else { Ok(()) }
    }
}

/// A comparison as a dict, its text and tables, its warnings, and whether all solutions have converged.
type Compared<'py> = (Bound<'py, PyAny>, String, Vec<Shown>, Vec<String>, bool);

/// Both methods under the last load: a dict with the keys of `compare.json`, the text of the command line in lines of `width`
/// letters and its tables, the warnings, and whether all solutions have converged.
#[pyfunction]
#[pyo3(signature = (case, width, threads = None, progress = None))]
pub fn compare<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    width: usize,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Compared<'py>> {
    let case = Arc::clone(&case.get().case);
    let (file, text, tables, warnings, converged) = work::try_run(py, threads, progress, move |listener| {
        let task = Compare::new(&case, work::room(), false)?;
        let stop = Arc::clone(listener.stop());
        let compared = task.compare(&mut Stopping(&stop), &mut |[n1, n2], stage| {
            let points = Some((n1, n2));
            listener.tell(true, || Progress { points, ..Progress::new("part", stage.to_owned()) });
            if listener.stops() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let compared = compared.map_err(|error| error.told())?;
        let (file, converged) = (compared.file(), compared.converged());
        let (text, tables) = (table::compared(&case, &file, width), tables_of(&file, &case.units()));
        Ok((file, text, tables, compared.warnings, converged))
    })?;
    Ok((to_python(py, &file)?, text, tables, warnings, converged))
}
