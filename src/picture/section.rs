//! Stresses in a vertical cut, with the interfaces and the places where they are largest (Fig. 6).

use super::axis::Axis;
use super::canvas::{Canvas, Dash};
use super::colour::{Colour, ColourMap};
use super::contour::zero_lines;
use super::map::{Bar, Fill, Map, Over};
use super::rows::{Largest, Quantity};
use super::sheet::sheet;
use super::snapshot::{Snapshot, equals};
use crate::stress::Section;
use ndarray::Array2;

/// Height over width of a cut that is not shown to scale, least and largest.
const ASPECT: [f64; 2] = [0.4, 1.1];

/// The picture.
pub fn section(snapshot: &Snapshot, section: &Section) -> Canvas {
    let values = [Quantity::Along, Quantity::Tau1].map(|quantity| section.values(quantity));
    let [along, tau1] = [0, 1].map(|k| {
        let values = &values[k];
        move |[s, z]: [f64; 2]| section.at(values, s, z)
    });
    let spans = [0, 1].map(|k| span(&values[k]));
    let bars = [
        Bar { label: snapshot.units.pressure("", "σₛ"), colours: ColourMap::Diverging, span: spans[0] },
        Bar {
            label: snapshot.units.pressure("", "τ₁"),
            colours: ColourMap::Sequential,
            span: [0.0, spans[1][1].max(f64::MIN_POSITIVE)],
        },
    ];
    let depth = section.depths.last().map_or(1.0, |depth| depth.z);
    let [first, last] = section.line.span;
    let scale = depth / (last - first);
    let aspect = scale.clamp(ASPECT[0], ASPECT[1]);
    let axes = || {
        [
            Axis::linear(snapshot.units.length("distance", "s")).from_to(first, last),
            Axis::linear(snapshot.units.length("depth", "z")).from_to(depth, 0.0),
        ]
    };
    let interfaces = |colour: Colour| {
        let line =
            move |z: f64| Over::Line { points: vec![[first, z], [last, z]], width: 0.9, dash: Dash::Dashed, colour };
        section.interfaces().into_iter().map(line)
    };
    let places = [Quantity::Along, Quantity::Tau1].map(|quantity| section.largest(quantity));
    let mark = |largest: Option<Largest>, colour: Colour| {
        largest.map(|largest| Over::Mark { at: [largest.s, largest.depth.z], colour })
    };
    let [bar_along, bar_tau1] = bars;
    let [x, y] = axes();
    let place = |[u, v]: [f64; 2]| [first + u * (last - first), v * depth];
    let mut over: Vec<Over> = zero_lines(200, 140, |part| along(place(part)))
        .into_iter()
        .map(|line| Over::Line {
            points: line.into_iter().map(place).collect(),
            width: 0.5,
            dash: Dash::Solid,
            colour: Colour::GREY,
        })
        .collect();
    over.extend(interfaces(Colour::BLACK));
    over.extend(contacts(snapshot, section));
    over.extend(mark(places[0], Colour::BLACK));
    let fill = Fill::Values(bar_along, &along);
    let first_map = Map { title: "(a) stress along the section σₛ".into(), x, y, aspect, fill, over };
    let [x, y] = axes();
    let mut over: Vec<Over> = interfaces(Colour::WHITE).collect();
    over.extend(contacts(snapshot, section));
    over.extend(mark(places[1], Colour::WHITE));
    let fill = Fill::Values(bar_tau1, &tau1);
    let second_map = Map { title: "(b) principal shear stress τ₁".into(), x, y, aspect, fill, over };

    let mut caption = snapshot.caption();
    let [dx, dy] = section.line.direction;
    let to_scale = if aspect == scale { "" } else { " Depth is stretched." };
    caption.push(format!(
        "Section along {:.0}° from the x axis; dashed: interface; bars on top: contacts; thin line in (a): {}.{to_scale}",
        dy.atan2(dx).to_degrees(),
        equals("σₛ", &[0.0])
    ));
    let words = |largest: Option<Largest>, symbol: &str| {
        largest.map(|Largest { value, s, depth }| {
            let symbol = snapshot.units.pressure_symbol(symbol);
            let place = [equals("s", &[rounded(s)]), equals("z", &[rounded(depth.z)])].join(", ");
            format!("{} at {place}", equals(&symbol, &[rounded(value)]))
        })
    };
    let largest: Vec<String> = words(places[0], "σₛ").into_iter().chain(words(places[1], "τ₁")).collect();
    caption.push(format!("Crosses: the largest values here, {}.", largest.join("; ")));
    sheet("", &[caption.join(" ")], &[&first_map, &second_map], 2)
}

/// Least and largest value, with zero.
fn span(values: &Array2<f64>) -> [f64; 2] {
    values.iter().fold([0.0, 0.0], |[low, high], &x| [x.min(low), x.max(high)])
}

/// Three digits, as a picture can show.
fn rounded(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}

/// The contacts along the cut, as bars on the surface.
fn contacts(snapshot: &Snapshot, section: &Section) -> Vec<Over> {
    let [first, last] = section.line.span;
    let length = section.line.direction[0].hypot(section.line.direction[1]);
    let touches = |s: f64| {
        let place = [0, 1].map(|k| section.line.origin[k] + s * section.line.direction[k] / length);
        snapshot.pressure_at(place).is_some()
    };
    const STEPS: u32 = 800;
    let mut bars = Vec::new();
    let mut start = None;
    for k in 0..=STEPS {
        let s = first + (last - first) * f64::from(k) / f64::from(STEPS);
        match (start, touches(s) && k < STEPS) {
            (None, true) => start = Some(s),
            (Some(from), false) => {
                bars.push(Over::Roof { from_to: [from, s] });
                start = None;
            }
            _ => {}
        }
    }
    bars
}
