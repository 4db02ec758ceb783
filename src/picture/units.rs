//! What the numbers of a case are measured in, as far as the case shows it.
//!
//! Cases take any consistent units. Where the substrate's modulus is 1, pressures are relative to it and are called
//! p/E₂ as in the paper; where the lattice period or the first level's radius is 1, lengths are relative to that.
//! Otherwise the axes say "unit of E" and "unit of length".

use crate::body::HalfSpace;
use crate::counterbody::{Level, Shape};
use crate::problem::Problem;

/// Units of lengths and pressures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Units {
    length: Option<String>,
    pressure: Option<String>,
}

impl Units {
    /// Units of a case.
    pub fn of(problem: &Problem) -> Self {
        let (counterbody, half_space) = (problem.counterbody(), problem.half_space());
        let is_one = |x: f64| (x - 1.0).abs() < 1e-9;
        let length = match counterbody.levels().first().map(Level::shape) {
            Some(_) if counterbody.indenters().is_some_and(|own| is_one(own.lattice().period())) => Some("l"),
            Some(Shape::Paraboloid { radius } | Shape::Sphere { radius }) if is_one(radius) => Some("r₁"),
            _ => None,
        };
        let pressure = is_one(half_space.substrate().young()).then(|| format!("E{}", substrate_index(half_space)));
        Self { length: length.map(str::to_owned), pressure }
    }

    /// The quantity and its symbol, a length, as an axis names it.
    pub fn length(&self, quantity: &str, symbol: &str) -> String {
        named(quantity, symbol, self.length.as_deref(), "unit\u{a0}of\u{a0}length")
    }

    /// The quantity and its symbol, a pressure, as an axis names it.
    pub fn pressure(&self, quantity: &str, symbol: &str) -> String {
        named(quantity, symbol, self.pressure.as_deref(), "unit\u{a0}of\u{a0}E")
    }

    /// The symbol of a length in a list of parameters: h/l or h.
    pub fn length_symbol(&self, symbol: &str) -> String {
        over(symbol, self.length.as_deref())
    }

    /// The symbol of a pressure in a list of parameters: p̄/E₂ or p̄.
    pub fn pressure_symbol(&self, symbol: &str) -> String {
        over(symbol, self.pressure.as_deref())
    }
}

fn over(symbol: &str, unit: Option<&str>) -> String {
    unit.map_or(symbol.to_owned(), |unit| format!("{symbol}/{unit}"))
}

fn named(quantity: &str, symbol: &str, unit: Option<&str>, otherwise: &str) -> String {
    let symbol = unit.map_or(format!("{symbol}\u{a0}({otherwise})"), |unit| format!("{symbol}/{unit}"));
    if quantity.is_empty() { symbol } else { format!("{quantity} {symbol}") }
}

/// Index of the substrate's material as letters carry it: none where there is no coating.
pub fn substrate_index(half_space: &HalfSpace) -> String {
    let layers = half_space.layers().len();
    if layers == 0 { String::new() } else { lowered(layers + 1) }
}

/// A number as an index.
pub fn lowered(number: usize) -> String {
    let digit = |c: char| ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'][c.to_digit(10).unwrap_or(0) as usize];
    number.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Material;
    use crate::counterbody::Indenters;
    use crate::lattice::Lattice;

    #[test]
    fn relative_units_are_recognised() {
        let units = |period: f64, radius: f64, young: f64| {
            let levels = vec![Level::new(Shape::Paraboloid { radius }, 0.0).unwrap(); 3];
            let indenters = Indenters::new(Lattice::hexagonal(period, 3).unwrap(), levels).unwrap();
            let half_space = HalfSpace::new(vec![], Material::from_young(young, 0.3).unwrap());
            Units::of(&Problem::new(indenters, half_space))
        };
        assert_eq!(units(1.0, 0.8, 1.0).length("radius", "a"), "radius a/l");
        assert_eq!(units(0.6, 1.0, 1.0).length("", "x"), "x/r₁");
        assert_eq!(units(0.6, 1.0, 1.0).pressure("pressure", "p"), "pressure p/E");
        let metres = units(2e-5, 8e-5, 2.1e11);
        assert_eq!(metres.length("", "x"), "x\u{a0}(unit\u{a0}of\u{a0}length)");
        assert_eq!(metres.pressure("pressure", "p"), "pressure p\u{a0}(unit\u{a0}of\u{a0}E)");
    }
}
