//! Stresses in a vertical section, with the interfaces and the places where they are largest (Fig. 6).

use super::axis::Axis;
use super::bar::Bar;
use super::canvas::{Canvas, Dash, Stroke};
use super::colour::Colour;
use super::curve::NUMBERED_COLOURS;
use super::label::equals;
use super::map::{Fill, Map, Over};
use super::number::degrees;
use super::sheet::sheet;
use super::snapshot::Snapshot;
use super::tiling::images;
use super::window::Window;
use crate::friction::Friction;
use crate::reading::{Criterion, LargestInSection, SectionMeasure, Utilisation, Verdict, tears, tips};
use crate::stress::{SurfaceLine, VerticalSection};
use ndarray::Array2;

/// Height over width of a section that is not shown to scale, least and largest.
const ASPECT: [f64; 2] = [0.4, 1.1];

/// Utilisation from which on a criterion is shown as failing: a limit load is known to 10⁻³.
const FAILING: f64 = 0.998;

/// The picture: the normal stress along the line, and the stress that governs failure, or the paper's τ₁.
pub fn section(snapshot: &Snapshot, section: &VerticalSection) -> Canvas {
    let picture = SectionPicture::new(snapshot, section);
    let values = picture.measures.map(|measure| section.values(measure));
    let [along, governing] = [0, 1].map(|k| {
        let values = &values[k];
        move |[s, z]: [f64; 2]| section.at(values, s, z)
    });
    let zero = section.zero_lines(&values[0]).into_iter().map(|points| line(points, 0.5, Dash::Solid, Colour::GREY));
    let along_bar = Bar::signed(snapshot.units.pressure_of("", "σₛ"), span(&values[0], section.highest));
    let apart = along_bar.apart;
    let (governing_bar, ink) = picture.governing_bar(&values[1]);
    let along = picture.panel('a', 0, Fill::Values(along_bar, &along), Colour::BLACK, zero.collect());
    let governing = picture.panel('b', 1, Fill::Values(governing_bar, &governing), ink, Vec::new());
    sheet(&snapshot.caption(&picture.words(apart)), &[&along, &governing])
}

/// The contents of both panels and of the caption.
struct SectionPicture<'a> {
    snapshot: &'a Snapshot,
    section: &'a VerticalSection,
    /// The stresses of both panels.
    measures: [SectionMeasure; 2],
    /// Largest values of both, where they are finite.
    largest: [Option<LargestInSection>; 2],
    /// Whether the second stress is infinite at a tip in the section.
    singular: bool,
    /// Criteria that fail in the plane of the section, and where: s, z; lengths.
    failures: Vec<(Criterion, [f64; 2])>,
    /// Whether depth is shown to the scale of the line, and height over width of the panels.
    is_to_scale: bool,
    aspect: f64,
}

impl<'a> SectionPicture<'a> {
    fn new(snapshot: &'a Snapshot, section: &'a VerticalSection) -> Self {
        let half_space = snapshot.step.problem().half_space();
        let governing = snapshot.governing().map(|criterion| section.governing_measure(criterion, half_space));
        let measures = [SectionMeasure::Along, governing.unwrap_or(SectionMeasure::Tau1)];
        let singular = is_singular(snapshot, measures[1]) && passes_tip(snapshot, section);
        let [along, governing] = measures.map(|measure| section.largest(measure));
        let [first, last] = section.line.span;
        let scale = deepest(section) / (last - first);
        let aspect = scale.clamp(ASPECT[0], ASPECT[1]);
        Self {
            snapshot,
            section,
            measures,
            largest: [along, governing.filter(|_| !singular)],
            singular,
            failures: failures(snapshot, section),
            is_to_scale: aspect == scale,
            aspect,
        }
    }

