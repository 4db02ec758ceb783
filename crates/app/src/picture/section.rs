//! Stresses in a vertical section, with the interfaces and the places where they are largest (Fig. 6).

use super::shown_depths::{ShownDepths, deepest};
use super::signed_values::{SIGNS, SignedValues};
use super::snapshot::Snapshot;
use super::window::Window;
use crate::picture::labels::Labels;
use percoat_case::words::Words;
use percoat_core::body::{HalfSpace, Side};
use percoat_core::reading::{Criterion, LargestInSection, SectionMeasure, Utilisation, Verdict, tears, tips};
use percoat_core::stress::{SurfaceLine, VerticalSection};
use percoat_draw::axis::Axis;
use percoat_draw::bar::Bar;
use percoat_draw::canvas::{Canvas, Dash, Stroke};
use percoat_draw::colour::Colour;
use percoat_draw::curve::NUMBERED_COLOURS;
use percoat_draw::label::equals;
use percoat_draw::map::{Fill, Map, Over};
use percoat_draw::number::degrees;
use percoat_draw::sheet::{Panel, sheet};

/// Width of the bar of a contact between the bodies, points.
const BETWEEN: f64 = 2.4;

/// Utilisation from which on a criterion is shown as failing: a limit load is known to 10⁻³.
const FAILING: f64 = 0.998;

/// The picture: the normal stress along the line, and the stress that governs failure, or the paper's τ₁; of the body, and above
/// it of the counterbody where it is elastic. `sections` are those of the bodies along one line, at least one.
pub fn section(snapshot: &Snapshot, sections: &[VerticalSection]) -> Canvas {
    let picture = SectionPicture::new(snapshot, sections);
    let values = picture.measures.map(|measure| SignedValues::new(sections, measure));
    let [along, governing] = [0, 1].map(|k| {
        let values = &values[k];
        move |place: [f64; 2]| values.at(place)
    });
    let zero = values[0].zero_lines().into_iter().map(|points| line(points, 0.5, Dash::Solid, Colour::GREY));
    let zero: Vec<Over> = zero.collect();
    let highest = sections.iter().filter_map(|section| section.highest).map(|[_, value]| value);
    let along_bar = Bar::signed(snapshot.units.pressure_of("", "σₛ"), values[0].span(highest));
    let apart = along_bar.apart;
    let (governing_bar, ink) = picture.governing_bar(&values[1]);
    let mut panels = Vec::new();
    for shown in [Some(picture.whole), picture.coating].into_iter().flatten() {
        let fill = Fill::Values(along_bar.clone(), &along);
        panels.push(picture.panel(0, shown, fill, Colour::BLACK, zero.clone()));
        panels.push(picture.panel(1, shown, Fill::Values(governing_bar.clone(), &governing), ink, Vec::new()));
    }
    for (letter, panel) in ('a'..).zip(&mut panels) {
        panel.title = format!("({letter}) {}", panel.title);
    }
    let panels: Vec<&dyn Panel> = panels.iter().map(|panel| panel as &dyn Panel).collect();
    sheet(&snapshot.caption(&picture.words(apart)), &panels)
}

/// The contents of all panels and of the caption.
struct SectionPicture<'a> {
    snapshot: &'a Snapshot,
    /// Section of the body, then that of the counterbody where it is elastic.
    sections: &'a [VerticalSection],
    /// The stresses of both panels.
    measures: [SectionMeasure; 2],
    /// Largest values of both, where they are finite, with s and z; lengths.
    largest: [Option<(f64, [f64; 2])>; 2],
    /// Whether the second stress is infinite at a tip in the section.
    singular: bool,
    /// Criteria that fail in the plane of the section, and where: s, z; lengths.
    failures: Vec<(Criterion, [f64; 2])>,
    /// The depths that the upper panels show, and those of thin coatings, which others show once more.
    whole: ShownDepths,
    coating: Option<ShownDepths>,
}

