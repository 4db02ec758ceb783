//! The samples beside the edge of a contact, and how far from it they are looked at.

use crate::reading::edge::Edge;

/// Distance from the edge, in spacings, over which the weight of a sample rises from zero to one.
pub(super) const RISE: f64 = 2.5;
/// Distance from the edge, in spacings, from which on samples are looked at.
pub(super) const NEAREST: f64 = 0.3;

/// A sample near a contact seen from its indenter's axis.
#[derive(Debug, Clone, Copy)]
pub struct Polar {
    /// Distance from the axis, a length.
    pub r: f64,
    /// Angle from the x axis, radians.
    pub theta: f64,
    /// Pressure, 0 outside contact.
    pub p: f64,
    /// Gap over the contact modulus of the surface material, 3E*g/4: a pressure times a length.
    pub opening: f64,
    /// Whether it lies in the hole of a ring.
    pub hole: bool,
}

impl Polar {
    /// A sample at `[x, y]` from the axis.
    pub fn new([x, y]: [f64; 2], p: f64, opening: f64, hole: bool) -> Self {
        Self { r: x.hypot(y), theta: y.atan2(x), p, opening, hole }
    }
}

/// Grid and edge behind the samples of a contact.
#[derive(Debug, Clone, Copy)]
pub struct Scale<'a> {
    /// Area for which a sample stands.
    pub sample_area: f64,
    /// Largest distance of neighbours, a length.
    pub spacing: f64,
    /// The edge on the half-space, from [`Scale::distances`].
    pub edge: &'a Edge,
}

impl Scale<'_> {
    /// Distances from an edge that boundaries of up to `resolution` samples per radius look at, in spacings.
    pub fn distances(resolution: f64) -> [f64; 2] {
        [0.5 * NEAREST, RISE + resolution.max(1.0).sqrt()]
    }

    /// Reach of a fit around a boundary of `radius`.
    pub(super) fn reach(&self, radius: f64) -> f64 {
        let resolution = radius / self.sample_area.sqrt();
        (RISE + resolution.sqrt()).min(0.6 * resolution) * self.spacing
    }
}