    /// One of both panels by its `number`: a field with the interfaces, the contacts, the largest value and the failures over it.
    fn panel<'f>(&self, letter: char, number: usize, fill: Fill<'f>, ink: Colour, below: Vec<Over>) -> Map<'f> {
        let (section, units) = (self.section, &self.snapshot.units);
        let [first, last] = section.line.span;
        let interfaces = section.interfaces().into_iter().map(|z| vec![[first, z], [last, z]]);
        // The lines of many interfaces are thin.
        let width = if interfaces.len() < NUMBERED_COLOURS { 0.9 } else { 0.4 };
        let interfaces = interfaces.map(|points| line(points, width, Dash::Dashed, ink));
        let mark = self.largest[number].map(|largest| Over::Mark { at: [largest.s, largest.depth.z], colour: ink });
        let rings = (1..).zip(&self.failures).map(|(number, &(_, at))| Over::Ring { at, number });
        let over = below.into_iter().chain(interfaces).chain(contacts(self.snapshot, section)).chain(mark).chain(rings);
        let [name, symbol] = named(self.measures[number]);
        Map {
            title: format!("({letter}) {name} {symbol}"),
            x: Axis::linear(units.length_of("distance", "s")).from_to(first, last),
            y: Axis::linear(units.length_of("depth", "z")).from_to(deepest(section), 0.0),
            aspect: self.aspect,
            fill,
            over: over.collect(),
        }
    }

    /// Colour bar of the second panel for its `values`, and the colour of lines over it.
    fn governing_bar(&self, values: &Array2<f64>) -> (Bar, Colour) {
        let [_, symbol] = named(self.measures[1]);
        let (label, [least, most]) = (self.snapshot.units.pressure_of("", symbol), span(values, None));
        if matches!(self.measures[1], SectionMeasure::Tension | SectionMeasure::Opening) {
            (Bar::signed(label, [least, most]), Colour::BLACK)
        } else {
            (Bar::sequential(label, most.max(f64::MIN_POSITIVE)), Colour::WHITE)
        }
    }

    /// Text of the caption; `apart`: whether tension and compression have scales of their own.
    fn words(&self, apart: bool) -> String {
        let problem = self.snapshot.step.problem();
        let direction = self.section.line.direction;
        let apart = if apart { "; tension and compression have scales of their own" } else { "" };
        let to_scale = if self.is_to_scale { "" } else { " Depth is stretched." };
        let residual = problem.half_space().residual_stresses().any(|stress| stress != 0.0);
        let residual = if residual { " Residual stress is in it." } else { "" };
        format!(
            "Section along {} from the x axis{}; dashed: interface; bars on top: contacts; thin line in (a): \
             {}{apart}.{to_scale}{residual} Crosses: the largest values here, {}.{}",
            degrees(direction),
            sliding_words(problem.friction(), direction),
            equals("σₛ", &[0.0]),
            self.largest_words(),
            self.failure_words()
        )
    }

    /// The largest values with their places.
    fn largest_words(&self) -> String {
        let units = &self.snapshot.units;
        let symbols = self.measures.map(|measure| named(measure)[1]);
        let words = |(largest, symbol): (Option<LargestInSection>, &str)| {
            largest.map(|LargestInSection { value, s, depth }| {
                let length = |symbol: &str, x: f64| units.length_equals(symbol, &[rounded(x)]);
                let place = [length("s", s), length("z", depth.z)].join(", ");
                format!("{} at {place}", units.pressure_equals(symbol, &[rounded(value)]))
            })
        };
        let infinite = self.singular.then(|| format!("{} is infinite at the tip", symbols[1]));
        let all: Vec<String> = self.largest.into_iter().zip(symbols).filter_map(words).chain(infinite).collect();
        all.join("; ")
    }

    /// The criteria at or beyond their strengths, by the numbers in the rings.
    fn failure_words(&self) -> String {
        let snapshot = self.snapshot;
        let failing = |(number, (criterion, _)): (usize, &(Criterion, [f64; 2]))| {
            let own = snapshot.strength.iter().find(|own| own.criterion == *criterion);
            let is_open =
                snapshot.failing != Some(*criterion) && own.is_some_and(|own| own.verdict == Verdict::Undecided);
            format!("{number}: {criterion}{}", if is_open { " (undecided by its error)" } else { "" })
        };
        let failing: Vec<String> = (1..).zip(&self.failures).map(failing).collect();
        if failing.is_empty() { String::new() } else { format!(" At or beyond its strength, {}.", failing.join("; ")) }
    }
}

