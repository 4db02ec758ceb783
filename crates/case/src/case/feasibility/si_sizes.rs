//! Warnings about values that no material and no body has in the units of the case, mostly errors by 10³ⁿ.
//!
//! Under SI `[units]` moduli lie between 1 kPa (a gel) and 1.3 TPa (diamond), lengths between 0.1 nm (an atom) and
//! 1 m. Interfaces bear no more than a third of the modulus beside them, whatever the unit.

use crate::case::{Case, LayerSection};
use crate::units::{Unit, is_force, is_length, is_pressure};
use percoat_core::body::{Layer, Material};
use percoat_core::counterbody::roughness::Statistics;
use percoat_core::counterbody::{Level, Topography};
use percoat_core::notation::number;
use percoat_core::run::words::{HIGH, ratio};

/// Smallest and largest modulus of materials, Pa.
const MODULI: [f64; 2] = [1e3, 1.3e12];
/// Smallest and largest length of a contact, m.
const LENGTHS: [f64; 2] = [1e-10, 1.0];

/// Warnings, a sentence each.
pub(super) fn doubts(case: &Case, materials: &[(Material, String)]) -> Vec<String> {
    let units = case.units();
    let mut doubts = names(case);
    if let Some(exponent) = exponent(units.pressure()) {
        doubts.extend(materials.iter().filter_map(|(material, name)| modulus(material.young(), name, exponent)));
    }
    if let Some(exponent) = exponent(units.length()) {
        doubts.extend(lengths(case).into_iter().filter_map(|(name, x)| length(x, &name, exponent)));
    }
    doubts.extend(interfaces(case, materials));
    doubts
}

/// The power of ten of an SI unit.
pub(super) fn exponent(unit: &Unit) -> Option<i32> {
    match unit {
        Unit::Si { exponent, .. } => Some(*exponent),
        _ => None,
    }
}

/// Warnings about units of another quantity, and misspelt SI units.
fn names(case: &Case) -> Vec<String> {
    let Some(units) = &case.units else { return Vec::new() };
    let [length, pressure] = [&units.length, &units.pressure].map(|name| name.as_deref().unwrap_or_default());
    let mut doubts = Vec::new();
    if is_pressure(length) {
        doubts.push(format!("units.length = \"{length}\" is a unit of pressure: are both names exchanged?"));
    }
    if is_length(pressure) {
        doubts.push(format!("units.pressure = \"{pressure}\" is a unit of length: are both names exchanged?"));
    }
    for (key, name) in [("length", length), ("pressure", pressure)].into_iter().filter(|(_, name)| is_force(name)) {
        doubts.push(format!(
            "units.{key} = \"{name}\" is a unit of force, and that of a case is its pressure times its length squared: which \
             unit is the {key} in?"
        ));
    }
    for (key, name, is_known, meant) in [
        ("length", length, is_length as fn(&str) -> bool, ["m", "mm", "µm", "nm", "pm"]),
        ("pressure", pressure, is_pressure as fn(&str) -> bool, ["Pa", "kPa", "MPa", "GPa", "TPa"]),
    ] {
        let near = meant.iter().find(|unit| unit.to_lowercase() == name.to_lowercase());
        if let Some(near) = near.filter(|_| !is_known(name)) {
            doubts.push(format!("units.{key} = \"{name}\" is not a known unit: is it \"{near}\"?"));
        }
    }
    doubts
}

fn modulus(young: f64, name: &str, exponent: i32) -> Option<String> {
    let pascals = young * 10f64.powi(exponent);
    (!(MODULI[0]..=MODULI[1]).contains(&pascals)).then(|| {
        format!(
            "Young's modulus {} of {name} is {} by [units], and those of all materials lie between 1 kPa and 1.3 TPa: is it in the \
             unit of units.pressure?",
            number(young),
            Unit::Si { base: "Pa", exponent }.with_unit(young, number)
        )
    })
}

fn length(x: f64, name: &str, exponent: i32) -> Option<String> {
    let metres = x * 10f64.powi(exponent);
    (x > 0.0 && !(LENGTHS[0] * (1.0 - 1e-9)..=LENGTHS[1] * (1.0 + 1e-9)).contains(&metres)).then(|| {
        format!(
            "{name} = {} is {} by [units], not between 0.1 nm and 1 m: is it in the unit of units.length?",
            number(x),
            Unit::Si { base: "m", exponent }.with_unit(x, number)
        )
    })
}

