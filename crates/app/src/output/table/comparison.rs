//! The tables of `percoat compare`.

use super::{Table, percent};
use crate::output::comparison::{CircleRecord, ComparisonFile};
use crate::output::number;
use percoat_case::case::Case;
use percoat_case::units::{Prefixed, Units};
use percoat_core::comparison::Deviation;
use percoat_core::reading::{LEVEL, READING};

/// Table of both solutions level by level, one block for the spectral one and for each circle.
pub fn readings(comparison: &ComparisonFile, units: &Units) -> Table {
    let (spectral, circles) = (&comparison.spectral.reading, &comparison.localized);
    let levels = || spectral.levels.iter().chain(circles.iter().flat_map(|circle| &circle.levels));
    let penetrations = circles.iter().map(|circle| circle.penetration).chain([spectral.penetration]);
    let penetration = units.length().suited(penetrations);
    let load = units.force().suited(levels().map(|level| level.load));
    let pressure = units.pressure().suited(levels().filter_map(|level| level.finite_peak()));
    let radius = units.length().suited(levels().filter_map(|level| level.contact_radius));
    let around = units.length().suited(circles.iter().flat_map(|circle| circle.radius.iter().copied().flatten()));
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
    let nowhere = vec![None; spectral.levels.len()];
    let of_circle = |circle: &CircleRecord| ("localized", inside(comparison, circle));
    let solutions = std::iter::once((("spectral", String::new()), spectral.penetration, &spectral.levels, &nowhere));
    let localized =
        circles.iter().map(|circle| (of_circle(circle), circle.penetration, &circle.levels, &circle.radius));
    let mut rows = Vec::new();
    for ((name, inside), found, levels, radii) in solutions.chain(localized) {
        let mut lead = [name.to_owned(), inside, number(penetration.shown(found))];
        for (level, &circle) in levels.iter().zip(radii) {
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
                value(&around, circle),
            ];
            rows.push([&lead[..], &cells[..]].concat());
            lead = [const { String::new() }; 3];
        }
    }
    Table::new(&header, rows, 0).keyed(&[0, 1, 3])
}

/// Number of indenters in a circle, or "alone" without mutual effect.
fn inside(comparison: &ComparisonFile, circle: &CircleRecord) -> String {
    if comparison.mutual_effect { circle.indenters.to_string() } else { "alone".to_owned() }
}

/// Table of the differences from the spectral solution for each circle and rule, and of the errors of the meshes.
pub fn differences(comparison: &ComparisonFile) -> Table {
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
        let mut name = if comparison.mutual_effect { rule.name() } else { "no mutual effect" }.to_owned();
        for circle in circles {
            rows.push(row(std::mem::take(&mut name), inside(comparison, circle), &circle.difference));
        }
    }
    if let Some(last) = comparison.localized.last() {
        rows.push(row("half the elements".to_owned(), last.indenters.to_string(), &last.mesh_error));
    }
    rows.push(row("half the grid".to_owned(), String::new(), &comparison.spectral_error));
    Table::new(&header, rows, 0).keyed(&[0, 1])
}

/// Largest difference of the stresses, in a line; `None` where none are compared.
pub fn stresses(comparison: &ComparisonFile, case: &Case) -> Option<String> {
    let worst = comparison.stresses.iter().max_by(|a, b| a.difference().total_cmp(&b.difference()))?;
    let largest = comparison.stresses.iter().flat_map(|pair| pair.spectral.components()[..6].to_vec());
    let largest = largest.fold(0.0, |most: f64, stress| most.max(stress.abs()));
    Some(format!(
        "stresses at {} points under the highest level agree within {:.2} % of the largest, worst at z = {} in {}",
        comparison.stresses.len(),
        100.0 * worst.difference() / largest,
        case.units().length().with_unit(worst.z, number),
        case.problem().half_space().material_id(worst.side)
    ))
}
