//! Stages of the preparation of the heights of a file before they are pressed, with rms values before and after.

use percoat_core::counterbody::roughness::{MeasuredRms, SurfaceForm};
use serde::Serialize;

/// A treatment of heights.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "stage", rename_all = "snake_case")]
pub enum Treated {
    /// None: as the file has them.
    AsRead,
    /// A form was subtracted.
    WithoutForm {
        /// The form.
        form: SurfaceForm,
        /// Radius of a sphere or cylinder, a length; none where it is flat.
        radius: Option<f64>,
    },
    /// Places without a measurement were filled.
    Filled {
        /// Part of all places, between 0 and 1.
        share: f64,
    },
    /// Short waves were left out.
    Smoothed {
        /// Cut-off λ_s, a length.
        cutoff: f64,
        /// Whether the surface goes on periodically beyond its border.
        is_periodic: bool,
    },
}

/// Heights after a treatment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Stage {
    /// The treatment.
    #[serde(flatten)]
    pub treated: Treated,
    /// Rms height, a length, and rms slope afterwards.
    #[serde(flatten)]
    pub rms: MeasuredRms,
}
