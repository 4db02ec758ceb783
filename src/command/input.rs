//! The case that a command works on.

use super::ending::Failure;
use crate::case::{Case, NoCase, Source, embedded, find};
use std::path::Path;

/// The case a command works on, changed by the overrides `set`, and its name.
pub fn read_case(case: Option<&Path>, set: &[String]) -> Result<(Case, String), Failure> {
    let (source, name) = read_source(case)?;
    Ok((Case::read(&source, set)?, name))
}

/// The text of a case and its name: a file, standard input (`-`), an embedded case by its name, or the default.
pub fn read_source(case: Option<&Path>) -> Result<(Source, String), Failure> {
    if case == Some(Path::new("-")) {
        let source = Source::standard_input().map_err(|error| NoCase::at(Path::new("standard input"), error))?;
        return Ok((source, "stdin".to_owned()));
    }
    let Some(path) = case else {
        // A file of that name is not meant.
        let source = embedded::source(embedded::DEFAULT).ok_or(NoCase::Unknown(embedded::DEFAULT.into()))?;
        return Ok((source, embedded::DEFAULT.to_owned()));
    };
    Ok((find(path)?, path.file_stem().unwrap_or_default().to_string_lossy().into_owned()))
}
