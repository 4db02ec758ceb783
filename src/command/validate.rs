//! `percoat validate`: the studies, their verdicts, and a report of them.

use super::interruption::{self, Saved};
use super::{Failure, Outcome, Studies, terminal};
use percoat::output::{make_folder, write_text};
use percoat::picture::{Format, write_picture};
use percoat::validation::paper::table;
use percoat::validation::{self, Report, STUDIES, Study, differences};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub fn run(name: Option<&str>, expected: Option<&Path>, options: &Studies) -> Result<Outcome, Failure> {
    let studies: Vec<&'static Study> = match name {
        Some(name) => validation::named(name),
        None => STUDIES.iter().collect(),
    };
    if let (Some(name), true) = (name, studies.is_empty()) {
        return Err(unknown(name));
    }
    let expected = expected
        .map(|path| std::fs::read_to_string(path).map_err(|error| Failure::Input { path: path.to_owned(), error }));
    let expected = expected.transpose()?;
    let folder = options.output.clone().unwrap_or_else(|| PathBuf::from("out/validate"));
    // The report of one study stays in its folder, so that it does not pass for the whole.
    let path = name.map_or_else(|| folder.clone(), |name| folder.join(name)).join("REPORT.md");
    refuse_foreign(&folder, &path, &studies)?;
    interruption::watch();
    let progress = !options.quiet && !options.verbose && terminal::moves();
    let started = Instant::now();
    let mut report = Report::default();
    let mut outcomes = Vec::new();
    for (number, study) in (1..).zip(&studies) {
        let started = Instant::now();
        if progress {
            eprint!("\r\x1b[Kstudy {number} of {}: {}", studies.len(), study.name);
        }
        let result = (study.run)();
        if options.verbose {
            eprintln!("{}: {:.1} s", study.name, started.elapsed().as_secs_f64());
        }
        if let Ok(outcome) = &result {
            outcomes.push((folder.join(study.name), outcome.clone()));
        }
        report.add(study, result);
    }
    if progress {
        eprint!("\r\x1b[K");
    }
    let markdown = report.markdown();
    // First of all: it marks what follows as percoat's.
    make_folder(path.parent().unwrap_or(&folder))?;
    write_text(&path, &markdown)?;
    for (folder, outcome) in &outcomes {
        write(folder, outcome)?;
    }
    let names: Vec<&str> = studies.iter().map(|study| study.name).collect();
    let statements = report.statements();
    write_page(&folder, &statements)?;
    *interruption::hold() = Saved::Result(folder.clone());
    let differences = expected.map(|expected| {
        let rows = differences(&expected, &markdown, name.is_some().then_some(&names[..]));
        rows.into_iter().chain(table::differences(&statements)).collect::<Vec<_>>()
    });
    for line in report.errors().iter().chain(differences.iter().flatten()) {
        eprintln!("error: {line}");
    }
    if !options.quiet {
        print(&report, &path, started)?;
    }
    let as_expected = differences.is_none_or(|differences| differences.is_empty());
    Ok(if report.holds() && as_expected { Outcome::Done } else { Outcome::Failed })
}

fn unknown(name: &str) -> Failure {
    let names: Vec<&str> = STUDIES.iter().map(|study| study.name).collect();
    Failure::Refused(format!("there is no study {name}; there are {}", names.join(", ")))
}

/// Refuses what the studies would overwrite that is not percoat's. A folder is percoat's with all names validate
/// writes where a report of percoat's stands in it or above it, so that the committed one can be renewed; other names
/// are left alone.
fn refuse_foreign(folder: &Path, report: &Path, studies: &[&Study]) -> Result<(), Failure> {
    let begins = |path: &Path, head: &str| std::fs::read_to_string(path).is_ok_and(|text| text.starts_with(head));
    let reported = |folder: &Path| begins(&folder.join("REPORT.md"), "# Validation report\n\npercoat ");
    let title = table::renewed(&[]).lines().next().unwrap_or_default().to_owned();
    let page = folder.join("paper/README.md");
    let paper = studies.iter().any(|study| study.name.starts_with("paper/"));
    let empty = |folder: &Path| std::fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none());
    let foreign = |study: &&Study| {
        let own = folder.join(study.name);
        let marked = own.ancestors().take_while(|above| above.starts_with(folder)).any(reported);
        (own.exists() && !empty(&own) && !marked).then_some(own)
    };
    let foreign = if report.exists() && !report.parent().is_some_and(reported) {
        Some(report.to_owned())
    } else if paper && page.exists() && !begins(&page, &title) {
        Some(page)
    } else {
        studies.iter().find_map(foreign)
    };
    foreign.map_or(Ok(()), |path| {
        Err(Failure::Refused(format!(
            "{} is not of a report of percoat, and validate would write over it: choose another folder with -o, or move it \
             away",
            path.display()
        )))
    })
}

/// The figures and data of a study.
fn write(folder: &Path, outcome: &validation::Outcome) -> Result<(), Failure> {
    make_folder(folder)?;
    for (name, figure) in &outcome.figures {
        write_picture(folder, name, Format::Png, &figure.draw(Format::Png))?;
    }
    for data in &outcome.data {
        write_text(&folder.join(format!("{}.data.csv", data.name)), &data.csv())?;
    }
    for data in &outcome.published {
        write_text(&folder.join(format!("{}.csv", data.name)), &data.rounded().csv())?;
    }
    Ok(())
}

/// The paper's page with the statements of this run.
fn write_page(folder: &Path, statements: &[(&str, Vec<String>)]) -> Result<(), Failure> {
    if statements.is_empty() {
        return Ok(());
    }
    make_folder(&folder.join("paper"))?;
    Ok(write_text(&folder.join("paper/README.md"), &table::renewed(statements))?)
}

fn print(report: &Report, path: &Path, started: Instant) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{}\n\n{}", report.table(), report.summary())?;
    writeln!(out, "{:.1} s; report in {}", started.elapsed().as_secs_f64(), path.display())?;
    Ok(())
}
