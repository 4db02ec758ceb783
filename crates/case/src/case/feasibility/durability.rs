//! Warnings about hardness, wear and fatigue that no material has, mostly one number in another unit than the others.
//!
//! Nothing is harder than a sixth of Young's modulus. H ≈ 3 Y by slip lines, from 1.5 Y of polymers to 7 Y of metals that harden by
//! strain. k H, Archard's coefficient without unit, lies between 1e-8 under lubrication and 1e-3 of bare like metals. Under a pressure H
//! ranges of τ₁ reach some H/3, and the exponents of fatigue lie between 3 and 20.

use crate::case::Case;
use percoat_core::body::{Durability, Fatigue, HalfSpace, Layer, Material, Side};
use percoat_core::notation::number;
use percoat_core::run::words::ratio;
use std::ops::RangeInclusive;

/// Largest hardness over Young's modulus.
const HARDEST: f64 = 1.0 / 6.0;
/// Hardness over yield strength.
const CONSTRAINT: RangeInclusive<f64> = 1.0..=10.0;
/// Largest coefficient of wear times hardness.
const SEVERE: f64 = 1e-3;
/// Hardness over Young's modulus where no hardness is given.
const USUAL: f64 = 0.01;
/// Largest amplitude of fatigue over hardness.
const WITHIN: f64 = 0.5;
/// Exponents of laws of fatigue.
const EXPONENTS: RangeInclusive<f64> = 2.0..=30.0;

/// Warnings, a sentence each, about the `materials` of a case with their names.
pub(super) fn doubts(case: &Case, materials: &[(Material, String)]) -> Vec<String> {
    let bodies = case.problem().bodies();
    let yielding = bodies.each().flat_map(HalfSpace::strengths).map(|strength| strength.yielding);
    let all = materials.iter().zip(bodies.each().flat_map(HalfSpace::durabilities)).zip(yielding);
    let mut doubts: Vec<String> = all
        .flat_map(|(((material, name), durability), yielding)| {
            let young = material.young();
            [
                hardness(name, durability, young, yielding),
                wear(name, durability, durability.hardness.unwrap_or(USUAL * young)),
                durability.fatigue.and_then(|law| fatigue("fatigue of", name, law, durability.hardness)),
            ]
        })
        .flatten()
        .collect();
    if bodies.counterbody().is_none() {
        let durability = bodies.surface_durability(Side::Counterbody);
        doubts.extend(durability.hardness.and_then(|hardness| wear("the counterbody", durability, hardness)));
    }
    let layers = bodies.each().flat_map(|body| {
        let inside = body.layers().iter().map(Some);
        inside.chain(body.substrate().material().map(|_| None))
    });
    doubts.extend(materials.iter().zip(layers).filter_map(|((_, name), layer): (_, Option<&Layer>)| {
        let layer = layer?;
        fatigue("interface_fatigue under", name, layer.interface_fatigue()?, layer.durability().hardness)
    }));
    doubts
}

/// A hardness that is implausible beside Young's modulus or the yield strength.
fn hardness(name: &str, durability: Durability, young: f64, yielding: Option<f64>) -> Option<String> {
    let hardness = durability.hardness?;
    let (part, of, bound) = match yielding {
        _ if hardness > HARDEST * young => {
            (hardness / young, format!("its Young's modulus {}", number(young)), "no more than a sixth of it")
        }
        Some(yielding) if !CONSTRAINT.contains(&(hardness / yielding)) => {
            (hardness / yielding, format!("its yield_strength {}", number(yielding)), "about three times it")
        }
        _ => return None,
    };
    Some(format!(
        "hardness {} of {name} is {} of {of}, and that of materials is {bound}: are both in one unit, not one in MPa and the other \
         in GPa?",
        number(hardness),
        ratio(part)
    ))
}

/// A coefficient of wear that is large in units of the hardness.
fn wear(name: &str, durability: Durability, hardness: f64) -> Option<String> {
    let wear = durability.wear?;
    let of = match durability.hardness {
        Some(_) => format!("its hardness {}", number(hardness)),
        None => format!("a hundredth of its Young's modulus, {},", number(hardness)),
    };
    (wear * hardness > SEVERE).then(|| {
        format!(
            "wear {} of {name} times {of} is {}, and that of materials is 1e-8 to 1e-3: is it in one over the unit of pressures?",
            number(wear),
            number(wear * hardness)
        )
    })
}

