//! A solved load step with its readings, from which the pictures of fields are drawn.

use crate::picture::labels::Labels;
use percoat_case::units::{Unit, Units, lowered, reference_index};
use percoat_core::body::{HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Level, Shape, half_angle};
use percoat_core::friction::Friction;
use percoat_core::lattice::{Cell, LatticeError};
use percoat_core::problem::Problem;
use percoat_core::reading::{Criterion, Governing, Reading, Utilisation};
use percoat_core::spectral::Step;
use percoat_draw::label::equals;
use percoat_draw::number::{degrees, short};

/// One load step.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// Title of the case.
    pub title: String,
    /// The step.
    pub step: Step,
    /// Reading of the step.
    pub reading: Reading,
    /// Utilisations of the strengths; empty without strengths.
    pub strength: Vec<Utilisation>,
    /// Criterion that fails at this load, if it is a limit load.
    pub failing: Option<Criterion>,
    /// Units of lengths and pressures.
    pub units: Units,
}

impl Snapshot {
    /// Snapshot of a step with its reading.
    pub fn new(title: &str, step: Step, reading: Reading) -> Self {
        let units = Units::of(step.problem());
        Self { title: title.to_owned(), step, reading, strength: Vec::new(), failing: None, units }
    }

    /// The snapshot with units that have names.
    #[must_use]
    pub fn with_units(self, units: Units) -> Self {
        Self { units, ..self }
    }

    /// The snapshot with utilisations of the strengths.
    #[must_use]
    pub fn with_strength(self, strength: Vec<Utilisation>) -> Self {
        Self { strength, ..self }
    }

    /// The snapshot as that at the limit load of a criterion.
    #[must_use]
    pub fn at_limit_of(self, criterion: Criterion) -> Self {
        Self { failing: Some(criterion), ..self }
    }

    /// The criterion that fails at this load, or else the one with the largest utilisation.
    pub fn governing(&self) -> Option<Criterion> {
        self.failing.or_else(|| Governing::of(&self.strength).map(|governing| governing.criterion))
    }

    /// Pressure, sample by sample, a₂ fastest.
    pub fn pressures(&self) -> &[f64] {
        self.step.finest().pressures()
    }

    /// Number of levels; 0 for a topography.
    pub fn levels(&self) -> usize {
        self.step.problem().levels().len()
    }

    /// Whether the indenter is the only one of an isolated contact, which needs no number.
    pub fn is_lone(&self) -> bool {
        self.step.problem().lone_indenter().is_some()
    }

    /// Caption: the title, the parameters of the case and the load, then more text.
    pub fn caption(&self, more: &str) -> String {
        let [n1, n2] = self.step.grid().points();
        let load = [
            self.units.load_equals(&[self.reading.load(self.units.quantity())]),
            self.units.length_equals("δ", &[self.step.penetration()]),
        ];
        let samples = format!("{n1}\u{a0}×\u{a0}{n2} samples");
        let friction = self.step.finest().shear().map(|shear| equals("μ", &[shear.friction]));
        let parts: Vec<String> = friction.into_iter().chain([load.join(", "), samples]).collect();
        format!("{} {more}", caption(&self.title, self.step.problem(), &self.units, &parts))
    }
}

/// Title and parameters of a case, then more parts of the sentence.
pub fn caption(title: &str, problem: &Problem, units: &Units, more: &[String]) -> String {
    let title = title.trim_end_matches('.');
    let title = if title.is_empty() { String::new() } else { format!("{title}. ") };
    let above =
        problem.bodies().counterbody().map(|counterbody| format!("counterbody {}", materials(counterbody, units)));
    let parts = [materials(problem.half_space(), units)]
        .into_iter()
        .chain(above)
        .chain(geometry(problem, units))
        .chain(problem.bodies().hardness().map(|(hardness, _)| units.pressure_equals("H", &[hardness])))
        .chain(problem.friction().map(sliding))
        .chain(problem.motion().map(|motion| format!("v = {}", units.velocity().with_unit(motion.velocity(), short))))
        .chain(more.iter().cloned());
    format!("{title}{}.", parts.collect::<Vec<_>>().join("; "))
}

/// Largest number of layers that a caption describes one by one.
const FEW: usize = 4;

