//! The largest measures of fatigue of a body, with their places and errors: of each material, and of each interface.

use crate::stress::range_plane::RangePlane;
use crate::stress::sliding_path::SlidingPath;

/// A largest measure and its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPeak {
    /// The value: a pressure, or a utilisation.
    pub value: f64,
    /// Estimated error of the value; `None` without a coarser grid.
    pub error: Option<f64>,
    /// Place x, y, z; lengths.
    pub position: [f64; 3],
}

/// Largest measures in a material.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MaterialPeaks {
    /// Range of τ₁, of a material with fatigue.
    pub range: Option<PathPeak>,
    /// Utilisation of Crossland's criterion, of a material with endurance limits.
    pub crossland: Option<PathPeak>,
    /// Utilisation of Dang Van's criterion, of a material with endurance limits.
    pub dang_van: Option<PathPeak>,
}

/// Largest measures of fatigue of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPeaks {
    pub(crate) path: SlidingPath,
    /// Peaks of each material, from the surface down.
    pub materials: Vec<MaterialPeaks>,
    /// Range of the shear traction of each interface with fatigue, from the surface down.
    pub interfaces: Vec<Option<PathPeak>>,
    /// Planes of the materials with fatigue, all with the same lines.
    pub planes: Vec<RangePlane>,
}

impl PathPeaks {
    /// Every peak.
    pub fn each(&mut self) -> impl Iterator<Item = &mut PathPeak> {
        self.materials.iter_mut().flat_map(MaterialPeaks::each).chain(self.interfaces.iter_mut().flatten())
    }

    /// Every peak of the material at the surface.
    pub fn in_surface(&mut self) -> impl Iterator<Item = &mut PathPeak> {
        self.materials.iter_mut().take(1).flat_map(MaterialPeaks::each)
    }
}

impl MaterialPeaks {
    fn each(&mut self) -> impl Iterator<Item = &mut PathPeak> {
        [&mut self.range, &mut self.crossland, &mut self.dang_van].into_iter().flatten()
    }
}
