//! The command line, for the program `percoat` that the package installs.

use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs the command line with these words, the program's name first; the exit code.
#[pyfunction]
pub fn main(py: Python<'_>, typed: Vec<OsString>) -> u8 {
    py.detach(|| percoat::command::main(typed))
}
