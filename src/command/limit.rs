//! `percoat limit`: the mean pressure at which something first fails, and what.

use super::allowed::Allowed;
use super::ending::{Ending, Failure};
use super::input::read_case;
use super::interruption;
use super::options::Common;
use super::pictures::PictureOptions;
use super::terminal::{self, tell};
use indicatif::ProgressBar;
use percoat::case::plausibility;
use percoat::case::resources::Job;
use percoat::output::{Plan, RunFolder, Writer, limit_json, number, summary, table, write_text};
use percoat::picture::{self, Snapshot};
use percoat::run::{LimitTask, StepRecord};
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// The case without one: it has strengths.
const DEFAULT: &str = "dlc-on-steel";

pub fn run(case: Option<&Path>, pictures: &PictureOptions, common: &Common) -> Result<Ending, Failure> {
    let (case, name) = read_case(Some(case.unwrap_or(Path::new(DEFAULT))), &common.set)?;
    let started = Instant::now();
    let folder = common.output.clone().unwrap_or_else(|| Path::new("out").join(&name));
    let task = LimitTask::of(&case.run()).map_err(Failure::refused)?;
    Allowed::new(&case, &folder, Job::Limit { pictures: pictures.wanted() })?;
    interruption::watch();
    let names = ["limit.json", "limit.csv"].map(str::to_owned).into_iter().chain(pictures.files(&["limit", "limit-section"]));
    let claim = RunFolder::claim(&folder, Plan { names: names.collect(), ..Plan::new(Writer::Limit) })?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let progress = common.bar(ProgressBar::new_spinner());
    let limits = task.solve(&mut |step: &StepRecord| {
        let worst = step.strength.iter().map(|utilisation| utilisation.value).fold(0.0, f64::max);
        let words =
            format!("mean pressure {}: largest utilisation {}", number(step.reading.mean_pressure), number(worst));
        if common.verbose {
            tell!("{words}");
        }
        progress.set_message(words);
        progress.tick();
    });
    progress.finish_and_clear();
    let limits = limits.map_err(Failure::refused)?;
    let warnings = [limits.warnings(), plausibility::of_case(&case)].concat();
    write_text(&claim.staging().join("limit.json"), &limit_json(&limits, &case, &warnings))?;
    write_text(&claim.staging().join("limit.csv"), &summary::curve(&limits.steps))?;
    let draw = || picture::utilisations(&case.title, case.problem(), &limits);
    pictures.write(&claim.staging(), "limit", draw)?;
    if let Some((step, section)) = limits.last.clone().zip(limits.section(&task)) {
        let reading = step.reading();
        let snapshot = Snapshot::new(&case.title, step, reading);
        pictures.write(&claim.staging(), "limit-section", || Some(picture::section(&snapshot, &section)))?;
    }
    interruption::publish(claim, &folder, common.quiet)?;
    if !common.quiet {
        let mut out = terminal::out();
        if !case.title.is_empty() {
            writeln!(out, "{}\n", case.title)?;
        }
        writeln!(out, "{}\n", table::limits(&limits))?;
        let (loads, seconds) = (limits.steps.len(), started.elapsed().as_secs_f64());
        writeln!(out, "{loads} loads solved; {seconds:.2} s; written to {}", folder.display())?;
        warnings.iter().for_each(|warning| tell!("warning: {warning}"));
    }
    Ok(if limits.converged() { Ending::Done } else { Ending::NotConverged })
}
