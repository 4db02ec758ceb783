//! Warnings about contacts of balls that no solid bears, by Hertz: a = (3PR/4E*)^⅓ and p₀ = 2E*a/(πR). Mostly a radius or a force is in
//! another unit.
//!
//! A perfect crystal bears a tenth to a fifth of Young's modulus, soft matter more; a contact of a few nanometres is one of single atoms.
//! A radius a beyond half of R has its warning in `single_contact`, and in the run.

use super::si_sizes::exponent;
use super::single_contact::{highest_radius, measured, softer_modulus, stiffer_modulus};
use crate::case::Case;
use percoat_core::body::HalfSpace;
use percoat_core::counterbody::Shape;
use percoat_core::notation::number;
use percoat_core::run::words::{STEEP, ratio};
use std::f64::consts::FRAC_2_PI;

/// Part of Young's modulus that no crystal bears as a pressure.
const CRYSTAL: f64 = 0.2;
/// Young's modulus from which on a material is no soft matter, Pa.
const HARD: f64 = 1e9;
/// Least width of a contact of many atoms, m.
const ATOMS: f64 = 3e-9;
/// Radius over the thickness of the coating below which they are probably not in one unit.
const BELOW_COATING: f64 = 2e-3;

/// Warnings, a sentence each, about each kind of fault the first level that has it.
pub(super) fn doubts(case: &Case) -> Vec<String> {
    let balls = case.problem().levels().iter().enumerate().filter_map(|(index, level)| match *level.shape() {
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => Some((index, radius)),
        _ => None,
    });
    let balls: Vec<(usize, f64)> = balls.collect();
    let first =
        |of: fn(&Case, usize, f64) -> Option<String>| balls.iter().find_map(|&(index, radius)| of(case, index, radius));
    [first(high_pressure), first(few_atoms), first(below_coating)].into_iter().flatten().collect()
}

/// A largest pressure that no crystal bears. The softer body gives its least value.
fn high_pressure(case: &Case, index: usize, radius: f64) -> Option<String> {
    let (bodies, shape) = (case.problem().bodies(), case.problem().levels()[index].shape());
    let (softer, stiffer) = (softer_modulus(bodies), stiffer_modulus(bodies));
    if highest_radius(case, shape, stiffer)? > STEEP * radius {
        return None;
    }
    let pressure = FRAC_2_PI * softer * highest_radius(case, shape, softer)? / radius;
    let materials = |body: &HalfSpace| [Some(body.surface_material()), body.substrate().material()];
    let young =
        bodies.each().flat_map(materials).flatten().map(|material| material.young()).fold(f64::INFINITY, f64::min);
    let units = case.units();
    let is_hard = young * 10f64.powi(exponent(units.pressure())?) >= HARD;
    (is_hard && pressure > CRYSTAL * young).then(|| {
        format!(
            "by Hertz the peak pressure under {} is {}, {} of the least Young's modulus {}, and no crystal bears more than a \
             fifth: is {}?",
            case.problem().level_name(index + 1),
            units.pressure().with_unit(pressure, number),
            ratio(pressure / young),
            units.pressure().with_unit(young, number),
            measured(case, index)
        )
    })
}

/// A contact of single atoms.
fn few_atoms(case: &Case, index: usize, _: f64) -> Option<String> {
    let shape = case.problem().levels()[index].shape();
    let width = 2.0 * highest_radius(case, shape, softer_modulus(case.problem().bodies()))?;
    let units = case.units();
    let metres = width * 10f64.powi(exponent(units.length())?);
    (0.0 < metres && metres < ATOMS).then(|| {
        format!(
            "by Hertz the contact under {} is {} wide at the highest load, a few atoms, which are no continuum: is {}?",
            case.problem().level_name(index + 1),
            units.length().with_unit(width, number),
            measured(case, index)
        )
    })
}

