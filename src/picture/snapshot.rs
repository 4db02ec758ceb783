//! A solved load step with what is known about it: what the pictures of fields are drawn from.

use super::axis::{power, signed};
use super::units::{Units, lowered, substrate_index};
use crate::body::{HalfSpace, Interface};
use crate::counterbody::{Counterbody, Level, Shape};
use crate::friction::Friction;
use crate::problem::Problem;
use crate::reading::{Criterion, Reading, Utilisation};
use crate::spectral::Step;

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
            equals(&self.units.pressure_symbol("p̄"), &[self.reading.mean_pressure]),
            equals(&self.units.length_symbol("δ"), &[self.step.penetration()]),
        ];
        let samples = format!("{n1}\u{a0}×\u{a0}{n2} samples");
        format!("{} {more}", caption(&self.title, self.step.problem(), &[load.join(", "), samples]))
    }
}

/// Title and parameters of a case, then what else is to be said about it.
pub fn caption(title: &str, problem: &Problem, more: &[String]) -> String {
    let units = Units::of(problem);
    let title = title.trim_end_matches('.');
    let title = if title.is_empty() { String::new() } else { format!("{title}. ") };
    let parts = [materials(problem.half_space(), &units)]
        .into_iter()
        .chain(geometry(problem.counterbody(), &units))
        .chain(problem.friction().map(sliding))
        .chain(more.iter().cloned());
    format!("{title}{}.", parts.collect::<Vec<_>>().join("; "))
}

/// A symbol and its values, which no line break parts from the first one.
pub fn equals(symbol: &str, values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|&x| short(x)).collect();
    format!("{}\u{a0}=\u{a0}{}", symbol.replace(' ', "\u{a0}"), values.join(", "))
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
            equals(&units.length_symbol(&format!("h{own}")), &[layer.thickness()]),
            equals(&format!("ν{index}"), &[layer.material().poisson()]),
        ]
        .join(", ");
        if layer.residual_stress() != 0.0 {
            part += &format!(", {}", equals(&units.pressure_symbol(&format!("σᵣ{own}")), &[layer.residual_stress()]));
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
    if units.pressure_symbol("E") == "E" {
        last += &format!(", {}", equals(&format!("E{index}"), &[substrate.young()]));
    }
    parts.push(last);
    parts.join(if single { ", " } else { "; " })
}

fn sliding(friction: &Friction) -> String {
    let [x, y] = friction.direction();
    // No minus before a zero.
    let angle = y.atan2(x).to_degrees().round() + 0.0;
    let uncoupled = if friction.is_coupled() { "" } else { ", uncoupled" };
    format!("sliding at {angle:.0}° from the x axis, {}{uncoupled}", equals("μ", &[friction.coefficient()]))
}

fn geometry(counterbody: &Counterbody, units: &Units) -> Option<String> {
    let indenters = counterbody.indenters()?;
    let levels = indenters.levels();
    let mut parts = Vec::new();
    let l = units.length_symbol("l");
    if l != "l/l" {
        parts.push(equals(&l, &[indenters.lattice().period()]));
    }
    let radius = |level: &Level| match level.shape() {
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => Some(radius),
        _ => None,
    };
    let shape = |level: &Level| match level.shape() {
        Shape::Cone { slope } => format!("cone of slope {}", short(slope)),
        Shape::Power { coefficient, exponent } => format!("{}·rⁿ, n = {}", short(coefficient), short(exponent)),
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => {
            format!("{} of {}", level.shape().name(), equals(&units.length_symbol("r"), &[radius]))
        }
    };
    match levels.iter().map(radius).collect::<Option<Vec<f64>>>() {
        Some(radii) => {
            let same = radii.iter().all(|x| *x == radii[0]);
            parts.push(equals(&units.length_symbol("rₘ"), if same { &radii[..1] } else { &radii }));
        }
        None => parts.extend(levels.iter().map(shape)),
    }
    if levels.len() > 1 {
        let symbol = units.length_symbol("(h₁ − hₘ)");
        let bare = symbol.strip_suffix(')').and_then(|symbol| symbol.strip_prefix('(')).unwrap_or(&symbol);
        parts.push(equals(bare, &indenters.drops()[1..]));
    }
    Some(parts.join(", "))
}

/// A number with up to five digits, as print has it.
pub fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{x:.4e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trimmed = |text: &str| {
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text };
        signed(text)
    };
    match exponent {
        -3..6 => trimmed(&format!("{x:.*}", usize::try_from(4 - exponent).unwrap_or(0))),
        _ if trimmed(digits) == "1" => power(exponent),
        _ => format!("{}·{}", trimmed(digits), power(exponent)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_printed_as_a_journal_does() {
        let texts = [0.06, 2.0, -0.055395, 2.1e11, 1e-6, 0.0, 20e-6, 123456.0].map(short);
        assert_eq!(texts, ["0.06", "2", "−0.055395", "2.1·10¹¹", "10⁻⁶", "0", "2·10⁻⁵", "123456"]);
    }
}
