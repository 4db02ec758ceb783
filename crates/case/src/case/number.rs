//! Numbers of a case by their dotted keys, as `layers.0.young`, and the ranges that materials state for them.

use super::Case;
use super::materials::{GPA, LibraryMaterial, library, materials_of_file};
use super::model::CASE;
use super::overrides::parts;
use crate::units::pascals;
use serde_json::{Value, json};
use std::path::Path;

/// Why there is no range of the material of a key.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoRange {
    /// The section of the key names no material of the library or of the case's file.
    #[error("the section of `{0}` names no `material` of the library")]
    NoMaterial(String),
    /// The material has no range for the key.
    #[error("the library states no range of `{key}` for {material}: `percoat materials {material}` has what it states")]
    NotStated {
        /// Last part of the key.
        key: String,
        /// Name of the material.
        material: String,
    },
}

impl Case {
    /// The number at a dotted key, items counted from 0; of loads their only one. `None` where none stands, and of whole numbers.
    pub fn number(&self, key: &str) -> Option<f64> {
        let path: Vec<&str> = parts(key).collect();
        CASE.range(&path.join("."))?;
        match json!(self).pointer(&format!("/{}", path.join("/")))? {
            Value::Array(items) => items.first().filter(|_| items.len() == 1).and_then(Value::as_f64),
            value => value.as_f64(),
        }
    }

    /// Lowest and highest value that the material of its section has in the library, or in the case's file of materials, for the
    /// number at a dotted key; in the unit of the case.
    ///
    /// # Errors
    /// [`NoRange`].
    pub fn material_range(&self, key: &str) -> Result<[f64; 2], NoRange> {
        let path: Vec<&str> = parts(key).collect();
        let none = || NoRange::NoMaterial(key.to_owned());
        let (&property, section) = path.split_last().ok_or_else(none)?;
        let case = json!(self);
        let name =
            case.pointer(&format!("/{}/material", section.join("/"))).and_then(Value::as_str).ok_or_else(none)?;
        let file = self.materials.as_ref().and_then(|path| materials_of_file(Path::new(path)).ok()).unwrap_or_default();
        let is_it = |material: &&LibraryMaterial| material.is_called(name);
        let material = file.iter().find(is_it).or_else(|| library().iter().find(is_it)).ok_or_else(none)?;
        let range = material.property(property).and_then(|property| property.range);
        let not_stated = || NoRange::NotStated { key: property.to_owned(), material: name.to_owned() };
        let pressure = case["units"]["pressure"].as_str().and_then(pascals);
        let factor = if property == "poisson" { Some(1.0) } else { pressure.map(|pascals| GPA / pascals) };
        range.zip(factor).map(|(ends, factor)| ends.map(|end| end * factor)).ok_or_else(not_stated)
    }
}

#[cfg(test)]
mod tests {
    use super::super::embedded;
    use super::*;

    fn case(set: &[&str]) -> Case {
        let set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
        Case::read(&embedded::source("ball-on-disc").unwrap(), &set).unwrap()
    }

    #[test]
    fn a_number_has_a_key_and_a_list_of_one_load_is_one() {
        let case = case(&["load.force=5 N", "friction.coefficient=0.2"]);
        for (key, number) in [
            ("layers.0.thickness", Some(3.0)),
            ("layers[0].thickness", Some(3.0)),
            ("load.force", Some(5000.0)),
            ("friction.coefficient", Some(0.2)),
            ("counterbody.young", Some(207.0)),
            ("grid.points", None),
            ("layers.1.thickness", None),
            ("title", None),
            ("", None),
        ] {
            assert_eq!(case.number(key), number, "{key}");
        }
        assert_eq!(self::case(&["load.force=[1, 2]"]).number("load.force"), None);
    }

    /// 100Cr6 has 190 to 213 GPa in the library.
    #[test]
    fn the_range_of_a_material_is_in_the_unit_of_the_case() {
        let in_unit = |unit: &str| case(&[&format!("units.pressure={unit}"), "load.force=1e-3"]);
        assert_eq!(case(&[]).material_range("counterbody.young"), Ok([190.0, 213.0]));
        let [low, high] = in_unit("MPa").material_range("counterbody.young").unwrap();
        assert!((low / 190e3 - 1.0).abs() < 1e-12 && (high / 213e3 - 1.0).abs() < 1e-12);
        assert_eq!(in_unit("MPa").material_range("counterbody.poisson"), Ok([0.27, 0.3]));
    }

    #[test]
    fn a_key_without_a_range_of_a_material_is_told_why() {
        let told = |key: &str| case(&[]).material_range(key).unwrap_err().to_string();
        assert!(told("levels.0.radius").contains("names no `material`"));
        assert!(told("layers.0.thickness").contains("no range of `thickness` for TiAlN"));
        assert!(told("young").contains("names no `material`"));
    }
}
