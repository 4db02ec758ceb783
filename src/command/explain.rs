//! `percoat explain`: what the keys of a case are.

use super::ending::{Ending, Failure};
use super::terminal;
use crate::case;
use std::io::Write;

/// The sections, or all that is to be said of a key.
pub fn run(key: Option<&str>) -> Result<Ending, Failure> {
    let mut out = terminal::out();
    let Some(key) = key else {
        write!(out, "{}", case::overview())?;
        return Ok(Ending::Done);
    };
    for (index, explanation) in case::explain(key).map_err(Failure::refused)?.iter().enumerate() {
        write!(out, "{}{explanation}", if index > 0 { "\n" } else { "" })?;
    }
    Ok(Ending::Done)
}

/// The JSON schema of a case.
pub fn schema() -> Result<Ending, Failure> {
    writeln!(terminal::out(), "{:#}", case::schema())?;
    Ok(Ending::Done)
}
