//! Errors with the messages of the command line.

use percoat::case::NoCase;
use percoat::output::FolderError;
use percoat::plain;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use std::error::Error;
use std::fmt;
use std::io;
use std::path::Path;

pyo3::create_exception!(
    percoat,
    CaseError,
    PyValueError,
    "A case, or what is asked of it, is refused: nothing has been computed.\n\nThe message is that of the command line: \
     where it stands, the value received, what is allowed and what to do."
);

/// A `CaseError` with this reason, hidden characters escaped.
pub fn refused(reason: impl fmt::Display) -> PyErr {
    CaseError::new_err(plain::lines(&reason.to_string()).into_owned())
}

/// The error of a file that cannot be read: an `OSError`, `FileNotFoundError` and the like by the number of the system.
pub fn unreadable(path: &Path, error: &io::Error) -> PyErr {
    match error.raw_os_error() {
        Some(code) => {
            let told = error.to_string();
            let told = told.split(" (os error").next().unwrap_or_default().to_owned();
            PyOSError::new_err((code, told, path.display().to_string()))
        }
        None => PyOSError::new_err(format!("cannot read {}: {error}", plain::path(path))),
    }
}

/// The error of a path or name without a case.
pub fn no_case(none: NoCase) -> PyErr {
    match none {
        NoCase::Unreadable { path, error } => unreadable(&path, &error),
        other => refused(other),
    }
}

/// The error of a folder that cannot be claimed or written: what is refused is a `CaseError`, what the system refuses an `OSError`.
pub fn no_folder(error: FolderError) -> PyErr {
    let FolderError::Output(error) = error else {
        // In Python there is no such option.
        return refused(error.to_string().replace(" with -o", ""));
    };
    let system = error.source().and_then(|source| source.downcast_ref::<io::Error>());
    match system.and_then(io::Error::raw_os_error) {
        Some(code) => PyOSError::new_err((code, error.to_string())),
        None => PyOSError::new_err(error.to_string()),
    }
}