/// A ball that is small beside the thickness of the coating.
fn below_coating(case: &Case, index: usize, radius: f64) -> Option<String> {
    let thickness = case.layers.first()?.thickness;
    (radius < BELOW_COATING * thickness).then(|| {
        format!(
            "levels[{index}].radius = {} is {} of layers[0].thickness = {}: are both in one unit?",
            number(radius),
            ratio(radius / thickness),
            number(thickness)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Source, foreseen, plausibility};

    const BALL: &str = "lattice = { kind = \"isolated\", size = 140.0 }\nlevels = [{ shape = \"sphere\", radius = 3000.0 }]\n\
                        layers = [{ thickness = 3.0, young = 400.0, poisson = 0.22 }]\n\
                        substrate = { young = 210.0, poisson = 0.3 }\nload = { force = [1000.0, 5000.0] }\n\
                        units = { length = \"µm\", pressure = \"GPa\" }\ngrid = { points = 256 }\n";

    /// Everything that `check` says of a ball of 3 mm under 5 N with these settings.
    fn said(overrides: &[&str]) -> Vec<String> {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let source = Source { name: "ball".to_owned(), text: BALL.to_owned(), ..Source::default() };
        let case = Case::read(&source, &overrides).unwrap_or_else(|error| panic!("{error}"));
        let all = plausibility::of_case(&case).into_iter().chain(foreseen(&case, &[]));
        all.map(|doubt| doubt.replace('\u{a0}', " ")).collect()
    }

    #[test]
    fn slips_of_units_of_one_ball_are_doubted_with_what_to_do() {
        const ASKED: &str = "is levels[0].radius in µm, and load.force in mN?";
        assert_eq!(said(&[]), Vec::<String>::new());
        for (overrides, told) in [
            (
                &["levels.0.radius=3", "lattice.size=10"][..],
                format!(
                    "by the formulas of a single contact: the contact radius 2.9912 under the ball is 1.00 of the indenter's radius 3.0000: strains are \
                     not small any more; {ASKED}"
                ),
            ),
            (
                &["levels.0.radius=3", "lattice.size=10", "load={ penetration = 5 }"],
                "by the formulas of a single contact: the contact radius 3.8730 under the ball is larger than the indenter's radius 3.0000: strains \
                 are not small any more; is levels[0].radius in µm, and load.penetration in µm?"
                    .to_owned(),
            ),
            (
                &["load.force=5"],
                "at load.force = 5.0000 the contact radius under the ball will have about 5.5 samples, by the formulas of a single contact: \
                 radii and peak pressures are rough below 10; raise grid.points, or lower lattice.size to 8.4569: the window is 21.52 \
                 times as wide as the contact at the highest load, with levels[0].radius in µm, and load.force in mN"
                    .to_owned(),
            ),
            (
                &["levels.0.radius=20", "lattice.size=20"],
                format!(
                    "by Hertz the peak pressure under the ball is 50.504 GPa, 0.24 of the least Young's modulus 210.00 GPa, and no \
                     crystal bears more than a fifth: {ASKED}"
                ),
            ),
            (
                &["levels.0.radius=0.05", "load.force=1e-7", "lattice.size=0.002"],
                format!(
                    "by Hertz the contact under the ball is 506.58 pm wide at the highest load, a few atoms, which are no continuum: \
                     {ASKED}"
                ),
            ),
            (
                &["levels.0.radius=0.05", "load.force=1e-3", "lattice.size=0.05", "layers.0.thickness=30"],
                "levels[0].radius = 0.050000 is 1.7e-3 of layers[0].thickness = 30.000: are both in one unit?".to_owned(),
            ),
        ] {
            assert_eq!(said(overrides), [told], "{overrides:?}");
        }
        // A case without [units] is asked for units in words, and its pressures are not compared with those that crystals bear.
        let unnamed = said(&["levels.0.radius=3", "lattice.size=10", "units={}"]).join("\n");
        let asked = "is levels[0].radius in the unit of the other lengths, and load.force in the unit of pressure times that of \
                     length squared?";
        assert!(unnamed.ends_with(asked), "{unnamed}");
        assert_eq!(said(&["levels.0.radius=20", "lattice.size=20", "units.pressure=MPa"]), Vec::<String>::new());
    }

    /// A window of any size has no mean pressure, and a layer under a single contact does not drift.
    #[test]
    fn an_isolated_contact_is_not_judged_by_the_mean_over_its_window() {
        let soft = said(&["counterbody={ young = 2e-4, poisson = 0.3 }"]).join("\n");
        let apart = "Young's modulus 400.00 of layers[0] is 2.0e6 times the 2.0000e-4 of the counterbody: are both in one unit, not one \
                     in MPa and the other in GPa?";
        assert!(soft.contains(apart) && !soft.contains("mean"), "{soft}");
        let spring = "layers.0.interface={ tangential_stiffness = 1e-6 }";
        assert_eq!(said(&[spring, "friction.coefficient=0.3"]), Vec::<String>::new());
    }
}
