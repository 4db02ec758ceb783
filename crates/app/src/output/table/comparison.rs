//! The tables of `percoat compare`.

use super::{Table, percent};
use crate::output::number;
use percoat_case::units::{Prefixed, Units};
use percoat_core::comparison::{Answer, CircleComparison, Comparison, Deviation};
use percoat_core::reading::{LEVEL, READING};

/// Table of both solutions level by level, one block for the spectral one and for each circle.
pub fn readings(comparison: &Comparison, units: &Units) -> Table {
    let spectral = Answer::from(&comparison.spectral.reading);
    let answers = || std::iter::once(&spectral).chain(comparison.circles.iter().map(|circle| &circle.answer));
    let levels = || answers().flat_map(|answer| &answer.levels);
    let penetration = units.length().suited(answers().map(|answer| answer.penetration));
    let load = units.force().suited(levels().map(|level| level.load));
    let pressure = units.pressure().suited(levels().filter_map(|level| level.finite_peak()));
    let radius = units.length().suited(levels().filter_map(|level| level.contact_radius));
    let around = units.length().suited(comparison.circles.iter().flat_map(|circle| circle.radii.iter().copied()));
    let header = [
        "solution".to_owned(),
        "inside".to_owned(),
        penetration.headed(READING.penetration.named.name),
        "level".to_owned(),
        load.headed(LEVEL.load.named.name),
        LEVEL.load_share.named.short.to_owned(),
        pressure.headed(LEVEL.max_pressure.named.name),
        radius.headed(LEVEL.contact_radius.named.name),
        around.headed("circle"),
    ];
    let nowhere = vec![f64::INFINITY; spectral.levels.len()];
    let circles = comparison.circles.iter();
    let blocks = std::iter::once(("spectral", String::new(), &spectral, &nowhere))
        .chain(circles.map(|circle| ("localized", inside(comparison, circle), &circle.answer, &circle.radii)));
    let mut rows = Vec::new();
    for (name, inside, answer, radii) in blocks {
        let mut lead = [name.to_owned(), inside, number(penetration.shown(answer.penetration))];
        for (level, &circle) in answer.levels.iter().zip(radii) {
            let value = |unit: &Prefixed, x: Option<f64>| {
                x.filter(|x| x.is_finite()).map_or("–".to_owned(), |x| number(unit.shown(x)))
            };
            let cells = [
                level.level.to_string(),
                number(load.shown(level.load)),
                percent(level.load_share),
                value(&pressure, level.finite_peak()),
                value(&radius, level.contact_radius.filter(|_| level.load > 0.0))
                    + if level.ring { " (ring)" } else { "" },
                value(&around, Some(circle)),
            ];
            rows.push([&lead[..], &cells[..]].concat());
            lead = [const { String::new() }; 3];
        }
    }
    Table::new(&header, rows, 0).keyed(&[0, 1, 3])
}

/// Number of indenters in a circle, or "alone" without mutual effect.
fn inside(comparison: &Comparison, circle: &CircleComparison) -> String {
    if comparison.task.mutual_effect { circle.indenters.to_string() } else { "alone".to_owned() }
}

/// Table of the differences from the spectral solution for each circle and rule, and of the errors of the meshes.
pub fn differences(comparison: &Comparison) -> Table {
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
    Table::new(&header, rows, 0).keyed(&[0, 1])
}

/// Largest difference of the stresses, in a line; `None` where none are compared.
pub fn stresses(comparison: &Comparison, units: &Units) -> Option<String> {
    let worst = comparison.stresses.iter().max_by(|a, b| a.difference().total_cmp(&b.difference()))?;
    let largest = comparison.stresses.iter().flat_map(|pair| pair.spectral.components()[..6].to_vec());
    let largest = largest.fold(0.0, |most: f64, stress| most.max(stress.abs()));
    Some(format!(
        "stresses at {} points under the highest level agree within {:.2} % of the largest, worst at z = {} in {}",
        comparison.stresses.len(),
        100.0 * worst.difference() / largest,
        units.length().with_unit(worst.depth.z, number),
        comparison.task.problem.half_space().material_id(worst.depth.material)
    ))
}
