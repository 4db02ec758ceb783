//! `[units]`: what lengths and pressures are measured in, by name.

use serde::Serialize;

use super::error::Refusal;
use super::reader::TableAt;

/// The section `[units]`: names alone, no number is converted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct UnitsSection {
    /// Of lengths; none: not named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<String>,
    /// Of pressures; none: not named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure: Option<String>,
}

impl UnitsSection {
    pub(super) fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        section.only()?;
        let name = |key| section.optional(key).map(|value| value.name().map(str::to_owned)).transpose();
        Ok(Self { length: name("length")?, pressure: name("pressure")? })
    }
}
