//! `percoat solve`: every load step of a case, the table and the output folder.

use super::allowed::Allowed;
use super::ending::{Ending, Failure};
use super::input::read_case;
use super::interruption;
use super::options::Common;
use super::pictures::PictureOptions;
use super::plan::may_write;
use super::shown::Shown;
use super::terminal::{self, tell};
use indicatif::ProgressBar;
use percoat::case::resources::Job;
use percoat::case::{Case, plausibility};
use percoat::output::summary::{curve, summary};
use percoat::output::{Clock, Recording, RunFolder, histograms, table, write_text};
use percoat::picture::Snapshot;
use percoat::run::StepRecord;
use std::io::Write;
use std::path::Path;
use std::time::Duration;

pub fn run(case: Option<&Path>, pictures: &PictureOptions, common: &Common) -> Result<Ending, Failure> {
    let clock = Clock::start();
    let (case, name) = read_case(case, &common.set)?;
    let folder = common.output.clone().unwrap_or_else(|| Path::new("out").join(&name));
    let run = case.run();
    let job = Job::Solve { pictures: pictures.wanted() };
    let allowed = Allowed::new(&case, &folder, job)?;
    run.check()?;
    interruption::watch();
    let claim = RunFolder::claim(&folder, may_write(&case, run.loads.len(), pictures))?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let recording = Recording::new(&claim, &run, case.to_toml(), clock);
    let mut recording = Shown::new(recording, &claim, &run, allowed, common);
    let outcome = run.solve(&mut recording)?;
    let (section, mut clock) = recording.finish()?;
    let ending = if outcome.converged() { Ending::Done } else { Ending::NotConverged };
    let warnings = [outcome.warnings, plausibility::of_case(&case)].concat();
    let steps = &outcome.steps;
    if let (Some(last), Some(record), true) = (outcome.last, steps.last(), pictures.wanted()) {
        let snapshot = Snapshot::new(&case.title, last, record.reading.clone()).with_strength(record.strength.clone());
        let spinner = spinner("drawing pictures", common);
        pictures.draw(&claim.staging(), &snapshot, section.as_ref(), steps)?;
        spinner.finish_and_clear();
    }
    let timing = clock.timing();
    let summary = summary(&case, &warnings, outcome.change, steps, timing);
    write_text(&claim.staging().join("summary.json"), &summary)?;
    write_text(&claim.staging().join("curve.csv"), &curve(steps))?;
    if let Some(histograms) = histograms(steps) {
        write_text(&claim.staging().join("histograms.csv"), &histograms)?;
    }
    interruption::publish(claim, &folder, common.quiet)?;
    if !common.quiet {
        print(&case, steps, outcome.change)?;
        let (seconds, parts) = (clock.seconds(), table::timing(&timing));
        writeln!(terminal::out(), "{seconds:.2} s ({parts}); written to {}", folder.display())?;
        for warning in &warnings {
            tell!("warning: {warning}");
        }
    }
    Ok(ending)
}

/// A sign of life while something without steps goes on.
fn spinner(what: &str, common: &Common) -> ProgressBar {
    let spinner = common.bar(ProgressBar::new_spinner()).with_message(what.to_owned());
    spinner.enable_steady_tick(Duration::from_millis(200));
    spinner
}

fn print(case: &Case, steps: &[StepRecord], change: Option<f64>) -> Result<(), Failure> {
    let mut out = terminal::out();
    if !case.title.is_empty() {
        writeln!(out, "{}", case.title)?;
    }
    writeln!(out, "\n{}\n\n{}", table::steps(steps), table::solved(steps))?;
    if let Some(largest) = table::largest_stresses(steps) {
        writeln!(out, "\n{largest}\n")?;
    }
    if let Some(strength) = table::utilisations(steps, case.problem().half_space()) {
        writeln!(out, "\n{strength}\n")?;
    }
    if let Some(errors) = table::largest_errors(steps) {
        writeln!(out, "{errors}")?;
    }
    if let Some(change) = change {
        writeln!(out, "change from the next coarser grid: {change:.1e}")?;
    }
    Ok(())
}
