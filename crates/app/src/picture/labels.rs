//! Labels of quantities in the units of a case.

use percoat_case::case::NamedKey;
use percoat_case::units::{Unit, Units};
use percoat_core::load::LoadQuantity;
use percoat_core::quantity::{Kind, Named};
use percoat_draw::Label;
use percoat_draw::label::equals;

/// Labels of quantities, lengths, pressures and loads in the units of a case.
pub trait Labels {
    fn length_of(&self, words: &str, symbol: &str) -> Label;
    fn pressure_of(&self, words: &str, symbol: &str) -> Label;
    /// A quantity by its name, and its symbol where it has a unit.
    fn label(&self, named: &Named) -> Label;
    /// The quantity of loads, with its words.
    fn load_of(&self, words: &str) -> Label;
    /// The key of a case, with its words.
    fn key_of(&self, key: &NamedKey) -> Label;
    /// Loads in a list of parameters, with their symbol.
    fn load_equals(&self, values: &[f64]) -> String;
    /// Lengths in a list of parameters: h/l = 0.5, h = 3 µm or h = 3.
    fn length_equals(&self, symbol: &str, values: &[f64]) -> String;
    /// Pressures in a list of parameters: p̄/E₂ = 0.06, p̄ = 60 MPa or p̄ = 60.
    fn pressure_equals(&self, symbol: &str, values: &[f64]) -> String;
}

impl Labels for Units {
    fn length_of(&self, words: &str, symbol: &str) -> Label {
        Label::of(words, symbol, self.length(), "unit\u{a0}of\u{a0}length")
    }

    fn pressure_of(&self, words: &str, symbol: &str) -> Label {
        Label::of(words, symbol, self.pressure(), "unit\u{a0}of\u{a0}E")
    }

    fn label(&self, named: &Named) -> Label {
        let Named { name, symbol, kind, .. } = *named;
        let unknown = match kind {
            Kind::Fraction | Kind::Ratio | Kind::Passes | Kind::Utilisation => return name.into(),
            Kind::Temperature => "unit\u{a0}of\u{a0}temperature",
            // The unit of a strain is known in every case.
            Kind::Strain => "",
            Kind::Pressure => "unit\u{a0}of\u{a0}E",
            Kind::Force => "unit\u{a0}of\u{a0}force",
            Kind::Length => "unit\u{a0}of\u{a0}length",
            Kind::Area => "unit\u{a0}of\u{a0}area",
            Kind::Volume => "unit\u{a0}of\u{a0}volume",
            Kind::Energy => "unit\u{a0}of\u{a0}energy",
            Kind::Stiffness => "unit\u{a0}of\u{a0}force\u{a0}per\u{a0}length",
            Kind::Time => "unit\u{a0}of\u{a0}time",
            Kind::PressurePerLength => "unit\u{a0}of\u{a0}E\u{a0}per\u{a0}length",
        };
        Label::of(name, symbol, &self.unit(kind), unknown)
    }

    fn load_of(&self, words: &str) -> Label {
        let (name, symbol) = (self.quantity().name(), self.quantity().symbol());
        let words = if words.is_empty() { name.to_owned() } else { format!("{words}, {name}") };
        match self.quantity() {
            LoadQuantity::MeanPressure => self.pressure_of(&words, symbol),
            LoadQuantity::Force => Label::of(&words, symbol, &self.force(), "unit\u{a0}of\u{a0}force"),
        }
    }

    fn key_of(&self, key: &NamedKey) -> Label {
        let text = match (key.unit(self), key.unknown_unit()) {
            (Unit::Relative(to), _) => format!("{}\u{a0}/\u{a0}{to}", key.words),
            (Unit::None, Some(unknown)) => format!("{}\u{a0}({unknown})", key.words),
            _ => key.words.clone(),
        };
        Label::new(text, key.unit(self))
    }

    fn load_equals(&self, values: &[f64]) -> String {
        equals_in(&self.load(), self.quantity().symbol(), values)
    }

    fn length_equals(&self, symbol: &str, values: &[f64]) -> String {
        equals_in(self.length(), symbol, values)
    }

    fn pressure_equals(&self, symbol: &str, values: &[f64]) -> String {
        equals_in(self.pressure(), symbol, values)
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::{HalfSpace, Material};
    use percoat_core::counterbody::{Indenters, Level, Shape};
    use percoat_core::lattice::Lattice;
    use percoat_core::problem::Problem;

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
