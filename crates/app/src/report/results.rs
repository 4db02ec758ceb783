//! The finished results of a folder.

use super::ReportError;
use crate::output::{
    ComparisonFile, IdentificationFile, LifeFile, LimitFile, SWEEP_LOG, Summary, Unreadable, damaged_results, disk,
    is_beside,
};
use crate::sweep::{Description, Part, Row};
use serde_json::Value;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The finished results of a folder, one at least.
#[derive(Debug)]
pub(super) struct Results {
    pub folder: PathBuf,
    /// `summary.json`.
    pub run: Option<Summary>,
    /// `limit.json`.
    pub limit: Option<LimitFile>,
    /// `life.json`.
    pub life: Option<LifeFile>,
    /// `identification.json`.
    pub identification: Option<IdentificationFile>,
    /// `compare.json`.
    pub comparison: Option<ComparisonFile>,
    /// `sweep.json` with its log.
    pub sweep: Option<Swept>,
    /// Files that are missing or were changed since percoat wrote them, each with what is wrong with it.
    unlike: Vec<(String, String)>,
}

/// Files whose numbers a page shows.
const SHOWN: [&str; 7] =
    ["summary.json", "limit.json", "life.json", "identification.json", "compare.json", "sweep.json", SWEEP_LOG];

/// `sweep.json` with the rows of its log.
#[derive(Debug)]
pub(super) struct Swept {
    /// `sweep.json`.
    pub description: Description,
    /// Rows of the combinations, by ascending number.
    pub rows: Vec<Row>,
}

impl Results {
    /// Reads the files of a folder.
    pub(super) fn read(folder: &Path) -> Result<Self, ReportError> {
        if !folder.is_dir() {
            return Err(ReportError::NoFolder(folder.to_owned()));
        }
        let part = Part::read(folder)?;
        let sweep = part.map(|part| Swept { description: part.description.clone(), rows: part.rows() });
        let run = record(&folder.join("summary.json"), Summary::read)?;
        let limit = record(&folder.join("limit.json"), LimitFile::read)?;
        let life = record(&folder.join("life.json"), LifeFile::read)?;
        let identification = record(&folder.join("identification.json"), IdentificationFile::read)?;
        let comparison = record(&folder.join("compare.json"), ComparisonFile::read)?;
        let unlike = damaged_results(folder);
        let results = Self { folder: folder.to_owned(), run, limit, life, identification, comparison, sweep, unlike };
        let Self { run, limit, life, identification, comparison, sweep, .. } = &results;
        let others = identification.is_some() || comparison.is_some();
        if run.is_none() && limit.is_none() && life.is_none() && sweep.is_none() && !others {
            let unfinished = ["unfinished", "unfinished-life", "unfinished-sweep"]
                .iter()
                .any(|name| disk::is_folder(&folder.join(name)));
            return Err(ReportError::Nothing { folder: folder.to_owned(), unfinished });
        }
        Ok(results)
    }

    /// Refuses a file with numbers of the page that was changed since percoat wrote it.
    pub(super) fn whole(&self) -> Result<(), ReportError> {
        match self.unlike.iter().find(|(name, _)| SHOWN.contains(&name.as_str()) && self.folder.join(name).exists()) {
            Some((name, reason)) => {
                Err(ReportError::Damaged { path: self.folder.join(name), reason: format!(" {reason}") })
            }
            None => Ok(()),
        }
    }

    /// Files that are missing or damaged and not shown, a sentence each.
    pub(super) fn doubts(&self) -> Vec<String> {
        self.unlike.iter().map(|(name, reason)| format!("{name} {reason}")).collect()
    }

    /// Media type and bytes of the picture `name` of a result, SVG before PNG; `None` where the result has none.
    pub(super) fn picture(&self, result: &str, name: &str) -> Result<Option<(&'static str, Vec<u8>)>, ReportError> {
        for (ending, kind) in [("svg", "image/svg+xml"), ("png", "image/png")] {
            let file = format!("{name}.{ending}");
            let path = self.folder.join(&file);
            if disk::is_file(&path) && is_beside(result, &self.folder, &file).map_err(ReportError::input(&path))? {
                return disk::read(&path).map(|bytes| Some((kind, bytes))).map_err(ReportError::input(&path));
            }
        }
        Ok(None)
    }
}

fn text(path: &Path) -> Result<Option<String>, ReportError> {
    match disk::read_text(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(ReportError::input(path)(error)),
    }
}

/// The record in a JSON file; `None` where there is no file.
fn record<T>(path: &Path, read: impl Fn(&Value) -> Result<T, Unreadable>) -> Result<Option<T>, ReportError> {
    let Some(text) = text(path)? else { return Ok(None) };
    let refused = |version: Option<&str>, reason: String| {
        let version = version.map(str::to_owned);
        ReportError::Version { path: path.to_owned(), version, reason }
    };
    let file: Value =
        serde_json::from_str(&text).map_err(|error| refused(None, format!("it is not JSON ({error})")))?;
    read(&file).map(Some).map_err(|error| refused(file["percoat"].as_str(), error.to_string()))
}
