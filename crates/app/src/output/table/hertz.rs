//! Hertz beside an isolated contact: what the layers change.

use super::change;
use crate::output::number::number;
use percoat_case::case::Case;
use percoat_case::units::Units;
use percoat_core::counterbody::Shape;
use percoat_core::reading::{PlasticReading, Reading};
use percoat_core::run::StepRecord;
use std::f64::consts::PI;

/// The contact of a ball with bare bodies.
struct Hertz {
    radius: f64,
    peak: f64,
    approach: f64,
}

impl Hertz {
    /// The contact under a `force` of a ball of this radius on bodies with the contact modulus E*.
    fn new(force: f64, ball: f64, modulus: f64) -> Self {
        let radius = (0.75 * force * ball / modulus).cbrt();
        Self { radius, peak: 1.5 * force / (PI * radius * radius), approach: radius * radius / ball }
    }
}

/// Peak pressure, contact radius and penetration by Hertz of the ball on the bare substrates, under the force of the last converged
/// step with contact, and the relative differences of that step from them, in two lines; `None` unless the contact is isolated and that
/// of one ball, where no substrate is elastic, and where a surface is pressed in.
pub fn hertz(case: &Case, steps: &[StepRecord], units: &Units) -> Option<[String; 2]> {
    let problem = case.problem();
    let level = problem.lone_indenter()?;
    let (Shape::Paraboloid { radius: ball } | Shape::Sphere { radius: ball }) = level.shape() else { return None };
    let step = steps.iter().rev().find(|step| step.reading.touches() && step.converged())?;
    if step.plastic.as_ref().is_some_and(PlasticReading::is_pressed_in) {
        return None;
    }
    let Reading { force, penetration, .. } = step.reading;
    let hertz = Hertz::new(force, ball, problem.bodies().substrate_modulus()?);
    let [load, peak, radius, approach] = [
        units.force().with_unit(force, number),
        units.pressure().with_unit(hertz.peak, number),
        units.length().with_unit(hertz.radius, number),
        units.length().with_unit(hertz.approach, number),
    ];
    let level = step.reading.levels.first()?;
    let changes: Vec<String> = [
        change("the peak pressure", level.finite_peak(), Some(hertz.peak)),
        change("the contact radius", level.contact_radius, Some(hertz.radius)),
        change("the penetration", Some(penetration), Some(hertz.approach)),
    ]
    .into_iter()
    .flatten()
    .collect();
    let what = if problem.bodies().is_bare() { "here they differ in" } else { "the layers change" };
    Some([
        format!(
            "Hertz, bare substrates, {load}: peak pressure {peak}, contact radius {radius}, penetration {approach}"
        ),
        format!("{what} {}", changes.join(", ")),
    ])
}
