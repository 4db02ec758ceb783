//! Labels of quantities on axes and in captions: words, symbol and unit.

use super::number::short;
use percoat_common::unit::{Prefixed, Unit};

/// The label of a quantity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// Words and symbol.
    text: String,
    unit: Unit,
}

impl Label {
    /// A label of any words with a unit that stands behind them.
    pub fn new(text: String, unit: Unit) -> Self {
        Self { text, unit }
    }

    /// The label of a quantity by words and symbol; without a unit's name `unknown` says in what its numbers are.
    pub fn of(words: &str, symbol: &str, unit: &Unit, unknown: &str) -> Self {
        let symbol = match unit {
            Unit::None => format!("{symbol}\u{a0}({unknown})"),
            Unit::Relative(to) => format!("{symbol}/{to}"),
            Unit::Named(_) | Unit::Si { .. } | Unit::Strain => symbol.to_owned(),
        };
        let text = match (words.is_empty(), symbol.is_empty()) {
            (true, _) => symbol,
            (false, true) => words.to_owned(),
            (false, false) => format!("{words} {symbol}"),
        };
        Self { text, unit: unit.clone() }
    }

    /// The unit with the prefix for numbers of a size.
    pub fn unit(&self, size: f64) -> Prefixed {
        self.unit.prefixed(size)
    }

    /// Words and symbol.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The label with a value, "thickness of layer 1 = 2 µm".
    pub fn equals(&self, value: f64) -> String {
        let unit = self.unit(value);
        unit.behind(&format!("{}\u{a0}=\u{a0}{}", self.text, short(unit.shown(value))))
    }

    /// The label with the unit alone, for a quantity that is named elsewhere.
    pub fn wordless(&self) -> Self {
        Self { text: String::new(), unit: self.unit.clone() }
    }

    /// Words, symbol and unit.
    pub fn label(&self, unit: &Prefixed) -> String {
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

/// A symbol and its values; no line break separates the symbol from the first value.
pub fn equals(symbol: &str, values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|&x| short(x)).collect();
    format!("{}\u{a0}=\u{a0}{}", symbol.replace(' ', "\u{a0}"), values.join(", "))
}
