//! A measured indentation curve with its fit.

use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_core::identification::{Identification, Measurement};
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Ink, Style};
use percoat_draw::number::short;

/// The picture: measured and fitted penetrations over the force, and their differences, with the band of two standard errors of the fit, by
/// those of the parameters alone: measured points scatter by their own deviations besides, which are their bars where they are known.
pub fn identification(title: &str, units: &Units, measured: &Measurement, found: &Identification) -> Canvas {
    let mut order: Vec<usize> = (0..measured.forces().len()).collect();
    order.sort_by(|&a, &b| measured.forces()[a].total_cmp(&measured.forces()[b]));
    let curve = |label: &str, of: &dyn Fn(usize) -> f64, error: &dyn Fn(usize) -> f64, style, colour| Curve {
        label: label.to_owned(),
        points: order.iter().map(|&i| [measured.forces()[i], of(i)]).collect(),
        errors: order.iter().map(|&i| error(i)).collect(),
        style,
        colour: Ink::Number(colour),
    };
    // Without deviations all points scatter alike, and by how much is the residual in the caption.
    let deviation = |i: usize| measured.deviations().map_or(f64::NAN, |deviations| deviations[i]);
    let band = |i: usize| 2.0 * found.band[i];
    let force = || Axis::linear(units.load_of(""));
    let chart = |name: &str, symbol: &str, below: &dyn Fn(usize) -> f64| Chart {
        title: String::new(),
        x: force(),
        y: Axis::linear(units.length_of(name, symbol)),
        curves: vec![
            curve("fit ± 2 standard errors", &|i| found.fitted[i] - below(i), &band, Style::Line, 2),
            curve("measured", &|i| measured.penetrations()[i] - below(i), &deviation, Style::Markers, 1),
        ],
    };
    let curves = chart("penetration", "δ", &|_| 0.0);
    let differences = chart("measured − fit", "", &|i| found.fitted[i]);
    let values: Vec<String> = found
        .estimates
        .iter()
        .map(|estimate| {
            format!(
                "{}\u{a0}=\u{a0}{}\u{a0}±\u{a0}{}",
                estimate.parameter.name,
                short(estimate.value),
                short(estimate.error)
            )
        })
        .collect();
    let title = if title.is_empty() { String::new() } else { format!("{title}. ") };
    let caption = format!(
        "{title}{}. Least squares of {} points; residual {} (root mean square).{}",
        values.join(", "),
        found.fitted.len(),
        units.length().with_unit(found.rms, short),
        if measured.deviations().is_some() { " Bars: their standard deviations." } else { "" }
    );
    plots(&caption, &[curves, differences])
}
