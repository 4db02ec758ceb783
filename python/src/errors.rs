//! Errors with the messages of the command line.

use percoat::case::NoCase;
use percoat::plain;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
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
