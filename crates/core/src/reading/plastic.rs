//! The permanent indentation under a hardness: the area at the hardness, the depths and their volume.
//!
//! Where p = H the gap g is below zero, and −g is the depth by which the surface is pressed in, a length. At a distance d
//! inside the border of this area −g rises like d^{3/2}, outside H − p rises like √d: with H − p in the place of the pressure
//! and −g in that of the gap the outside is a contact, whose border is read between the samples in the same way.
//!
//! The model has no pile-up: what is pressed in does not rise beside it, and its volume is lost to it. Hardness does not depend on the
//! depth; down to about a tenth of its thickness a coating bears its hardness alone, deeper the substrate yields too.

use super::{area, estimate};
use crate::notation::number;
use crate::numeric::{serialised, sums};
use crate::quantity::quantities;
use crate::spectral::{Contact, Step};
use serde::{Deserialize, Serialize};
use std::fmt;

quantities! {
    /// Permanent indentation of the softer surface under its hardness. Errors are those of the grid; `None` without a coarser one.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct PlasticReading {
        /// Hardness H of the softer surface, a pressure.
        pub hardness: f64 = Pressure "hardness" "H" error hardness_error,
        /// Penetration of which H is the [composite hardness](crate::body::CompositeHardness), a length; `None` where H does not depend on it.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub hardness_depth: Option<f64>,
        /// Error of a composite hardness by that of the penetration, a pressure.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub hardness_error: Option<f64>,
        /// Area where the pressure is H in this step, a length squared.
        #[serde(deserialize_with = "serialised::number")]
        pub area: f64 = Area "area at the hardness" "A" error area_error,
        /// Error of the area.
        pub area_error: Option<f64>,
        /// Largest depth pressed in by this step and those before it, a length.
        #[serde(deserialize_with = "serialised::number")]
        pub depth: f64 = Length "largest depth pressed in" "u" short "largest depth" error depth_error,
        /// Error of the depth.
        pub depth_error: Option<f64>,
        /// Volume pressed in by this step and those before it, in the cell, a cubed length.
        #[serde(deserialize_with = "serialised::number")]
        pub volume: f64 = Volume "volume pressed in" "V" error volume_error,
        /// Error of the volume.
        pub volume_error: Option<f64>,
        /// Penetration at which contact begins when it is loaded again, a length: the permanent depth of an indentation curve.
        #[serde(deserialize_with = "serialised::number")]
        pub permanent_depth: f64 = Length "permanent depth" "u" error permanent_depth_error,
        /// Error of the permanent depth.
        pub permanent_depth_error: Option<f64>,
    }
    table PlasticQuantities as PLASTIC;
}

/// Area, depth, volume and permanent depth on one grid, and the uncertainty of the area.
struct OnGrid {
    values: [f64; 4],
    uncertainty: f64,
}

impl OnGrid {
    /// `None` without hardness.
    fn of(contact: &Contact) -> Option<Self> {
        let (grid, hardness, depths) = (contact.grid(), contact.hardness(), contact.indentation()?);
        let (p, g, f) = (contact.pressures(), contact.gaps(), contact.surface().gaps());
        let is_full = |i: usize| p[i] >= hardness;
        let (mut area, mut uncertainty) = (0.0, 0.0);
        if (0..p.len()).any(is_full) {
            let below: Vec<f64> = p.iter().map(|p| hardness - p).collect();
            let pressed: Vec<f64> = (0..p.len()).map(|i| if is_full(i) { (-g[i]).max(0.0) } else { 0.0 }).collect();
            let elastic = area::contact_fraction(grid, (&below, f64::INFINITY), &pressed, |_| false);
            area = (1.0 - elastic.value) * grid.cell().area();
            uncertainty = elastic.uncertainty * grid.cell().area();
        }
        // The initial gap has the depths of earlier loads.
        let now = |i: usize| if is_full(i) { (-g[i]).max(0.0) } else { 0.0 };
        let depth = -sums::least(p.len(), |i| -depths[i]);
        let permanent = sums::least(p.len(), |i| f[i] + now(i));
        let volume = sums::of(p.len(), |i| [depths[i]])[0] * grid.sample_area();
        Some(Self { values: [area, depth, volume, permanent], uncertainty })
    }
}

impl PlasticReading {
    /// Reading of a step; `None` without hardness.
    pub fn of(step: &Step) -> Option<Self> {
        let finest = OnGrid::of(step.finest())?;
        let coarser: Vec<OnGrid> = step.coarser().iter().filter_map(OnGrid::of).collect();
        let error = |index: usize, law: f64| {
            let of_coarser = coarser.iter().map(|coarse| Some(coarse.values[index]));
            (!coarser.is_empty()).then(|| estimate::of_area(law, finest.values[index], of_coarser))
        };
        let [area, depth, volume, permanent_depth] = finest.values;
        Some(Self {
            hardness: step.finest().hardness(),
            hardness_depth: step.problem().composite_hardness().map(|_| step.penetration()),
            hardness_error: None,
            area,
            area_error: error(0, finest.uncertainty),
            depth,
            depth_error: error(1, 0.0),
            volume,
            volume_error: error(2, 0.0),
            permanent_depth,
            permanent_depth_error: error(3, 0.0).map(|error| error + step.apex_error()),
        })
    }

    /// The reading with the error of a composite hardness by the `error` of the penetration, a length.
    pub(crate) fn with_error_of_depth(self, step: &Step, error: Option<f64>) -> Self {
        let composite = step.problem().composite_hardness().zip(error);
        let hardness_error = composite.map(|(composite, error)| composite.error(step.penetration(), error));
        Self { hardness_error, ..self }
    }

    /// Whether anything is pressed in.
    pub fn is_pressed_in(&self) -> bool {
        self.depth > 0.0
    }
}

impl fmt::Display for PlasticReading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.is_pressed_in() {
            return write!(f, "nothing is pressed in, hardness {}", number(self.hardness));
        }
        write!(
            f,
            "hardness {} on the area {}, pressed in by up to {}, permanent depth {}",
            number(self.hardness),
            number(self.area),
            number(self.depth),
            number(self.permanent_depth)
        )
    }
}
