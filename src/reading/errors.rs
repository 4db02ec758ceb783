//! Estimated discretisation errors of a reading.

/// Estimated errors of the scalars of a load step, each in the unit of its quantity; `None` where there is no
/// coarser grid to compare with or no such quantity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Errors {
    /// Of the mean pressure.
    pub mean_pressure: Option<f64>,
    /// Of the penetration.
    pub penetration: Option<f64>,
    /// Of the fraction in contact.
    pub contact_fraction: Option<f64>,
    /// Of the largest pressure.
    pub max_pressure: Option<f64>,
}

/// Estimated errors of the scalars of a level.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LevelErrors {
    /// Of the force on one indenter.
    pub load: Option<f64>,
    /// Of the share of the whole load.
    pub load_share: Option<f64>,
    /// Of the peak pressure.
    pub max_pressure: Option<f64>,
    /// Of the contact area of one indenter.
    pub contact_area: Option<f64>,
    /// Of √(area/π).
    pub contact_radius: Option<f64>,
    /// Of a ring's inner radius.
    pub radius_inner: Option<f64>,
    /// Of a ring's outer radius.
    pub radius_outer: Option<f64>,
    /// Of the smallest boundary radius.
    pub radius_min: Option<f64>,
    /// Of the largest boundary radius.
    pub radius_max: Option<f64>,
    /// Of (largest − smallest)/largest.
    pub asymmetry: Option<f64>,
}
