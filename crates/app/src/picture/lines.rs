//! Stresses along the surface and both sides of each interface (Fig. 7).

use super::snapshot::Snapshot;
use crate::picture::labels::Labels;
use percoat_core::body::{HalfSpace, Side};
use percoat_core::reading::SectionMeasure;
use percoat_core::stress::VerticalSection;
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Ink, NUMBERED_COLOURS, Style};
use percoat_draw::number::degrees;

/// Number of interfaces from which on colours show depths, and both sides of an interface have one name.
const MANY: usize = NUMBERED_COLOURS;

/// The picture: the lines of the body, then those of the counterbody where it is elastic. `sections` are those of the bodies along
/// one line, at least one.
pub fn lines(snapshot: &Snapshot, sections: &[VerticalSection]) -> Canvas {
    let bodies = snapshot.step.problem().bodies().each();
    let charts: Vec<Chart> =
        bodies.zip(sections).flat_map(|(half_space, section)| of_body(snapshot, half_space, section)).collect();
    let what = format!("Lines along {} from the x axis.", degrees(sections[0].line.direction));
    let many = sections.iter().any(|section| section.interfaces().len() >= MANY);
    let sides = if many { " Thick: above an interface; thin: below." } else { "" };
    plots(&snapshot.caption(&(what + sides)), &charts)
}

/// The charts of one body.
fn of_body(snapshot: &Snapshot, half_space: &HalfSpace, section: &VerticalSection) -> [Chart; 2] {
    let distances = section.line.distances();
    let interfaces = section.interfaces().len();
    // Whether a row lies on the lower side of an interface.
    let below = |row: usize| row > 0 && section.depths[row - 1].z == section.depths[row].z;
    let name = |row: usize| {
        let depth = section.depths[row];
        let (material, above) = (half_space.material_id(depth.material), !below(row));
        let interface = half_space.interface_id(if above { depth.material } else { depth.material - 1 });
        match (row, interfaces, above) {
            (0, ..) => "surface".to_owned(),
            (_, 1, _) if material.name.is_some() => format!("interface, {material}"),
            (_, 1, true) => "interface, coating".to_owned(),
            (_, 1, false) => "interface, substrate".to_owned(),
            (_, MANY.., true) => interface.to_string(),
            (_, MANY.., false) => String::new(),
            (_, _, true) => format!("{interface}, above"),
            (_, _, false) => format!("{interface}, below"),
        }
    };
    let points = |row: usize, measure: SectionMeasure| {
        let states = distances.iter().zip(section.states.row(row));
        let mut points: Vec<[f64; 2]> = states.map(|(&s, state)| [s, section.measure(measure, state)]).collect();
        // An edge of contact between two points is the top of the surface's curve.
        if let Some(highest) =
            section.highest.filter(|_| measure == SectionMeasure::Along && section.depths[row].z == 0.0)
        {
            points.insert(points.partition_point(|[s, _]| *s <= highest[0]), highest);
        }
        points
    };
    let chart = |title: String, measure: SectionMeasure, y: Axis| Chart {
        title,
        x: Axis::linear(snapshot.units.length_of("distance", "s")),
        y,
        curves: (1usize..)
            .zip(section.face_rows())
            .map(|(number, row)| Curve {
                label: name(row),
                points: points(row, measure),
                errors: Vec::new(),
                style: if below(row) && interfaces >= MANY { Style::Thin } else { Style::Line },
                colour: match interfaces {
                    MANY.. => Ink::by_depth(number / 2, interfaces + 1),
                    _ => number.into(),
                },
            })
            .collect(),
    };
    let along = Axis::linear(snapshot.units.pressure_of("stress along the section", "σₛ"));
    let tau1 = Axis::linear(snapshot.units.pressure_of("principal shear stress", "τ₁"));
    let (letters, of) = match half_space.side() {
        Some(Side::Counterbody) => (['c', 'd'], ", counterbody"),
        Some(Side::Body) => (['a', 'b'], ", body"),
        None => (['a', 'b'], ""),
    };
    let title = |number: usize, what: &str| format!("({}) {what}{of}", letters[number]);
    [
        chart(title(0, "tension and compression"), SectionMeasure::Along, along),
        chart(title(1, "principal shear stress"), SectionMeasure::Tau1, tau1),
    ]
}
