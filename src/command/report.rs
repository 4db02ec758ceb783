//! `percoat report`: a finished result as one HTML page.

use super::ending::{Ending, Failure};
use super::interruption;
use super::terminal;
use percoat_app::output::{OutputError, Plan, RunFolder, Writer, disk, make_folder, remove_drafts, write_text};
use percoat_app::report::{self, Page, ReportError};
use percoat_common::plain;
use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Name of the page in the folder of the result.
const NAME: &str = "report.html";

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Input { path, error } => Self::Input { path, error },
            refused => Self::refused(refused),
        }
    }
}

pub fn run(folder: &Path, output: Option<&Path>, quiet: bool) -> Result<Ending, Failure> {
    let file = output.map_or_else(|| folder.join(NAME), Path::to_path_buf);
    // A folder without a result is left unchanged.
    let mut page = report::page(folder)?;
    let is_earlier = owned(&file)?;
    match file.file_name().and_then(|name| name.to_str()).filter(|_| is_in(&file, folder)) {
        Some(name) => page = publish(folder, name, is_earlier)?,
        None => {
            file.parent().filter(|parent| !parent.as_os_str().is_empty()).map_or(Ok(()), make_folder)?;
            remove_drafts(&file, report::BEGINNING);
            write_text(&file, &page.html)?;
            let parent = file.parent().unwrap_or(Path::new(""));
            disk::sync_folder(parent).map_err(|error| Failure::from(OutputError::new(&file, error)))?;
        }
    }
    terminal::warn(&page.missing, quiet);
    if !quiet {
        writeln!(terminal::out(), "written to {}", plain::path(&file))?;
    }
    Ok(Ending::Done)
}

/// Writes the page beside its result, in the place of an earlier page.
fn publish(folder: &Path, name: &str, is_earlier: bool) -> Result<Page, Failure> {
    let names = vec![name.to_owned()];
    let adopted = if is_earlier { names.clone() } else { Vec::new() };
    // Pages with other names are kept.
    let plan = Plan { names, adopted, within: name.to_owned(), ..Plan::new(Writer::Report) };
    let claim = RunFolder::claim(folder, plan)?;
    // While the folder is claimed no other run writes there: the files that are read belong together.
    let page = report::page(folder)?;
    write_text(&claim.staging().join(name), &page.html)?;
    interruption::publish(claim, folder, true)?;
    Ok(page)
}

/// Whether the file is an earlier page that may be replaced; other files are refused.
fn owned(file: &Path) -> Result<bool, Failure> {
    match report::is_own(file) {
        Ok(true) => Ok(true),
        Ok(false) => Err(Failure::Refused(format!(
            "{} is not a report that percoat wrote, or was changed since: choose another file with -o, or move it away",
            plain::path(file)
        ))),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(Failure::Input { path: file.to_owned(), error }),
    }
}

/// Whether a file lies, or would lie, in the folder itself.
fn is_in(file: &Path, folder: &Path) -> bool {
    let parent = file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let real = |path: &Path| -> Option<PathBuf> { fs::canonicalize(path).ok() };
    real(parent).is_some_and(|parent| Some(parent) == real(folder))
}
