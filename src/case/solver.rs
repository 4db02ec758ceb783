//! `[solver]`: how the contact problem is solved, and how far.

use super::error::Refusal;
use super::reader::TableAt;
use crate::spectral::{Method, Settings};

pub(super) fn read(section: Option<&TableAt<'_>>) -> Result<Settings, Refusal> {
    let mut settings = Settings::default();
    let Some(section) = section else { return Ok(settings) };
    section.only()?;
    if let Some(method) = section.optional("method") {
        let choices = [("preconditioned", Method::Preconditioned), ("polonsky-keer", Method::PolonskyKeer)];
        settings.method = method.choice(&choices)?;
    }
    if let Some(tolerance) = section.optional("tolerance") {
        settings.tolerance = tolerance.number(1e-14..=1e-2)?;
    }
    if let Some(limit) = section.optional("max_iterations") {
        settings.max_iterations = limit.integer(1..=usize::MAX)?;
    }
    Ok(settings)
}
