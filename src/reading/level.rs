//! What is read of the indenters of one level.

use super::LevelErrors;

/// Scalars of one level. Where a level has several indenters in the cell, loads and areas are means over them, contact,
/// inner and outer radius means by area, the others extremes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LevelReading {
    /// Level, from 1.
    pub level: usize,
    /// Force on one indenter: a pressure times an area.
    pub load: f64,
    /// Share of the whole load that the level carries.
    pub load_share: f64,
    /// Peak pressure, between the samples; in the unit of Young's modulus.
    pub max_pressure: f64,
    /// Whether the peak pressure is infinite, see [`crate::counterbody::Shape::singular_peak`]: `max_pressure` is then
    /// only what the grid resolves of it. Never for a level without load.
    pub singular: bool,
    /// Contact area of one indenter, a length squared.
    pub contact_area: f64,
    /// √(area/π), a length; `None` for merged contacts.
    pub contact_radius: Option<f64>,
    /// Whether the contact of an indenter of this level is open in the middle.
    pub ring: bool,
    /// √(area/π) of a ring's hole, a length. `None` without a hole, for merged contacts and for spots of too few samples
    /// or no smooth boundary.
    pub radius_inner: Option<f64>,
    /// √(area/π) of all inside a ring's outer boundary, a length; see `radius_inner`.
    pub radius_outer: Option<f64>,
    /// Smallest distance of the boundary from the axis, a length; `None` for merged contacts and for spots of too few
    /// samples or no smooth boundary.
    pub radius_min: Option<f64>,
    /// Largest distance of the boundary from the axis, a length; see `radius_min`.
    pub radius_max: Option<f64>,
    /// Centre [x, y] of the pressure from the axis, lengths: Σ p **x**/Σ p. `None` without load and for merged contacts.
    pub centre: Option<[f64; 2]>,
    /// Whether the contact of an indenter of this level touches that of a neighbour, or by the localized method one of
    /// both reaches under the other's surface.
    pub merged: bool,
    /// Samples, or elements, along the contact radius: below [`FEW_SAMPLES`] the radii are rough.
    pub resolution: f64,
    /// What the reading of the boundary says of its own errors.
    pub uncertainty: Uncertainty,
    /// Estimated discretisation errors, where coarser grids tell them.
    pub errors: LevelErrors,
}

/// What the reading of a level's peak and boundaries on one grid says of its own errors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Uncertainty {
    /// Samples between the peak pressure and the edge of contact, at most those along the contact radius.
    pub peak_to_edge: f64,
    /// Of the contact area, a length squared.
    pub area: f64,
    /// Of the contact radius, a length.
    pub radius: Option<f64>,
    /// Of the radius of a ring's hole, a length.
    pub hole: Option<f64>,
    /// Of the distances of the boundary from the axis, a length.
    pub boundary: Option<f64>,
}

/// Fewest samples along a contact radius from which on radii and peak pressures are more than rough.
pub const FEW_SAMPLES: f64 = 10.0;

impl LevelReading {
    /// (largest − smallest)/largest boundary radius.
    pub fn asymmetry(&self) -> Option<f64> {
        self.radius_min.zip(self.radius_max).map(|(least, largest)| (largest - least) / largest)
    }

    /// The peak pressure where it is finite.
    pub fn finite_peak(&self) -> Option<f64> {
        (!self.singular).then_some(self.max_pressure)
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for LevelReading {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut keys = serializer.serialize_struct("level", 17)?;
        keys.serialize_field("level", &self.level)?;
        keys.serialize_field("load", &self.load)?;
        keys.serialize_field("load_share", &self.load_share)?;
        keys.serialize_field("max_pressure", &self.finite_peak())?;
        keys.serialize_field("singular", &self.singular)?;
        keys.serialize_field("contact_area", &self.contact_area)?;
        keys.serialize_field("contact_radius", &self.contact_radius)?;
        keys.serialize_field("ring", &self.ring)?;
        keys.serialize_field("radius_inner", &self.radius_inner)?;
        keys.serialize_field("radius_outer", &self.radius_outer)?;
        keys.serialize_field("radius_min", &self.radius_min)?;
        keys.serialize_field("radius_max", &self.radius_max)?;
        keys.serialize_field("asymmetry", &self.asymmetry())?;
        // Two columns of a table, whether it is known or not.
        keys.serialize_field("centre", &self.centre.map_or([None; 2], |centre| centre.map(Some)))?;
        keys.serialize_field("merged", &self.merged)?;
        keys.serialize_field("resolution", &self.resolution)?;
        keys.serialize_field("errors", &self.errors)?;
        keys.end()
    }
}
