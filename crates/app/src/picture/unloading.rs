//! The stiffness of unloadings over the contact radius, with that of the layered body found and of bare ones.

use crate::picture::labels::Labels;
use percoat_case::case::Case;
use percoat_core::identification::{FromUnloading, Punch, Unloading};
use percoat_core::quantity::Kind;
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Ink, Style};
use percoat_draw::number::short;

/// Points of a curve.
const POINTS: u32 = 60;
/// Radii of the curves over the smallest and the largest measured one.
const BEYOND: [f64; 2] = [0.6, 1.4];

/// The picture: stiffnesses measured by unloadings without the frame, with two standard errors, over the contact radius; the flat punch on the layered
/// body of the case, which has the values found, and on its surface and its substrate alone, dashed. β is the factor of the stiffness.
pub fn unloading(best: &Case, unloadings: &[Unloading], found: &FromUnloading, beta: f64) -> Canvas {
    let (units, problem) = (best.units(), best.problem());
    let bodies = problem.bodies();
    let [least, most] = [found.radii[0] * BEYOND[0], found.radii[1] * BEYOND[1]];
    let radii: Vec<f64> = (0..POINTS).map(|k| least + (most - least) * f64::from(k) / f64::from(POINTS - 1)).collect();
    let line = |label: &str, of: &dyn Fn(f64) -> f64, style, colour| Curve {
        label: label.to_owned(),
        points: radii.iter().map(|&a| [a, beta * of(a)]).collect(),
        errors: Vec::new(),
        style,
        colour: Ink::Number(colour),
    };
    let mut curves = vec![
        line("layered", &|a| Punch::new(bodies, a).stiffness, Style::Line, 2),
        line("surface alone", &|a| 2.0 * bodies.contact_modulus() * a, Style::Dashed, 3),
    ];
    curves.extend(
        bodies.substrate_modulus().map(|modulus| line("substrate alone", &|a| 2.0 * modulus * a, Style::Dashed, 4)),
    );
    let pairs = || unloadings.iter().zip(&found.contacts);
    curves.push(Curve {
        label: "measured".to_owned(),
        points: pairs().map(|(_, contact)| [contact.radius, contact.measured_stiffness]).collect(),
        errors: pairs()
            .map(|(measured, contact)| {
                2.0 * measured.stiffness_error * (contact.measured_stiffness / measured.stiffness).powi(2)
            })
            .collect(),
        style: Style::Markers,
        colour: Ink::Number(1),
    });
    let stiffness = units.unit(Kind::Stiffness).prefixed(1.0);
    let chart = Chart {
        title: String::new(),
        x: Axis::linear(units.length_of("contact radius", "a")),
        y: Axis::linear(stiffness.headed("stiffness of unloading S")),
        curves,
    };
    let value = |estimate: &percoat_core::identification::Estimate| {
        format!(
            "{}\u{a0}=\u{a0}{}\u{a0}±\u{a0}{}",
            estimate.parameter.name,
            short(estimate.value),
            short(estimate.error)
        )
    };
    let values: Vec<String> = found.estimates.iter().map(value).collect();
    let title = if best.title.is_empty() { String::new() } else { format!("{}. ", best.title) };
    plots(&format!("{title}{}. Bars: two standard errors of the unloading.", values.join(", ")), &[chart])
}
