//! Stresses in a vertical cut, with the interfaces and the places where they are largest (Fig. 6).

use super::axis::Axis;
use super::bar::Bar;
use super::canvas::{Canvas, Dash, Stroke};
use super::colour::Colour;
use super::curve::MOST;
use super::map::{Fill, Map, Over};
use super::number::degrees;
use super::quantity::equals;
use super::rows::{Largest, Quantity};
use super::sheet::sheet;
use super::snapshot::Snapshot;
use super::tiling::images;
use super::window::Window;
use crate::friction::Friction;
use crate::reading::{Criterion, Utilisation, Verdict, tears, tips};
use crate::stress::{SurfaceLine, VerticalSection};
use ndarray::Array2;

/// Height over width of a cut that is not shown to scale, least and largest.
const ASPECT: [f64; 2] = [0.4, 1.1];

/// A utilisation from here on is a failure: a limit load is known to 10⁻³.
const FAILS: f64 = 0.998;

/// The picture.
pub fn section(snapshot: &Snapshot, section: &VerticalSection) -> Canvas {
    // Beside tension and compression stands what brings failure about, or the paper's τ₁.
    let half_space = snapshot.step.problem().half_space();
    let second = snapshot.governing().map_or(Quantity::Tau1, |criterion| section.failing(criterion, half_space));
    let quantities = [Quantity::Along, second];
    let values = quantities.map(|quantity| section.values(quantity));
    let [along, other] = [0, 1].map(|k| {
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
    let singular = match second {
        Quantity::Tau1 | Quantity::Mises => true,
        Quantity::Tension => tears(&snapshot.step),
        Quantity::Shear => snapshot.step.problem().friction().is_some(),
        Quantity::Along | Quantity::Opening => false,
    };
    let singular = singular && passes_tip(snapshot, section);
    let [largest_along, largest_other] = quantities.map(|quantity| section.largest(quantity));
    let largest_other = largest_other.filter(|_| !singular);
    let failures = failures(snapshot, section);
    let panel = |title: String, fill, ink: Colour, largest: Option<Largest>, below: Vec<Over>| {
        let interfaces = section.interfaces().into_iter().map(|z| vec![[first, z], [last, z]]);
        // Of many the lines are thin.
        let width = if interfaces.len() < MOST { 0.9 } else { 0.4 };
        let interfaces = interfaces.map(|points| line(points, width, Dash::Dashed, ink));
        let mark = largest.map(|largest| Over::Mark { at: [largest.s, largest.depth.z], colour: ink });
        let rings = (1..).zip(&failures).map(|(number, &(_, at))| Over::Ring { at, number });
        let over = below.into_iter().chain(interfaces).chain(contacts(snapshot, section)).chain(mark).chain(rings);
        Map {
            title,
            x: Axis::linear(snapshot.units.length_of("distance", "s")).from_to(first, last),
            y: Axis::linear(snapshot.units.length_of("depth", "z")).from_to(depth, 0.0),
            aspect,
            fill,
            over: over.collect(),
        }
    };
    let zero = section.zero_lines(&values[0]).into_iter().map(|points| line(points, 0.5, Dash::Solid, Colour::GREY));
    let bar = Bar::signed(snapshot.units.pressure_of("", "σₛ"), span(&values[0], section.highest));
    let apart = if bar.apart { "; tension and compression have scales of their own" } else { "" };
    let along =
        panel(titled('a', Quantity::Along), Fill::Values(bar, &along), Colour::BLACK, largest_along, zero.collect());
    let [_, symbol] = second.named();
    let (label, [least, most]) = (snapshot.units.pressure_of("", symbol), span(&values[1], None));
    let (bar, ink) = if matches!(second, Quantity::Tension | Quantity::Opening) {
        (Bar::signed(label, [least, most]), Colour::BLACK)
    } else {
        (Bar::sequential(label, most.max(f64::MIN_POSITIVE)), Colour::WHITE)
    };
    let other = panel(titled('b', second), Fill::Values(bar, &other), ink, largest_other, Vec::new());

    let [dx, dy] = section.line.direction;
    let to_scale = if aspect == scale { "" } else { " Depth is stretched." };
    let words = |largest: Option<Largest>, symbol: &str| {
        largest.map(|Largest { value, s, depth }| {
            let length = |symbol: &str, x: f64| snapshot.units.length_equals(symbol, &[rounded(x)]);
            let place = [length("s", s), length("z", depth.z)].join(", ");
            format!("{} at {place}", snapshot.units.pressure_equals(symbol, &[rounded(value)]))
        })
    };
    let infinite = singular.then(|| format!("{symbol} is infinite at the tip"));
    let largest = [words(largest_along, "σₛ"), words(largest_other, symbol), infinite];
    let residual = half_space.residual_stresses().any(|stress| stress != 0.0);
    let residual = if residual { " Residual stress is in it." } else { "" };
    let failing = |(number, (criterion, _)): (usize, &(Criterion, [f64; 2]))| {
        let own = snapshot.strength.iter().find(|own| own.criterion == *criterion);
        let is_open = snapshot.failing != Some(*criterion) && own.is_some_and(|own| own.verdict == Verdict::Undecided);
        format!("{number}: {criterion}{}", if is_open { " (undecided by its error)" } else { "" })
    };
    let failed: Vec<String> = (1..).zip(&failures).map(failing).collect();
    let rings =
        if failed.is_empty() { String::new() } else { format!(" At or beyond its strength, {}.", failed.join("; ")) };
    let ahead = snapshot.step.problem().friction().map(Friction::direction).map(|[x, y]| x * dx + y * dy);
    let sliding = match ahead {
        Some(part) if part > 0.999 * dx.hypot(dy) => ", along which the indenters slide",
        Some(part) if part < -0.999 * dx.hypot(dy) => ", against which the indenters slide",
        _ => "",
    };
    let caption = snapshot.caption(&format!(
        "VerticalSection along {} from the x axis{sliding}; dashed: interface; bars on top: contacts; thin line in (a): {}{apart}.{to_scale}{residual} \
         Crosses: the largest values here, {}.{rings}",
        degrees([dx, dy]),
        equals("σₛ", &[0.0]),
        largest.into_iter().flatten().collect::<Vec<String>>().join("; ")
    ));
    sheet(&caption, &[&along, &other])
}

fn titled(letter: char, quantity: Quantity) -> String {
    let [name, symbol] = quantity.named();
    format!("({letter}) {name} {symbol}")
}

/// What fails in the plane of the cut, and where: s, z.
fn failures(snapshot: &Snapshot, section: &VerticalSection) -> Vec<(Criterion, [f64; 2])> {
    let (cell, near) = (snapshot.step.grid().cell(), snapshot.step.grid().spacing());
    let SurfaceLine { origin, span: [first, last], .. } = section.line;
    let [dx, dy] = section.line.unit();
    let deepest = section.depths.last().map_or(0.0, |depth| depth.z);
    let window = window_of(section, near);
    let on_cut = |utilisation: &Utilisation| {
        let [x, y, z] = utilisation.position;
        let images = images(cell, cell.fractions([x, y]), window).into_iter();
        let away = images.map(|[x, y]| [x - origin[0], y - origin[1]]);
        let mut places = away.filter(|[x, y]| (x * dy - y * dx).abs() <= near).map(|[x, y]| x * dx + y * dy);
        let s = places.find(|s| (first..=last).contains(s)).filter(|_| z <= deepest)?;
        Some((utilisation.criterion, [s, z]))
    };
    let fails = |own: &&Utilisation| own.value >= FAILS || snapshot.failing == Some(own.criterion);
    snapshot.strength.iter().filter(fails).filter_map(on_cut).collect()
}

/// A window around the line of a cut, so much wider.
fn window_of(section: &VerticalSection, wider: f64) -> Window {
    let ends = section.line.ends();
    [0, 1].map(|k| [ends[0][k].min(ends[1][k]) - wider, ends[0][k].max(ends[1][k]) + wider])
}

/// Whether the cut reaches the surface at a tip in contact, where τ₁ is infinite whatever the samples show.
fn passes_tip(snapshot: &Snapshot, section: &VerticalSection) -> bool {
    if section.depths.first().is_none_or(|depth| depth.z > 0.0) {
        return false;
    }
    let (cell, ends) = (snapshot.step.grid().cell(), section.line.ends());
    let near = 1e-6 * snapshot.step.grid().spacing();
    let window = window_of(section, near);
    let (along, length) = ([0, 1].map(|k| ends[1][k] - ends[0][k]), section.line.span[1] - section.line.span[0]);
    let aside = |[x, y]: [f64; 2]| ((x - ends[0][0]) * along[1] - (y - ends[0][1]) * along[0]).abs() / length;
    let mut images = tips(&snapshot.step, &snapshot.reading).flat_map(|site| images(cell, site.place, window));
    images.any(|place| aside(place) < near)
}

/// Least and largest value, with zero.
fn span(values: &Array2<f64>, highest: Option<[f64; 2]>) -> [f64; 2] {
    let highest = highest.map(|[_, value]| value);
    values.iter().copied().chain(highest).fold([0.0, 0.0], |[low, high], x| [x.min(low), x.max(high)])
}

/// Three digits, as a picture can show.
fn rounded(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}

/// The contacts along the cut, as bars on the surface.
fn contacts(snapshot: &Snapshot, section: &VerticalSection) -> Vec<Over> {
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
    use crate::stress::{StressField, SurfaceLine};

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
            let line = SurfaceLine { origin: [-0.5, aside], direction: [1.0, 0.0], span: [0.0, 1.0], points: 21 };
            let depths = [0.0, 0.1, 0.2].map(|z| Depth { z, material: 1 });
            let field = StressField::new(snapshot.step.finest(), MeanStress::Confined);
            let canvas = section(&snapshot, &field.section(&line, &depths));
            let infinite = |mark: &Mark| matches!(mark, Mark::Text { text, .. } if text.contains("infinite"));
            assert_eq!(canvas.marks.iter().any(infinite), singular, "{aside}");
        }
    }
}
