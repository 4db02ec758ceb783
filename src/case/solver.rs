//! `[solver]`: how the contact problem is solved, and how far.

use super::error::Refusal;
use super::reader::TableAt;
use crate::spectral::{Method, Settings};

pub(super) fn read(section: &TableAt<'_>) -> Result<Settings, Refusal> {
    section.only()?;
    let method = match section.value("method")?.word()? {
        "polonsky-keer" => Method::PolonskyKeer,
        _ => Method::Preconditioned,
    };
    let tolerance = section.value("tolerance")?.number()?;
    Ok(Settings { method, tolerance, max_iterations: section.value("max_iterations")?.integer()? })
}