fn materials(half_space: &HalfSpace, units: &Units) -> String {
    if half_space.layers().len() > FEW {
        return [many_layers(half_space, units), substrate_words(half_space, units)].join("; ");
    }
    let single = half_space.layers().len() == 1;
    let mut parts = Vec::new();
    for (number, layer) in (1..).zip(half_space.layers()) {
        let index = lowered(number);
        let suffix = if single { "" } else { &index };
        let mut part = before(layer.material());
        let stiffness = match half_space.substrate().material() {
            Some(base) => Some(equals(&format!("χ{suffix}"), &[layer.material().shear() / base.shear()])),
            None => young_words(layer.material(), suffix, units),
        };
        let others = [
            units.length_equals(&format!("h{suffix}"), &[layer.thickness()]),
            equals(
                &format!("ν{}", if half_space.material_count() == 1 { "" } else { &index }),
                &[layer.material().poisson()],
            ),
        ];
        part += &stiffness.into_iter().chain(others).collect::<Vec<_>>().join(", ");
        if layer.residual_stress() != 0.0 {
            part += &format!(", {}", units.pressure_equals(&format!("σᵣ{suffix}"), &[layer.residual_stress()]));
        }
        match layer.interface() {
            Interface::Bonded => {}
            Interface::Frictionless => part += ", frictionless below",
            Interface::Spring { .. } => part += ", springs below",
        }
        parts.push(part);
    }
    parts.push(substrate_words(half_space, units));
    parts.join(if single { ", " } else { "; " })
}

/// Description of many layers by their total thickness and the ranges of their parameters.
fn many_layers(half_space: &HalfSpace, units: &Units) -> String {
    let layers = half_space.layers();
    let range = |of: &dyn Fn(&Layer) -> f64| {
        let (least, most) =
            layers.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        if least == most { vec![least] } else { vec![least, most] }
    };
    let to = |text: String| text.replace(", ", " to ");
    let stiffness = match half_space.substrate().material() {
        Some(base) => to(equals("χ", &range(&|layer| layer.material().shear() / base.shear()))),
        None => to(units.pressure_equals("E", &range(&|layer| layer.material().young()))),
    };
    let together: f64 = layers.iter().map(Layer::thickness).sum();
    let mut parts = vec![
        format!("{} layers, together {}", layers.len(), units.length_equals("h", &[together])),
        stiffness,
        to(equals("ν", &range(&|layer| layer.material().poisson()))),
    ];
    let residual = range(&|layer| layer.residual_stress());
    if residual != [0.0] {
        parts.push(to(units.pressure_equals("σᵣ", &residual)));
    }
    let interfaces = |name: &str, is: fn(&Interface) -> bool| {
        let count = layers.iter().filter(|layer| is(&layer.interface())).count();
        (count > 0).then(|| format!("{count} {name} interface{}", if count > 1 { "s" } else { "" }))
    };
    parts.extend(interfaces("frictionless", |interface| matches!(interface, Interface::Frictionless)));
    parts.extend(interfaces("spring", |interface| matches!(interface, Interface::Spring { .. })));
    parts.join(", ")
}

/// The name of a material with a colon; empty where it has none.
fn before(material: Material) -> String {
    material.name().map_or(String::new(), |name| format!("{name}: "))
}

fn substrate_words(half_space: &HalfSpace, units: &Units) -> String {
    let Some(substrate) = half_space.substrate().material() else { return "rigid base".to_owned() };
    let index = reference_index(half_space);
    let poisson = before(substrate) + &equals(&format!("ν{index}"), &[substrate.poisson()]);
    std::iter::once(poisson).chain(young_words(substrate, &index, units)).collect::<Vec<_>>().join(", ")
}

/// Young's modulus; `None` where pressures are relative to one.
fn young_words(material: Material, index: &str, units: &Units) -> Option<String> {
    let is_relative = matches!(units.pressure(), Unit::Relative(_));
    (!is_relative).then(|| units.pressure_equals(&format!("E{index}"), &[material.young()]))
}

fn sliding(friction: &Friction) -> String {
    let angle = degrees(friction.direction());
    let uncoupled = if friction.is_coupled() { "" } else { ", uncoupled" };
    format!("sliding at {angle} from the x axis, {}{uncoupled}", equals("μ", &[friction.coefficient()]))
}

/// Whether a cell is neither hexagonal nor square, so that its vectors describe it.
pub fn is_oblique(cell: &Cell) -> bool {
    let [[side, _], _] = cell.vectors();
    let like = |named: Result<Cell, LatticeError>| {
        named.is_ok_and(|named| {
            let pairs = named.vectors().into_iter().flatten().zip(cell.vectors().into_iter().flatten());
            pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9 * side.abs())
        })
    };
    !like(Cell::hexagonal(side)) && !like(Cell::square(side))
}

