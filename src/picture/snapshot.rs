//! A solved load step with what is known about it: what the pictures of fields are drawn from.

use super::axis::{power, signed};
use super::units::{Units, lowered, period, substrate_index};
use crate::grid::Grid;
use crate::hierarchy::{Hierarchy, Solution};
use crate::indenter::{Shape, drops};
use crate::material::{HalfSpace, Interface};
use crate::observables::{Boundary, boundaries};
use crate::texture::{Surface, Texture};

/// One load step.
#[derive(Debug, Clone)]
pub struct Snapshot<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The counterbody.
    pub surface: &'a Surface,
    /// Coating and substrate.
    pub half_space: &'a HalfSpace,
    /// The finest grid.
    pub grid: &'a Grid,
    /// The counterbody's surface on it.
    pub texture: &'a Texture,
    /// Pressure, one value per sample, a₂ fastest.
    pub pressure: &'a [f64],
    /// Mean pressure p̄.
    pub mean_pressure: f64,
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Per site, the boundary of its contact where it has one; empty for a topography.
    pub boundaries: Vec<Option<Boundary>>,
    /// What lengths and pressures are measured in.
    pub units: Units,
}

impl<'a> Snapshot<'a> {
    /// The load step that `hierarchy` solved last.
    pub fn new(
        title: &'a str,
        surface: &'a Surface,
        half_space: &'a HalfSpace,
        hierarchy: &'a Hierarchy,
        solution: &'a Solution,
    ) -> Self {
        Self {
            title,
            surface,
            half_space,
            grid: hierarchy.grid(),
            texture: hierarchy.texture(),
            pressure: &solution.pressure,
            mean_pressure: crate::field::mean(&solution.pressure),
            penetration: solution.penetration,
            boundaries: boundaries(hierarchy, solution),
            units: Units::of(surface, half_space),
        }
    }

    /// Number of levels; 0 for a topography.
    pub fn levels(&self) -> usize {
        self.surface.levels()
    }

    /// Index of the first site of a level (from 1).
    pub fn site_of(&self, level: usize) -> Option<usize> {
        self.texture.sites.iter().position(|site| site.level == level)
    }

    /// Largest sample of the pressure.
    pub fn max_pressure(&self) -> f64 {
        self.pressure.iter().copied().fold(0.0, f64::max)
    }

    /// Caption: the title, the case's parameters and the load.
    pub fn caption(&self) -> Vec<String> {
        let mut lines = caption(self.title, self.surface, self.half_space);
        let [n1, n2] = self.grid.points();
        lines.push(format!(
            "{} = {}, {} = {}; {n1} × {n2} samples.",
            self.units.pressure_symbol("p̄"),
            short(self.mean_pressure),
            self.units.length_symbol("δ"),
            short(self.penetration)
        ));
        lines
    }
}

/// Title and parameters of a case, line by line.
pub fn caption(title: &str, surface: &Surface, half_space: &HalfSpace) -> Vec<String> {
    let units = Units::of(surface, half_space);
    let mut lines = Vec::new();
    if !title.is_empty() {
        lines.push(format!("{}.", title.trim_end_matches('.')));
    }
    lines.push(format!("{}.", materials(half_space, &units)));
    if let Some(geometry) = geometry(surface, &units) {
        lines.push(format!("{geometry}."));
    }
    lines
}

fn materials(half_space: &HalfSpace, units: &Units) -> String {
    let substrate = half_space.substrate();
    let single = half_space.layers().len() == 1;
    let mut parts = Vec::new();
    for (number, layer) in (1..).zip(half_space.layers()) {
        let index = lowered(number);
        let (chi, h) =
            if single { ("χ".to_owned(), "h".to_owned()) } else { (format!("χ{index}"), format!("h{index}")) };
        let mut part = format!(
            "{chi} = {}, {} = {}, ν{index} = {}",
            short(layer.material().shear() / substrate.shear()),
            units.length_symbol(&h),
            short(layer.thickness()),
            short(layer.material().poisson())
        );
        match layer.interface() {
            Interface::Bonded => {}
            Interface::Frictionless => part += ", frictionless below",
            Interface::Spring { .. } => part += ", springs below",
        }
        parts.push(part);
    }
    let index = substrate_index(half_space);
    let mut last = format!("ν{index} = {}", short(substrate.poisson()));
    if units.pressure_symbol("E") == "E" {
        last += &format!(", E{index} = {}", short(substrate.young()));
    }
    parts.push(last);
    parts.join(if single { ", " } else { "; " })
}

fn geometry(surface: &Surface, units: &Units) -> Option<String> {
    let Surface::Indenters { levels, .. } = surface else { return None };
    let list = |values: &[f64]| {
        let same = values.iter().all(|x| *x == values[0]);
        let shown = if same { &values[..1] } else { values };
        shown.iter().map(|&x| short(x)).collect::<Vec<_>>().join(", ")
    };
    let mut parts = Vec::new();
    let l = units.length_symbol("l");
    if l != "l/l" {
        parts.extend(period(surface).map(|period| format!("{l} = {}", short(period))));
    }
    let radii: Option<Vec<f64>> = levels
        .iter()
        .map(|level| match level.shape() {
            Shape::Paraboloid { radius } | Shape::Sphere { radius } => Some(radius),
            _ => None,
        })
        .collect();
    parts.push(match radii {
        Some(radii) => format!("{} = {}", units.length_symbol("rₘ"), list(&radii)),
        None => levels.iter().map(|level| level.shape().to_string()).collect::<Vec<_>>().join(", "),
    });
    if levels.len() > 1 {
        let drops: Vec<f64> = drops(levels)[1..].to_vec();
        let symbol = units.length_symbol("(h₁ − hₘ)");
        parts.push(format!("{symbol} = {}", drops.iter().map(|&x| short(x)).collect::<Vec<_>>().join(", ")));
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
