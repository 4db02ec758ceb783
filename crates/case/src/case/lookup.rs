//! The case of a path or a name.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::named_pipes::is_pipe;
use super::{Source, embedded};
use percoat_common::plain;

/// Why no case is found.
#[derive(Debug, thiserror::Error)]
pub enum NoCase {
    /// The path is neither a file nor an embedded case.
    #[error("{} is neither a file nor an embedded case ({})", plain::path(.0), names().join(", "))]
    Unknown(PathBuf),
    /// The file is not the text of a case.
    #[error("{0}")]
    NoText(io::Error),
    /// The file cannot be read.
    #[error("cannot read {}: {error}", plain::path(path))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        error: io::Error,
    },
}

impl NoCase {
    /// The error of reading `path`.
    pub fn at(path: &Path, error: io::Error) -> Self {
        match error.kind() {
            ErrorKind::InvalidData => Self::NoText(error),
            _ => Self::Unreadable { path: path.to_owned(), error },
        }
    }
}

fn names() -> Vec<&'static str> {
    embedded::all().iter().map(|(name, _)| *name).collect()
}

/// The case file at `path`, or where there is none the embedded case of that name.
///
/// # Errors
/// [`NoCase`].
pub fn find(path: &Path) -> Result<Source, NoCase> {
    let is_file = path.is_file() || is_pipe(path);
    if let Some(source) = path.to_str().filter(|_| !is_file).and_then(embedded::source) {
        return Ok(source);
    }
    if path.extension().is_none() && !is_file {
        return Err(NoCase::Unknown(path.to_owned()));
    }
    Source::file(path).map_err(|error| NoCase::at(path, error))
}