impl<'a> SectionPicture<'a> {
    fn new(snapshot: &'a Snapshot, sections: &'a [VerticalSection]) -> Self {
        let bodies = snapshot.step.problem().bodies();
        let governing = snapshot.governing().and_then(|criterion| {
            let half_space = bodies.on(criterion.side());
            let index = bodies.each().position(|body| std::ptr::eq(body, half_space))?;
            Some(sections.get(index)?.governing_measure(criterion, half_space))
        });
        let measures = [SectionMeasure::Along, governing.unwrap_or(SectionMeasure::Tau1)];
        let singular = is_singular(snapshot, measures[1]) && passes_tip(snapshot, &sections[0]);
        let [along, governing] = measures.map(|measure| largest(sections, measure));
        Self {
            snapshot,
            sections,
            measures,
            largest: [along, governing.filter(|_| !singular)],
            singular,
            failures: failures(snapshot, sections),
            whole: ShownDepths::whole(sections),
            coating: ShownDepths::coating(sections),
        }
    }

    /// A panel of one of both stresses by its `number`: a field with the interfaces, the contacts, the largest value and the failures
    /// over it.
    fn panel<'f>(&self, number: usize, shown: ShownDepths, fill: Fill<'f>, ink: Colour, below: Vec<Over>) -> Map<'f> {
        let (sections, units) = (self.sections, &self.snapshot.units);
        let [first, last] = sections[0].line.span;
        let level = |z: f64| vec![[first, z], [last, z]];
        let of = |(section, sign): (&VerticalSection, f64)| {
            section.interfaces().into_iter().map(|z| level(sign * z)).collect::<Vec<_>>()
        };
        let interfaces: Vec<_> = sections.iter().zip(SIGNS).flat_map(of).collect();
        // The lines of many interfaces are thin.
        let width = if interfaces.len() < NUMBERED_COLOURS { 0.9 } else { 0.4 };
        let interfaces = interfaces.into_iter().map(|points| line(points, width, Dash::Solid, ink));
        let has_both = shown.top < 0.0 && shown.bottom > 0.0;
        let surface = has_both.then(|| line(level(0.0), 0.6, Dash::Solid, ink));
        let is_shown = |at: &[f64; 2]| (shown.top..=shown.bottom).contains(&at[1]);
        let mark = self.largest[number].map(|(_, at)| at).filter(is_shown).map(|at| Over::Mark { at, colour: ink });
        let rings = (1..).zip(&self.failures).filter(|(_, (_, at))| is_shown(at));
        let rings = rings.map(|(number, &(_, at))| Over::Ring { at, number });
        let over = below.into_iter().chain(interfaces).chain(surface);
        let over = over.chain(contacts(self.snapshot, sections, shown, ink)).chain(mark).chain(rings);
        let [name, symbol] = named(self.measures[number]);
        let title = if shown.is_coating { format!("{symbol} in the coating") } else { format!("{name} {symbol}") };
        Map {
            title,
            x: Axis::linear(units.length_of("distance", "s")).from_to(first, last),
            y: Axis::linear(units.length_of("depth", "z")).from_to(shown.bottom, shown.top),
            aspect: shown.aspect,
            fill,
            over: over.collect(),
        }
    }

    /// Colour bar of the second panel for its `values`, and the colour of lines over it.
    fn governing_bar(&self, values: &SignedValues<'_>) -> (Bar, Colour) {
        let [_, symbol] = named(self.measures[1]);
        let (label, [least, most]) = (self.snapshot.units.pressure_of("", symbol), values.span(std::iter::empty()));
        if matches!(self.measures[1], SectionMeasure::Tension | SectionMeasure::Opening) {
            (Bar::signed(label, [least, most]), Colour::BLACK)
        } else {
            (Bar::sequential(label, most.max(f64::MIN_POSITIVE)), Colour::WHITE)
        }
    }

    /// Text of the caption; `apart`: whether tension and compression have scales of their own.
    fn words(&self, apart: bool) -> String {
        let problem = self.snapshot.step.problem();
        let direction = self.sections[0].line.direction;
        let apart = if apart { "; tension and compression have scales of their own" } else { "" };
        let coating = self.coating.map_or(String::new(), |coating| {
            format!(" (c), (d): the coating of (a), (b) in the same colours.{}", coating.words(" There depth"))
        });
        let to_scale = self.whole.words(" Depth") + &coating;
        let residual = problem.bodies().each().flat_map(HalfSpace::residual_stresses).any(|stress| stress != 0.0);
        let residual = if residual { " Residual stress is in it." } else { "" };
        let bodies = match self.sections.len() {
            0 | 1 => format!("; bars on top: {}", Words::of(problem.kind()).load.bars),
            _ => "; above z = 0 the counterbody, below it the body; bars between them: contacts".to_owned(),
        };
        format!(
            "Section along {} from the x axis{}{bodies}; level lines: interfaces; curved lines: \
             {}{apart}.{to_scale}{residual} Crosses: the largest values here, {}.{}",
            degrees(direction),
            sliding_words(problem.sliding_direction(), direction),
            equals("σₛ", &[0.0]),
            self.largest_words(),
            self.failure_words()
        )
    }

    /// The largest values with their places.
    fn largest_words(&self) -> String {
        let units = &self.snapshot.units;
        let symbols = self.measures.map(|measure| named(measure)[1]);
        let words = |(largest, symbol): (Option<(f64, [f64; 2])>, &str)| {
            largest.map(|(value, [s, z])| {
                // Rounding beside the length of the section is zero.
                let [first, last] = self.sections[0].line.span;
                let snapped = |x: f64| if x.abs() < 1e-9 * (last - first).abs() { 0.0 } else { rounded(x) };
                let length = |symbol: &str, x: f64| units.length_equals(symbol, &[snapped(x)]);
                let place = [length("s", s), length("z", z)].join(", ");
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
            let utilisation = snapshot.strength.iter().find(|utilisation| utilisation.criterion == *criterion);
            let is_open = snapshot.failing != Some(*criterion)
                && utilisation.is_some_and(|utilisation| utilisation.verdict == Verdict::Undecided);
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
        SectionMeasure::Mises => ["von Mises stress", "σᵥ"],
        SectionMeasure::Tension => ["largest principal stress", "σ₁"],
        SectionMeasure::Shear => ["shear of horizontal planes", "τ"],
        SectionMeasure::Opening => ["normal stress of horizontal planes", "σₙ"],
    }
}

/// Whether a stress is infinite at a tip in contact.
fn is_singular(snapshot: &Snapshot, measure: SectionMeasure) -> bool {
    match measure {
        SectionMeasure::Tau1 | SectionMeasure::Mises => true,
        SectionMeasure::Tension => {
            snapshot.step.problem().bodies().each().any(|half_space| tears(&snapshot.step, half_space))
        }
        SectionMeasure::Shear => snapshot.step.problem().friction().is_some(),
        SectionMeasure::Along | SectionMeasure::Opening => false,
    }
}

/// Text on a section along the direction of sliding, or against it; empty for others.
fn sliding_words(along: Option<[f64; 2]>, [dx, dy]: [f64; 2]) -> &'static str {
    match along.map(|[x, y]| x * dx + y * dy) {
        Some(part) if part > 0.999 * dx.hypot(dy) => ", along which the indenters slide",
        Some(part) if part < -0.999 * dx.hypot(dy) => ", against which the indenters slide",
        _ => "",
    }
}

fn line(points: Vec<[f64; 2]>, width: f64, dash: Dash, colour: Colour) -> Over {
    Over::Line(Stroke { points, width, dash, colour })
}

/// The largest value of a measure in the bodies, and where: s, z; lengths.
fn largest(sections: &[VerticalSection], measure: SectionMeasure) -> Option<(f64, [f64; 2])> {
    let of = |(section, sign): (&VerticalSection, f64)| {
        let LargestInSection { value, s, depth } = section.largest(measure)?;
        Some((value, [s, sign * depth.z]))
    };
    sections.iter().zip(SIGNS).filter_map(of).reduce(|best, next| if next.0 > best.0 { next } else { best })
}

/// Criteria that fail in the plane of the section, and where: s, z; lengths.
fn failures(snapshot: &Snapshot, sections: &[VerticalSection]) -> Vec<(Criterion, [f64; 2])> {
    let (cell, near) = (snapshot.step.grid().cell(), snapshot.step.grid().spacing());
    let SurfaceLine { origin, span: [first, last], .. } = sections[0].line;
    let [dx, dy] = sections[0].line.unit();
    let window = window_of(&sections[0], near);
    let in_plane = |utilisation: &Utilisation| {
        let [x, y, z] = utilisation.position;
        let part = usize::from(utilisation.criterion.side() == Some(Side::Counterbody));
        let deepest = deepest(sections.get(part)?);
        let images = cell.images_in(cell.fractions([x, y]), window).into_iter();
        let away = images.map(|[x, y]| [x - origin[0], y - origin[1]]);
        let mut places = away.filter(|[x, y]| (x * dy - y * dx).abs() <= near).map(|[x, y]| x * dx + y * dy);
        let s = places.find(|s| (first..=last).contains(s)).filter(|_| z <= deepest)?;
        Some((utilisation.criterion, [s, SIGNS[part] * z]))
    };
    let fails =
        |utilisation: &&Utilisation| utilisation.value >= FAILING || snapshot.failing == Some(utilisation.criterion);
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
    let bodies = snapshot.step.problem().bodies().each();
    let tips = bodies.flat_map(|half_space| tips(&snapshot.step, &snapshot.reading, half_space));
    tips.flat_map(|site| cell.images_in(site.place, window)).any(|place| aside(place) < near)
}

/// A number rounded to three digits, as a picture can show.
fn rounded(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}

/// The contacts along the section, as bars on the surface: on top of the plot, or between the bodies.
fn contacts(snapshot: &Snapshot, sections: &[VerticalSection], shown: ShownDepths, ink: Colour) -> Vec<Over> {
    let [first, last] = sections[0].line.span;
    let stretches = snapshot.stretches(sections[0].line.ends(), true).into_iter();
    let stretches = stretches.map(|ends| ends.map(|part| first + (last - first) * part));
    let over = |from_to: [f64; 2]| match shown.top == 0.0 {
        true => Over::Roof { from_to },
        false => line(from_to.map(|s| [s, 0.0]).to_vec(), BETWEEN, Dash::Solid, ink),
    };
    stretches.map(over).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::{Depth, HalfSpace, Interface, Layer, Material, MeanStress};
    use percoat_core::counterbody::{Indenters, Level, Shape};
    use percoat_core::lattice::Lattice;
    use percoat_core::load::Load;
    use percoat_core::problem::Problem;
    use percoat_core::run::places::section_depths;
    use percoat_core::spectral::{Settings, Solver};
    use percoat_core::stress::{StressField, SurfaceLine};
    use percoat_draw::canvas::Mark;

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
            let canvas = section(&snapshot, &[field.section(&line, &depths)]);
            let infinite = |mark: &Mark| matches!(mark, Mark::Text { text, .. } if text.contains("infinite"));
            assert_eq!(canvas.marks.iter().any(infinite), singular, "{aside}");
        }
    }

    #[test]
    fn a_thin_coating_has_panels_of_its_own_in_the_same_colours() {
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let words = |thickness: f64| {
            let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
            let indenters = Indenters::new(Lattice::square(1.0, 1).unwrap(), vec![level]).unwrap();
            let coating = Layer::new(Material::from_young(2.0, 0.3).unwrap(), thickness, Interface::Bonded).unwrap();
            let problem = Problem::new(indenters, HalfSpace::new(vec![coating], substrate));
            let step = Solver::new(problem, [32, 32], Settings::default()).unwrap().solve(Load::MeanPressure(0.02));
            let reading = step.reading();
            let snapshot = Snapshot::new("", step, reading);
            let line = SurfaceLine { origin: [-0.5, 0.1], direction: [1.0, 0.0], span: [0.0, 1.0], points: 21 };
            let field = StressField::new(snapshot.step.finest(), MeanStress::Confined);
            let depths = section_depths(field.half_space(), 0.5);
            let canvas = section(&snapshot, &[field.section(&line, &depths)]);
            let text = |mark: &Mark| if let Mark::Text { text, .. } = mark { Some(text.clone()) } else { None };
            canvas.marks.iter().filter_map(text).collect::<Vec<_>>().join(" ")
        };
        let (thin, thick) = (words(0.02), words(0.2));
        for text in [
            "(c) σₛ in the coating",
            "(d) τ₁ in the coating",
            "(c), (d): the coating of (a), (b)",
            "stretched by a factor of 9",
        ] {
            assert!(thin.contains(text), "no {text}: {thin}");
            assert!(!thick.contains(text), "{text}: {thick}");
        }
    }
}
