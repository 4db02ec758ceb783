//! Strengths and residual stresses of the parts of a case in sentences, each with its origin.

use crate::output::table::BARS;
use percoat_case::case::LibraryStrength;
use serde_json::Value;

/// Keys of the strengths of a material.
const STRENGTHS: [&str; 2] = ["yield_strength", "tensile_strength"];

/// Sentences on the strengths of each part of a serialised case and the residual stress of each layer, from the surface down, those
/// of the counterbody last; then what a strength of the library is worth. Empty where no strength and no residual stress is given.
pub(super) fn sentences(case: &Value) -> Vec<String> {
    let unit = case["units"]["pressure"].as_str();
    let is_given = |section: &Value| {
        STRENGTHS
            .iter()
            .chain(&["interface_strength", "residual_stress", "endurance", "fatigue", "strain_life"])
            .any(|key| !section[*key].is_null())
    };
    if !parts(case).iter().any(|(_, section)| is_given(section)) {
        return Vec::new();
    }
    let told = parts(case).into_iter().map(|(part, section)| format!("{part}: {}", told(section, unit)));
    let library = LibraryStrength::of_case(case);
    let worth = (!library.is_empty()).then(|| WORTH.to_owned());
    let bars = library.iter().any(|strength| strength.key == "tensile_strength").then(|| BARS.to_owned());
    told.chain(worth).chain(bars).collect()
}

/// Sentence on strengths of the library.
const WORTH: &str =
    "strengths of the library are those of test pieces, not of your part; percoat materials NAME states their sources";

/// The layers, the substrate and the elastic counterbody of a case in words, each with its section.
fn parts(case: &Value) -> Vec<(String, &Value)> {
    let above = &case["counterbody"];
    let mut parts = layers(case, "");
    parts.extend(base(&case["substrate"], "substrate"));
    parts.extend(layers(above, " of the counterbody"));
    parts.extend(base(above, "counterbody"));
    parts
}

fn layers<'a>(body: &'a Value, of: &str) -> Vec<(String, &'a Value)> {
    let layers = (1..).zip(body["layers"].as_array().into_iter().flatten());
    layers.map(|(number, layer): (usize, _)| (named(&format!("layer {number}{of}"), layer), layer)).collect()
}

/// The material below the layers of a body; `None` of a rigid one.
fn base<'a>(section: &'a Value, what: &str) -> Option<(String, &'a Value)> {
    (section.is_object() && section["rigid"] != true).then(|| (named(what, section), section))
}

fn named(part: &str, section: &Value) -> String {
    section["name"].as_str().map_or_else(|| part.to_owned(), |name| format!("{part} ({name})"))
}

/// Strengths, strengths of the lower face and residual stress of a section in words.
fn told(section: &Value, unit: Option<&str>) -> String {
    let with_unit = |x: f64| unit.map_or_else(|| x.to_string(), |unit| format!("{x}\u{a0}{unit}"));
    let library = LibraryStrength::of_section(section, unit);
    let strength = |key: &&str| {
        let value = with_unit(section[*key].as_f64()?);
        let of_library = library.iter().find(|strength| strength.key == *key);
        let origin = of_library.map_or_else(|| "given".to_owned(), |strength| of(strength, &with_unit));
        Some(format!("{} {value} ({origin})", key.replace('_', " ")))
    };
    let mut told: Vec<String> = STRENGTHS.iter().filter_map(strength).collect();
    told.extend(
        ["endurance", "fatigue", "strain_life"]
            .into_iter()
            .filter(|key| !section[*key].is_null())
            .map(|key| format!("{} given", key.replace('_', " "))),
    );
    if told.is_empty() {
        told.push("no strength given: failure there is not checked".to_owned());
    }
    let face = ["normal", "shear"].into_iter().filter_map(|key| {
        let strength = section["interface_strength"][key].as_f64()?;
        Some(format!("{key} strength of its lower face {} (given)", with_unit(strength)))
    });
    told.extend(face);
    if section["thickness"].is_number() {
        let residual = section["residual_stress"].as_f64();
        told.push(residual.map_or_else(
            || "no residual stress given".to_owned(),
            |stress| format!("residual stress {} (given)", with_unit(stress)),
        ));
    }
    told.join("; ")
}

/// Origin of a strength of the library: kind of test and range, where they are known.
fn of(strength: &LibraryStrength, with_unit: &impl Fn(f64) -> String) -> String {
    let range = strength.range.map(|[low, high]| format!("{low} to {}", with_unit(high)));
    let known: Vec<String> = strength.what.map(str::to_owned).into_iter().chain(range).collect();
    if known.is_empty() { "library".to_owned() } else { format!("library: {}", known.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn each_part_has_its_strengths_with_their_origin() {
        let case = json!({
            "units": { "pressure": "MPa" },
            "layers": [
                { "thickness": 1, "name": "DLC", "tensile_strength": 1500, "residual_stress": -1000,
                  "interface_strength": { "normal": 500, "shear": 600, "friction": 0.3 } },
                { "thickness": 2, "name": "Cr" },
            ],
            "substrate": { "material": "HSS", "name": "HSS", "yield_strength": 3250 },
            "counterbody": { "material": "Si3N4", "name": "Si3N4", "tensile_strength": 800 },
        });
        let told = sentences(&case).join("\n").replace('\u{a0}', " ");
        let of_library = |text: &str| text.contains("(library: ");
        for line in [
            "layer 1 (DLC): tensile strength 1500 MPa (given); normal strength of its lower face 500 MPa (given); \
             shear strength of its lower face 600 MPa (given); residual stress -1000 MPa (given)",
            "layer 2 (Cr): no strength given: failure there is not checked; no residual stress given",
            "substrate (HSS): yield strength 3250 MPa (library: yield in compression; low end tension, 1960 to 3250 MPa)",
            "counterbody (Si3N4): tensile strength 800 MPa (library: flexural, 650 to 980 MPa)",
        ] {
            assert!(told.lines().any(|other| other == line), "{line} does not stand in\n{told}");
        }
        assert_eq!(told.lines().filter(|line| of_library(line)).count(), 2);
        assert!(told.contains(WORTH) && told.contains(BARS));
        // A strength of another number than the library's is the user's.
        let case = json!({ "units": { "pressure": "GPa" }, "substrate": { "material": "M2", "yield_strength": 2.0 },
                           "counterbody": { "rigid": true, "hardness": 9.0 } });
        assert_eq!(sentences(&case), ["substrate: yield strength 2\u{a0}GPa (given)"]);
        let bare = json!({ "layers": [{ "thickness": 1, "young": 2 }], "substrate": { "young": 1, "poisson": 0.3 } });
        assert!(sentences(&bare).is_empty());
    }
}
