//! `percoat limit`: the mean pressures or forces at which materials and interfaces fail.

use super::declared::Declared::{self, Picture, Text};
use super::declared::plan;
use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::options::Common;
use super::progress::Progress;
use super::results::Results;
use super::terminal;
use percoat_app::output::{Writer, number, summary, table, with_error};
use percoat_app::picture::{self, Canvas, Snapshot};
use percoat_app::task::{FindLimits, Limited};
use percoat_common::machine::Capacity;
use percoat_core::load::LoadQuantity;
use percoat_core::run::{EVENTS, GridStart, LimitStep, Recorder, StepRecord};
use percoat_core::{Step, StressFields};
use std::convert::Infallible;
use std::path::Path;
use std::time::Instant;

/// Name of the embedded case that is solved without CASE: it has strengths.
const DEFAULT: &str = "dlc-on-steel";

/// Shows the progress of the search.
struct Searching {
    /// The quantity in which loads are stated.
    quantity: LoadQuantity,
    progress: Progress,
}

impl Recorder for Searching {
    type Error = Infallible;

    fn begin(&mut self, start: &GridStart) -> Result<(), Infallible> {
        self.progress.tell(format_args!("{}\n{start}", start.problem()));
        self.progress.grid(start.grid().points(), 0);
        Ok(())
    }

    fn step(&mut self, _step: &Step, record: &StepRecord, _fields: Option<&StressFields>) -> Result<(), Infallible> {
        let words = record.governing_in_words(with_error).unwrap_or("no contact".to_owned());
        let load = number(record.reading.load(self.quantity));
        let words = format!("{} {load}: {words}", self.quantity.name());
        self.progress.tell(&words);
        self.progress.say(words);
        Ok(())
    }

    fn refined(&mut self, points: [usize; 2], change: f64) {
        self.progress.tell(format_args!("{points:?} points: change {change:.2e}"));
    }
}

pub fn run(case: Option<&Path>, up_to: Option<&str>, set: &[String], common: &Common) -> Result<Ending, Failure> {
    let (started, pictures) = (Instant::now(), &common.pictures);
    let (case, name) = read_case(Some(case.unwrap_or(Path::new(DEFAULT))), set)?;
    let folder = output_folder(common, &name)?;
    let task = FindLimits::new(&case, Capacity::on_this_machine(&folder), pictures.wanted())?;
    let task = match up_to {
        Some(load) => task.up_to(load)?,
        None => task,
    };
    let results = Results::claim(folder, plan(Writer::Limit, &files(), pictures), common.saying())?;
    let mut searching = Searching { quantity: case.units().quantity(), progress: Progress::new("", 0, 0, common) };
    let found = task.find(&mut searching)?;
    searching.progress.finish();
    results.write_all(&files(), &found, pictures)?;
    let Limited { limits, warnings, .. } = &found;
    let line = || format!("{} loads solved; {:.2} s", limits.steps.len(), started.elapsed().as_secs_f64());
    results.finish("limit.json", || table::limited(&case, limits, terminal::width()), line, warnings)?;
    Ok(Ending::of(limits.converged()))
}

/// The files of the limits; the sections are in the order in which the limits are reached.
fn files<'a>() -> [Declared<Limited<'a>>; 3 + EVENTS] {
    [
        Text("limit.json", |found| Some(found.file().to_json())),
        Text("limit.csv", |found| (!found.limits.steps.is_empty()).then(|| summary::curve(&found.limits.steps))),
        Picture("limit", |found| {
            let Limited { case, limits, .. } = found;
            picture::utilisations(&case.title, case.problem(), &case.units(), limits)
        }),
        Picture("limit-section", |found| section(found, 0)),
        Picture("limit-section-2", |found| section(found, 1)),
        Picture("limit-section-3", |found| section(found, 2)),
        Picture("limit-section-4", |found| section(found, 3)),
    ]
}

/// The stresses through the place that fails as the `number`-th, from 0.
fn section(Limited { case, limits, .. }: &Limited<'_>, number: usize) -> Option<Canvas> {
    let event = limits.shown.get(number)?;
    let sections = event.sections(&case.run())?;
    let LimitStep { limit, record, step } = event.clone();
    let snapshot = Snapshot::new(&case.title, step, record.reading).with_strength(record.strength);
    let snapshot = snapshot.at_limit_of(limit.criterion).with_units(case.units());
    Some(picture::section(&snapshot, &sections))
}
