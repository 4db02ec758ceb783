//! A surface as an instrument's file has it.

use super::fault::Heights;
use super::header::{HeightsUnit, Length};

/// Heights with their sides and unit.
#[derive(Debug)]
pub struct Measured {
    /// Heights in the unit of the file, axis 0 along a₁, axis 1 along a₂; NaN where there is no measurement.
    pub heights: Heights,
    /// Sides along a₁ and a₂.
    pub sides: [Length; 2],
    /// Unit of the heights; none where the file has none.
    pub unit: Option<HeightsUnit>,
    /// Warnings about the file, a sentence each.
    pub doubts: Vec<String>,
}
