//! What happens to a body while it lasts: something fails and what lies above it comes off.

use crate::numeric::serialised;
use crate::reading::FatiguePart;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Kind of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum EventKind {
    /// A material fails below the surface: what lies above that depth comes off.
    Detachment,
    /// A material fails at the surface: slices come off one after another from here on.
    SurfaceWear,
    /// An interface fails: the layers above it come off.
    Delamination,
    /// Sliding, or wear of the surface by fatigue, has taken the rest of a layer.
    WornThrough,
}

impl fmt::Display for EventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Detachment => "detachment",
            Self::SurfaceWear => "wear of the surface by fatigue",
            Self::Delamination => "delamination",
            Self::WornThrough => "worn through",
        })
    }
}

/// An event.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Passes until then.
    pub passes: f64,
    /// What happens.
    pub what: EventKind,
    /// The material or the interface that fails, by its number in the original body.
    #[serde(flatten)]
    pub part: FatiguePart,
    /// Depth below the surface down to which it comes off, a length: z* where it fails, or what fails at once below that.
    pub depth: f64,
    /// Thickness of all layers together afterwards, a length.
    pub thickness: f64,
    /// Height of what has come off and was worn off until then, a length.
    pub removed: f64,
}

/// What is left and worn after some passes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// Passes.
    pub passes: f64,
    /// Thickness of all layers together, a length.
    pub thickness: f64,
    /// Height of what has come off and was worn off the body, a length: the mean of what was worn off on a lattice, the largest of it under
    /// an isolated contact.
    pub removed: f64,
    /// Mean depth worn off the body by sliding, a length.
    pub body: f64,
    /// Mean depth worn off the counterbody by sliding, a length.
    pub counterbody: f64,
    /// Largest depth worn off the body, a length.
    pub body_depth: f64,
    /// Largest depth worn off the counterbody, a length.
    pub counterbody_depth: f64,
    /// Largest contact pressure, in the unit of Young's modulus; infinite under a tip. It is that of the contact before where the surfaces
    /// have none that is known.
    #[serde(deserialize_with = "serialised::infinite")]
    pub max_pressure: f64,
    /// Area of contact, a length squared.
    pub contact_area: f64,
    /// Passes until the next failure of the materials as they are damaged by then; infinite where there is none.
    #[serde(deserialize_with = "serialised::infinite")]
    pub next: f64,
}
