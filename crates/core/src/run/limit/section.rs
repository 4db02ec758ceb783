//! The section of the stresses through a place that fails.

use super::LimitStep;
use crate::body::HalfSpace;
use crate::run::Run;
use crate::run::places::{SECTION, section_depths};
use crate::stress::{StressFields, SurfaceLine, VerticalSection};
use std::f64::consts::PI;

/// Half the length of the section, in radii of a contact.
const HALF_LENGTH: f64 = 3.0;
/// Least depth of the section, in radii of a contact.
const LEAST_DEPTH: f64 = 2.0;
/// Largest depth of a coating, in radii of a contact, that the section reaches through.
const DEEPEST_COATING: f64 = 8.0;

impl LimitStep {
    /// Sections of the stresses in each body at the limit, through the place that fails: along the direction of sliding, or along x
    /// without friction, a contact's width to both sides and deep enough to show the place; through the middle of the window where an
    /// isolated contact fails outside of it. `None` where the limit has no place.
    pub fn sections(&self, run: &Run) -> Option<Vec<VerticalSection>> {
        let Self { limit, step, .. } = self;
        let [x, y, z] = limit.position()?;
        // The window of the step may be larger than that of the case.
        let (bodies, cell) = (run.problem.bodies(), step.grid().cell());
        let direction = run.problem.direction();
        // Stresses around the window of an isolated contact have no section: that through its middle shows the contact.
        let [x, y] = if cell.contains([x, y]) { [x, y] } else { cell.point([0.5; 2]) };
        let reading = step.reading();
        let radius = (reading.contact_area / (PI * reading.contact_spots.max(1) as f64)).sqrt();
        let reach = (HALF_LENGTH * radius).min(0.5 * cell.reduced().longer_side());
        let coating = bodies.each().flat_map(HalfSpace::interface_depths).fold(0.0, f64::max);
        let [_, points] = SECTION;
        let span = cell.clipped([x, y], direction, [-reach, reach]);
        let line = SurfaceLine { origin: [x, y], direction, span, points };
        let depth = (LEAST_DEPTH * radius).max(1.5 * z).max(1.25 * coating.min(DEEPEST_COATING * radius));
        let mean = run.mean_stress().unwrap_or_default();
        let fields = StressFields::new(step.finest(), mean);
        Some(fields.each().map(|field| field.section(&line, &section_depths(field.half_space(), depth))).collect())
    }
}
