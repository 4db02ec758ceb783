//! The case that a command works on.

use super::ending::Failure;
use super::options::Common;
use percoat_case::case::{Case, NoCase, Source, embedded, find};
use percoat_common::plain;
use std::path::{Path, PathBuf};

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
        // A file of that name is not read.
        let source = embedded::source(embedded::DEFAULT).ok_or(NoCase::Unknown(embedded::DEFAULT.into()))?;
        return Ok((source, embedded::DEFAULT.to_owned()));
    };
    Ok((find(path)?, path.file_stem().unwrap_or_default().to_string_lossy().into_owned()))
}

/// The text of a file.
pub fn read_text(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| Failure::Input { path: path.to_owned(), error })
}

/// The output folder of a case: that of `-o`, or `out/<case name>`.
pub fn output_folder(common: &Common, name: &str) -> Result<PathBuf, Failure> {
    common.output.clone().map_or_else(|| default_folder(name), Ok)
}

/// `out/<case name>`; a name is refused that cannot be that of a folder in `out`, or has hidden characters.
pub fn default_folder(name: &str) -> Result<PathBuf, Failure> {
    // Some scripts, and emoji, join letters by marks without width.
    let is_hidden = |c: char| plain::is_hidden(c) && !matches!(c, '\u{200c}' | '\u{200d}');
    // Some systems drop dots and spaces at the end: `.. ` is `..` there.
    let is_plain = !name.is_empty() && !name.ends_with(['.', ' ']) && name != ".percoat" && !name.contains('/');
    if is_plain && !name.contains(is_hidden) {
        return Ok(Path::new("out").join(name));
    }
    Err(Failure::Refused(format!(
        "the name of the case, `{}`, cannot be the name of a folder in out/: give a folder with -o, or rename the file",
        plain::line(name)
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_whose_name_is_none_of_a_folder_has_no_default_one() {
        for name in ["fig2", "a.b", ".hidden", "..x", "µ 1", "-"] {
            assert_eq!(default_folder(name).unwrap(), Path::new("out").join(name));
        }
        for name in
            ["", ".", "..", "...", "a.", "a ", ".. ", " ", ".percoat", "a\nb", "a\u{1b}[2J", "a\u{202e}b", "a/../.."]
        {
            let refused = default_folder(name).unwrap_err();
            assert!(refused.code() == 2 && refused.to_string().contains("-o"), "{name:?}: {refused}");
        }
    }
}
