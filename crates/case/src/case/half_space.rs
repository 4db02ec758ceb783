//! A half-space alone: layers and substrate without a case around them, with what materials need.

use super::Source;
use super::error::{CaseError, Refusal};
use super::layers;
use super::materials;
use super::measures;
use super::model::CASE;
use super::reader::TableAt;
use super::span::Span;
use percoat_core::body::HalfSpace;

/// Reads the sections `[[layers]]` and `[substrate]` in the form of a case, which may have `[units]` and `materials` for them.
///
/// # Errors
/// [`CaseError`] as for a case, and for any other section.
pub fn half_space(source: &Source) -> Result<HalfSpace, CaseError> {
    source.read(&[], read)
}

/// Keys of a case that a half-space has.
const KEYS: [&str; 4] = ["layers", "substrate", "units", "materials"];

fn read(source: &Source) -> Result<HalfSpace, Refusal> {
    let mut root = source.tree(&CASE)?;
    measures::convert(&mut root, &CASE)?;
    materials::fill(&mut root, &CASE, source)?;
    let end = source.text.trim_end().len();
    let root = TableAt::root(&root, &CASE, Span::new(0, end..end));
    root.only()?;
    if let Some(entry) = root.table.entries.iter().find(|entry| !KEYS.contains(&&entry.key[..])) {
        let message = format!("`{}` has no place in a half-space", entry.key);
        return Err(
            Refusal::new(entry.key_span, message, "not used here").help(format!("allowed here: {}", KEYS.join(", ")))
        );
    }
    layers::read(&root).map(|body| body.half_space)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, embedded};

    fn read(text: &str) -> Result<HalfSpace, CaseError> {
        half_space(&Source { name: "body.toml".to_owned(), text: text.to_owned(), ..Source::default() })
    }

    #[test]
    fn it_is_that_of_a_case_with_the_same_sections() {
        let source = embedded::source("dlc-on-steel").unwrap();
        let case = Case::read(&source, &[]).unwrap();
        let text: toml::Table = toml::from_str(&source.text).unwrap();
        let sections = text.into_iter().filter(|(key, _)| ["layers", "substrate"].contains(&&key[..]));
        let alone = read(&toml::to_string(&sections.collect::<toml::Table>()).unwrap()).unwrap();
        assert_eq!(&alone, case.half_space());
        assert!(alone.layers().len() == 2);
    }

    #[test]
    fn its_materials_may_be_those_of_the_library() {
        let alone = read("[substrate]\nmaterial = \"TiN\"\n[units]\npressure = \"MPa\"\n").unwrap();
        assert_eq!(alone.surface_material().young(), 430e3);
    }

    #[test]
    fn anything_else_is_refused_where_it_stands() {
        let substrate = "[substrate]\nyoung = 1\npoisson = 0.3\n";
        let refused = |text: &str| read(text).unwrap_err().to_string();
        let told = refused(&format!("{substrate}[load]\nmean_pressure = 1\n"));
        assert!(told.contains("`load` has no place in a half-space") && told.contains("body.toml:4"), "{told}");
        let told = refused(&format!("{substrate}[[layer]]\nthickness = 1\n"));
        assert!(told.contains("did you mean `layers`?"), "{told}");
        let told = refused("");
        assert!(told.contains("substrate") && told.contains("missing"), "{told}");
    }
}
