//! `percoat.compare`: the spectral and the localized solution side by side.

use crate::case::Case;
use crate::errors::refused;
use crate::progress::Progress;
use crate::record::to_python;
use crate::tables::{Shown, compared as tables_of};
use crate::work;
use percoat::Sampling;
use percoat::case::plausibility;
use percoat::case::resources::{Job, needs};
use percoat::output::{ComparisonFile, table};
use percoat::run::{Recorder, RefinementEnd, Run};
use pyo3::prelude::*;
use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::Arc;

/// The recorder of a refinement: keeps no step, and says by this function which grids memory holds.
struct Fits<F>(F);

impl<F: Fn([usize; 2]) -> bool + Send> Recorder for Fits<F> {
    type Error = Infallible;

    fn fits(&self, points: [usize; 2]) -> bool {
        self.0(points)
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
    let job = Job::Compare { pictures: false };
    let own = Arc::clone(&case.get().own);
    let task = own.comparison();
    task.check().map_err(refused)?;
    let room = case.get().allow(job)?;
    let compared = work::run(py, threads, progress, move |listener| {
        let run = Run { loads: vec![task.load], stress: None, ..own.run() };
        run.check().map_err(|error| error.told())?;
        let (points, end) = match own.grid {
            Sampling::Points(points) => (points, RefinementEnd::Reached),
            Sampling::Accuracy(_) => {
                let mut fits = Fits(|points| needs(&own, points, job).fit(room));
                let refined = run.solve(&mut fits).map_err(|error| error.told())?;
                (refined.points, refined.end.unwrap_or(RefinementEnd::Reached))
            }
        };
        let [n1, n2] = points;
        let comparison = task.compare(points, &mut |what| {
            let (unit, points, phase) = ("part", Some((n1, n2)), what.to_owned());
            listener.tell(true, |seconds| Progress {
                unit,
                done: 0,
                of: 0,
                points,
                iteration: 0,
                residual: f64::NAN,
                phase,
                seconds,
            });
            if listener.stops() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let comparison = comparison.map_err(|error| error.to_string())?;
        let (text, tables) = (table::compared(&own, &comparison, width), tables_of(&comparison, &own.units()));
        let mut warnings = [comparison.warnings(), plausibility::of_case(&own)].concat();
        if end != RefinementEnd::Reached {
            warnings.push(format!("grid.accuracy is not reached: {end}"));
        }
        let converged = comparison.converged() && end == RefinementEnd::Reached;
        let file = ComparisonFile::new(&comparison, &own, own.load.values().len());
        Ok::<_, String>((file, text, tables, warnings, converged))
    })?;
    let (file, text, tables, warnings, converged) = compared.map_err(refused)?;
    Ok((to_python(py, &file)?, text, tables, warnings, converged))
}
