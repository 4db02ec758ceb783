//! Errors, with the message of the command line.

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

/// What is asked for is refused, for this reason, in which nothing is hidden.
pub fn refused(reason: impl fmt::Display) -> PyErr {
    CaseError::new_err(plain::lines(&reason.to_string()).into_owned())
}

/// A file cannot be read; Python makes of it `FileNotFoundError` and the like.
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

/// There is no case where one is looked for.
pub fn no_case(none: NoCase) -> PyErr {
    match none {
        NoCase::Unreadable { path, error } => unreadable(&path, &error),
        other => refused(other),
    }
}
