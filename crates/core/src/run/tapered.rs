//! The parts of load and contact of a topography where a window tapers its heights.

use crate::spectral::Contact;
use serde::{Deserialize, Serialize};

/// Parts of load and contact where the [window](crate::counterbody::roughness::Window) of a topography is below 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Tapered {
    /// Part of the load, 0 to 1.
    pub load: f64,
    /// Part of the samples in contact, 0 to 1.
    pub area: f64,
}

impl Tapered {
    /// Parts of a contact; `None` without a window or without contact.
    pub fn of(contact: &Contact) -> Option<Self> {
        let run_out = contact.problem().topography()?.run_out()?;
        let (grid, pressure) = (contact.grid(), contact.pressure());
        let (mut load, mut area, mut all) = (0.0, 0.0, [0.0; 2]);
        for (index, pressure) in pressure.iter().enumerate().filter(|(_, pressure)| **pressure > 0.0) {
            all = [all[0] + pressure, all[1] + 1.0];
            if run_out.is_tapered(grid.fractions(index)) {
                (load, area) = (load + pressure, area + 1.0);
            }
        }
        (all[1] > 0.0).then(|| Self { load: load / all[0], area: area / all[1] })
    }
}