/// Lengths of a case by their keys.
fn lengths(case: &Case) -> Vec<(String, f64)> {
    let problem = case.problem();
    let sides = problem.cell().vectors().map(|[x, y]| x.hypot(y));
    let mut all: Vec<(String, f64)> = vec![
        ("a side of the cell".to_owned(), sides[0].min(sides[1])),
        ("a side of the cell".to_owned(), sides[0].max(sides[1])),
    ];
    // A given pressure may be that on a road or a foundation.
    all.retain(|_| problem.counterbody().is_some());
    all.dedup_by(|a, b| a.1 == b.1);
    all.extend(case.levels.iter().enumerate().filter_map(|(number, level)| {
        let (key, radius) = level.apex_radius()?;
        Some((format!("levels[{number}].{key}"), radius))
    }));
    // Single heights are not checked: their reference is arbitrary, and they may differ by less than an atom.
    let heights = problem.levels().iter().map(Level::height);
    let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| [low.min(h), high.max(h)]);
    if high - low > LENGTHS[0].max(sides[0]) {
        all.push(("the largest difference of levels.height".to_owned(), high - low));
    }
    all.extend(
        problem.topography().map(|topography| ("the range of the surface's heights".to_owned(), range(topography))),
    );
    let thickness = |prefix: &'static str| {
        move |(number, layer): (usize, &LayerSection)| (format!("{prefix}layers[{number}].thickness"), layer.thickness)
    };
    all.extend(case.layers.iter().enumerate().map(thickness("")));
    let above = case.counterbody.iter().flat_map(|above| above.layers.0.iter().enumerate());
    all.extend(above.map(thickness("counterbody.")));
    all
}

fn range(topography: &Topography) -> f64 {
    Statistics::of(topography.own_heights().view()).range
}

/// Warnings about interface strengths that are implausible beside the softer material.
fn interfaces(case: &Case, materials: &[(Material, String)]) -> Vec<String> {
    let mut rest = materials;
    let layers = case.problem().bodies().each().flat_map(|body| {
        let (own_materials, other) = rest.split_at(body.material_count());
        rest = other;
        // On a rigid base the last layer alone.
        let beside = (0..).map(|number| &own_materials[number..own_materials.len().min(number + 2)]);
        body.layers().iter().zip(beside)
    });
    let strengths = layers.flat_map(|(layer, beside): (&Layer, _)| {
        let (softer, name) = beside.iter().min_by(|a, b| a.0.young().total_cmp(&b.0.young())).expect("the layer at least");
        let strength = layer.interface_strength();
        let of = [("normal", strength.normal), ("shear", strength.shear)];
        of.into_iter().filter_map(move |(key, value)| {
            let part = value? / softer.young();
            (part > HIGH).then(|| {
                format!(
                    "interface_strength.{key} under {} is {} of Young's modulus {} of {name}: are both in one unit, not one in MPa and \
                     the other in GPa?",
                    beside[0].1,
                    ratio(part),
                    number(softer.young())
                )
            })
        })
    });
    strengths.collect()
}

#[cfg(test)]
mod tests {
    use super::super::plausibility;
    use super::*;
    use crate::case::embedded;

    fn doubts(overrides: &[&str]) -> String {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let case = Case::read(&embedded::source("dlc-on-steel").unwrap(), &overrides);
        plausibility::of_case(&case.unwrap_or_else(|error| panic!("{error}"))).join("\n")
    }

    #[test]
    fn numbers_that_no_body_has_are_doubted_by_name() {
        for (overrides, words) in [
            (
                &["substrate.young=210000"][..],
                &["Young's modulus 210000 of the substrate is 210.00\u{a0}TPa", "1.3 TPa"][..],
            ),
            (
                &["substrate.young=210e9", "layers.0.young=200e9", "layers.1.young=280e9"],
                &["of layers[0] is", "of layers[1] is"],
            ),
            (&["units.pressure=mm"], &["units.pressure = \"mm\" is a unit of length"]),
            (
                &["units.pressure=µm", "units.length=GPa"],
                &["units.length = \"GPa\" is a unit of pressure", "exchanged"],
            ),
            (&["units.pressure=Mpa"], &["units.pressure = \"Mpa\" is not a known unit: is it \"MPa\"?"]),
            (&["units.pressure=Pa"], &["of the substrate is 210.00\u{a0}Pa"]),
            (&["units.pressure=mPa"], &["of layers[0] is"]),
            (
                &["units.length=m"],
                &["a side of the cell = 20.000 is 20.000\u{a0}m", "levels[0].radius = 50.000", "layers[0].thickness"],
            ),
            (&["units.length=pm"], &["a side of the cell = 20.000 is 20.000\u{a0}pm"]),
            (&["units.length=MM"], &["is it \"mm\"?"]),
            (
                &["layers.0.interface_strength={ normal = 500, shear = 1 }"],
                &["interface_strength.normal under layers[0] is 2.5"],
            ),
            (
                &["layers.1.interface_strength={ shear = 900 }"],
                &["interface_strength.shear under layers[1]", "of the substrate"],
            ),
            (&["layers.0.tensile_strength=150"], &["tensile_strength of layers[0] is 0.75"]),
        ] {
            let said = doubts(overrides);
            for word in words {
                assert!(said.contains(word), "{overrides:?}: \"{word}\" does not stand in\n{said}");
            }
        }
    }

    #[test]
    fn numbers_that_bodies_have_are_not() {
        for overrides in [
            &[][..],
            &["units.pressure=psi", "units.length=in"],
            &["units.pressure=N/mm²"],
            &["units.length=mm"],
            &["units.length=nm"],
            &["substrate.young=1200"],
            &["units.pressure=hPa"],
        ] {
            assert_eq!(doubts(overrides), "", "{overrides:?}");
        }
    }
}
