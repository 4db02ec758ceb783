//! The places at which a run computes stresses: planes, a section, points, a volume.

use crate::body::{Depth, HalfSpace, MeanStress};
use crate::stress::SurfaceLine;
use serde::Serialize;

/// Number of intervals in depth and of points along the line of a section.
pub(crate) const SECTION: [usize; 2] = [200, 401];

/// A request for stresses.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressRequest {
    /// Convention for the mean lateral stress.
    pub mean: MeanStress,
    /// Depths z ≥ 0 of horizontal planes, lengths; a depth on an interface gives both of its sides.
    pub planes: Vec<f64>,
    /// A vertical section.
    pub cut: Option<Cut>,
    /// Points x, y, z; lengths.
    pub points: Vec<[f64; 3]>,
    /// The volume under the cell.
    pub volume: Option<Volume>,
}

/// A vertical section to be computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// The line on the surface.
    pub line: SurfaceLine,
    /// Depth down to which it reaches, a length.
    pub depth: f64,
}

/// A volume under the whole cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Volume {
    /// Depth down to which it reaches, a length.
    pub depth: f64,
    /// Number of intervals in depth.
    pub rows: usize,
    /// Number of points along each cell vector.
    pub points: usize,
}

impl StressRequest {
    /// Depths of the planes on a half-space; a depth on an interface appears twice, once for each side.
    pub fn plane_depths(&self, half_space: &HalfSpace) -> Vec<Depth> {
        self.planes.iter().flat_map(|&z| half_space.depths(z)).collect()
    }

    /// Places (x, y) of the points, lengths, and their depths on a half-space; a point on an interface appears twice.
    pub fn points_at(&self, half_space: &HalfSpace) -> Vec<([f64; 2], Depth)> {
        let sides = |&[x, y, z]: &[f64; 3]| half_space.depths(z).into_iter().map(move |depth| ([x, y], depth));
        self.points.iter().flat_map(sides).collect()
    }
}

impl Cut {
    /// Depths of its rows on a half-space; a depth on an interface appears twice, once for each side.
    pub fn depths(&self, half_space: &HalfSpace) -> Vec<Depth> {
        half_space.rows(self.depth, SECTION[0])
    }
}
