//! The case that a command works on.

use super::ending::Failure;
use percoat::case::{Case, Source, embedded};
use std::io::ErrorKind;
use std::path::Path;

/// The case a command works on, changed by the overrides `set`, and its name: a file, an embedded case by its name, or
/// the default.
pub fn read_case(case: Option<&Path>, set: &[String]) -> Result<(Case, String), Failure> {
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
        None => Source::file(path).map_err(|error| match error.kind() {
            // It can be read, but is no case.
            ErrorKind::InvalidData => Failure::Refused(error.to_string()),
            _ => Failure::Input { path: path.to_owned(), error },
        })?,
    };
    Ok((Case::read(&source, set)?, name))
}
