//! Names of keys in words with their units, for axes and legends: `layers.0.thickness` is the "thickness of layer 1", a length.
//!
//! The words are the first ones of the key's meaning, with the place of its table: the meaning says "of the layer", the name of layer 2
//! "of layer 2".

use super::key::{Form, Key, Keys};
use super::unit::Unit;
use crate::case::model::CASE;
use crate::units::{self, Units};

/// Most letters of the words of a meaning; for a longer one the key itself is the name.
const LONG: usize = 48;

/// The name of a key in words, and its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedKey {
    /// The words, "thickness of layer 1".
    pub words: String,
    unit: Unit,
}

impl NamedKey {
    /// The key at a dotted path, items counted from 0; `material` is the name of the material of the section at a path such as
    /// `layers.0`, where it has one. A path that no case has is its own name.
    pub fn new(path: &str, material: impl Fn(&str) -> Option<String>) -> Self {
        let path = path.replace('[', ".").replace(']', "");
        found(&path, material).unwrap_or(Self { words: path, unit: Unit::Pure })
    }

    /// Unit of the key in a case with `units`; [`None`](units::Unit::None) of a pure number, and where it is unknown.
    pub fn unit(&self, units: &Units) -> units::Unit {
        let over = |text: &dyn Fn(String) -> String, unit: &units::Unit| {
            unit.name().map_or(units::Unit::None, |name| units::Unit::Named(text(name)))
        };
        match self.unit {
            Unit::Pure | Unit::LengthToOneMinusN | Unit::AreaCoefficient | Unit::Other(_) => units::Unit::None,
            Unit::Degree => units::Unit::Named("°".to_owned()),
            Unit::Length => units.length().clone(),
            Unit::Time => units.time().clone(),
            Unit::Velocity => units.velocity(),
            Unit::Pressure => units.pressure().clone(),
            Unit::Force => units.force(),
            Unit::PressureTimesLength => units.energy_per_area(),
            Unit::PerPressure => over(&|name| format!("1/{name}"), units.pressure()),
            Unit::PressurePerLength => {
                let length = units.length().name();
                let per = length.map(|length| over(&|name| format!("{name}/{length}"), units.pressure()));
                per.unwrap_or(units::Unit::None)
            }
        }
    }

    /// Words in the place of a unit that is not known; `None` of a pure number.
    pub fn unknown_unit(&self) -> Option<String> {
        self.unit.is_converted().then(|| format!("unit\u{a0}of\u{a0}{}", self.unit.quantity()))
    }
}

fn found(path: &str, material: impl Fn(&str) -> Option<String>) -> Option<NamedKey> {
    let (mut keys, mut place, mut last): (&Keys, Vec<String>, Option<&'static Key>) = (&CASE, Vec::new(), None);
    let mut walked = String::new();
    let mut parts = path.split('.');
    while let Some(part) = parts.next() {
        let key = keys.get(part).or_else(|| last.filter(|_| part.parse::<usize>().is_ok()))?;
        walked = format!("{walked}.{part}").trim_start_matches('.').to_owned();
        if let [Form::Sections(..)] = key.forms {
            let index: usize = parts.next()?.parse().ok()?;
            walked = format!("{walked}.{index}");
            let number = format!("{} {}", part.trim_end_matches('s'), index + 1);
            place.insert(0, material(&walked).map_or(number.clone(), |name| format!("{name}, {number}")));
        } else if ["substrate", "counterbody"].contains(&part) {
            place.insert(0, format!("the {part}"));
        }
        (keys, last) = (key.holds(), Some(key));
    }
    let key = last?;
    let place = place.join(" of ");
    let meaning = first_words(key.what);
    let meaning = if meaning.chars().count() > LONG { key.name.replace('_', " ") } else { meaning };
    let words = match place.is_empty() {
        true => meaning,
        false if meaning.contains("the layer") => meaning.replace("the layer", &place),
        false => format!("{meaning} of {place}"),
    };
    Some(NamedKey { words, unit: key.unit })
}

/// A meaning without its article, up to its first stop; without the names of files or keys in it.
fn first_words(what: &str) -> String {
    let end = what.find([',', ':', ';', '(']).unwrap_or(what.len());
    let mut words = what[..end].trim();
    if let Some(mark) = words.find('`') {
        words = words[..mark].trim_end().rsplit_once(' ').map_or("", |(before, _)| before);
    }
    let bare = ["the ", "a ", "an "].iter().find_map(|article| words.strip_prefix(article));
    bare.unwrap_or(words).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_have_names_in_words_with_their_place_and_unit() {
        let units = Units::unknown().named(Some("µm"), Some("GPa"));
        let named = |path: &str| {
            let key = NamedKey::new(path, |section| (section == "layers.1").then(|| "CrN".to_owned()));
            (key.words.clone(), key.unit(&units).name().unwrap_or_default())
        };
        for (path, words, unit) in [
            ("layers.0.thickness", "thickness of layer 1", "µm"),
            ("layers[1].thickness", "thickness of CrN, layer 2", "µm"),
            ("layers.1.young", "Young's modulus of CrN, layer 2", "GPa"),
            ("layers.0.interface", "interface below layer 1", ""),
            (
                "layers.0.interface.tangential_stiffness",
                "stiffness of the interface against sliding of layer 1",
                "GPa/µm",
            ),
            ("layers.0.material", "material of layer 1", ""),
            ("layers.0.wear", "Archard's coefficient of wear k of layer 1", "1/GPa"),
            ("substrate.yield_strength", "yield strength of the substrate", "GPa"),
            ("counterbody.poisson", "Poisson's ratio of the counterbody", ""),
            ("counterbody.layers.0.thickness", "thickness of layer 1 of the counterbody", "µm"),
            ("levels.2.radius", "radius at the apex of level 3", "µm"),
            ("friction.coefficient", "coefficient of friction μ", ""),
            ("load.mean_pressure", "mean pressure p̄", "GPa"),
            ("load.force", "force P on one cell", "mN"),
            ("lattice.period", "period", "µm"),
            ("no.such.key", "no.such.key", ""),
        ] {
            assert_eq!(named(path), (words.to_owned(), unit.to_owned()), "{path}");
        }
    }

    #[test]
    fn a_length_without_a_name_is_said_to_be_one() {
        let key = |path: &str| NamedKey::new(path, |_| None).unknown_unit();
        assert_eq!(key("layers.0.thickness").as_deref(), Some("unit\u{a0}of\u{a0}length"));
        assert_eq!(key("friction.coefficient"), None);
    }
}
