//! Unloadings in `identification.json`: what was measured, the contact of the model, hardness, and the modulus by the formula for bare bodies.

use super::number::{number, with_error, with_unit};
use super::table::Table;
use percoat_case::case::Case;
use percoat_case::units::Units;
use percoat_core::body::Bodies;
use percoat_core::identification::{FromUnloading, Unloading, UnloadingContact, UnloadingDoubt};
use percoat_core::measured::Measured;
use percoat_core::quantity::Kind;
use percoat_core::run::tip::outside;
use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// Parameters found by unloadings, as a file of results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct UnloadingRecord {
    beta: f64,
    stiffness_error: f64,
    surface_modulus: f64,
    substrate_modulus: Option<f64>,
    tests: Vec<TestRecord>,
}

/// An unloading.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct TestRecord {
    force: f64,
    penetration: f64,
    stiffness: f64,
    stiffness_error: f64,
    exponent: f64,
    residual_depth: f64,
    contact_depth: f64,
    contact_radius: f64,
    epsilon: f64,
    fitted_stiffness: f64,
    hardness: f64,
    hardness_error: f64,
    bare_modulus: f64,
    bare_modulus_error: f64,
    bare_young: Option<f64>,
}

impl UnloadingRecord {
    /// The record of what was found by unloadings with a factor β; `bodies` have the values found.
    pub fn new(unloadings: &[Unloading], (found, beta): (&FromUnloading, f64), bodies: &Bodies) -> Self {
        let test = |(unloading, contact): (&Unloading, &UnloadingContact)| TestRecord {
            force: unloading.force,
            penetration: unloading.penetration,
            stiffness: unloading.stiffness,
            stiffness_error: unloading.stiffness_error,
            exponent: unloading.exponent,
            residual_depth: unloading.residual_depth,
            contact_depth: contact.depth,
            contact_radius: contact.radius,
            epsilon: contact.epsilon,
            fitted_stiffness: contact.stiffness,
            hardness: contact.hardness,
            hardness_error: contact.hardness_error,
            bare_modulus: contact.bare.reduced,
            bare_modulus_error: contact.bare.error,
            bare_young: contact.bare.young,
        };
        Self {
            beta,
            stiffness_error: found.model_error,
            surface_modulus: bodies.contact_modulus(),
            substrate_modulus: bodies.substrate_modulus(),
            tests: unloadings.iter().zip(&found.contacts).map(test).collect(),
        }
    }

    /// Table of what was measured by each unloading, and table of its contact.
    pub fn tables(&self, names: &[&str], units: &Units) -> [Table; 2] {
        let most = |of: &dyn Fn(&TestRecord) -> f64| self.tests.iter().map(of).fold(0.0, |most, x| x.abs().max(most));
        let unit = |kind: Kind, of: &dyn Fn(&TestRecord) -> f64| units.unit(kind).prefixed(most(of));
        let force = unit(Kind::Force, &|test| test.force);
        let [depth, stiffness] =
            [unit(Kind::Length, &|test| test.penetration), units.unit(Kind::Stiffness).prefixed(1.0)];
        let radius = unit(Kind::Length, &|test| test.contact_radius);
        let [hardness, modulus] =
            [unit(Kind::Pressure, &|test| test.hardness), unit(Kind::Pressure, &|test| test.bare_modulus)];
        let measured = |(name, test): (&&str, &TestRecord)| {
            vec![
                (*name).to_owned(),
                number(force.shown(test.force)),
                number(depth.shown(test.penetration)),
                number(depth.shown(test.residual_depth)),
                number(test.exponent),
                with_error(stiffness.shown(test.stiffness), Some(stiffness.shown(test.stiffness_error))),
                number(stiffness.shown(test.fitted_stiffness)),
            ]
        };
        let contact = |(name, test): (&&str, &TestRecord)| {
            let shown = |unit: &percoat_case::units::Prefixed, x: f64, error: f64| {
                with_error(unit.shown(x), Some(unit.shown(error)))
            };
            vec![
                (*name).to_owned(),
                number(depth.shown(test.contact_depth)),
                number(radius.shown(test.contact_radius)),
                number(test.epsilon),
                shown(&hardness, test.hardness, test.hardness_error),
                shown(&modulus, test.bare_modulus, test.bare_modulus_error),
                test.bare_young.map_or("none".to_owned(), |young| number(modulus.shown(young))),
            ]
        };
        let heads = [
            [
                "unloading".to_owned(),
                force.headed("force"),
                depth.headed("penetration"),
                depth.headed("left"),
                "m".to_owned(),
                stiffness.headed("stiffness S"),
                stiffness.headed("S of the model"),
            ],
            [
                "unloading".to_owned(),
                depth.headed("contact depth"),
                radius.headed("contact radius"),
                "ε".to_owned(),
                hardness.headed("hardness"),
                modulus.headed("bare E_r"),
                modulus.headed("bare E"),
            ],
        ];
        let rows = || names.iter().zip(&self.tests);
        let [first, second] = heads;
        [Table::new(&first, rows().map(measured).collect(), 1), Table::new(&second, rows().map(contact).collect(), 1)]
    }

