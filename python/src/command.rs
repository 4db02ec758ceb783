//! The command line, for the program that the package installs.

use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs the command line as typed, its own name first; the exit code.
#[pyfunction]
pub fn main(py: Python<'_>, typed: Vec<OsString>) -> u8 {
    py.detach(|| percoat::command::main(typed))
}
