//! Numbers with their unit, as in "12.7 mm", and units as products of powers of newtons and metres: "GPa/µm", "N/mm²", "1/GPa".
//!
//! A factor is a number times a power of ten, so that a decimal prefix shifts digits and changes none: 12.7 mm are 12700 µm.

/// A unit as a product of powers of newtons and metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// The factor of the SI unit is `factor` · 10^`exponent`.
    factor: f64,
    exponent: i32,
    newtons: i32,
    metres: i32,
}

/// Prefixes from 10⁻¹² to 10¹² by thousands.
pub(crate) const PREFIXES: [&str; 9] = ["p", "n", "µ", "m", "", "k", "M", "G", "T"];

/// A pound-force a square inch, Pa.
const PSI: f64 = POUND_FORCE / (0.0254 * 0.0254);

/// Units with SI prefixes: powers of newtons and metres.
const PREFIXED: [(&str, i32, i32); 4] = [("m", 0, 1), ("N", 1, 0), ("Pa", 1, -2), ("J", 1, 1)];

/// Inch, m, without its power of ten.
const INCH: f64 = 2.54;
/// Kilogram-force, N.
const KILOGRAM_FORCE: f64 = 9.806_65;
/// Pound-force, N.
const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// Other units: factor, power of ten, powers of newtons and metres.
const OTHERS: [(&[&str], f64, i32, i32, i32); 16] = [
    (&["cm"], 1.0, -2, 0, 1),
    (&["Å", "Å", "angstrom"], 1.0, -10, 0, 1),
    (&["micron", "microns"], 1.0, -6, 0, 1),
    (&["in", "inch"], INCH, -2, 0, 1),
    (&["mil", "thou"], INCH, -5, 0, 1),
    (&["Nm"], 1.0, 0, 1, 1),
    (&["daN"], 1.0, 1, 1, 0),
    (&["kgf", "kp"], KILOGRAM_FORCE, 0, 1, 0),
    (&["gf"], KILOGRAM_FORCE, -3, 1, 0),
    (&["lbf"], POUND_FORCE, 0, 1, 0),
    (&["hPa"], 1.0, 2, 1, -2),
    (&["bar"], 1.0, 5, 1, -2),
    (&["atm"], 1.013_25, 5, 1, -2),
    (&["psi"], PSI, 0, 1, -2),
    (&["ksi"], PSI, 3, 1, -2),
    (&["Msi"], PSI, 6, 1, -2),
];

impl Measure {
    /// The metre.
    pub const METRE: Self = Self { factor: 1.0, exponent: 0, newtons: 0, metres: 1 };
    /// The square metre.
    pub const SQUARE_METRE: Self = Self { factor: 1.0, exponent: 0, newtons: 0, metres: 2 };
    /// The newton.
    pub const NEWTON: Self = Self { factor: 1.0, exponent: 0, newtons: 1, metres: 0 };
    /// The pascal.
    pub const PASCAL: Self = Self { factor: 1.0, exponent: 0, newtons: 1, metres: -2 };
    /// The pure number 1.
    pub const ONE: Self = Self { factor: 1.0, exponent: 0, newtons: 0, metres: 0 };

    /// The unit of a name, a product or quotient of known units with whole powers; `None` where it is none.
    pub fn of(name: &str) -> Option<Self> {
        let mut terms = name.trim().split('/');
        let numerator = terms.next()?.trim();
        let above = if numerator == "1" { Self::ONE } else { Self::product(numerator)? };
        terms.try_fold(above, |unit, below| {
            let below = below.trim();
            let below = below.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')).unwrap_or(below);
            Some(unit.times(Self::product(below)?.to_the(-1)))
        })
    }

    /// The unit of a name, where it measures the same as another one.
    pub fn like(name: &str, other: Self) -> Option<Self> {
        Self::of(name).filter(|unit| unit.convert(1.0, other).is_some())
    }

    fn product(text: &str) -> Option<Self> {
        let parts = text.split(['·', '*', ' ', '\u{a0}', '⋅']).filter(|part| !part.is_empty());
        let mut units = parts.map(Self::power).peekable();
        units.peek()?;
        units.try_fold(Self::ONE, |product, unit| Some(product.times(unit?)))
    }

