//! Where a run gives stresses.

use crate::body::{Depth, HalfSpace, MeanStress};
use crate::stress::Line;

/// Intervals in depth, and points along the line, of a section.
pub const SECTION: [usize; 2] = [200, 401];

/// Stresses asked for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressRequest {
    /// What the mean lateral stress is.
    pub mean: MeanStress,
    /// Depths z ≥ 0 of horizontal planes, lengths; one on an interface gives both sides.
    pub planes: Vec<f64>,
    /// A vertical section: the line on the surface and the depth it reaches, a length.
    pub section: Option<(Line, f64)>,
    /// Single points x, y, z; lengths.
    pub points: Vec<[f64; 3]>,
    /// A volume under the cell.
    pub volume: Option<Volume>,
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

/// Where stresses are given on a half-space: every depth in its material.
#[derive(Debug, Clone, Default)]
pub struct Places {
    /// Horizontal planes; a depth on an interface stands twice.
    pub planes: Vec<Depth>,
    /// A vertical section: its line and its rows; a row on an interface stands twice, once for each side.
    pub section: Option<(Line, Vec<Depth>)>,
    /// Single points, (x, y) and a depth.
    pub points: Vec<([f64; 2], Depth)>,
    /// A volume: depths of its planes, points along a₁ and a₂.
    pub volume: Option<(Vec<Depth>, [usize; 2])>,
}

impl StressRequest {
    /// The places on a half-space.
    pub fn places(&self, half_space: &HalfSpace) -> Places {
        let [rows, _] = SECTION;
        let point = |&[x, y, z]: &[f64; 3]| half_space.depths(z).into_iter().map(move |depth| ([x, y], depth));
        Places {
            planes: self.planes.iter().flat_map(|&z| half_space.depths(z)).collect(),
            section: self.section.map(|(line, depth)| (line, half_space.rows(depth, rows))),
            points: self.points.iter().flat_map(point).collect(),
            volume: self.volume.map(|volume| (half_space.rows(volume.depth, volume.rows), [volume.points; 2])),
        }
    }
}
