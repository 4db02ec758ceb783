//! Events of a body while it lasts: something fails and what lies above it comes off.

use crate::numeric::serialised;
use crate::reading::FatiguePart;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Kind of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// A material fails below the surface: what lies above that depth comes off.
    Detachment,
    /// A material fails at the surface: slices come off one after another from here on.
    SurfaceWear,
    /// An interface fails: the layers above it come off.
    Delamination,
    /// Sliding, or wear of the surface by fatigue, has taken the rest of a layer.
    WornThrough,
    /// A material or an interface fails where points stay in place: a crack begins, and nothing comes off.
    Crack,
}

impl fmt::Display for EventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Detachment => "detachment",
            Self::SurfaceWear => "wear of the surface by fatigue",
            Self::Delamination => "delamination",
            Self::WornThrough => "worn through",
            Self::Crack => "crack",
        })
    }
}

/// An event.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Passes until the event.
    pub passes: f64,
    /// Distance that the counterbody has slid until the event, a length; `None` where it is not known.
    pub distance: Option<f64>,
    /// Kind of the event.
    pub what: EventKind,
    /// The material or the interface that fails, by its number in the original body.
    #[serde(flatten)]
    pub part: FatiguePart,
    /// Depth below the surface down to which it comes off, a length: z* where it fails, or what fails at once below that. Of a layer that is
    /// worn through its whole thickness.
    pub depth: f64,
    /// Thickness of all layers together afterwards, a length.
    pub thickness: f64,
    /// Height of what has come off and was worn off until the event, a length.
    pub removed: f64,
}

impl Course {
    /// Whether a groove is deeper than the layers that are left, of which sliding on a lattice takes its mean depth. Those under an
    /// isolated contact are counted where its groove is deepest.
    pub fn is_grooved(&self) -> bool {
        self.thickness > 0.0 && self.body.is_some_and(|mean| self.body_depth > mean + self.thickness)
    }
}

/// Wear scar of a surface of an isolated contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Scar {
    /// Diameter of a circle with its area, a length: that of the samples that are worn, or of the ellipse around them where points stay in place and
    /// the middle may stick.
    pub diameter: f64,
    /// Largest depth, a length.
    pub depth: f64,
    /// Volume, a cubed length.
    pub volume: f64,
}

/// A row of the course: what is left and worn after some passes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// Passes.
    pub passes: f64,
    /// Distance that the counterbody has slid, a length; `None` where it is not known.
    pub distance: Option<f64>,
    /// Thickness of all layers together, a length: under an isolated contact where its groove is deepest.
    pub thickness: f64,
    /// Height of what has come off and was worn off the body, a length: the mean of what sliding has worn off on a lattice, the largest of it
    /// under an isolated contact and where points stay in place.
    pub removed: f64,
    /// Mean depth worn off the body by sliding, a length; `None` under an isolated contact, which has no area to take it over.
    pub body: Option<f64>,
    /// Mean depth worn off the counterbody by sliding, a length; `None` of an isolated contact.
    pub counterbody: Option<f64>,
    /// Largest depth worn off the body, a length.
    pub body_depth: f64,
    /// Largest depth worn off the counterbody, a length.
    pub counterbody_depth: f64,
    /// Cross-section of the groove that an isolated contact has worn in the body, a length squared; `None` without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub groove: Option<f64>,
    /// Scar of the counterbody of an isolated contact that wears; `None` without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scar: Option<Scar>,
    /// Scar of the body under an isolated contact whose points stay in place and wear; `None` without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body_scar: Option<Scar>,
    /// Volume worn off that counterbody over force and distance, one over a pressure; `None` before it has slid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub specific_rate: Option<f64>,
    /// Largest contact pressure, in the unit of Young's modulus; infinite under a tip. It is that of the contact before where the surfaces
    /// have none that is known.
    #[serde(deserialize_with = "serialised::infinite")]
    pub max_pressure: f64,
    /// Half of the rise and fall of the largest pressure while a groove takes in a row of samples, over which it is the mean; `None` without
    /// a groove in a body that tires.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_pressure_error: Option<f64>,
    /// Area of contact, a length squared.
    pub contact_area: f64,
    /// Passes until the next failure of the materials as they are damaged by then; infinite where there is none.
    #[serde(deserialize_with = "serialised::infinite")]
    pub next: f64,
}
