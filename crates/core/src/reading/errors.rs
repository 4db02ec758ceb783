//! Estimated discretisation errors of a reading.

use serde::{Deserialize, Serialize};

/// Estimated errors of the scalars of a load step, each in the unit of its quantity; `None` where there is no
/// coarser grid to compare with or no such quantity.
///
/// On the way to a solution the nested grids have solved the same load step with a half, a quarter, … of the points.
/// Quantities converge at second order, a cusp of the pressure slower; errors oscillate as the edge of contact moves
/// among the samples, so that two grids can agree by chance. The estimate is therefore 1.5 to 4 times the largest of
///
/// |q(h) − q(2h)|,  |q(h) − q(4h)|/4,  and the error by the law for n samples along a contact radius:
///
/// | quantity | relative |
/// |---|---|
/// | peak pressure | 0.1 n⁻² + n⁻⁴ for profiles rᵏ with k ≥ 2; 0.25 n^{1−k} for the cusps of 1 < k < 2; n samples between the peak and the edge, which under a stiff coating lies in a ridge along it |
/// | load on an indenter, prescribed the penetration | 0.03 n⁻² + 0.3 n⁻⁴ |
/// | share of the load, absolute; load on an indenter, prescribed the mean pressure | 0.002 n⁻² |
/// | penetration | 0.01 n⁻²; 0.05 n⁻² under a topography |
/// | elastic energy | 0.03 n⁻², prescribed the mean pressure, 0.05 n⁻² under a topography; 0.03 n⁻² + 0.3 n⁻⁴, prescribed the penetration |
/// | mean gap of a topography | 0.05 n⁻² of the penetration |
/// | area of a topography corrected by its perimeter | a quarter of the correction |
/// | centre of the pressure | 0.005 n⁻² of the contact radius |
/// | areas, radii, asymmetry, fraction in contact | the uncertainty of the reading of the boundary |
///
/// The fraction in contact of a topography is read between the samples; where its spots are narrower than ten samples on the
/// average, or many and without boundaries of their own, it is that or the count corrected by the perimeter, whichever has the
/// smaller error by these laws.
///
/// The numbers are read off seven hundred random cases solved again with four times the points; that the estimates hold
/// in 95 % of others is shown in `validation/discretisation`. A prescribed quantity has no error; the peak under a tip is
/// infinite and has none either.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Errors {
    /// Error of the mean pressure, in the unit of pressure; `None` for an isolated contact.
    pub mean_pressure: Option<f64>,
    /// Error of the force, a pressure times an area.
    #[serde(default)]
    pub force: Option<f64>,
    /// Error of the penetration, a length.
    pub penetration: Option<f64>,
    /// Error of the area of contact, a length squared.
    #[serde(default)]
    pub contact_area: Option<f64>,
    /// Error of the fraction in contact; `None` for an isolated contact.
    pub contact_fraction: Option<f64>,
    /// Error of the elastic energy, a pressure times a cubed length.
    #[serde(default)]
    pub elastic_energy: Option<f64>,
    /// Error of the largest pressure, in the unit of pressure.
    pub max_pressure: Option<f64>,
}

/// Estimated errors of the scalars of a level.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct LevelErrors {
    /// Error of the force on one indenter, a pressure times an area.
    pub load: Option<f64>,
    /// Error of the share of the whole load.
    pub load_share: Option<f64>,
    /// Error of the peak pressure, in the unit of pressure.
    pub max_pressure: Option<f64>,
    /// Error of the contact area of one indenter, a length squared.
    pub contact_area: Option<f64>,
    /// Error of the contact radius √(area/π), a length.
    pub contact_radius: Option<f64>,
    /// Error of a ring's inner radius, a length.
    pub radius_inner: Option<f64>,
    /// Error of a ring's outer radius, a length.
    pub radius_outer: Option<f64>,
    /// Error of the smallest boundary radius, a length.
    pub radius_min: Option<f64>,
    /// Error of the largest boundary radius, a length.
    pub radius_max: Option<f64>,
    /// Error of the asymmetry (largest − smallest)/largest.
    pub asymmetry: Option<f64>,
    /// Errors of x and y of the pressure's centre, lengths.
    #[serde(default)]
    pub centre: [Option<f64>; 2],
}
