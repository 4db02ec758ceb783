//! A measured curve of drawing off surfaces that adhere, with its fit.

use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_core::identification::{FromRetraction, Retraction};
use percoat_core::reading::READING;
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Ink, Style};
use percoat_draw::number::short;

/// The picture: measured and fitted forces over the penetration, and their differences, with the band of two standard errors of the fit by those of
/// the parameters alone.
pub fn retraction(title: &str, units: &Units, measured: &Retraction, found: &FromRetraction) -> Canvas {
    let places = measured.penetrations();
    let curve = |label: &str, of: &dyn Fn(usize) -> f64, error: &dyn Fn(usize) -> f64, style, colour| Curve {
        label: label.to_owned(),
        points: places.iter().enumerate().map(|(i, place)| [*place, of(i)]).collect(),
        errors: (0..places.len()).map(error).collect(),
        style,
        colour: Ink::Number(colour),
    };
    let chart = |title: &str, below: &dyn Fn(usize) -> f64| Chart {
        title: title.to_owned(),
        x: Axis::linear(units.label(&READING.penetration.named)),
        y: Axis::linear(units.label(&READING.force.named)),
        curves: vec![
            curve("fit ± 2 standard errors", &|i| found.fitted[i] - below(i), &|i| 2.0 * found.band[i], Style::Line, 2),
            curve("measured", &|i| measured.forces()[i] - below(i), &|_| f64::NAN, Style::Markers, 1),
        ],
    };
    let charts = [chart("", &|_| 0.0), chart("measured − fit", &|i| found.fitted[i])];
    let value = |estimate: &percoat_core::identification::Estimate| {
        let [value, error] = [estimate.value, estimate.error].map(short);
        format!("{}\u{a0}=\u{a0}{value}\u{a0}±\u{a0}{error}", estimate.parameter.name)
    };
    let values: Vec<String> = found.estimates.iter().map(value).collect();
    let title = if title.is_empty() { String::new() } else { format!("{title}. ") };
    let caption = format!(
        "{title}{}. Least squares of {} forces; residual {} (root mean square).",
        values.join(", "),
        found.fitted.len(),
        units.force().with_unit(found.rms, short)
    );
    plots(&caption, &charts)
}
