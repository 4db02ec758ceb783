//! Example cases that are embedded in the program.

use super::Source;

/// Name of the case that runs when none is given.
pub const DEFAULT: &str = "fig2";

/// Name and text of every embedded case.
pub fn all() -> &'static [(&'static str, &'static str)] {
    &percoat_cases::CASES
}

/// An embedded case as a source; `None` for an unknown name.
pub fn source(name: &str) -> Option<Source> {
    let (_, text) = percoat_cases::CASES.iter().find(|(known, _)| *known == name)?;
    Some(Source { name: format!("embedded case {name}"), text: (*text).to_owned(), ..Source::default() })
}
