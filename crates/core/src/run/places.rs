//! The places at which a run computes stresses: planes, a section, points, a volume.

use crate::body::{Depth, HalfSpace, MeanStress};
use crate::stress::SurfaceLine;
use serde::Serialize;

/// Number of intervals in depth and of points along the line of a section.
pub const SECTION: [usize; 2] = [200, 401];
/// Number of further intervals in a thin coating and a little below it.
const COATING: usize = 60;
/// Number of rows of a section, interfaces left out, at most.
pub const MOST_ROWS: usize = SECTION[0] + COATING;
/// Part of the depth of a section below which a coating is thin.
pub const THIN: f64 = 1.0 / 12.0;
/// Depth down to which a thin coating is shown on its own, in thicknesses of all layers.
pub const BELOW_COATING: f64 = 2.5;

/// A request for stresses and strains.
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
    /// Whether strains are computed beside stresses.
    pub strain: bool,
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
        section_depths(half_space, self.depth)
    }
}

/// Depths of the rows of a section on a half-space, down to `depth`, a length, or to a rigid base above it: equal intervals, and more of
/// them in a coating that is thin, or that would be in a section twice as high. Both sides of each interface are among them.
pub fn section_depths(half_space: &HalfSpace, depth: f64) -> Vec<Depth> {
    let mut rows = half_space.rows(depth, SECTION[0]);
    let coating = half_space.interface_depths().last().copied().unwrap_or(f64::INFINITY);
    if coating < 2.0 * THIN * depth {
        rows.extend(half_space.rows(BELOW_COATING * coating, COATING));
        rows.sort_by(|a, b| a.z.total_cmp(&b.z).then(a.material.cmp(&b.material)));
        rows.dedup_by(|a, b| a.material == b.material && (a.z - b.z).abs() < 1e-9 * coating);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, Layer, Material};

    #[test]
    fn a_thin_coating_has_rows_of_its_own_and_both_sides_of_each_interface_once() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        let rows = |thickness: f64| {
            let layer = Layer::new(material, thickness, Interface::Bonded).unwrap();
            let rows = section_depths(&HalfSpace::new(vec![layer], material), 60.0);
            let sides: Vec<usize> = rows.iter().filter(|row| row.z == thickness).map(|row| row.material).collect();
            assert_eq!(sides, [1, 2], "{thickness}");
            assert!(rows.windows(2).all(|pair| pair[0].z < pair[1].z || pair[0].material < pair[1].material));
            assert!(rows.len() <= MOST_ROWS + 4, "{}", rows.len());
            rows.iter().filter(|row| row.material == 1).count()
        };
        // 60/2.5 intervals, and those of 0.3 of the whole.
        assert!(rows(3.0) >= 24 && rows(0.1) >= 24, "{} {}", rows(3.0), rows(0.1));
        assert_eq!(rows(30.0), 101);
    }
}