/// Cell vectors with their unit, as in "cell a₁ = (1, 0.2), a₂ = (0.3, 1.4)".
fn cell_vectors(cell: &Cell, units: &Units) -> String {
    let unit = units.length().suited(cell.vectors().into_iter().flatten());
    let [a1, a2] = cell.vectors().map(|vector| vector.map(|c| short(unit.shown(c))).join(",\u{a0}"));
    let over = if let Unit::Relative(to) = units.length() { format!("/{to}") } else { String::new() };
    let vector = |name: &str, places: &str| unit.behind(&format!("{name}{over}\u{a0}=\u{a0}({places})"));
    format!("cell {}, {}", vector("a₁", &a1), vector("a₂", &a2))
}

fn geometry(problem: &Problem, units: &Units) -> Option<String> {
    let cell = problem.cell();
    let mut parts = Vec::new();
    if let Some(sides) = cell.window_sides() {
        let shown = if sides[0] == sides[1] { &sides[..1] } else { &sides };
        parts.push(format!("isolated, window {}", units.length_equals("w", shown)));
    } else if is_oblique(&cell) {
        parts.push(cell_vectors(&cell, units));
    }
    let Some(indenters) = problem.indenters() else { return (!parts.is_empty()).then(|| parts.join(", ")) };
    let levels = indenters.levels();
    let period = problem.period().filter(|_| *units.length() != Unit::Relative("l".to_owned()));
    parts.extend(period.map(|period| units.length_equals("l", &[period])));
    let radius = |level: &Level| match *level.shape() {
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => Some(radius),
        _ => None,
    };
    let shape = |level: &Level| match *level.shape() {
        Shape::Cone { slope } => format!("cone of slope {}", short(slope)),
        Shape::Power { coefficient, exponent } => {
            let coefficient = if coefficient == 1.0 { String::new() } else { short(coefficient) + "\u{a0}" };
            format!("{coefficient}rⁿ, {}", equals("n", &[exponent]))
        }
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => {
            format!("{} of {}", level.shape().name(), units.length_equals("r", &[radius]))
        }
        Shape::SpheroCone { radius, slope } => {
            let radius = units.length_equals("r", &[radius]);
            format!("sphero-cone of {radius} and half angle {}°", short(half_angle(slope)))
        }
        Shape::Measured(_) => "measured tip".to_owned(),
    };
    match levels.iter().map(radius).collect::<Option<Vec<f64>>>() {
        Some(radii) => {
            let same = radii.iter().all(|x| *x == radii[0]);
            parts.push(units.length_equals("rₘ", if same { &radii[..1] } else { &radii }));
        }
        None => parts.extend(levels.iter().map(shape)),
    }
    if levels.len() > 1 {
        parts.push(format!("lower by {}", units.length_equals("Δₘ", &indenters.drops()[1..])));
    }
    Some(parts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::Material;
    use percoat_core::counterbody::Indenters;
    use percoat_core::lattice::Lattice;

    fn words(layers: usize, cell: Cell) -> String {
        let material = |young: f64| Material::from_young(young, 0.3).unwrap();
        let layer = |k: usize| Layer::new(material(1.0 + k as f64), 0.1, Interface::Bonded).unwrap();
        let body = HalfSpace::new((0..layers).map(layer).collect(), material(1.0));
        let levels = [0.1, 0.0].map(|height| Level::new(Shape::Paraboloid { radius: 3.0 }, height).unwrap()).to_vec();
        let sites = vec![vec![[0.0, 0.0]], vec![[0.5, 0.5]]];
        let problem = Problem::new(Indenters::new(Lattice::new(cell, sites).unwrap(), levels).unwrap(), body);
        caption("", &problem, &Units::of(&problem), &[]).replace('\u{a0}', " ")
    }

    #[test]
    fn a_thickness_and_a_height_have_letters_of_their_own() {
        let words = words(2, Cell::square(2.0).unwrap());
        assert!(
            words.contains("h₁ = 0.1") && words.contains("h₂ = 0.1") && words.contains("lower by Δₘ = 0.1"),
            "{words}"
        );
        assert!(!words.contains("h₁ −") && !words.contains("a₁"), "{words}");
    }

    #[test]
    fn many_layers_take_no_more_room_than_few_and_an_oblique_cell_has_its_vectors() {
        let (few, many) = (words(4, Cell::square(2.0).unwrap()), words(40, Cell::new([2.0, 0.5], [0.0, 3.0]).unwrap()));
        assert!(many.contains("40 layers, together h = 4, χ = 1 to 40, ν = 0.3; ν₄₁ = 0.3"), "{many}");
        assert!(many.contains("cell a₁ = (2, 0.5), a₂ = (0, 3)"), "{many}");
        assert!(many.len() < few.len(), "{many}\n{few}");
    }
}