    /// A unit with its power: "mm²", "mm^2", "mm2", "m⁻¹".
    fn power(text: &str) -> Option<Self> {
        let digit =
            |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|raised| raised == c).and_then(|n| char::from_digit(n as u32, 10));
        let plain: String = text.chars().map(|c| digit(c).unwrap_or(if c == '⁻' { '-' } else { c })).collect();
        let end = plain.find(|c: char| c == '^' || c == '-' || c.is_ascii_digit()).unwrap_or(plain.len());
        let (symbol, power) = plain.split_at(end);
        let power: i32 = if power.is_empty() { 1 } else { power.trim_start_matches('^').parse().ok()? };
        (1..=9).contains(&power.abs()).then_some(())?;
        Some(Self::symbol(symbol)?.to_the(power))
    }

    fn symbol(symbol: &str) -> Option<Self> {
        let known = OTHERS.iter().find(|(names, ..)| names.contains(&symbol));
        if let Some(&(_, factor, exponent, newtons, metres)) = known {
            return Some(Self { factor, exponent, newtons, metres });
        }
        PREFIXED.iter().find_map(|&(base, newtons, metres)| {
            let prefix = symbol.strip_suffix(base)?;
            // The letters mu and u are written for the sign.
            let prefix = if ["u", "μ"].contains(&prefix) { "µ" } else { prefix };
            let place = PREFIXES.iter().position(|known| *known == prefix)?;
            Some(Self { factor: 1.0, exponent: 3 * place as i32 - 12, newtons, metres })
        })
    }

    fn times(self, other: Self) -> Self {
        Self {
            factor: self.factor * other.factor,
            exponent: self.exponent + other.exponent,
            newtons: self.newtons + other.newtons,
            metres: self.metres + other.metres,
        }
    }

    fn to_the(self, power: i32) -> Self {
        Self {
            factor: self.factor.powi(power),
            exponent: power * self.exponent,
            newtons: power * self.newtons,
            metres: power * self.metres,
        }
    }

    /// Quotient of the unit and another.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        self.times(other.to_the(-1))
    }

    /// Product of the unit and a whole power of another.
    #[must_use]
    pub fn by(self, other: Self, power: i32) -> Self {
        self.times(other.to_the(power))
    }

    /// A number in the unit as one in another; `None` where one measures something else.
    pub fn convert(self, number: f64, to: Self) -> Option<f64> {
        if (self.newtons, self.metres) != (to.newtons, to.metres) {
            return None;
        }
        Some(shifted(number * (self.factor / to.factor), self.exponent - to.exponent))
    }
}

/// A number times a power of ten, as its shortest decimal shifted: 2e-15 times 10⁹ is 2e-6, which a product in binary misses.
fn shifted(number: f64, exponent: i32) -> f64 {
    let decimal = format!("{number:e}");
    let parts = decimal.split_once('e').and_then(|(digits, power)| Some((digits, power.parse::<i32>().ok()?)));
    let moved = parts.and_then(|(digits, power)| format!("{digits}e{}", power + exponent).parse().ok());
    moved.unwrap_or(number)
}

/// The number and the name of the unit of a text such as "12.7 mm", "3µm" or "2e-6 1/GPa"; `None` of a number alone, and where no unit
/// can stand behind a number.
pub fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let end = text.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)))?;
    // Letters and signs at the end belong to the unit where they make no number.
    let number = |end: usize| Some((text.get(..end)?.parse::<f64>().ok()?, text[end..].trim()));
    let (number, unit) = (end.saturating_sub(2)..=end).rev().find_map(number)?;
    (unit.starts_with(char::is_alphabetic) || unit.starts_with("1/")).then_some((number, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn converted(text: &str, to: &str) -> Option<f64> {
        let (number, unit) = split(text)?;
        Measure::of(unit)?.convert(number, Measure::of(to)?)
    }

    #[test]
    fn a_decimal_prefix_changes_no_digit() {
        for (text, to, expected) in [
            ("12.7 mm", "µm", 12700.0),
            ("3 nm", "µm", 0.003),
            ("3µm", "nm", 3000.0),
            ("0.1um", "mm", 0.0001),
            ("20 N", "GPa·µm²", 20000.0),
            ("20N", "mN", 20000.0),
            ("210e3 MPa", "GPa", 210.0),
            ("1.5 N/mm²", "MPa", 1.5),
            ("1.5 N/mm^2", "kPa", 1500.0),
            ("2 bar", "N/mm2", 0.2),
            ("0.5 GPa/µm", "N/mm³", 500_000.0),
            ("2e-15 m²/N", "1/GPa", 2e-6),
            ("1 in", "mm", 25.4),
            ("3 mil", "µm", 76.2),
            ("1 kgf", "N", 9.80665),
            ("7 Å", "nm", 0.7),
            ("-1.5 GPa", "MPa", -1500.0),
            ("4 m⁻¹", "1/mm", 0.004),
            ("1e-6 mm³/(N·m)", "1/GPa", 1e-6),
            ("1e-6 mm³/Nm", "1/MPa", 1e-9),
        ] {
            assert_eq!(converted(text, to), Some(expected), "{text} in {to}");
        }
        // A pound a square inch by its definition.
        assert!((converted("1 ksi", "MPa").unwrap() / 6.894_757_293_168_361 - 1.0).abs() < 1e-15);
        assert!((converted("1 lbf/in²", "psi").unwrap() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn what_measures_something_else_or_nothing_is_not_converted() {
        for (text, to) in [
            ("20 N", "GPa"),
            ("3 µm", "µm²"),
            ("3 furlong", "m"),
            ("3 m^0", "m"),
            ("3 m^99", "m"),
            ("3 m/", "m"),
            ("3 /m", "1/m"),
            ("3 mm mm mm", "mm"),
            ("N", "N"),
            ("3", "m"),
            ("inf m", "m"),
            ("3 1", "m"),
        ] {
            assert_eq!(converted(text, to), None, "{text} in {to}");
        }
        assert_eq!(split("1e3 m"), Some((1000.0, "m")));
        assert_eq!(split("100Cr6"), Some((100.0, "Cr6")));
        for text in ["fine", "210", "2101", "0,05 N", "-10,25", "5", "", "e", "1e", "µm"] {
            assert_eq!(split(text), None, "{text}");
        }
        assert_eq!(
            [split("5eV"), split("3 E"), split("2e-6 1/GPa")],
            [Some((5.0, "eV")), Some((3.0, "E")), Some((2e-6, "1/GPa"))]
        );
    }
}