    /// Lines beside the moduli found: those by the formula for bare bodies, the error of the solver, and the assumptions.
    pub fn notes(&self, units: &Units) -> Vec<String> {
        let modulus = |x: f64| with_unit(&units.unit(Kind::Pressure), Measured { value: x, error: None });
        let bare = || self.tests.iter().map(|test| test.bare_modulus);
        let [least, most] = [bare().fold(f64::INFINITY, f64::min), bare().fold(0.0, f64::max)].map(modulus);
        let range = if self.tests.len() == 1 { least } else { format!("{least} to {most}") };
        let substrate = self
            .substrate_modulus
            .map_or(String::new(), |substrate| format!(", of the substrate with it {}", modulus(substrate)));
        vec![
            format!(
                "reduced modulus: the formula for bare bodies, E_r = √π S/(2β√A) with ε = 3/4, gives {range}; of the surface with the indenter the \
                 values found have {}{substrate}",
                modulus(self.surface_modulus)
            ),
            format!("error of the computed stiffness by the solver: {:.1e} at most", self.stiffness_error),
            format!(
                "taken for granted: unloading is elastic, the impression it leaves is a flat surface to the contact, nothing piles up around it, \
                 and β = {}",
                number(self.beta)
            ),
        ]
    }

    /// Number of unloadings.
    pub fn len(&self) -> usize {
        self.tests.len()
    }

    /// Smallest and largest ε.
    pub fn epsilons(&self) -> [f64; 2] {
        let all = || self.tests.iter().map(|test| test.epsilon);
        [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)]
    }
}

/// The content of `identification.csv` for unloadings: a line for each fitted point, and its power law.
pub fn unloaded(unloadings: &[Unloading]) -> String {
    let mut text = "force,penetration,fitted,fitted_error,curve\n".to_owned();
    for (curve, unloading) in unloadings.iter().enumerate() {
        let points = unloading.forces.iter().zip(&unloading.penetrations).zip(&unloading.fitted);
        for ((force, penetration), fitted) in points {
            writeln!(text, "{force},{penetration},{fitted},,{curve}").expect("a String takes any text");
        }
    }
    text
}

/// Why what was found by unloadings may not hold, a sentence each; `case` has the values found.
pub fn doubts_of_unloading(names: &[String], found: &FromUnloading, case: &Case) -> Vec<String> {
    let told = found.doubts.iter().map(|doubt| match doubt {
        UnloadingDoubt::NoPowerLaw(curve) => format!(
            "{}: the unloading is no power law, its residuals are a pattern; the standard error of its stiffness does not hold: fit another part, \
             or look for creep and drift",
            names[*curve]
        ),
        UnloadingDoubt::Exponent(curve, exponent) => format!(
            "{}: the exponent m = {} of the unloading is none of elastic unloading, which has 1 to 2: look for creep, drift or a wrong zero, or fit \
             another part",
            names[*curve],
            number(*exponent)
        ),
        UnloadingDoubt::PileUp(curve, left) => format!(
            "{}: {:.0} % of the penetration is left after the unloading; from 70 % on material often piles up around the contact, which then is wider \
             than taken, and modulus and hardness smaller than stated: look at the impression",
            names[*curve],
            100.0 * left
        ),
        UnloadingDoubt::Scatter(reduced) => format!(
            "the unloadings differ by more than their errors, reduced chi-square {}: the errors of what was found are by their scatter; look for a \
             wrong area function, thickness or frame, for roughness, or for moduli that change with depth",
            number(*reduced)
        ),
        UnloadingDoubt::NoDerivative(underivable) => format!(
            "what was found has no derivative by {}, which the model does not allow to vary: {}; how an error of it affects the result is unknown",
            underivable.names.join(", "),
            underivable.reason
        ),
    });
    let level = case.problem().levels().first().and_then(|level| outside("the tip", level.shape(), found.radii));
    told.chain(level).collect()
}
