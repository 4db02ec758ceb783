//! `percoat identify`: parameters of a stack from a measured indentation curve.

use super::declared::Declared::{self, Picture, Text};
use super::declared::plan;
use super::ending::{Ending, Failure};
use super::input::{output_folder, read_source};
use super::options::Common;
use super::progress::Progress;
use super::results::Results;
use super::terminal;
use percoat_app::output::{self, Writer, fitted, identified};
use percoat_app::picture;
use percoat_app::task::{Identified, Identify};
use percoat_case::case::{Document, IdentificationTask, known_instrument};
use percoat_case::measurements::{self, Curve, Segment};
use percoat_common::machine::Capacity;
use percoat_common::plain;
use percoat_core::identification::IdentificationError;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

pub fn run(
    (data, case): (&Path, &Path),
    (free, stated): (&[String], &[String]),
    segment: Segment,
    (set, common): (&[String], &Common),
) -> Result<Ending, Failure> {
    let (started, pictures) = (Instant::now(), &common.pictures);
    let (source, name) = read_source(Some(case))?;
    let document = Document::new(&source, set)?;
    let case = document.case()?;
    let table = std::fs::read(data).map_err(|error| Failure::Input { path: data.to_owned(), error })?;
    let Curve { measurement: measured, notes } =
        measurements::read(&measurements::text(&table), segment, &case.units())
            .map_err(|fault| Failure::Refused(format!("{}: {fault}", plain::path(data))))?;
    let task = IdentificationTask::new(&document, &case, free)
        .map_err(|error| Failure::Refused(format!("--free: {error}")))?;
    let known = known_instrument(stated).map_err(|error| Failure::Refused(format!("--known: {error}")))?;
    let folder = output_folder(common, &name)?;
    let room = Capacity::on_this_machine(&folder);
    let task = Identify::new(task.with_instrument(known), room, pictures.wanted())?.with_notes(notes);
    let results = Results::claim(folder, plan(Writer::Identify, &files(), pictures), common.saying())?;
    let progress = Progress::new("", 0, 0, common);
    let result = task.find(&measured, &mut |trial| {
        let words = output::trial(&case, trial);
        progress.tell(&words);
        progress.say(words);
        ControlFlow::Continue(())
    });
    progress.finish();
    let result = result.map_err(|error| match error {
        IdentificationError::Model(error) => Failure::Case(error),
        error => Failure::refused(error),
    })?;
    results.write_all(&files(), &result, pictures)?;
    let (file, Identified { found, best, warnings, .. }) = (result.file(), &result);
    let line = || format!("{} steps of the search; {:.2} s", found.steps, started.elapsed().as_secs_f64());
    results.finish("identification.json", || identified(&file, &best.units(), terminal::width()), line, warnings)?;
    Ok(Ending::Done)
}

/// The files of an identification.
fn files<'a>() -> [Declared<Identified<'a>>; 3] {
    [
        Text("identification.json", |result| Some(result.file().to_json())),
        Text("identification.csv", |result| Some(fitted(result.measured, &result.found))),
        Picture("identification", |result| {
            let Identified { measured, found, best, .. } = result;
            Some(picture::identification(&best.title, &best.units(), measured, found))
        }),
    ]
}
