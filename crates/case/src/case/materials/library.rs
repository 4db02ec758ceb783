//! The materials of the embedded library and of files, and the search for one by its name.

use crate::case::section::ReadTable;
use std::path::Path;
use std::sync::LazyLock;

use super::entry::{LibraryMaterial, MATERIALS_FILE};
use crate::case::error::{CaseError, Refusal};
use crate::case::lookup::NoCase;
use crate::case::reader::TableAt;
use crate::case::source::Source;
use crate::case::span::Span;
use crate::case::suggestions::{alternatives, nearest};

const TEXT: &str = include_str!("library.toml");

static LIBRARY: LazyLock<Vec<LibraryMaterial>> = LazyLock::new(|| {
    let source = Source { name: "library.toml".to_owned(), text: TEXT.to_owned(), ..Source::default() };
    source.read(&[], read).unwrap_or_else(|error| panic!("{error}"))
});

/// The materials of the embedded library, GPa, sorted by kind.
pub fn library() -> &'static [LibraryMaterial] {
    &LIBRARY
}

/// Why a name is that of no material.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no material \"{name}\"; {}", self.help().unwrap_or_else(|| "percoat materials lists them".to_owned()))]
pub struct UnknownMaterial {
    /// The name.
    pub name: String,
    /// Names of the materials that have it as a word, such as the three kinds of "DLC"; else the most similar name; empty without one.
    pub near: Vec<String>,
}

impl UnknownMaterial {
    /// The error for a name that none of the materials has.
    pub fn among<'a>(name: &str, materials: impl IntoIterator<Item = &'a LibraryMaterial>) -> Self {
        let materials: Vec<&LibraryMaterial> = materials.into_iter().collect();
        let mut kinds: Vec<String> = materials
            .iter()
            .filter(|material| has_word(&material.name, name))
            .map(|material| material.name.clone())
            .collect();
        kinds.dedup();
        if !kinds.is_empty() {
            return Self { name: name.to_owned(), near: kinds };
        }
        let names: Vec<&str> = materials.iter().flat_map(|material| material.names()).collect();
        let lower: Vec<String> = names.iter().map(|name| name.to_lowercase()).collect();
        let near = nearest(name, &lower.iter().map(String::as_str).collect::<Vec<_>>());
        let near = near.and_then(|(near, _)| Some(names[lower.iter().position(|listed| listed == near)?].to_owned()));
        Self { name: name.to_owned(), near: near.into_iter().collect() }
    }

    /// Names that may be meant, as a question; `None` without one.
    pub fn help(&self) -> Option<String> {
        (!self.near.is_empty()).then(|| format!("did you mean {}?", alternatives(&self.near, '"')))
    }
}

/// Whether one of the words of a name, between blanks and signs, is `word`, capital or not.
fn has_word(name: &str, word: &str) -> bool {
    name.split(|letter: char| !letter.is_alphanumeric()).any(|part| part.to_lowercase() == word.to_lowercase())
}

/// The materials of a file.
///
/// # Errors
/// [`CaseError`] where the file of materials cannot be read, or for its first fault, with line, key, value and what is allowed.
pub fn materials_of_file(path: &Path) -> Result<Vec<LibraryMaterial>, MaterialsError> {
    let source = Source::file(path).map_err(|error| NoCase::at(path, error))?;
    Ok(source.read(&[], read)?)
}

/// Why a file of materials is refused.
#[derive(Debug, thiserror::Error)]
pub enum MaterialsError {
    /// A file that cannot be read.
    #[error(transparent)]
    File(#[from] NoCase),
    /// A fault in the file.
    #[error(transparent)]
    Fault(#[from] CaseError),
}

/// The materials of a source that is a file of them.
pub(super) fn read(source: &Source) -> Result<Vec<LibraryMaterial>, Refusal> {
    let tree = source.tree(&MATERIALS_FILE)?;
    let end = source.text.trim_end().len();
    let root = TableAt::root(&tree, &MATERIALS_FILE, Span::new(0, end..end));
    root.only()?;
    root.value("material")?;
    let mut all: Vec<LibraryMaterial> = Vec::new();
    for section in root.sections("material")? {
        let material = LibraryMaterial::read_table(&section)?;
        if all.iter().any(|other| other.is_called(&material.name)) {
            return Err(section.value("name")?.refuse("a name that no other material of the file has"));
        }
        if material.aliases.iter().any(|alias| all.iter().any(|other| other.is_called(alias))) {
            return Err(section.value("aliases")?.refuse("names that no other material of the file has"));
        }
        all.push(material);
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::super::entry::{Certainty, Property};
    use super::*;
    use percoat_core::body::Material;

    fn properties(material: &LibraryMaterial) -> Vec<(&'static str, &Property)> {
        let strengths = [
            ("hardness", &material.hardness),
            ("yield_strength", &material.yield_strength),
            ("tensile_strength", &material.tensile_strength),
            ("ultimate_strength", &material.ultimate_strength),
        ];
        let given = strengths.into_iter().filter_map(|(key, property)| Some((key, property.as_ref()?)));
        [("young", &material.young), ("poisson", &material.poisson)].into_iter().chain(given).collect()
    }

    #[test]
    fn every_number_of_the_library_has_its_source_and_no_strength_is_assumed() {
        assert!(library().len() >= 40);
        for material in library() {
            assert!(
                material.kind.is_some() && material.about.as_ref().is_some_and(|text| text.ends_with('.')),
                "{}",
                material.name
            );
            for (key, property) in properties(material) {
                let of = format!("{key} of {}", material.name);
                assert!(property.source.is_some() && property.certainty.is_some(), "{of}");
                let is_modulus = ["young", "poisson"].contains(&key);
                assert!(is_modulus || property.certainty == Some(Certainty::Sourced), "{of}");
                assert!(is_modulus == property.what.is_none() && (property.range.is_some() || !is_modulus), "{of}");
            }
        }
    }

    #[test]
    fn numbers_of_the_library_agree_with_each_other() {
        for material in library() {
            let young = material.young.value;
            assert!(Material::from_young(young, material.poisson.value).is_ok() && (1e-3..1300.0).contains(&young));
            let hardness = material.hardness.as_ref().map(|hardness| hardness.value);
            assert!(hardness.is_none_or(|hardness| hardness < young / 6.0), "hardness of {}", material.name);
            // Metals harden by strain, and a polymer yields at nearly half its hardness.
            let yielding = material.yield_strength.as_ref().map(|strength| strength.value);
            assert!(
                yielding.zip(hardness).is_none_or(|(yielding, hardness)| yielding < 0.45 * hardness),
                "{}",
                material.name
            );
            let ultimate = material.ultimate_strength.as_ref().map(|strength| strength.value);
            assert!(
                yielding.zip(ultimate).is_none_or(|(yielding, ultimate)| yielding <= ultimate),
                "{}",
                material.name
            );
        }
    }

    #[test]
    fn a_name_is_that_of_one_material() {
        let mut names: Vec<&str> = library().iter().flat_map(LibraryMaterial::names).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert!(names.len() == count && count > library().len() + 40);
    }

    #[test]
    fn materials_are_sorted_by_kind() {
        let mut kinds: Vec<_> = library().iter().map(|material| material.kind.as_deref()).collect();
        kinds.dedup();
        let mut distinct = kinds.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(kinds.len(), distinct.len());
    }

    #[test]
    fn a_printed_material_is_a_file_of_one() {
        for material in library() {
            let source = Source { text: material.to_toml(), ..Source::default() };
            assert_eq!(source.read(&[], read).unwrap(), std::slice::from_ref(material));
        }
    }
}
