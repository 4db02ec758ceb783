//! `percoat identify`: parameters of a stack from a measured indentation curve.

use super::declared::Declared::{self, Picture, Text};
use super::declared::plan;
use super::ending::{Ending, Failure};
use super::input::{output_folder, read_source, read_text};
use super::options::Common;
use super::progress::Progress;
use super::results::Results;
use super::terminal;
use percoat_app::output::{self, IdentificationFile, Writer, fitted, identified};
use percoat_app::picture;
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, CaseError, IdentificationTask, known_instrument, plausibility};
use percoat_case::measurements;
use percoat_common::plain;
use percoat_core::identification::{Identification, IdentificationError, Measurement};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

pub fn run(
    (data, case): (&Path, &Path),
    (free, stated): (&[String], &[String]),
    set: &[String],
    common: &Common,
) -> Result<Ending, Failure> {
    let (started, pictures) = (Instant::now(), &common.pictures);
    let (source, name) = read_source(Some(case))?;
    let case = Case::read(&source, set)?;
    let measured = measurements::read(&read_text(data)?, &case.units())
        .map_err(|fault| Failure::Refused(format!("{}: {fault}", plain::path(data))))?;
    let task = IdentificationTask::new(&source, set, &case, free)
        .map_err(|error| Failure::Refused(format!("--free: {error}")))?;
    let known = known_instrument(stated).map_err(|error| Failure::Refused(format!("--known: {error}")))?;
    let task = task.with_instrument(known);
    let folder = output_folder(common, &name)?;
    Allowed::new(&case, &folder, Job::Identify { pictures: pictures.wanted() }).map_err(Failure::Refused)?;
    let results = Results::claim(folder, plan(Writer::Identify, &files(), pictures), common.saying())?;
    let (found, best) = find(&task, &case, &measured, common)?;
    let warnings = [output::doubts(&measured, &found, &best), plausibility::of_case(&best)].concat();
    let result = Identified { measured: &measured, found: &found, best: &best, warnings: &warnings };
    results.write_all(&files(), &result, pictures)?;
    let line = || format!("{} steps of the search; {:.2} s", found.steps, started.elapsed().as_secs_f64());
    results.finish("identification.json", || identified(&found, &best, terminal::width()), line, &warnings)?;
    Ok(Ending::Done)
}

/// A case whose values are found.
struct Identified<'a> {
    measured: &'a Measurement,
    found: &'a Identification,
    best: &'a Case,
    warnings: &'a [String],
}

/// The files of an identification.
fn files<'a>() -> [Declared<Identified<'a>>; 3] {
    [
        Text("identification.json", |case| {
            Some(IdentificationFile::new(case.found, case.best, case.warnings).to_json())
        }),
        Text("identification.csv", |case| Some(fitted(case.measured, case.found))),
        Picture("identification", |case| {
            Some(picture::identification(&case.best.title, &case.best.units(), case.measured, case.found))
        }),
    ]
}

/// Searches for the values, and shows the progress.
fn find(
    task: &IdentificationTask,
    case: &Case,
    measured: &Measurement,
    common: &Common,
) -> Result<(Identification, Case), Failure> {
    let progress = Progress::new("", 0, 0, common);
    let found = task.find(measured, &mut |trial| {
        let words = output::trial(case, trial);
        progress.tell(&words);
        progress.say(words);
        ControlFlow::Continue(())
    });
    progress.finish();
    found.map_err(|error: IdentificationError<CaseError>| match error {
        IdentificationError::Model(error) => Failure::Case(error),
        error => Failure::refused(error),
    })
}
