//! Difference between localized and spectral solution against the number of indenters in the circle.

use super::snapshot::caption;
use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_core::comparison::{CircleComparison, Comparison, Deviation};
use percoat_core::localized::CircleRadius;
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Style};

type Value = fn(&Deviation) -> f64;

/// The quantities that are drawn, with their names.
const QUANTITIES: [(&str, Value); 4] = [
    ("penetration", |deviation| deviation.penetration),
    ("load on one", |deviation| deviation.load),
    ("peak pressure", |deviation| deviation.max_pressure),
    ("contact radius", |deviation| deviation.contact_radius),
];

/// The picture: one panel for each rule of the circle radius; `None` for less than two circles, or where nothing differs, as without
/// contact.
pub fn comparison(title: &str, units: &Units, comparison: &Comparison) -> Option<Canvas> {
    if comparison.circles.len() < 2 || comparison.other_rule.is_empty() {
        return None;
    }
    let [asked, other, _] = comparison.rules();
    let mut panels = [asked, other];
    panels.sort_by_key(|(rule, _)| *rule != CircleRadius::LoadBalanced);
    let differences = panels.iter().flat_map(|(_, circles)| circles.iter()).flat_map(|circle| {
        let of = |deviation: &Deviation| QUANTITIES.map(|(_, value)| value(deviation));
        [of(&circle.difference), of(&circle.mesh_error)].concat()
    });
    let (least, most) = differences
        .filter(|x| x.is_finite() && *x > 0.0)
        .fold((f64::INFINITY, 0.0f64), |(a, b), x| (a.min(x), b.max(x)));
    if most == 0.0 {
        return None;
    }
    let range = [10f64.powf(least.max(1e-6).log10().floor()), 10f64.powf(most.log10().ceil())];
    let chart = |(letter, (rule, circles)): (char, &(CircleRadius, &[CircleComparison]))| Chart {
        title: match rule {
            CircleRadius::LatticeSum => format!("({letter}) lattice sum outside"),
            _ => format!("({letter}) {} radius", rule.name()),
        },
        x: Axis::log("indenters inside the circle"),
        y: Axis::log("largest relative difference").from_to(range[0], range[1]),
        curves: curves(circles),
    };
    let charts: Vec<Chart> = ('a'..).zip(&panels).map(chart).collect();
    let [n1, n2] = comparison.spectral.points;
    let more = [
        units.load_equals(&[comparison.spectral.reading.load(units.quantity())]),
        format!("localized with {} elements across the largest contact", comparison.task.elements),
        format!("spectral on {n1}\u{a0}×\u{a0}{n2} samples"),
    ];
    let what = "Largest difference of any level from the spectral solution. Bars: what half the elements change, a bound of the mesh's \
                own error; open: it exceeds half of the difference.";
    Some(plots(&format!("{} {what}", caption(title, &comparison.task.problem, units, &more)), &charts))
}

fn curves(circles: &[CircleComparison]) -> Vec<Curve> {
    let curve = |(colour, (name, value)): (usize, (&str, Value))| Curve {
        label: name.to_owned(),
        points: circles.iter().map(|circle| [circle.indenters as f64, value(&circle.difference)]).collect(),
        errors: circles.iter().map(|circle| value(&circle.mesh_error)).collect(),
        style: Style::LineMarkers,
        colour: colour.into(),
    };
    (1usize..).zip(QUANTITIES).map(curve).collect()
}
