//! `percoat limit`: the mean pressure at which something first fails, and what.

use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::interruption;
use super::options::{Changes, Common};
use super::pictures::PictureOptions;
use super::progress::Progress;
use super::terminal;
use crate::case::feasibility::Allowed;
use crate::case::plausibility;
use crate::case::resources::Job;
use crate::output::{Plan, RunFolder, Writer, limit_json, number, summary, table, with_error, write_text};
use crate::picture::{self, Snapshot};
use crate::plain;
use crate::run::{Recorder, Shown, StepRecord};
use crate::{Solver, Step, StressField};
use std::convert::Infallible;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// The case without one: it has strengths.
const DEFAULT: &str = "dlc-on-steel";

/// Shows how far the search is.
struct Searching<'a> {
    allowed: Allowed<'a>,
    common: &'a Common,
    progress: Progress,
}

impl Recorder for Searching<'_> {
    type Error = Infallible;

    fn fits(&self, points: [usize; 2]) -> bool {
        self.allowed.fits(points)
    }

    fn begin(&mut self, solver: &Solver) -> Result<(), Infallible> {
        if self.common.verbose {
            self.progress.tell(format_args!("{}\n{solver}", solver.problem()));
        }
        self.progress.grid(solver.grid().points(), 0);
        Ok(())
    }

    fn step(&mut self, _step: &Step, record: &StepRecord, _field: Option<&StressField>) -> Result<(), Infallible> {
        let words = record.governing().map_or("no contact".to_owned(), |own| own.in_words(with_error));
        let words = format!("mean pressure {}: {words}", number(record.reading.mean_pressure));
        if self.common.verbose {
            self.progress.tell(&words);
        }
        self.progress.say(words);
        Ok(())
    }

    fn refined(&mut self, points: [usize; 2], change: f64) {
        if self.common.verbose {
            self.progress.tell(format_args!("{points:?} points: change {change:.2e}"));
        }
    }
}

pub fn run(
    case: Option<&Path>,
    changes: &Changes,
    pictures: &PictureOptions,
    common: &Common,
) -> Result<Ending, Failure> {
    let started = Instant::now();
    let (case, name) = read_case(Some(case.unwrap_or(Path::new(DEFAULT))), &changes.set)?;
    let folder = output_folder(common, &name)?;
    let run = case.run();
    let allowed = Allowed::new(&case, &folder, Job::Limit { pictures: pictures.wanted() }).map_err(Failure::Refused)?;
    run.check_limits()?;
    interruption::watch();
    let names = ["limit.json", "limit.csv"].map(str::to_owned).into_iter();
    let names = names.chain(pictures.files(&["limit", "limit-section"])).collect();
    let claim = RunFolder::claim(&folder, Plan { names, ..Plan::new(Writer::Limit) })?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let progress = Progress::new("", 0, 0, common);
    let mut searching = Searching { allowed, common, progress };
    let limits = run.limits(&mut searching)?;
    searching.progress.finish();
    let warnings = [limits.warnings.clone(), plausibility::of_case(&case)].concat();
    let json = limit_json(&limits, &case, &warnings);
    write_text(&claim.staging().join("limit.json"), &json)?;
    if !limits.steps.is_empty() {
        write_text(&claim.staging().join("limit.csv"), &summary::curve(&limits.steps))?;
    }
    pictures.write(&claim.staging(), "limit", || {
        picture::utilisations(&case.title, case.problem(), &case.units(), &limits)
    })?;
    if let (true, Some(section), Some(Shown { limit, record, step })) =
        (pictures.wanted(), limits.section(&run), limits.shown.clone())
    {
        let snapshot = Snapshot::new(&case.title, step, record.reading).with_strength(record.strength);
        let snapshot = snapshot.at_limit_of(limit.criterion).with_units(case.units());
        pictures.write(&claim.staging(), "limit-section", || Some(picture::section(&snapshot, &section)))?;
    }
    interruption::publish(claim, &folder, common.quiet)?;
    if common.json {
        write!(terminal::out(), "{json}")?;
    } else if !common.quiet {
        let mut out = terminal::out();
        write!(out, "{}", table::limited(&case, &limits, terminal::width()))?;
        let (loads, seconds) = (limits.steps.len(), started.elapsed().as_secs_f64());
        writeln!(out, "{loads} loads solved; {seconds:.2} s; written to {}", plain::path(&folder))?;
    }
    terminal::warn(&warnings, common.quiet);
    Ok(if limits.converged() { Ending::Done } else { Ending::NotConverged })
}
