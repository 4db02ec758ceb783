//! The materials of the embedded library and of files, and the search for one by its name.

use std::path::Path;
use std::sync::LazyLock;

use super::entry::{LibraryMaterial, MATERIALS_FILE};
use crate::case::error::{CaseError, Refusal};
use crate::case::lookup::NoCase;
use crate::case::reader::TableAt;
use crate::case::source::Source;
use crate::case::span::Span;
use crate::case::suggestions::nearest;

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
#[error("there is no material \"{name}\"{}", .near.as_ref().map_or_else(
    || "; percoat materials lists them".to_owned(),
    |near| format!("; did you mean \"{near}\"?"),
))]
pub struct UnknownMaterial {
    /// The name.
    pub name: String,
    /// The most similar name of a material.
    pub near: Option<String>,
}

impl UnknownMaterial {
    /// The error for a name that none of the materials has.
    pub fn among<'a>(name: &str, materials: impl IntoIterator<Item = &'a LibraryMaterial>) -> Self {
        let names: Vec<&str> = materials.into_iter().map(|own| &own.name[..]).collect();
        let lower: Vec<String> = names.iter().map(|name| name.to_lowercase()).collect();
        let near = nearest(name, &lower.iter().map(String::as_str).collect::<Vec<_>>());
        let near = near.and_then(|(near, _)| Some(names[lower.iter().position(|own| own == near)?].to_owned()));
        Self { name: name.to_owned(), near }
    }
}

/// The materials of a file.
///
/// # Errors
/// A file that cannot be read, and [`CaseError`] for its first fault, with line, key, value and what is allowed.
pub fn materials_of_file(path: &Path) -> Result<Vec<LibraryMaterial>, MaterialsError> {
    let source = Source::file(path).map_err(|error| NoCase::at(path, error))?;
    Ok(source.read(&[], read)?)
}

/// Why a file of materials is refused.
#[derive(Debug, thiserror::Error)]
pub enum MaterialsError {
    /// It cannot be read.
    #[error(transparent)]
    File(#[from] NoCase),
    /// It has a fault.
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
        let own = LibraryMaterial::read_table(&section)?;
        if all.iter().any(|other| other.name == own.name) {
            let refusal = section.value("name")?.refuse("a name that no other material of the file has");
            return Err(refusal);
        }
        all.push(own);
    }
    Ok(all)
}
