//! Labels of quantities on axes and in captions: words, symbol and unit.

use super::number::short;
use crate::case::NamedKey;
use crate::load::LoadQuantity;
use crate::units::{Prefixed, Unit, Units};

/// The label of a quantity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// Words and symbol.
    text: String,
    unit: Unit,
}

impl Label {
    /// The unit with the prefix for numbers of a size.
    pub(super) fn unit(&self, size: f64) -> Prefixed {
        self.unit.prefixed(size)
    }

    /// Words and symbol.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// The label with a value, "thickness of layer 1 = 2 µm".
    pub(super) fn equals(&self, value: f64) -> String {
        let unit = self.unit(value);
        unit.behind(&format!("{}\u{a0}=\u{a0}{}", self.text, short(unit.shown(value))))
    }

    /// The label with the unit alone, for a quantity that is named elsewhere.
    pub(super) fn wordless(&self) -> Self {
        Self { text: String::new(), unit: self.unit.clone() }
    }

    /// Words, symbol and unit.
    pub(super) fn label(&self, unit: &Prefixed) -> String {
        match (self.text.is_empty(), unit.name.is_empty()) {
            (true, _) => unit.name.clone(),
            (false, true) => self.text.clone(),
            (false, false) => format!("{}\u{a0}({})", self.text, unit.name),
        }
    }
}

impl From<&str> for Label {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

impl From<String> for Label {
    fn from(text: String) -> Self {
        Self { text, unit: Unit::None }
    }
}

impl Units {
    pub(super) fn length_of(&self, words: &str, symbol: &str) -> Label {
        label(words, symbol, self.length(), "unit\u{a0}of\u{a0}length")
    }

    pub(super) fn area_of(&self, words: &str, symbol: &str) -> Label {
        label(words, symbol, &self.area(), "unit\u{a0}of\u{a0}area")
    }

    pub(super) fn pressure_of(&self, words: &str, symbol: &str) -> Label {
        label(words, symbol, self.pressure(), "unit\u{a0}of\u{a0}E")
    }

    /// The quantity of loads, with its words.
    pub(super) fn load_of(&self, words: &str) -> Label {
        let (name, symbol) = (self.quantity().name(), self.quantity().symbol());
        let words = if words.is_empty() { name.to_owned() } else { format!("{words}, {name}") };
        match self.quantity() {
            LoadQuantity::MeanPressure => self.pressure_of(&words, symbol),
            LoadQuantity::Force => label(&words, symbol, &self.force(), "unit\u{a0}of\u{a0}force"),
        }
    }

    /// The key of a case, with its words.
    pub(super) fn key_of(&self, key: &NamedKey) -> Label {
        let text = match (key.unit(self), key.unknown_unit()) {
            (Unit::Relative(to), _) => format!("{}\u{a0}/\u{a0}{to}", key.words),
            (Unit::None, Some(unknown)) => format!("{}\u{a0}({unknown})", key.words),
            _ => key.words.clone(),
        };
        Label { text, unit: key.unit(self) }
    }

    /// Loads in a list of parameters, with their symbol.
    pub(super) fn load_equals(&self, values: &[f64]) -> String {
        equals_in(&self.load(), self.quantity().symbol(), values)
    }

    /// Lengths in a list of parameters: h/l = 0.5, h = 3 µm or h = 3.
    pub(super) fn length_equals(&self, symbol: &str, values: &[f64]) -> String {
        equals_in(self.length(), symbol, values)
    }

    /// Pressures in a list of parameters: p̄/E₂ = 0.06, p̄ = 60 MPa or p̄ = 60.
    pub(super) fn pressure_equals(&self, symbol: &str, values: &[f64]) -> String {
        equals_in(self.pressure(), symbol, values)
    }
}

fn label(words: &str, symbol: &str, unit: &Unit, unknown: &str) -> Label {
    let symbol = match unit {
        Unit::None => format!("{symbol}\u{a0}({unknown})"),
        Unit::Relative(to) => format!("{symbol}/{to}"),
        Unit::Named(_) | Unit::Si { .. } => symbol.to_owned(),
    };
    let text = match (words.is_empty(), symbol.is_empty()) {
        (true, _) => symbol,
        (false, true) => words.to_owned(),
        (false, false) => format!("{words} {symbol}"),
    };
    Label { text, unit: unit.clone() }
}

fn equals_in(unit: &Unit, symbol: &str, values: &[f64]) -> String {
    let prefixed = unit.suited(values.iter().copied());
    let shown: Vec<f64> = values.iter().map(|&x| prefixed.shown(x)).collect();
    match unit {
        Unit::Relative(to) => equals(&format!("{symbol}/{to}"), &shown),
        // Zero needs no unit.
        _ if values.iter().all(|x| *x == 0.0) => equals(symbol, &shown),
        _ => prefixed.behind(&equals(symbol, &shown)),
    }
}

/// A symbol and its values; no line break separates the symbol from the first value.
pub(super) fn equals(symbol: &str, values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|&x| short(x)).collect();
    format!("{}\u{a0}=\u{a0}{}", symbol.replace(' ', "\u{a0}"), values.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::Lattice;
    use crate::problem::Problem;

    fn units(young: f64) -> Units {
        let levels = vec![Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap()];
        let indenters = Indenters::new(Lattice::square(young, 1).unwrap(), levels).unwrap();
        let half_space = HalfSpace::new(vec![], Material::from_young(young, 0.3).unwrap());
        Units::of(&Problem::new(indenters, half_space))
    }

    fn plain(text: &str) -> String {
        text.replace('\u{a0}', " ")
    }

    #[test]
    fn axes_have_the_prefix_with_which_their_numbers_read_well() {
        let si = units(2.0).named(Some("m"), Some("Pa"));
        let named = |quantity: Label, size: f64| {
            let unit = quantity.unit(size);
            (plain(&quantity.label(&unit)), unit.shown(size))
        };
        assert_eq!(named(si.length_of("contact radius", "a"), 20e-6).0, "contact radius a (µm)");
        let (label, shown) = named(si.pressure_of("", "p"), 3e7);
        assert!(label == "p (MPa)" && (shown - 30.0).abs() < 1e-9, "{label} {shown}");
        assert_eq!(named(units(1.0).pressure_of("pressure", "p"), 1e-9).0, "pressure p/E");
        assert_eq!(named(units(2.0).pressure_of("pressure", "p"), 1e9).0, "pressure p (unit of E)");
        assert_eq!(named(units(2.0).named(None, Some("psi")).pressure_of("", "p"), 1e9).0, "p (psi)");
    }

    #[test]
    fn captions_have_units_behind_numbers() {
        let si = units(2.0).named(Some("m"), Some("Pa"));
        assert_eq!(plain(&si.pressure_equals("E₂", &[2.1e11])), "E₂ = 210 GPa");
        assert_eq!(plain(&si.length_equals("Δₘ", &[1e-7, 2e-7])), "Δₘ = 100, 200 nm");
        assert_eq!(plain(&si.length_equals("s", &[0.0])), "s = 0");
        assert_eq!(plain(&units(1.0).pressure_equals("p̄", &[0.06])), "p̄/E = 0.06");
        assert_eq!(plain(&units(2.0).pressure_equals("p̄", &[6e7])), "p̄ = 6×10⁷");
    }
}
