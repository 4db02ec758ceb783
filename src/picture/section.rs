//! Stresses in a vertical cut, with the interfaces and the places where they are largest (Fig. 6).

use super::axis::Axis;
use super::canvas::{Canvas, Dash, Stroke};
use super::colour::{Colour, ColourMap};
use super::map::{Bar, Fill, Map, Over};
use super::rows::{Largest, Quantity};
use super::sheet::sheet;
use super::snapshot::{Snapshot, equals};
use super::tiling::images;
use crate::reading::tips;
use crate::stress::Section;
use ndarray::Array2;

/// Height over width of a cut that is not shown to scale, least and largest.
const ASPECT: [f64; 2] = [0.4, 1.1];

/// The picture.
pub fn section(snapshot: &Snapshot, section: &Section) -> Canvas {
    let quantities = [Quantity::Along, Quantity::Tau1];
    let values = quantities.map(|quantity| section.values(quantity));
    let [along, tau1] = [0, 1].map(|k| {
        let values = &values[k];
        move |[s, z]: [f64; 2]| section.at(values, s, z)
    });
    let depth = section.depths.last().map_or(1.0, |depth| depth.z);
    let [first, last] = section.line.span;
    let scale = depth / (last - first);
    let aspect = scale.clamp(ASPECT[0], ASPECT[1]);
    let line = |points: Vec<[f64; 2]>, width: f64, dash: Dash, colour: Colour| {
        Over::Line(Stroke { points, width, dash, colour })
    };
    let singular = passes_tip(snapshot, section);
    let [largest_along, largest_tau1] = quantities.map(|quantity| section.largest(quantity));
    let largest_tau1 = largest_tau1.filter(|_| !singular);
    let panel = |title: &str, fill, ink: Colour, largest: Option<Largest>, below: Vec<Over>| {
        let interfaces = section.interfaces().into_iter().map(|z| vec![[first, z], [last, z]]);
        let interfaces = interfaces.map(|points| line(points, 0.9, Dash::Dashed, ink));
        let mark = largest.map(|largest| Over::Mark { at: [largest.s, largest.depth.z], colour: ink });
        Map {
            title: title.to_owned(),
            x: Axis::linear(snapshot.units.length("distance", "s")).from_to(first, last),
            y: Axis::linear(snapshot.units.length("depth", "z")).from_to(depth, 0.0),
            aspect,
            fill,
            over: below.into_iter().chain(interfaces).chain(contacts(snapshot, section)).chain(mark).collect(),
        }
    };
    let bar = |symbol: &str, colours: ColourMap, span: [f64; 2]| Bar {
        label: snapshot.units.pressure("", symbol),
        colours,
        span,
    };
    let zero = section.zero_lines(&values[0]).into_iter().map(|points| line(points, 0.5, Dash::Solid, Colour::GREY));
    let fill = Fill::Values(bar("σₛ", ColourMap::Diverging, span(&values[0])), &along);
    let along = panel("(a) stress along the section σₛ", fill, Colour::BLACK, largest_along, zero.collect());
    let most = span(&values[1])[1].max(f64::MIN_POSITIVE);
    let fill = Fill::Values(bar("τ₁", ColourMap::Sequential, [0.0, most]), &tau1);
    let tau1 = panel("(b) principal shear stress τ₁", fill, Colour::WHITE, largest_tau1, Vec::new());

    let [dx, dy] = section.line.direction;
    let to_scale = if aspect == scale { "" } else { " Depth is stretched." };
    let words = |largest: Option<Largest>, symbol: &str| {
        largest.map(|Largest { value, s, depth }| {
            let symbol = snapshot.units.pressure_symbol(symbol);
            let place = [equals("s", &[rounded(s)]), equals("z", &[rounded(depth.z)])].join(", ");
            format!("{} at {place}", equals(&symbol, &[rounded(value)]))
        })
    };
    let infinite = singular.then(|| "τ₁ is infinite at the tip".to_owned());
    let largest = [words(largest_along, "σₛ"), words(largest_tau1, "τ₁"), infinite];
    let caption = snapshot.caption(&format!(
        "Section along {:.0}° from the x axis; dashed: interface; bars on top: contacts; thin line in (a): {}.{to_scale} \
         Crosses: the largest values here, {}.",
        dy.atan2(dx).to_degrees(),
        equals("σₛ", &[0.0]),
        largest.into_iter().flatten().collect::<Vec<String>>().join("; ")
    ));
    sheet(&caption, &[&along, &tau1])
}

/// Whether the cut reaches the surface at a tip in contact, where τ₁ is infinite whatever the samples show.
fn passes_tip(snapshot: &Snapshot, section: &Section) -> bool {
    if section.depths.first().is_none_or(|depth| depth.z > 0.0) {
        return false;
    }
    let (cell, ends) = (snapshot.step.grid().cell(), section.line.ends());
    let near = 1e-6 * snapshot.step.grid().spacing();
    let window = [0, 1].map(|k| [ends[0][k].min(ends[1][k]) - near, ends[0][k].max(ends[1][k]) + near]);
    let (along, length) = ([0, 1].map(|k| ends[1][k] - ends[0][k]), section.line.span[1] - section.line.span[0]);
    let aside = |[x, y]: [f64; 2]| ((x - ends[0][0]) * along[1] - (y - ends[0][1]) * along[0]).abs() / length;
    let mut images = tips(&snapshot.step, &snapshot.reading).flat_map(|site| images(cell, site.place, window));
    images.any(|place| aside(place) < near)
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
    let stretches = snapshot.stretches(section.line.ends(), true).into_iter();
    stretches.map(|ends| Over::Roof { from_to: ends.map(|part| first + (last - first) * part) }).collect()
}

#[cfg(test)]
mod tests {
    use super::super::canvas::Mark;
    use super::*;
    use crate::body::{Depth, HalfSpace, Material, MeanStress};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::Lattice;
    use crate::load::Load;
    use crate::problem::Problem;
    use crate::spectral::{Settings, Solver};
    use crate::stress::{Line, StressField};

    #[test]
    fn a_cut_through_a_tip_has_no_finite_shear_stress_to_show() {
        let cones = vec![Level::new(Shape::Cone { slope: 0.1 }, 0.0).unwrap()];
        let indenters = Indenters::new(Lattice::square(1.0, 1).unwrap(), cones).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let mut solver = Solver::new(Problem::new(indenters, body), [32, 32], Settings::default()).unwrap();
        let step = solver.solve(Load::MeanPressure(0.005));
        let reading = step.reading();
        let snapshot = Snapshot::new("", step, reading);
        for (aside, singular) in [(0.0, true), (1.0, true), (0.1, false)] {
            let line = Line { origin: [-0.5, aside], direction: [1.0, 0.0], span: [0.0, 1.0], points: 21 };
            let depths = [0.0, 0.1, 0.2].map(|z| Depth { z, material: 1 });
            let field = StressField::new(snapshot.step.finest(), MeanStress::Confined);
            let canvas = section(&snapshot, &field.section(&line, &depths));
            let infinite = |mark: &Mark| matches!(mark, Mark::Text { text, .. } if text.contains("infinite"));
            assert_eq!(canvas.marks.iter().any(infinite), singular, "{aside}");
        }
    }
}
