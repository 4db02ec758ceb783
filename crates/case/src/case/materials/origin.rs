//! Strengths of a case that are numbers of the library, with what is known about them there.
//!
//! A case is written with the numbers that its materials gave: a strength is of the library where it is the number that the library
//! has for the material of its section. So a case that is read back, and one in a result, tell the same.

use super::entry::{LibraryMaterial, Property};
use super::fill::{GPA, rounded};
use super::library::library;
use crate::units::pascals;
use serde::Serialize;
use serde_json::Value;

/// A strength of a case that is a number of the library.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LibraryStrength {
    /// The material of the library.
    pub material: &'static str,
    /// Key of the strength: `yield_strength`, `tensile_strength`.
    pub key: &'static str,
    /// The strength, in the pressure unit of the case.
    pub value: f64,
    /// Lowest and highest value of its sources, in the pressure unit of the case.
    pub range: Option<[f64; 2]>,
    /// Quantity measured, such as the kind of test.
    pub what: Option<&'static str>,
    /// Source of the number.
    pub source: Option<&'static str>,
}

impl LibraryStrength {
    /// The strengths of a serialised case that are numbers of the library, each once, from the surface down; those of the counterbody
    /// last.
    pub fn of_case(case: &Value) -> Vec<Self> {
        let unit = case["units"]["pressure"].as_str();
        let counterbody = &case["counterbody"];
        let layers = |body: &Value| body["layers"].as_array().cloned().unwrap_or_default();
        let mut parts = layers(case);
        parts.push(case["substrate"].clone());
        parts.extend(layers(counterbody));
        parts.push(counterbody.clone());
        let mut all: Vec<Self> = Vec::new();
        for origin in parts.iter().flat_map(|part| Self::of_section(part, unit)) {
            if !all.contains(&origin) {
                all.push(origin);
            }
        }
        all
    }

    /// Strengths of a section of a serialised case that are numbers of the library; `unit` is the pressure unit of the case.
    pub fn of_section(section: &Value, unit: Option<&str>) -> Vec<Self> {
        let (Some(name), Some(pascals)) = (section["material"].as_str(), unit.and_then(pascals)) else {
            return Vec::new();
        };
        let factor = GPA / pascals;
        let Some(material) = library().iter().find(|material| material.is_called(name)) else { return Vec::new() };
        let origin = |(key, property): (&'static str, &'static Property)| {
            let convert = |x: f64| rounded(x * factor);
            let value = section[key].as_f64().filter(|value| *value == convert(property.value))?;
            let Property { range, what, source, .. } = property;
            let (range, [what, source]) = (range.map(|ends| ends.map(convert)), [what, source].map(Option::as_deref));
            Some(Self { material: &material.name, key, value, range, what, source })
        };
        strengths(material).into_iter().filter_map(origin).collect()
    }
}

/// The strengths of a material that a case takes, by their keys.
fn strengths(material: &'static LibraryMaterial) -> Vec<(&'static str, &'static Property)> {
    let all = [("yield_strength", &material.yield_strength), ("tensile_strength", &material.tensile_strength)];
    all.into_iter().filter_map(|(key, property)| Some((key, property.as_ref()?))).collect()
}
