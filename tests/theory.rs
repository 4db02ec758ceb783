//! The equations of the book, `docs/src/theory.md`, have their code in the table of `src/theory.md`, and a test or a study that guards
//! them.

use std::fs;
use std::path::{Path, PathBuf};

/// One row of the table of `src/theory.md`.
struct Equation {
    number: usize,
    code: Vec<Reference>,
    guards: Vec<Reference>,
}

/// A file with the items in it that are named, or the folder of a study.
struct Reference {
    path: String,
    items: Vec<String>,
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn page() -> String {
    source("src/theory.md")
}

/// The number of a text that begins with "(n)".
fn number(text: &str) -> Option<usize> {
    text.strip_prefix('(')?.split_once(')')?.0.parse().ok()
}

/// The numbers of the equations in the book, in their order: what stands behind the beginnings of blocks of mathematics.
fn numbers_in_the_book(book: &str) -> Vec<usize> {
    let begins = book.lines().filter_map(|line| line.strip_prefix("```math"));
    let numbered = begins.map(str::trim).filter(|number| !number.is_empty());
    numbered.map(|number| number.parse().unwrap_or_else(|_| panic!("```math {number}"))).collect()
}

/// The texts within backticks: a path begins a reference, what follows are items of that file.
fn references(cell: &str) -> Vec<Reference> {
    let mut references: Vec<Reference> = Vec::new();
    for text in cell.split('`').skip(1).step_by(2) {
        match references.last_mut() {
            Some(last) if !text.contains('/') => last.items.push(text.to_owned()),
            _ => references.push(Reference { path: text.to_owned(), items: Vec::new() }),
        }
    }
    references
}

fn equations(page: &str) -> Vec<Equation> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.strip_prefix("| (")?.split('|').collect();
        let [label, _name, code, guards, _] = cells[..] else { panic!("a row of four cells: {line}") };
        let number = number(&format!("({}", label.trim()))?;
        Some(Equation { number, code: references(code), guards: references(guards) })
    };
    page.lines().filter_map(row).collect()
}

/// Whether a text has the word, with nothing beside it that would make it another one.
fn has_word(text: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word)
        .any(|(at, _)| !text[..at].ends_with(is_part) && !text[at + word.len()..].starts_with(is_part))
}

/// Whether a source defines an item: `Type::function`, a function or a type.
fn defines(source: &str, item: &str) -> bool {
    let (owner, name) = item.split_once("::").map_or((None, item), |(owner, name)| (Some(owner), name));
    let kinds: &[&str] = if owner.is_some() { &["fn"] } else { &["fn", "struct", "enum", "trait", "type", "const"] };
    kinds.iter().any(|kind| has_word(source, &format!("{kind} {name}")))
        && owner.is_none_or(|owner| has_word(source, owner))
}

/// Whether a source has a test of this name.
fn tests(source: &str, name: &str) -> bool {
    let Some((before, _)) = source.split_once(&format!("fn {name}()")) else { return false };
    let attributes = before.lines().rev().skip(1).take_while(|line| line.trim_start().starts_with('#'));
    attributes.chain(before.lines().last()).any(|line| line.contains("#[test]"))
}

fn source(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn every_equation_has_its_code() {
    for equation in equations(&page()) {
        assert!(!equation.code.is_empty(), "({}) names no code", equation.number);
        for Reference { path, items } in &equation.code {
            assert!(!items.is_empty(), "({}) names nothing in {path}", equation.number);
            let source = source(path);
            for item in items {
                assert!(defines(&source, item), "({}): there is no {item} in {path}", equation.number);
            }
        }
    }
}

#[test]
fn every_equation_is_guarded_by_a_test_or_a_study() {
    for equation in equations(&page()) {
        assert!(!equation.guards.is_empty(), "nothing guards ({})", equation.number);
        for Reference { path, items } in &equation.guards {
            if Path::new(path).extension().is_none() {
                assert!(path.starts_with("validation/") && items.is_empty(), "({}): {path}", equation.number);
                source(&format!("{path}/README.md"));
                continue;
            }
            assert!(!items.is_empty(), "({}) names no test in {path}", equation.number);
            let source = source(path);
            for item in items {
                assert!(tests(&source, item), "({}): there is no test {item} in {path}", equation.number);
            }
        }
    }
}

#[test]
fn the_numbers_of_the_table_are_those_of_the_book() {
    let rows: Vec<usize> = equations(&page()).iter().map(|equation| equation.number).collect();
    assert!(!rows.is_empty());
    assert_eq!(rows, (1..=rows.len()).collect::<Vec<_>>(), "the rows in their order");
    assert_eq!(numbers_in_the_book(&source("docs/src/theory.md")), rows, "each equation once, in its order");
}
