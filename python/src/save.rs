//! `Result.save` and `Columns.save`: the output folders of the command line.

use crate::case::{Case, file};
use crate::errors::{no_folder, refused};
use crate::record::from_python;
use crate::row::Row;
use crate::step::{Kept, Step};
use crate::work;
use percoat::case::Source;
use percoat::output::{
    Clock, FolderError, OutputError, Plan, Recording, RunFolder, Summary, Timing, Writer, solved_plan, write_file,
    write_scalars,
};
use percoat::run::{GridStart, Outcome, Recorder, StepRecord};
use percoat::{Solver, StressFields, case, plain, sweep};
use pyo3::prelude::*;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

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

/// Writes a result into the folder of `percoat solve --no-pictures`. Returns where files are now that stood in the way.
///
/// What the case has in memory becomes a file beside `case.toml`: `array`, the content of `heights.npy`, where its heights are an array,
/// and the file of heights or pressures that was pickled with it.
#[pyfunction]
#[pyo3(signature = (case, summary, steps, folder, array = None))]
pub fn save_result(
    py: Python<'_>,
    case: &Bound<'_, Case>,
    summary: &Bound<'_, PyAny>,
    steps: Vec<PyRef<'_, Step>>,
    folder: PathBuf,
    array: Option<&[u8]>,
) -> PyResult<Option<String>> {
    let summary: Summary = from_python(summary)?;
    let mut written = case::Case::clone(&case.get().case);
    let beside = beside(&mut written, &case.get().source, array);
    let kept: Vec<Arc<Kept>> = steps.iter().map(|step| step.kept()).collect();
    let saved = work::run(py, None, None, move |_| save_solved(&written, summary, &kept, &folder, beside))?;
    Ok(saved?)
}

/// A file beside `case.toml`: its name and content.
type Beside = (String, Arc<[u8]>);

/// The heights or pressures that the source of a case has in memory, under the name that the case has for them then.
fn beside(case: &mut case::Case, source: &Source, array: Option<&[u8]>) -> Option<Beside> {
    let (what, name) = file(case)?;
    let (ending, content) = match (source.files.get(name), array) {
        (Some(bytes), _) => (Path::new(name).extension()?.to_string_lossy().into_owned(), Arc::clone(bytes)),
        (None, Some(array)) => ("npy".to_owned(), Arc::from(array)),
        (None, None) => return None,
    };
    *name = format!("{what}.{ending}");
    Some((name.clone(), content))
}

fn save_solved(
    case: &case::Case,
    summary: Summary,
    kept: &[Arc<Kept>],
    folder: &Path,
    beside: Option<Beside>,
) -> Result<Option<String>, SaveError> {
    let (clock, run) = (Clock::start(), case.run());
    let mut plan = solved_plan(case, run.loads.len(), true);
    plan.names.extend(beside.iter().map(|(name, _)| name.clone()));
    let claim = RunFolder::claim(folder, plan)?;
    let aside = shown(claim.set_aside());
    let mut recording = Recording::new(&claim, &run, case.to_toml(), clock);
    let Some(points) = kept.first().map(|first| first.step.grid().points()) else {
        return Err(SaveError::Refused("there are no load steps to save".to_owned()));
    };
    let solver = Solver::new(Arc::clone(case.problem()), points, case.solver);
    let solver = solver.map_err(|error| SaveError::Refused(error.to_string()))?;
    recording.begin(&GridStart::from(&solver))?;
    let Summary { steps, accuracy, warnings, timing, .. } = summary;
    let steps: Vec<StepRecord> = steps.into_iter().zip(kept).map(|(record, kept)| whole(record, kept)).collect();
    for (record, kept) in steps.iter().zip(kept) {
        let fields = run.stress.as_ref().map(|request| StressFields::new(kept.step.finest(), request.mean));
        recording.step(&kept.step, record, fields.as_ref())?;
    }
    let (_, clock) = recording.finish()?;
    if let Some((name, content)) = beside {
        write_file(&claim.staging().join(name), |writer| writer.write_all(&content))?;
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

/// Writes a sweep with a description that took `wall` seconds into the folder of `percoat sweep --no-pictures`. Returns where files are
/// now that stood in the way.
#[pyfunction]
pub fn save_sweep(
    py: Python<'_>,
    description: &Bound<'_, PyAny>,
    rows: Vec<PyRef<'_, Row>>,
    wall: f64,
    folder: PathBuf,
) -> PyResult<Option<String>> {
    let description: sweep::Description = from_python(description)?;
    let rows: Vec<sweep::Row> = rows.iter().map(|row| row.row().clone()).collect();
    let saved = work::run(py, None, None, move |_| -> Result<_, SaveError> {
        let names = sweep::files().collect();
        let claim = RunFolder::claim(&folder, Plan { names, ..Plan::new(Writer::Sweep) })?;
        let aside = shown(claim.set_aside());
        let description = description.after(&rows, wall);
        sweep::write(&claim.staging(), &rows, &description, description.uncertainty(&rows).as_ref())?;
        let later = claim.publish()?;
        Ok(shown(later.as_deref()).or(aside))
    })?;
    Ok(saved?)
}
