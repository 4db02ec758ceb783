//! `percoat explain`: the keys of a case with types, units, ranges and defaults.

use super::ending::{Ending, Failure};
use super::terminal;
use percoat_case::case;
use std::io::Write;

/// Prints the sections of a case, or the explanation of a key.
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

/// Prints the JSON schema of a case.
pub fn schema() -> Result<Ending, Failure> {
    writeln!(terminal::out(), "{:#}", case::schema())?;
    Ok(Ending::Done)
}

/// Prints all keys as tables in Markdown.
pub fn table() -> Result<Ending, Failure> {
    write!(terminal::out(), "{}", case::key_table())?;
    Ok(Ending::Done)
}
