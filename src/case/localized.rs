//! `[localized]`: the circles of the localized method, for `compare`.

use serde::Serialize;

use super::error::Refusal;
use super::reader::TableAt;
use super::value::ValueAt;
use crate::localized::CircleRadius;

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

impl LocalizedSection {
    pub(super) fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        section.only()?;
        let indenters = section.value("indenters")?.list()?.iter().map(ValueAt::integer).collect::<Result<_, _>>()?;
        let radius = match section.value("radius")?.word()? {
            "area-balanced" => CircleRadius::AreaBalanced,
            "lattice-sum" => CircleRadius::LatticeSum,
            _ => CircleRadius::LoadBalanced,
        };
        let mutual_effect = section.value("mutual_effect")?.boolean()?;
        Ok(Self { indenters, elements: section.value("elements")?.integer()?, radius, mutual_effect })
    }
}
