//! Why there is no report of a folder.

use crate::sweep::PartError;
use percoat_common::plain;
use std::io;
use std::path::{Path, PathBuf};

/// Why there is no report of a folder.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The path is no folder.
    #[error("{} is not a folder: give the output folder of percoat solve, sweep, limit, life, identify or compare", plain::path(.0))]
    NoFolder(PathBuf),
    /// The folder has no finished result.
    #[error(
        "{} holds no finished result (no summary.json, limit.json, life.json, sweep.json, identification.json or compare.json){}", plain::path(folder),
        if *unfinished {
            ", only steps of a run that has not ended (unfinished/): let it end or run the command again, then report"
        } else {
            ": run percoat solve, sweep, limit, life, identify or compare with -o into it first"
        }
    )]
    Nothing {
        /// The folder.
        folder: PathBuf,
        /// Whether it has an unfinished run.
        unfinished: bool,
    },
    /// A file is not in the form that this version writes.
    #[error(
        "{} cannot be read by percoat {}: {reason}; it was written by {}: report it with that version, or compute it again",
        plain::path(path), env!("CARGO_PKG_VERSION"),
        version.as_ref().map_or("another program, or changed since".to_owned(), |version| format!("percoat {version}"))
    )]
    Version {
        /// The file.
        path: PathBuf,
        /// The version that the file names; `None` where it names none.
        version: Option<String>,
        /// The key that is missing or of another kind.
        reason: String,
    },
    /// A file can be read, but was changed since percoat wrote it.
    #[error("{}{reason}; its numbers are not shown: put back what was written, or compute it again", plain::path(path))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage of the file, as the words behind its name.
        reason: String,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {error}", plain::path(path))]
    Input {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        error: io::Error,
    },
}

impl ReportError {
    pub(super) fn input(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |error| Self::Input { path, error }
    }

    /// The error for a result at `path` that `version` of percoat wrote.
    pub(super) fn version(path: &Path, version: &str, reason: impl Into<String>) -> Self {
        Self::Version { path: path.to_owned(), version: Some(version.to_owned()), reason: reason.into() }
    }
}

impl From<PartError> for ReportError {
    fn from(error: PartError) -> Self {
        match error {
            PartError::Input { path, error } => Self::Input { path, error },
            PartError::Damaged { path, reason } => Self::Damaged { path, reason },
            PartError::Unlike { first, second, named } => {
                Self::Damaged { path: first.into(), reason: format!(" and {second} differ in {named}") }
            }
        }
    }
}
