//! `percoat identify`: parameters of a stack from measured indentation curves.

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
use percoat_case::case::{Document, Found, IdentificationTask, Known};
use percoat_case::measurements::{self, Curves, Segment, Source, Taken};
use percoat_case::units::Units;
use percoat_common::machine::Capacity;
use percoat_common::plain;
use percoat_core::identification::IdentificationError;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

pub fn run(
    files: &[PathBuf],
    (free, stated): (&[String], &[String]),
    segment: Segment,
    (set, common): (&[String], &Common),
) -> Result<Ending, Failure> {
    let (started, pictures) = (Instant::now(), &common.pictures);
    let Some((case, data)) = files.split_last().filter(|(_, data)| !data.is_empty()) else {
        return Err(Failure::refused(
            "identify takes tables of curves and behind them a case: percoat identify data.csv mine.toml --free …",
        ));
    };
    let (source, name) = read_source(Some(case))?;
    let document = Document::new(&source, set)?;
    let case = document.case()?;
    let measured = measured(data, segment, &case.units())?;
    let task = IdentificationTask::new(&document, &case, free)
        .map_err(|error| Failure::Refused(format!("--free: {error}")))?;
    let known = Known::of(stated).and_then(|known| known.for_segment(segment));
    let known = known.map_err(|error| Failure::Refused(format!("--known: {error}")))?;
    let folder = output_folder(common, &name)?;
    let room = Capacity::on_this_machine(&folder);
    let task = Identify::new(task.with_known(known), room, pictures.wanted())?;
    let results = Results::claim(folder, plan(Writer::Identify, &written(), pictures), common.saying())?;
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
    results.write_all(&written(), &result, pictures)?;
    let (file, Identified { found, best, warnings, .. }) = (result.file(), &result);
    let line = || format!("{} steps of the search; {:.2} s", found.steps(), started.elapsed().as_secs_f64());
    results.finish("identification.json", || identified(&file, &best.units(), terminal::width()), line, warnings)?;
    Ok(Ending::Done)
}

/// The curves in files.
fn measured(data: &[PathBuf], segment: Segment, units: &Units) -> Result<Taken, Failure> {
    let read = |path: &PathBuf| -> Result<(String, String), Failure> {
        let table = std::fs::read(path).map_err(|error| Failure::Input { path: path.clone(), error })?;
        Ok((plain::path(path).to_string(), measurements::text(&table).into_owned()))
    };
    let texts: Vec<(String, String)> = data.iter().map(read).collect::<Result<_, _>>()?;
    let sources: Vec<(&str, Source<'_>)> =
        texts.iter().map(|(name, text)| (name.as_str(), Source::Text(text.as_str()))).collect();
    Taken::new(&sources, segment, units).map_err(Failure::refused)
}

/// The files of an identification.
fn written<'a>() -> [Declared<Identified<'a>>; 3] {
    [
        Text("identification.json", |result| Some(result.file().to_json())),
        Text("identification.csv", |result| Some(fitted(result.measured, &result.found))),
        Picture("identification", |result| {
            let Identified { measured, found, best, .. } = result;
            match (&measured.curves, found) {
                (Curves::Loading(curve), Found::Loading(found)) => {
                    Some(picture::identification(&best.title, &best.units(), curve, found))
                }
                (Curves::Unloading(unloadings), Found::Unloading(found)) => {
                    Some(picture::unloading(best, unloadings, found, result.beta))
                }
                (Curves::Retraction(curve), Found::Retraction(found)) => {
                    Some(picture::retraction(&best.title, &best.units(), curve, found))
                }
                _ => None,
            }
        }),
    ]
}
