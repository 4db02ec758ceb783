//! The case that a command works on.

use super::ending::Failure;
use crate::case::{Case, Source, embedded};
use std::io::{self, ErrorKind};
use std::path::Path;

/// The case a command works on, changed by the overrides `set`, and its name.
pub fn read_case(case: Option<&Path>, set: &[String]) -> Result<(Case, String), Failure> {
    let (source, name) = read_source(case)?;
    Ok((Case::read(&source, set)?, name))
}

/// The text of a case and its name: a file, standard input (`-`), an embedded case by its name, or the default.
pub fn read_source(case: Option<&Path>) -> Result<(Source, String), Failure> {
    if case == Some(Path::new("-")) {
        let source = Source::standard_input().map_err(|error| input_failure(Path::new("standard input"), error))?;
        return Ok((source, "stdin".to_owned()));
    }
    let path = case.unwrap_or(Path::new(embedded::DEFAULT));
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let embedded = path.to_str().filter(|_| case.is_none() || !path.is_file()).and_then(embedded::source);
    let source = match embedded {
        Some(source) => source,
        None if path.extension().is_none() && !path.is_file() => {
            let names: Vec<&str> = embedded::all().iter().map(|(name, _)| *name).collect();
            return Err(Failure::Refused(format!(
                "{} is neither a file nor an embedded case ({})",
                path.display(),
                names.join(", ")
            )));
        }
        None => Source::file(path).map_err(|error| input_failure(path, error))?,
    };
    Ok((source, name))
}

fn input_failure(path: &Path, error: io::Error) -> Failure {
    match error.kind() {
        // It can be read, but is no case.
        ErrorKind::InvalidData => Failure::Refused(error.to_string()),
        _ => Failure::Input { path: path.to_owned(), error },
    }
}
