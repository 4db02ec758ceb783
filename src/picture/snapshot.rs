//! A solved load step with what is known about it: what the pictures of fields are drawn from.

use super::number::{degrees, short};
use super::quantity::equals;
use crate::body::{HalfSpace, Interface};
use crate::counterbody::{Counterbody, Level, Shape};
use crate::friction::Friction;
use crate::problem::Problem;
use crate::reading::{Criterion, Reading, Utilisation};
use crate::spectral::Step;
use crate::units::{Unit, Units, lowered, substrate_index};

/// One load step.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// Title of the case.
    pub title: String,
    /// The step.
    pub step: Step,
    /// What is read off it.
    pub reading: Reading,
    /// What it takes up of the strengths, where there are any.
    pub strength: Vec<Utilisation>,
    /// What fails at this load, where that was looked for.
    pub failing: Option<Criterion>,
    /// What lengths and pressures are measured in.
    pub units: Units,
}

impl Snapshot {
    /// A step and what is read off it.
    pub fn new(title: &str, step: Step, reading: Reading) -> Self {
        let units = Units::of(step.problem());
        Self { title: title.to_owned(), step, reading, strength: Vec::new(), failing: None, units }
    }

    /// With units that have names.
    #[must_use]
    pub fn with_units(self, units: Units) -> Self {
        Self { units, ..self }
    }

    /// With what it takes up of the strengths.
    #[must_use]
    pub fn with_strength(self, strength: Vec<Utilisation>) -> Self {
        Self { strength, ..self }
    }

    /// At the limit load of a criterion.
    #[must_use]
    pub fn at_limit_of(self, criterion: Criterion) -> Self {
        Self { failing: Some(criterion), ..self }
    }

    /// The criterion that fails here or else governs: its utilisation is largest.
    pub fn governing(&self) -> Option<Criterion> {
        self.failing.or_else(|| Utilisation::governing(&self.strength).map(|own| own.criterion))
    }

    /// Pressure sample by sample, a₂ fastest.
    pub fn pressures(&self) -> &[f64] {
        self.step.finest().pressures()
    }

    /// Number of levels; 0 for a topography.
    pub fn levels(&self) -> usize {
        self.step.problem().counterbody().levels().len()
    }

    /// Caption: the title, the case's parameters and the load, then what more is to be said.
    pub fn caption(&self, more: &str) -> String {
        let [n1, n2] = self.step.grid().points();
        let load = [
            self.units.pressure_equals("p̄", &[self.reading.mean_pressure]),
            self.units.length_equals("δ", &[self.step.penetration()]),
        ];
        let samples = format!("{n1}\u{a0}×\u{a0}{n2} samples");
        format!("{} {more}", caption(&self.title, self.step.problem(), &self.units, &[load.join(", "), samples]))
    }
}

/// Title and parameters of a case, then what else is to be said about it.
pub fn caption(title: &str, problem: &Problem, units: &Units, more: &[String]) -> String {
    let title = title.trim_end_matches('.');
    let title = if title.is_empty() { String::new() } else { format!("{title}. ") };
    let parts = [materials(problem.half_space(), units)]
        .into_iter()
        .chain(geometry(problem.counterbody(), units))
        .chain(problem.friction().map(sliding))
        .chain(more.iter().cloned());
    format!("{title}{}.", parts.collect::<Vec<_>>().join("; "))
}

fn materials(half_space: &HalfSpace, units: &Units) -> String {
    let substrate = half_space.substrate();
    let single = half_space.layers().len() == 1;
    let mut parts = Vec::new();
    for (number, layer) in (1..).zip(half_space.layers()) {
        let index = lowered(number);
        let own = if single { "" } else { &index };
        let mut part = [
            equals(&format!("χ{own}"), &[layer.material().shear() / substrate.shear()]),
            units.length_equals(&format!("h{own}"), &[layer.thickness()]),
            equals(&format!("ν{index}"), &[layer.material().poisson()]),
        ]
        .join(", ");
        if layer.residual_stress() != 0.0 {
            part += &format!(", {}", units.pressure_equals(&format!("σᵣ{own}"), &[layer.residual_stress()]));
        }
        match layer.interface() {
            Interface::Bonded => {}
            Interface::Frictionless => part += ", frictionless below",
            Interface::Spring { .. } => part += ", springs below",
        }
        parts.push(part);
    }
    let index = substrate_index(half_space);
    let mut last = equals(&format!("ν{index}"), &[substrate.poisson()]);
    if !matches!(units.pressure(), Unit::Relative(_)) {
        last += &format!(", {}", units.pressure_equals(&format!("E{index}"), &[substrate.young()]));
    }
    parts.push(last);
    parts.join(if single { ", " } else { "; " })
}

fn sliding(friction: &Friction) -> String {
    let angle = degrees(friction.direction());
    let uncoupled = if friction.is_coupled() { "" } else { ", uncoupled" };
    format!("sliding at {angle} from the x axis, {}{uncoupled}", equals("μ", &[friction.coefficient()]))
}

fn geometry(counterbody: &Counterbody, units: &Units) -> Option<String> {
    let indenters = counterbody.indenters()?;
    let levels = indenters.levels();
    let mut parts = Vec::new();
    if *units.length() != Unit::Relative("l".to_owned()) {
        parts.push(units.length_equals("l", &[indenters.lattice().period()]));
    }
    let radius = |level: &Level| match level.shape() {
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => Some(radius),
        _ => None,
    };
    let shape = |level: &Level| match level.shape() {
        Shape::Cone { slope } => format!("cone of slope {}", short(slope)),
        Shape::Power { coefficient, exponent } => format!("{} rⁿ, n = {}", short(coefficient), short(exponent)),
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => {
            format!("{} of {}", level.shape().name(), units.length_equals("r", &[radius]))
        }
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
