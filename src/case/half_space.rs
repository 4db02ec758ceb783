//! A half-space alone: layers and substrate without a case around them.

use super::error::{CaseError, Refusal};
use super::layers::{self, LayerSection, SubstrateSection};
use super::node::Table;
use super::place::Place;
use super::reader::TableAt;
use super::{Source, keys};
use crate::body::HalfSpace;

/// Reads the sections `[[layers]]` and `[substrate]`, as they stand in a case.
///
/// # Errors
/// [`CaseError`] as of a case; any other section is refused.
pub fn half_space(source: &Source) -> Result<HalfSpace, CaseError> {
    read(source).map_err(|refusal| CaseError::new(source, &[], refusal))
}

fn read(source: &Source) -> Result<HalfSpace, Refusal> {
    let root = Table::parse(&source.text)?;
    let end = source.text.trim_end().len();
    let root = TableAt::root(&root, &keys::CASE, Place::new(0, end..end));
    root.only()?;
    if let Some(entry) = root.table.entries.iter().find(|entry| !["layers", "substrate"].contains(&&entry.key[..])) {
        let message = format!("`{}` has no place in a half-space", entry.key);
        return Err(Refusal::new(entry.key_place, message, "not used here").help("allowed here: layers, substrate"));
    }
    let layer_sections = root.sections("layers")?;
    let layers: Vec<LayerSection> = layer_sections.iter().map(LayerSection::read).collect::<Result<_, _>>()?;
    let substrate_section = root.required_section("substrate")?;
    let substrate = SubstrateSection::read(&substrate_section)?;
    layers::build(&layers, &layer_sections, &substrate, &substrate_section)
}