/// Name and symbol of a stress.
fn named(measure: SectionMeasure) -> [&'static str; 2] {
    match measure {
        SectionMeasure::Along => ["stress along the section", "σₛ"],
        SectionMeasure::Tau1 => ["principal shear stress", "τ₁"],
        SectionMeasure::Mises => ["stress of von Mises", "σᵥ"],
        SectionMeasure::Tension => ["largest principal stress", "σ₁"],
        SectionMeasure::Shear => ["shear of horizontal planes", "τ"],
        SectionMeasure::Opening => ["normal stress of horizontal planes", "σₙ"],
    }
}

/// Whether a stress is infinite at a tip in contact.
fn is_singular(snapshot: &Snapshot, measure: SectionMeasure) -> bool {
    match measure {
        SectionMeasure::Tau1 | SectionMeasure::Mises => true,
        SectionMeasure::Tension => tears(&snapshot.step),
        SectionMeasure::Shear => snapshot.step.problem().friction().is_some(),
        SectionMeasure::Along | SectionMeasure::Opening => false,
    }
}

/// Text on a section along the direction of sliding, or against it; empty for others.
fn sliding_words(friction: Option<&Friction>, [dx, dy]: [f64; 2]) -> &'static str {
    match friction.map(Friction::direction).map(|[x, y]| x * dx + y * dy) {
        Some(part) if part > 0.999 * dx.hypot(dy) => ", along which the indenters slide",
        Some(part) if part < -0.999 * dx.hypot(dy) => ", against which the indenters slide",
        _ => "",
    }
}

fn line(points: Vec<[f64; 2]>, width: f64, dash: Dash, colour: Colour) -> Over {
    Over::Line(Stroke { points, width, dash, colour })
}

/// Depth of the last row, a length.
fn deepest(section: &VerticalSection) -> f64 {
    section.depths.last().map_or(1.0, |depth| depth.z)
}

/// Criteria that fail in the plane of the section, and where: s, z; lengths.
fn failures(snapshot: &Snapshot, section: &VerticalSection) -> Vec<(Criterion, [f64; 2])> {
    let (cell, near) = (snapshot.step.grid().cell(), snapshot.step.grid().spacing());
    let SurfaceLine { origin, span: [first, last], .. } = section.line;
    let [dx, dy] = section.line.unit();
    let deepest = section.depths.last().map_or(0.0, |depth| depth.z);
    let window = window_of(section, near);
    let in_plane = |utilisation: &Utilisation| {
        let [x, y, z] = utilisation.position;
        let images = images(cell, cell.fractions([x, y]), window).into_iter();
        let away = images.map(|[x, y]| [x - origin[0], y - origin[1]]);
        let mut places = away.filter(|[x, y]| (x * dy - y * dx).abs() <= near).map(|[x, y]| x * dx + y * dy);
        let s = places.find(|s| (first..=last).contains(s)).filter(|_| z <= deepest)?;
        Some((utilisation.criterion, [s, z]))
    };
    let fails = |own: &&Utilisation| own.value >= FAILING || snapshot.failing == Some(own.criterion);
    snapshot.strength.iter().filter(fails).filter_map(in_plane).collect()
}

/// A window around the line of a section, `wider` by a length on all sides.
fn window_of(section: &VerticalSection, wider: f64) -> Window {
    let ends = section.line.ends();
    [0, 1].map(|k| [ends[0][k].min(ends[1][k]) - wider, ends[0][k].max(ends[1][k]) + wider])
}

/// Whether the section reaches the surface at a tip in contact, where τ₁ is infinite whatever the samples show.
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

/// Least and largest of the values, of zero and of the `highest` value between them.
fn span(values: &Array2<f64>, highest: Option<[f64; 2]>) -> [f64; 2] {
    let highest = highest.map(|[_, value]| value);
    values.iter().copied().chain(highest).fold([0.0, 0.0], |[low, high], x| [x.min(low), x.max(high)])
}

/// A number rounded to three digits, as a picture can show.
fn rounded(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}

/// The contacts along the section, as bars on the surface.
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