/// A law of fatigue whose exponent or amplitude no material has.
fn fatigue(key: &str, name: &str, law: Fatigue, hardness: Option<f64>) -> Option<String> {
    if !EXPONENTS.contains(&law.exponent()) {
        let exponent = number(law.exponent());
        return Some(format!("{key} {name} has the exponent {exponent}, and those of materials lie between 2 and 30"));
    }
    let hardness = hardness.filter(|hardness| law.amplitude() > WITHIN * hardness)?;
    Some(format!(
        "{key} {name} has the amplitude {}, {} of the hardness {}, and no pressure up to that does it: are both in one unit, not \
         one in MPa and the other in GPa?",
        number(law.amplitude()),
        ratio(law.amplitude() / hardness),
        number(hardness)
    ))
}

#[cfg(test)]
mod tests {
    use super::super::plausibility;
    use crate::case::{Case, embedded};

    fn doubts(overrides: &[&str]) -> Vec<String> {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let case = Case::read(&embedded::source("dlc-on-steel").unwrap(), &overrides);
        plausibility::of_case(&case.unwrap_or_else(|error| panic!("{error}")))
    }

    #[test]
    fn durabilities_that_no_material_has_are_doubted_by_name() {
        let law = |amplitude: &str, exponent: &str| {
            format!("{{ amplitude = {amplitude}, passes = 1e6, exponent = {exponent} }}")
        };
        for (overrides, words) in [
            (vec!["layers.0.hardness=60".to_owned()], &["hardness 60.000 of layers[0] is", "Young's modulus"][..]),
            (vec!["substrate.hardness=1.5".to_owned()], &["hardness 1.5000 of the substrate", "yield_strength 2.0000"]),
            (vec!["substrate.hardness=25".to_owned()], &["of its yield_strength 2.0000", "about three times it"]),
            (
                vec!["substrate.wear=0.1".to_owned()],
                &["wear 0.10000 of the substrate", "a hundredth of its Young's modulus"],
            ),
            (
                vec!["substrate.wear=0.1".to_owned(), "substrate.hardness=7".to_owned()],
                &["times its hardness 7.0000 is 0.70000", "one over the unit of pressures"],
            ),
            (
                vec!["counterbody={ rigid = true, wear = 1e-3, hardness = 80 }".to_owned()],
                &["wear 0.0010000 of the counterbody times its hardness 80.000"],
            ),
            (
                vec![format!("substrate.fatigue={}", law("400", "8")), "substrate.hardness=7".to_owned()],
                &["fatigue of the substrate has the amplitude 400.00", "not one in MPa"],
            ),
            (
                vec![format!("layers.0.fatigue={}", law("0.4", "0.5"))],
                &["fatigue of layers[0] has the exponent 0.50000"],
            ),
            (
                vec![format!("layers.1.interface_fatigue={}", law("0.4", "80"))],
                &["interface_fatigue under layers[1] has the exponent 80.000"],
            ),
        ] {
            let overrides: Vec<&str> = overrides.iter().map(String::as_str).collect();
            let said = doubts(&overrides);
            assert_eq!(said.len(), 1, "{overrides:?}: {said:?}");
            for word in words {
                assert!(said[0].contains(word), "{overrides:?}: \"{word}\" does not stand in\n{}", said[0]);
            }
        }
    }

    #[test]
    fn those_that_materials_have_are_not() {
        let plain = ["substrate.hardness=7", "substrate.wear=1e-6", "layers.0.hardness=20", "layers.0.wear=1e-9"];
        assert_eq!(doubts(&plain), Vec::<String>::new());
        let law = "{ amplitude = 0.4, passes = 1e6, exponent = 8 }";
        let laws =
            ["layers.0.fatigue", "substrate.fatigue", "layers.1.interface_fatigue"].map(|key| format!("{key}={law}"));
        let laws: Vec<&str> = laws.iter().map(String::as_str).collect();
        assert_eq!(doubts(&[&plain[..], &laws].concat()), Vec::<String>::new());
    }
}
