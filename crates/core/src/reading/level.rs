//! Reading of one level: loads, areas, radii and their errors.

use crate::numeric::serialised;
use crate::quantity::quantities;
use serde::{Deserialize, Serialize};

quantities! {
    /// Scalars of one level. Where a level has several indenters in the cell, loads and areas are means over them, contact,
    /// inner and outer radius means by area, the others extremes.
    #[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
    pub struct LevelReading {
        /// Level, from 1.
        pub level: usize,
        /// Force on one indenter: a pressure times an area; with the tension on the samples that face it.
        #[serde(deserialize_with = "serialised::number")]
        pub load: f64 = Force "load on one" "P",
        /// Share of the whole load that the level carries; of surfaces that adhere of the contact load, without tension.
        #[serde(deserialize_with = "serialised::number")]
        pub load_share: f64 = Fraction "share of the load" "P/ΣP" short "share",
        /// Peak pressure, between the samples, in the unit of Young's modulus; infinite under a tip with load, see
        /// [`crate::counterbody::Shape::singular_peak`].
        #[serde(flatten, with = "serialised::max_pressure")]
        pub max_pressure: f64 = Pressure "peak pressure" "p" short "peak",
        /// Largest pressure on the grid where the peak pressure is infinite; `None` where it is finite.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub resolved_peak: Option<f64>,
        /// Contact area of one indenter, a length squared.
        #[serde(deserialize_with = "serialised::number")]
        pub contact_area: f64 = Area "contact area" "A",
        /// √(area/π), a length; `None` for merged contacts.
        pub contact_radius: Option<f64> = Length "contact radius" "a",
        /// Whether the contact of an indenter of this level is open in the middle.
        pub ring: bool,
        /// √(area/π) of a ring's hole, a length. `None` without a hole, for merged contacts and for spots of too few samples
        /// or no smooth boundary.
        pub radius_inner: Option<f64> = Length "inner radius of a ring" "a",
        /// √(area/π) of all inside a ring's outer boundary, a length; see `radius_inner`.
        pub radius_outer: Option<f64> = Length "outer radius of a ring" "a",
        /// Smallest distance of the boundary from the axis, a length; `None` for merged contacts and for spots of too few
        /// samples or no smooth boundary.
        pub radius_min: Option<f64> = Length "smallest boundary radius" "a",
        /// Largest distance of the boundary from the axis, a length; see `radius_min`.
        pub radius_max: Option<f64> = Length "largest boundary radius" "a",
        /// (largest − smallest)/largest boundary radius; see `radius_min`.
        pub asymmetry: Option<f64> = Fraction "asymmetry" "Δa/a",
        /// Centre [x, y] of the pressure from the axis, lengths: Σ p **x**/Σ p. `None` without load and for merged contacts.
        #[serde(with = "serialised::pair")]
        pub centre: Option<[f64; 2]>,
        /// Whether the contact of an indenter of this level touches that of a neighbour, or by the localized method one of
        /// both reaches under the other's surface.
        pub merged: bool,
        /// Samples, or elements, along the contact radius: below [`FEW_SAMPLES`] the radii are rough.
        #[serde(deserialize_with = "serialised::number")]
        pub resolution: f64,
        /// Uncertainties of the reading of the boundary on one grid; not kept in files.
        #[serde(skip)]
        pub uncertainty: Uncertainty,
        /// Estimated discretisation errors, where there are coarser grids.
        pub errors: LevelErrors,
    }
    table LevelQuantities as LEVEL;
    /// Estimated errors of the scalars of a level.
    #[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
    errors LevelErrors {
        /// Errors of x and y of the pressure's centre, lengths.
        #[serde(default)]
        pub centre: [Option<f64>; 2],
    }
}

/// Uncertainties of the reading of a level's peak and boundaries on one grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Uncertainty {
    /// Samples between the peak pressure and the edge of contact, at most those along the contact radius.
    pub peak_to_edge: f64,
    /// Uncertainty of the contact area, a length squared.
    pub area: f64,
    /// Uncertainty of the contact radius, a length.
    pub radius: Option<f64>,
    /// Uncertainty of the radius of a ring's hole, a length.
    pub hole: Option<f64>,
    /// Uncertainty of the distances of the boundary from the axis, a length.
    pub boundary: Option<f64>,
}

/// Fewest samples along a contact radius from which on radii and peak pressures are more than rough.
pub const FEW_SAMPLES: f64 = 10.0;

impl LevelReading {
    /// (largest − smallest)/largest of two radii of a boundary, where both are known.
    pub(crate) fn asymmetry_of(least: Option<f64>, largest: Option<f64>) -> Option<f64> {
        least.zip(largest).map(|(least, largest)| (largest - least) / largest)
    }

    /// The peak pressure, infinite under a tip, and the value `shown` by the grid there; `None` away from tips.
    pub(crate) fn peak_of(shown: f64, is_tip: bool) -> (f64, Option<f64>) {
        if is_tip && !shown.is_nan() { (f64::INFINITY, Some(shown)) } else { (shown, None) }
    }

    /// Whether any of its indenters is in contact.
    pub fn touches(&self) -> bool {
        self.contact_area > 0.0
    }

    /// Whether the peak pressure is infinite.
    pub fn singular(&self) -> bool {
        self.max_pressure.is_infinite()
    }

    /// The peak pressure where it is finite.
    pub fn finite_peak(&self) -> Option<f64> {
        (!self.singular()).then_some(self.max_pressure)
    }

    /// The peak pressure that the grid resolves: always finite.
    pub fn grid_peak(&self) -> f64 {
        self.resolved_peak.unwrap_or(self.max_pressure)
    }
}
