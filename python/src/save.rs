//! `Result.save` and `Columns.save`: the output folders of the command line.

use crate::case::Case;
use crate::errors::{no_folder, refused};
use crate::record::from_python;
use crate::row::Row;
use crate::step::{Kept, Step};
use crate::sweep::Sweep;
use crate::work;
use percoat::output::{
    Clock, FolderError, OutputError, Plan, Recording, RunFolder, Summary, Timing, Writer, solved_plan, write_file,
    write_scalars,
};
use percoat::run::{Outcome, Recorder, StepRecord};
use percoat::{Solver, StressFields, case, plain, sweep};
use pyo3::prelude::*;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Name of the file of heights that are an array of the case.
const HEIGHTS: &str = "heights.npy";

/// Why a result cannot be saved.
#[derive(Debug, thiserror::Error)]
enum SaveError {
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error("{0}")]
    Refused(String),
}

impl From<OutputError> for SaveError {
    fn from(error: OutputError) -> Self {
        Self::Folder(error.into())
    }
}

impl From<SaveError> for PyErr {
    fn from(error: SaveError) -> Self {
        match error {
            SaveError::Folder(error) => no_folder(error),
            SaveError::Refused(reason) => refused(reason),
        }
    }
}

/// Writes a result into the folder of `percoat solve --no-pictures`, with the content of `heights.npy` where the heights of the case
/// are an array. Returns where files are now that stood in the way.
#[pyfunction]
#[pyo3(signature = (case, summary, steps, folder, heights = None))]
pub fn save_result(
    py: Python<'_>,
    case: &Bound<'_, Case>,
    summary: &Bound<'_, PyAny>,
    steps: Vec<PyRef<'_, Step>>,
    folder: PathBuf,
    heights: Option<&[u8]>,
) -> PyResult<Option<String>> {
    let summary: Summary = from_python(summary)?;
    let mut own = case::Case::clone(&case.get().own);
    if let (Some(surface), true) = (&mut own.surface, heights.is_some()) {
        surface.heights = Some(HEIGHTS.to_owned());
    }
    let heights = heights.map(<[u8]>::to_vec);
    let kept: Vec<Arc<Kept>> = steps.iter().map(|step| step.kept()).collect();
    let saved = work::run(py, None, None, move |_| save_solved(&own, summary, &kept, &folder, heights.as_deref()))?;
    Ok(saved?)
}

fn save_solved(
    case: &case::Case,
    summary: Summary,
    kept: &[Arc<Kept>],
    folder: &Path,
    heights: Option<&[u8]>,
) -> Result<Option<String>, SaveError> {
    let (clock, run) = (Clock::start(), case.run());
    let mut plan = solved_plan(case, run.loads.len(), true);
    plan.names.extend(heights.map(|_| HEIGHTS.to_owned()));
    let claim = RunFolder::claim(folder, plan)?;
    let aside = shown(claim.set_aside());
    let mut recording = Recording::new(&claim, &run, case.to_toml(), clock);
    let Some(points) = kept.first().map(|own| own.step.grid().points()) else {
        return Err(SaveError::Refused("there are no load steps to save".to_owned()));
    };
    let solver = Solver::new(Arc::clone(case.problem()), points, case.solver);
    recording.begin(&solver.map_err(|error| SaveError::Refused(error.to_string()))?)?;
    let Summary { steps, accuracy, warnings, timing, .. } = summary;
    let steps: Vec<StepRecord> = steps.into_iter().zip(kept).map(|(record, own)| whole(record, own)).collect();
    for (record, own) in steps.iter().zip(kept) {
        let fields = run.stress.as_ref().map(|request| StressFields::new(own.step.finest(), request.mean));
        recording.step(&own.step, record, fields.as_ref())?;
    }
    let (_, clock) = recording.finish()?;
    if let Some(heights) = heights {
        write_file(&claim.staging().join(HEIGHTS), |writer| writer.write_all(heights))?;
    }
    let outcome = Outcome { steps, last: None, points, change: accuracy, end: None, warnings: Vec::new() };
    let solved = timing.unwrap_or(Timing { setup: 0.0, solve: 0.0, stress: 0.0, output: 0.0 });
    let timing = Timing { output: solved.output + clock.seconds(), ..solved };
    write_scalars(&claim.staging(), case, &outcome, &warnings, timing)?;
    let later = claim.publish()?;
    Ok(shown(later.as_deref()).or(aside))
}

/// A record with the distributions of a topography, which a summary does not have.
fn whole(mut record: StepRecord, kept: &Kept) -> StepRecord {
    if let Some(rough) = &mut record.rough {
        let again = StepRecord::new(&kept.step, kept.step.reading());
        rough.histograms = again.rough.map_or(Vec::new(), |rough| rough.histograms);
    }
    record
}

fn shown(path: Option<&Path>) -> Option<String> {
    path.map(plain::path)
}

/// Writes a sweep that took `wall` seconds into the folder of `percoat sweep --no-pictures`. Returns where files are now that stood in
/// the way.
#[pyfunction]
pub fn save_sweep(
    py: Python<'_>,
    sweep: &Bound<'_, Sweep>,
    rows: Vec<PyRef<'_, Row>>,
    wall: f64,
    folder: PathBuf,
) -> PyResult<Option<String>> {
    let own = sweep.get().clone();
    let rows: Vec<sweep::Row> = rows.iter().map(|row| row.own().clone()).collect();
    let saved = work::run(py, None, None, move |_| -> Result<_, SaveError> {
        let names = sweep::FILES.map(str::to_owned).to_vec();
        let claim = RunFolder::claim(&folder, Plan { names, ..Plan::new(Writer::Sweep) })?;
        let aside = shown(claim.set_aside());
        sweep::write(&claim.staging(), &rows, &own.description().after(&rows, wall))?;
        let later = claim.publish()?;
        Ok(shown(later.as_deref()).or(aside))
    })?;
    Ok(saved?)
}
