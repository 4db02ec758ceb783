//! A unit by its name, and with the prefix that suits a number.
//!
//! For an SI unit with its prefix (m, mm, µm, nm; Pa … TPa) axes, tables and captions take the prefix with which their numbers
//! read well, 2.1·10¹¹ Pa as 210 GPa. Any other name is written behind unchanged numbers.

use super::measure::{Measure, PREFIXES};
use std::ops::RangeInclusive;

/// Lengths, moduli, pressures and wavenumbers whose products double precision carries.
///
/// Results are products of up to five of a case's lengths and moduli and of their squares: between 1e-60 and 1e60 none of
/// them overflows or vanishes.
pub const CARRIED: RangeInclusive<f64> = 1e-60..=1e60;

/// A unit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unit {
    /// No unit, of a number without dimension or of unknown unit.
    None,
    /// A quantity of the case, by its symbol.
    Relative(String),
    /// A name that is not of an SI unit.
    Named(String),
    /// An SI unit times a power of ten.
    Si {
        /// Symbol of the unit without prefix.
        base: &'static str,
        /// The power of ten.
        exponent: i32,
    },
    /// A strain, as microstrain or in per cent.
    Strain,
}

/// A unit with the prefix that suits numbers of some size.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Prefixed {
    /// Name of the unit; empty where there is none.
    pub name: String,
    /// The numbers shown are those of the case times ten to this power.
    pub exponent: i32,
}

/// Strains below this are shown as microstrain.
const MOST_MICROSTRAIN: f64 = 2e-3;
/// Whether a name is that of a length.
pub fn is_length(name: &str) -> bool {
    Measure::like(name, Measure::METRE).is_some()
}

/// Whether a name is that of a pressure.
pub fn is_pressure(name: &str) -> bool {
    Measure::like(name, Measure::PASCAL).is_some()
}

/// Pascals of a unit of pressure by its name; `None` for a name that is not known.
pub fn pascals(name: &str) -> Option<f64> {
    Measure::of(name)?.convert(1.0, Measure::PASCAL)
}

/// Whether a name is that of a force.
pub fn is_force(name: &str) -> bool {
    Measure::like(name, Measure::NEWTON).is_some()
}

impl Unit {
    /// The unit of a name, which may be an SI unit `base` with a prefix.
    pub fn called(name: &str, base: &'static str) -> Self {
        // The letters mu and u are written for the sign.
        let prefix = name.strip_suffix(base).map(|prefix| if ["u", "μ"].contains(&prefix) { "µ" } else { prefix });
        match prefix.and_then(|prefix| PREFIXES.iter().position(|known| *known == prefix)) {
            Some(place) => Self::Si { base, exponent: 3 * place as i32 - 12 },
            None => Self::Named(name.to_owned()),
        }
    }

    /// Name of the unit; `None` for numbers without one and for strains.
    pub fn name(&self) -> Option<String> {
        match self {
            Self::None | Self::Relative(_) | Self::Strain => None,
            Self::Named(name) => Some(name.clone()),
            Self::Si { base, exponent } if exponent.abs() <= 12 => Some(si(base, *exponent)),
            // No prefix goes so far.
            Self::Si { base, exponent } => Some(format!("1e{exponent}\u{a0}{base}")),
        }
    }

    /// The unit with the prefix for numbers up to `size`: unchanged for lengths and pressures from 0.01 to 9999, and for what follows from
    /// them, as forces, from 0.1 to 1000. A strain is one of microstrain below 0.2 %.
    pub fn prefixed(&self, size: f64) -> Prefixed {
        let unprefixed = || Prefixed { name: self.name().unwrap_or_default(), exponent: 0 };
        let Self::Si { base, exponent } = *self else {
            return match (self, size.abs() < MOST_MICROSTRAIN) {
                (Self::Strain, true) => Prefixed { name: "µε".to_owned(), exponent: 6 },
                (Self::Strain, false) => Prefixed { name: "%".to_owned(), exponent: 2 },
                _ => unprefixed(),
            };
        };
        // Users have chosen the units of lengths and pressures; those of forces and energies follow from both.
        let unchanged = if ["m", "Pa"].contains(&base) { 0.01..9999.5 } else { 0.1..999.95 };
        let reads_well = !size.is_normal() || unchanged.contains(&size.abs());
        // A force of small units may lie below all prefixes.
        if reads_well && exponent.abs() <= 12 {
            return unprefixed();
        }
        let size = if size.is_normal() { size.abs() } else { 1.0 };
        let magnitude = (size * (1.0 + 1e-12)).log10().floor() as i32 + exponent;
        let prefix = (magnitude.div_euclid(3) * 3).clamp(-12, 12);
        Prefixed { name: si(base, prefix), exponent: exponent - prefix }
    }

    /// The unit with the prefix for all of these numbers, of which the largest decides.
    pub fn suited(&self, numbers: impl IntoIterator<Item = f64>) -> Prefixed {
        self.prefixed(numbers.into_iter().map(f64::abs).filter(|x| x.is_finite()).fold(0.0, f64::max))
    }

    /// A number with its unit, as `text` writes the number.
    pub fn with_unit(&self, x: f64, text: impl Fn(f64) -> String) -> String {
        self.prefixed(x).with_unit(x, text)
    }
}

impl Prefixed {
    /// A number of the case as it is shown.
    pub fn shown(&self, x: f64) -> f64 {
        if self.exponent < 0 { x / 10f64.powi(-self.exponent) } else { x * 10f64.powi(self.exponent) }
    }

    /// A name with this unit: "mean pressure (GPa)", or the name alone.
    pub fn headed(&self, name: &str) -> String {
        if self.name.is_empty() { name.to_owned() } else { format!("{name} ({})", self.name) }
    }

    /// A number of the case with this unit, as `text` writes the number that is shown.
    pub fn with_unit(&self, x: f64, text: impl Fn(f64) -> String) -> String {
        self.behind(&text(self.shown(x)))
    }

    /// A text with this unit behind it, from which no line break parts it.
    pub fn behind(&self, text: &str) -> String {
        if self.name.is_empty() { text.to_owned() } else { format!("{text}\u{a0}{}", self.name) }
    }
}

/// An SI unit with the prefix of a power of ten.
fn si(base: &str, exponent: i32) -> String {
    format!("{}{base}", PREFIXES[((exponent + 12) / 3).clamp(0, 8) as usize])
}

/// A number as an index.
pub fn lowered(number: usize) -> String {
    let digit = |c: char| ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'][c.to_digit(10).unwrap_or(0) as usize];
    number.to_string().chars().map(digit).collect()
}
