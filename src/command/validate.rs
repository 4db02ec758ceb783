//! `percoat validate`: the studies, their verdicts, and a report of them.

use super::ending::{Ending, Failure};
use super::input::read_text;
use super::options::{Saying, Studies};
use super::results::Results;
use super::terminal::{self, tell};
use percoat_app::output::{Plan, RunFolder, Writer, disk, make_folder};
use percoat_app::picture::{self, Format};
use percoat_common::plain;
use percoat_validation::paper::table;
use percoat_validation::{self as validation, Outcome, Report, STUDIES, Study, differences};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The paper's page with the statements of the run.
const PAGE: &str = "paper/README.md";

pub fn run(name: Option<&str>, expected: Option<&Path>, options: &Studies) -> Result<Ending, Failure> {
    let studies = chosen(name)?;
    let expected = expected.map(read_text).transpose()?;
    let folder = options.output.clone().unwrap_or_else(|| PathBuf::from("out/validate"));
    // The report of one study stands in its folder, so that it is not taken for that of all.
    let within = name.map_or_else(String::new, |name| format!("{name}/"));
    let path = format!("{within}REPORT.md");
    let (report_path, plan) = (folder.join(&path), may_write(&folder, &path, within, &studies));
    let mut results = Results::claim(folder, plan, Saying { quiet: options.quiet, json: false })?;
    // Where each study of the paper fails, or none is run, the page stays as it is.
    results.claim.keep(PAGE.to_owned());
    let started = Instant::now();
    let (report, outcomes) = carry_out(&studies, &mut results.claim, options);
    let markdown = report.markdown();
    let statements = report.statements();
    results.write(&path, &markdown)?;
    for (study, outcome) in &outcomes {
        write(&results, study, outcome)?;
    }
    if !statements.is_empty() {
        results.write(PAGE, &table::renewed(&statements))?;
    }
    results.publish()?;
    let names: Vec<&str> = studies.iter().map(|study| study.name).collect();
    let differences = expected.map(|expected| {
        let rows = differences(&expected, &markdown, name.is_some().then_some(&names[..]));
        rows.into_iter().chain(table::differences(&statements)).collect::<Vec<_>>()
    });
    for line in report.errors().iter().chain(differences.iter().flatten()) {
        tell!("error: {line}");
    }
    if !options.quiet {
        print(&report, &report_path, started)?;
    }
    let as_expected = differences.is_none_or(|differences| differences.is_empty());
    Ok(if report.holds() && as_expected { Ending::Done } else { Ending::Failed })
}

/// Runs the studies one after another; returns their report, and the outcomes of studies without an error. The earlier files of a
/// study with an error stay in the folder.
fn carry_out(
    studies: &[&'static Study],
    claim: &mut RunFolder,
    options: &Studies,
) -> (Report, Vec<(&'static str, Outcome)>) {
    let progress = !options.quiet && !options.verbose && terminal::moves();
    let (mut report, mut outcomes) = (Report::default(), Vec::new());
    for (number, study) in (1..).zip(studies) {
        let started = Instant::now();
        if progress {
            terminal::clear_line();
            let _ = write!(std::io::stderr(), "study {number} of {}: {}", studies.len(), study.name);
        }
        let result = (study.run)();
        if options.verbose {
            tell!("{}: {:.1} s", study.name, started.elapsed().as_secs_f64());
        }
        match &result {
            Ok(outcome) => outcomes.push((study.name, outcome.clone())),
            Err(_) => claim.keep(format!("{}/", study.name)),
        }
        report.add(study, result);
    }
    if progress {
        terminal::clear_line();
    }
    (report, outcomes)
}

/// Prints names and titles of the studies: all, or those of a name.
pub fn list(name: Option<&str>) -> Result<Ending, Failure> {
    let mut out = terminal::out();
    for study in chosen(name)? {
        writeln!(out, "{:<18} {}", study.name, study.title)?;
    }
    Ok(Ending::Done)
}

/// The studies of a name, or all of them.
fn chosen(name: Option<&str>) -> Result<Vec<&'static Study>, Failure> {
    let studies = name.map_or_else(|| STUDIES.iter().collect(), validation::named);
    match name {
        Some(name) if studies.is_empty() => {
            let names: Vec<&str> = STUDIES.iter().map(|study| study.name).collect();
            Err(Failure::Refused(format!("there is no study {name}; there are {}", names.join(", "))))
        }
        _ => Ok(studies),
    }
}

/// The files that the studies may write, before they are run.
fn may_write(folder: &Path, report: &str, within: String, studies: &[&Study]) -> Plan {
    let mut names = vec![report.to_owned()];
    let of_study = |study: &&Study| study.files.iter().map(|file| format!("{}/{file}", study.name)).collect::<Vec<_>>();
    names.extend(studies.iter().flat_map(of_study));
    let mut adopted = Vec::new();
    if studies.iter().any(|study| study.name.starts_with("paper/")) {
        names.push(PAGE.to_owned());
        // The page with an edited text around the table is built into the program before the table is renewed.
        let page = disk::read_text(&folder.join(PAGE)).unwrap_or_default();
        adopted.extend(table::is_around(&page).then(|| PAGE.to_owned()));
    }
    Plan { names, adopted, within, ..Plan::new(Writer::Validate) }
}

/// Writes the figures and data of a study.
fn write(results: &Results, study: &str, outcome: &Outcome) -> Result<(), Failure> {
    let folder = results.staging().join(study);
    make_folder(&folder)?;
    for (name, figure) in &outcome.figures {
        picture::write(&figure.draw(), &folder, name, Format::Png)?;
    }
    outcome.tables().try_for_each(|(name, data)| results.write(&format!("{study}/{name}"), &data.csv()))
}

fn print(report: &Report, path: &Path, started: Instant) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(out, "{}\n\n{}", report.tables(terminal::width()), report.summary())?;
    writeln!(out, "{:.1} s; report in {}", started.elapsed().as_secs_f64(), plain::path(path))?;
    Ok(())
}
