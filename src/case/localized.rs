//! `[localized]`: the circles of the localized method, for `compare`.

use serde::Serialize;

use super::error::Refusal;
use super::reader::TableAt;
use crate::localized::CircleRadius;

/// Most circles that a case can ask for.
const CIRCLES: usize = 100;

/// The section `[localized]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LocalizedSection {
    /// Indenters inside the circle, one value a circle.
    pub indenters: Vec<usize>,
    /// Elements across the largest contact.
    pub elements: usize,
    /// How large the circle is, or what stands outside it.
    pub radius: CircleRadius,
    /// Whether the indenters around the one looked at act on it.
    pub mutual_effect: bool,
}

impl Default for LocalizedSection {
    fn default() -> Self {
        Self { indenters: vec![7, 13, 37, 73], elements: 48, radius: CircleRadius::LoadBalanced, mutual_effect: true }
    }
}

impl LocalizedSection {
    pub(super) fn read(section: Option<&TableAt<'_>>) -> Result<Self, Refusal> {
        let mut localized = Self::default();
        let Some(section) = section else { return Ok(localized) };
        section.only()?;
        if let Some(indenters) = section.optional("indenters") {
            const WANTED: &str = "a list of at least one integer";
            const HELP: &str = "for example indenters = [7, 13]";
            localized.indenters = indenters.items(WANTED, HELP, CIRCLES, |circle| circle.integer(1..=10_000))?;
            if localized.indenters.is_empty() {
                return Err(indenters.refuse(WANTED).help(HELP));
            }
        }
        if let Some(elements) = section.optional("elements") {
            localized.elements = elements.integer(4..=1000)?;
        }
        if let Some(radius) = section.optional("radius") {
            let rules = [CircleRadius::LoadBalanced, CircleRadius::AreaBalanced, CircleRadius::LatticeSum];
            localized.radius = radius.choice(&rules.map(|rule| (rule.name(), rule)))?;
        }
        if let Some(effect) = section.optional("mutual_effect") {
            localized.mutual_effect = effect.boolean()?;
        }
        Ok(localized)
    }
}
