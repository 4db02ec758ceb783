//! `percoat limit`: the mean pressures or forces at which materials and interfaces fail.

use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::options::Common;
use super::pictures::PictureOptions;
use super::plan::plan;
use super::progress::Progress;
use super::results::Results;
use super::terminal;
use percoat_app::output::{LimitFile, Writer, number, summary, table, with_error};
use percoat_app::picture::{self, Snapshot};
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, plausibility};
use percoat_core::load::LoadQuantity;
use percoat_core::run::{EVENTS, LimitStep, Limits, Recorder, Run, StepRecord};
use percoat_core::{Solver, Step, StressFields};
use std::convert::Infallible;
use std::path::Path;
use std::time::Instant;

/// Name of the embedded case that is solved without CASE: it has strengths.
const DEFAULT: &str = "dlc-on-steel";
/// Names of the pictures of the sections, in the order in which limits are reached.
const SECTIONS: [&str; EVENTS] = ["limit-section", "limit-section-2", "limit-section-3", "limit-section-4"];

/// Shows the progress of the search.
struct Searching<'a> {
    allowed: Allowed<'a>,
    /// The quantity in which loads are stated.
    quantity: LoadQuantity,
    progress: Progress,
}

impl Recorder for Searching<'_> {
    type Error = Infallible;

    fn fits(&self, points: [usize; 2]) -> bool {
        self.allowed.fits(points)
    }

    fn begin(&mut self, solver: &Solver) -> Result<(), Infallible> {
        self.progress.tell(format_args!("{}\n{solver}", solver.problem()));
        self.progress.grid(solver.grid().points(), 0);
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

pub fn run(case: Option<&Path>, set: &[String], common: &Common) -> Result<Ending, Failure> {
    let (started, pictures) = (Instant::now(), &common.pictures);
    let (case, name) = read_case(Some(case.unwrap_or(Path::new(DEFAULT))), set)?;
    let folder = output_folder(common, &name)?;
    let run = case.run();
    let allowed = Allowed::new(&case, &folder, Job::Limit { pictures: pictures.wanted() }).map_err(Failure::Refused)?;
    run.check_limits()?;
    let drawn = [&["limit"][..], &SECTIONS].concat();
    let plan = plan(Writer::Limit, &["limit.json", "limit.csv"], pictures, &drawn);
    let results = Results::claim(folder, plan, common.saying())?;
    let quantity = case.units().quantity();
    let mut searching = Searching { allowed, quantity, progress: Progress::new("", 0, 0, common) };
    let limits = run.limits(&mut searching)?;
    searching.progress.finish();
    let warnings = [limits.warnings.clone(), plausibility::of_case(&case)].concat();
    let json = LimitFile::new(&limits, &case, &warnings).to_json();
    results.write("limit.json", &json)?;
    if !limits.steps.is_empty() {
        results.write("limit.csv", &summary::curve(&limits.steps))?;
    }
    draw(&results, &case, &run, &limits, pictures)?;
    let line = || format!("{} loads solved; {:.2} s", limits.steps.len(), started.elapsed().as_secs_f64());
    results.finish(|| json, || table::limited(&case, &limits, terminal::width()), line, &warnings)?;
    Ok(Ending::of(limits.converged()))
}

/// Draws the utilisations over the load, and the stresses through each of the places that fail first.
fn draw(results: &Results, case: &Case, run: &Run, limits: &Limits, pictures: &PictureOptions) -> Result<(), Failure> {
    let staging = results.staging();
    pictures.write(&staging, "limit", || picture::utilisations(&case.title, case.problem(), &case.units(), limits))?;
    for (event, name) in limits.shown.iter().zip(&SECTIONS).filter(|_| pictures.wanted()) {
        let LimitStep { limit, record, step } = event.clone();
        let Some(sections) = event.sections(run) else { continue };
        let snapshot = Snapshot::new(&case.title, step, record.reading).with_strength(record.strength);
        let snapshot = snapshot.at_limit_of(limit.criterion).with_units(case.units());
        pictures.write(&staging, name, || Some(picture::section(&snapshot, &sections)))?;
    }
    Ok(())
}
