//! What the localized method is asked for.

use super::circle::CircleRadius;

/// Part of a mesh that the largest contact should fill.
pub(super) const FILLING: f64 = 0.75;

/// What the localized method is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup {
    /// Indenters inside each circle, at least: whole shells are taken.
    pub indenters: usize,
    /// Elements across the largest contact.
    pub elements: usize,
    /// How large the circles are.
    pub radius: CircleRadius,
    /// Whether the indenters around the one looked at act on it; if not, each is alone on the half-space.
    pub mutual_effect: bool,
}

impl Setup {
    /// Elements along the side of a mesh with so many across the largest contact.
    pub fn width(elements: usize) -> usize {
        (elements as f64 / FILLING).ceil() as usize / 2 * 2 + 1
    }
}
