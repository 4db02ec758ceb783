//! `[units]`: what lengths and pressures are measured in, by name.

use serde::Serialize;

use super::error::Refusal;
use super::reader::TableAt;

/// Most characters of a name.
const MOST: usize = 12;

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
        Ok(Self { length: name(section, "length", "\"µm\"")?, pressure: name(section, "pressure", "\"GPa\"")? })
    }
}

fn name(section: &TableAt<'_>, key: &str, example: &str) -> Result<Option<String>, Refusal> {
    let Some(value) = section.optional(key) else { return Ok(None) };
    let wanted = format!("a name of 1 to {MOST} characters without spaces at its ends, such as {example}");
    let text = value.text(&wanted)?;
    let fits = (1..=MOST).contains(&text.chars().count()) && text.trim() == text && !text.contains(char::is_control);
    if fits { Ok(Some(text.to_owned())) } else { Err(value.refuse(wanted)) }
}
