//! Why there is no report of a folder.

use crate::output::Unreadable;
use crate::plain;
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};

/// Why there is no report of a folder.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// There is no such folder.
    #[error("{} is not a folder: give the output folder of percoat solve, sweep or limit", plain::path(.0))]
    NoFolder(PathBuf),
    /// Nothing has been finished in it.
    #[error(
        "{} holds no finished result (no summary.json, limit.json or sweep.json){}", plain::path(folder),
        if *unfinished {
            ", only steps of a run that has not ended (unfinished/): let it end or run the command again, then report"
        } else {
            ": run percoat solve, sweep or limit with -o into it first"
        }
    )]
    Nothing {
        /// The folder.
        folder: PathBuf,
        /// Whether a run has begun there.
        unfinished: bool,
    },
    /// A file is not as this version writes it.
    #[error(
        "{} cannot be read by percoat {}: {reason}; it was written by {}: report it with that version, or compute it again",
        plain::path(path), env!("CARGO_PKG_VERSION"),
        version.as_ref().map_or("another program, or changed since".to_owned(), |version| format!("percoat {version}"))
    )]
    Version {
        /// The file.
        path: PathBuf,
        /// The version it names.
        version: Option<String>,
        /// What is missing or of another kind.
        reason: String,
    },
    /// A file is not as percoat wrote it there, although it can be read.
    #[error(
        "{} {reason}; its numbers are not shown: put back what was written, or compute it again",
        plain::path(path)
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is the matter with it.
        reason: String,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {error}", plain::path(path))]
    Input {
        /// The file.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
}

impl ReportError {
    pub(super) fn input(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |error| Self::Input { path, error }
    }

    /// Of a result that names its version, for a reason.
    pub(super) fn version(path: &Path, file: &Value, reason: impl Into<String>) -> Self {
        let version = file["percoat"].as_str().map(str::to_owned);
        Self::Version { path: path.to_owned(), version, reason: reason.into() }
    }

    pub(super) fn unreadable(path: &Path, version: Option<&str>) -> impl FnOnce(Unreadable) -> Self {
        let (path, version) = (path.to_owned(), version.map(str::to_owned));
        move |error| Self::Version { path, version, reason: error.to_string() }
    }
}
