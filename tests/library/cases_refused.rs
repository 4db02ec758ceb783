//! Every case in `tests/refused` is refused with the words its first lines expect.
//!
//! A line `# expect: WORDS` at the top of a file demands that WORDS stand in the error. The last one gives the place,
//! such as `:12:11`. Lines `# set: KEY=VALUE` are overrides.

#![cfg(feature = "cli")]

use std::fs;
use std::path::{Path, PathBuf};

use percoat::case::{Case, Source};

fn refused() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/refused");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    files
}

fn lines(text: &str, mark: &str) -> Vec<String> {
    text.lines().filter_map(|line| line.strip_prefix(mark)).map(str::to_owned).collect()
}

#[test]
fn every_bad_case_is_refused_with_the_expected_words() {
    let files = refused();
    assert!(files.len() >= 25, "only {} cases in tests/refused", files.len());
    let mut complaints = Vec::new();
    for path in &files {
        let source = Source::file(path).unwrap();
        let source = Source { name: path.file_name().unwrap().to_string_lossy().into_owned(), ..source };
        let (expected, overrides) = (lines(&source.text, "# expect: "), lines(&source.text, "# set: "));
        assert!(!expected.is_empty(), "{} expects nothing", path.display());
        match Case::read(&source, &overrides) {
            Ok(_) => complaints.push(format!("{} was read", path.display())),
            Err(error) => {
                let shown = error.to_string();
                if std::env::var_os("SHOW_REFUSALS").is_some() {
                    println!("{shown}\n");
                }
                let absent = expected.iter().filter(|words| !shown.contains(*words));
                complaints.extend(absent.map(|words| format!("\"{words}\" does not stand in\n{shown}")));
            }
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n\n"));
}

#[test]
fn a_refusal_without_colour_has_no_escape_sequences() {
    for path in refused() {
        let source = Source::file(&path).unwrap();
        let Err(error) = Case::read(&source, &lines(&source.text, "# set: ")) else { continue };
        assert!(!error.to_string().contains('\u{1b}'));
        assert!(error.render(true).contains('\u{1b}'));
    }
}
