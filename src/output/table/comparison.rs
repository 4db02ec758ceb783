//! The tables of `percoat compare`.

use super::{percent, render};
use crate::comparison::{Answer, CircleComparison, Comparison, Deviation};
use crate::output::number;

/// Both solutions level by level, one block for the spectral one and for each circle.
pub fn readings(comparison: &Comparison) -> String {
    let header = [
        "solution",
        "inside",
        "penetration",
        "level",
        "load on one",
        "share",
        "peak pressure",
        "contact radius",
        "circle",
    ];
    let spectral = Answer::from(&comparison.spectral.reading);
    let nowhere = vec![f64::INFINITY; spectral.levels.len()];
    let circles = comparison.circles.iter();
    let blocks = std::iter::once(("spectral", String::new(), &spectral, &nowhere))
        .chain(circles.map(|circle| ("localized", inside(comparison, circle), &circle.answer, &circle.radii)));
    let mut rows = Vec::new();
    for (name, inside, answer, radii) in blocks {
        let mut lead = [name.to_owned(), inside, number(answer.penetration)];
        for (level, &circle) in answer.levels.iter().zip(radii) {
            let value = |x: f64| if x.is_finite() { number(x) } else { "–".to_owned() };
            let cells = [
                level.level.to_string(),
                number(level.load),
                percent(level.load_share),
                value(level.finite_peak().unwrap_or(f64::NAN)),
                value(level.contact_radius.filter(|_| level.load > 0.0).unwrap_or(f64::NAN))
                    + if level.ring { " (ring)" } else { "" },
                value(circle),
            ];
            rows.push([&lead[..], &cells[..]].concat());
            lead = [const { String::new() }; 3];
        }
    }
    render(&header, &rows, 0)
}

/// How many indenters a circle has, where they act on each other.
fn inside(comparison: &Comparison, circle: &CircleComparison) -> String {
    if comparison.task.mutual_effect { circle.indenters.to_string() } else { "alone".to_owned() }
}

/// Differences from the spectral solution circle by circle, for the rules, and what the meshes contribute.
pub fn differences(comparison: &Comparison) -> String {
    let header =
        ["largest difference", "inside", "penetration", "load on one", "share", "peak pressure", "contact radius"];
    let row = |name: String, inside: String, deviation: &Deviation| {
        let Deviation { penetration, load, load_share, max_pressure, contact_radius } = *deviation;
        let cells = [penetration, load, load_share, max_pressure, contact_radius];
        let percents = cells.map(|x| if x.is_finite() { format!("{:.3} %", 100.0 * x) } else { "–".to_owned() });
        [&[name, inside][..], &percents[..]].concat()
    };
    let mut rows = Vec::new();
    for (rule, circles) in comparison.rules() {
        let mut name = if comparison.task.mutual_effect { rule.name() } else { "no mutual effect" }.to_owned();
        for circle in circles {
            rows.push(row(std::mem::take(&mut name), inside(comparison, circle), &circle.difference));
        }
    }
    if let Some(last) = comparison.circles.last() {
        rows.push(row("half the elements".to_owned(), last.indenters.to_string(), &last.mesh_error));
    }
    rows.push(row("half the grid".to_owned(), String::new(), &comparison.grid_error));
    render(&header, &rows, 0)
}

/// How far the stresses agree, in a line; `None` where none are compared.
pub fn stresses(comparison: &Comparison) -> Option<String> {
    let worst = comparison.stresses.iter().max_by(|a, b| a.difference().total_cmp(&b.difference()))?;
    let largest = comparison.stresses.iter().flat_map(|pair| pair.spectral.components()[..6].to_vec());
    let largest = largest.fold(0.0, |most: f64, stress| most.max(stress.abs()));
    Some(format!(
        "stresses at {} points under the highest level agree within {:.2} % of the largest, worst at z = {} in material {}",
        comparison.stresses.len(),
        100.0 * worst.difference() / largest,
        number(worst.depth.z),
        worst.depth.material
    ))
}
