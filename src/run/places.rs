//! Where a run gives stresses.

use crate::body::{Depth, HalfSpace, MeanStress};
use crate::stress::SurfaceLine;

/// Intervals in depth, and points along the line, of the section along a cut.
pub(crate) const SECTION: [usize; 2] = [200, 401];

/// Stresses asked for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressRequest {
    /// What the mean lateral stress is.
    pub mean: MeanStress,
    /// Depths z ≥ 0 of horizontal planes, lengths; one on an interface gives both sides.
    pub planes: Vec<f64>,
    /// A vertical cut.
    pub cut: Option<Cut>,
    /// Single points x, y, z; lengths.
    pub points: Vec<[f64; 3]>,
    /// A volume under the cell.
    pub volume: Option<Volume>,
}

/// A vertical cut asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// The line on the surface.
    pub line: SurfaceLine,
    /// How deep it reaches, a length.
    pub depth: f64,
}

/// The field under the whole cell.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Volume {
    /// Down to this depth, a length.
    pub depth: f64,
    /// Intervals in depth.
    pub rows: usize,
    /// Points along each cell vector.
    pub points: usize,
}

impl StressRequest {
    /// Depths of the planes on a half-space; one on an interface stands twice, once for each side.
    pub fn plane_depths(&self, half_space: &HalfSpace) -> Vec<Depth> {
        self.planes.iter().flat_map(|&z| half_space.depths(z)).collect()
    }

    /// Places (x, y) of the points, lengths, and their depths on a half-space; one on an interface stands twice.
    pub fn points_at(&self, half_space: &HalfSpace) -> Vec<([f64; 2], Depth)> {
        let sides = |&[x, y, z]: &[f64; 3]| half_space.depths(z).into_iter().map(move |depth| ([x, y], depth));
        self.points.iter().flat_map(sides).collect()
    }
}

impl Cut {
    /// Depths of its rows on a half-space; one on an interface stands twice, once for each side.
    pub fn depths(&self, half_space: &HalfSpace) -> Vec<Depth> {
        half_space.rows(self.depth, SECTION[0])
    }
}
