//! Where a run gives stresses, and what they are there.

use crate::body::{Depth, HalfSpace, MeanStress};
use crate::stress::{Line, Plane, Section, State, StressField};

/// Intervals in depth, and points along the line, of a section.
pub(crate) const SECTION: [usize; 2] = [200, 401];

/// Stresses asked for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressRequest {
    /// What the mean lateral stress is.
    pub mean: MeanStress,
    /// Depths z ≥ 0 of horizontal planes, lengths; one on an interface gives both sides.
    pub planes: Vec<f64>,
    /// A vertical section.
    pub section: Option<SectionRequest>,
    /// Single points x, y, z; lengths.
    pub points: Vec<[f64; 3]>,
    /// A volume under the cell.
    pub volume: Option<Volume>,
}

/// A vertical section asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionRequest {
    /// The line on the surface.
    pub line: Line,
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

/// Where stresses are given on a half-space: every depth in its material.
#[derive(Debug, Clone, Default)]
pub struct Places {
    /// Horizontal planes; a depth on an interface stands twice.
    pub planes: Vec<Depth>,
    /// A vertical section.
    pub section: Option<SectionRows>,
    /// Single points.
    pub points: Vec<PlaceAtDepth>,
    /// A volume.
    pub volume: Option<VolumePlanes>,
}

/// A vertical section: points along a line, row by row.
#[derive(Debug, Clone)]
pub struct SectionRows {
    /// The line on the surface.
    pub line: Line,
    /// Depths of the rows; one on an interface stands twice, once for each side.
    pub depths: Vec<Depth>,
}

/// A single point.
#[derive(Debug, Clone, Copy)]
pub struct PlaceAtDepth {
    /// Its place (x, y), lengths.
    pub place: [f64; 2],
    /// Its depth.
    pub depth: Depth,
}

/// A volume, plane by plane.
#[derive(Debug, Clone)]
pub struct VolumePlanes {
    /// Depths of the planes; one on an interface stands twice.
    pub depths: Vec<Depth>,
    /// Points along a₁ and a₂.
    pub points: [usize; 2],
}

impl StressRequest {
    /// The places on a half-space.
    pub fn places(&self, half_space: &HalfSpace) -> Places {
        let [rows, _] = SECTION;
        let point = |&[x, y, z]: &[f64; 3]| {
            half_space.depths(z).into_iter().map(move |depth| PlaceAtDepth { place: [x, y], depth })
        };
        Places {
            planes: self.planes.iter().flat_map(|&z| half_space.depths(z)).collect(),
            section: self
                .section
                .as_ref()
                .map(|section| SectionRows { line: section.line, depths: half_space.rows(section.depth, rows) }),
            points: self.points.iter().flat_map(point).collect(),
            volume: self.volume.map(|volume| VolumePlanes {
                depths: half_space.rows(volume.depth, volume.rows),
                points: [volume.points; 2],
            }),
        }
    }
}

impl Places {
    /// The field on the planes, at the samples of its grid; each is computed when its turn comes.
    pub fn on_planes(&self, field: &StressField) -> impl Iterator<Item = Plane> {
        self.planes.iter().map(|&depth| field.plane(depth, field.grid().points()))
    }

    /// The field on the section.
    pub fn on_section(&self, field: &StressField) -> Option<Section> {
        self.section.as_ref().map(|SectionRows { line, depths }| field.section(line, depths))
    }

    /// The field at the points.
    pub fn at_points(&self, field: &StressField) -> Vec<State> {
        self.points.iter().map(|&PlaceAtDepth { place, depth }| field.points(depth, &[place])[0]).collect()
    }
}
