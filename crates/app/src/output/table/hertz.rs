//! Hertz beside an isolated contact: what the layers change.

use super::change;
use crate::output::number::number;
use percoat_case::case::Case;
use percoat_case::units::Units;
use percoat_core::counterbody::Shape;
use percoat_core::reading::{PlasticReading, Reading};
use percoat_core::run::StepRecord;
use std::f64::consts::PI;

/// Contact radius and penetration of the only indenter on the bare substrates, and under a ball the peak pressure, with the force of the last
/// converged step with contact; and the relative differences of that step from them, in two lines. `None` unless the contact is isolated and
/// that of one indenter, where no substrate is elastic, where a surface is pressed in, and of surfaces that adhere.
pub fn hertz(case: &Case, steps: &[StepRecord], units: &Units) -> Option<[String; 2]> {
    let problem = case.problem();
    if problem.adhesion().is_some() {
        return None;
    }
    let shape = problem.lone_indenter()?.shape();
    let step = steps.iter().rev().find(|step| step.reading.touches() && step.converged())?;
    if step.plastic.as_ref().is_some_and(PlasticReading::is_pressed_in) {
        return None;
    }
    let Reading { force, penetration, .. } = step.reading;
    let radius = shape.radius_under(force / problem.bodies().substrate_modulus()?);
    let [approach, _] = shape.on_half_space(radius);
    let is_ball = matches!(shape, Shape::Paraboloid { .. } | Shape::Sphere { .. });
    let peak = is_ball.then(|| 1.5 * force / (PI * radius * radius));
    let load = units.force().with_unit(force, number);
    let length = |x: f64| units.length().with_unit(x, number);
    let told = peak.map(|peak| format!("peak pressure {}, ", units.pressure().with_unit(peak, number)));
    let level = step.reading.levels.first()?;
    let changes: Vec<String> = [
        peak.and_then(|peak| change("the peak pressure", level.finite_peak(), Some(peak))),
        change("the contact radius", level.contact_radius, Some(radius)),
        change("the penetration", Some(penetration), Some(approach)),
    ]
    .into_iter()
    .flatten()
    .collect();
    let what = if problem.bodies().is_bare() { "here they differ in" } else { "the layers change" };
    Some([
        format!(
            "{}, bare substrates, {load}: {}contact radius {}, penetration {}",
            if is_ball { "Hertz" } else { "Sneddon" },
            told.unwrap_or_default(),
            length(radius),
            length(approach)
        ),
        format!("{what} {}", changes.join(", ")),
    ])
}
