//! A surface as an instrument's file has it.

use super::fault::Heights;
use super::header::{HeightsUnit, Length};
use percoat_core::notation::number;

/// Distances of samples that instruments have, m: from fractions of an atom to those of a road.
const SPACINGS: [f64; 2] = [1e-12, 1e-2];

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

impl Measured {
    /// A warning where the sides and heights can hardly be what the units of the file make them.
    pub fn implausible(&self) -> Option<String> {
        let [x, y] = self.sides.each_ref().map(Length::metres);
        let [width, height] = self.heights.points.map(|n| n as f64);
        let (width, height, sides) = (x? / width, y? / height, [x?, y?].map(number).join(" × "));
        let [least, most] = SPACINGS;
        let at_fault = [("x", width), ("y", height)].into_iter().find(|(_, spacing)| !(least..=most).contains(spacing));
        if let Some((axis, spacing)) = at_fault {
            return Some(format!(
                "surface.heights: by the header of the file its samples stand {} m apart along {axis}, and it is {sides} m large: is its \
                 increment in another unit than the header says? Correct it in the program that wrote it, or give [lattice] or surface.period",
                number(spacing)
            ));
        }
        let Some(HeightsUnit::Known(name)) = &self.unit else { return None };
        let factor = Length { value: 1.0, unit: Some(name.clone()) }.metres()?;
        let measured = || self.heights.values.iter().copied().filter(|height| !height.is_nan());
        let range = factor * (measured().fold(f64::MIN, f64::max) - measured().fold(f64::MAX, f64::min));
        (range > x?.max(y?)).then(|| {
            format!(
                "surface.heights: by the header of the file its heights range over {} m, and it is {sides} m large: is its increment of \
                 heights in another unit than the header says? Correct it in the program that wrote it",
                number(range)
            )
        })
    }
}
