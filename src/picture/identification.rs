//! A measured indentation curve with its fit.

use super::axis::Axis;
use super::canvas::Canvas;
use super::chart::{Chart, plots};
use super::curve::{Curve, Ink, Style};
use super::number::short;
use crate::identification::{Identification, Measurement};
use crate::units::Units;

/// The picture: measured and fitted penetrations over the force, and their differences with the band of two standard errors of the fit, by
/// those of the parameters alone: measured points scatter by their own deviations besides.
pub fn identification(title: &str, units: &Units, measured: &Measurement, found: &Identification) -> Canvas {
    let mut order: Vec<usize> = (0..measured.forces().len()).collect();
    order.sort_by(|&a, &b| measured.forces()[a].total_cmp(&measured.forces()[b]));
    let points = |of: &dyn Fn(usize) -> f64| order.iter().map(|&i| [measured.forces()[i], of(i)]).collect();
    let curve = |label: &str, of: &dyn Fn(usize) -> f64, style, colour| Curve {
        label: label.to_owned(),
        points: points(of),
        errors: Vec::new(),
        style,
        colour: Ink::Number(colour),
    };
    let difference = |i: usize| measured.penetrations()[i] - found.fitted[i];
    let force = || Axis::linear(units.load_of(""));
    let curves = Chart {
        title: String::new(),
        x: force(),
        y: Axis::linear(units.length_of("penetration", "δ")),
        curves: vec![
            curve("measured", &|i| measured.penetrations()[i], Style::Markers, 1),
            curve("fit", &|i| found.fitted[i], Style::Line, 2),
        ],
    };
    let differences = Chart {
        title: String::new(),
        x: force(),
        y: Axis::linear(units.length_of("measured − fit", "")),
        curves: vec![
            curve("measured", &difference, Style::Markers, 1),
            curve("fit ± 2 standard errors", &|i| 2.0 * found.band[i], Style::Line, 2),
            curve("", &|i| -2.0 * found.band[i], Style::Line, 2),
        ],
    };
    let values: Vec<String> = found
        .estimates
        .iter()
        .map(|own| format!("{}\u{a0}=\u{a0}{}\u{a0}±\u{a0}{}", own.parameter.name, short(own.value), short(own.error)))
        .collect();
    let title = if title.is_empty() { String::new() } else { format!("{title}. ") };
    let caption = format!(
        "{title}{}. Least squares of {} points; residual {} (root mean square).",
        values.join(", "),
        found.fitted.len(),
        units.length().with_unit(found.rms, short)
    );
    plots(&caption, &[curves, differences])
}
