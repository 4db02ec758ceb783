//! `hardness`, `wear`, `fatigue`, `endurance` and `strain_life` of a material, and `interface_fatigue` of the lower face of a layer.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::reader::TableAt;
use super::section::{Words, section, words};
use percoat_core::body::{Durability, Endurance, Fatigue, MaterialError, StrainDirection, StrainLife};
use serde_json::Value;
use std::ops::Bound;

const SIZE: Form = Form::Number(Range::Size);
const SLOPE: Form = Form::Number(Range::between(0.2, 50.0));
const PART: Form = Form::Number(Range::Within(Bound::Excluded(0.0), Bound::Excluded(1.0)));
/// Part of specimens that has failed at the passes that are stated, where a law has a scatter and no other part.
const FAILURES: f64 = 0.1;
static LAW: [Form; 1] = [Form::Table(&FATIGUE)];
static LIMITS: [Form; 1] = [Form::Table(&ENDURANCE)];
static LIFE_BY_STRAIN: [Form; 1] = [Form::Table(&STRAIN_LIFE)];

// Keys of layers, of the substrate and of the counterbody.
pub(super) const HARDNESS: Key =
    Key::new(&[SIZE], "9.0").unit(Unit::Pressure).otherwise("its material's, or never reached");
pub(super) const WEAR: Key =
    Key::new(&[Form::Number(Range::SizeOrZero)], "1e-9").unit(Unit::PerPressure).otherwise("no wear");
pub(super) const FATIGUE_LAW: Key =
    Key::new(&LAW, "{ amplitude = 0.4, passes = 1e6, exponent = 8 }").otherwise("no fatigue");
pub(super) const ENDURANCE_LIMITS: Key =
    Key::new(&LIMITS, "{ torsion = 0.3, bending = 0.5 }").otherwise("never reached");
pub(super) const STRAIN_LAW: Key =
    Key::new(&LIFE_BY_STRAIN, "{ strain = 2e-4, passes = 1e6, exponent = 4, direction = \"tension\" }")
        .otherwise("no life by strain");

section! {
    /// Damage by the range of the shear stress, (range/amplitude)^exponent/passes in a pass.
    #[derive(Copy)]
    pub struct FatigueSection = FATIGUE, rules scatter_has_a_slope {
        /// range of the shear stress that does the damage 1 in `passes`
        pub amplitude: f64 = Key::new(&[SIZE], "0.4").unit(Unit::Pressure),
        /// passes of the range `amplitude` to failure
        pub passes: f64 = Key::new(&[SIZE], "1e6"),
        /// power of the range with which damage grows
        pub exponent: f64 = Key::new(&[SIZE], "8.0"),
        /// slope of the Weibull distribution of the passes of many specimens, of which `passes` is the median
        pub weibull_slope: Option<f64> = Key::new(&[SLOPE], "1.5")
            .otherwise("no scatter is known")
            .omitted_as_nothing(),
        /// part of many specimens that has failed at the passes that are stated
        pub failures: Option<f64> = Key::new(&[PART], "0.05")
            .otherwise("0.1, with `weibull_slope`")
            .omitted_as_nothing(),
    }
}

section! {
    /// Endurance limits of the amplitude of stress, for the criteria of Crossland and Dang Van.
    #[derive(Copy)]
    pub struct EnduranceSection = ENDURANCE, rules tension_does_no_good {
        /// limit of the shear stress in alternating torsion
        pub torsion: f64 = Key::new(&[SIZE], "0.3").unit(Unit::Pressure),
        /// limit of the stress in alternating bending
        pub bending: f64 = Key::new(&[SIZE], "0.5").unit(Unit::Pressure).rule("at most √3 `torsion`"),
    }
}

words! {
    /// The strain that counts in a life.
    pub enum DirectionWord {
        /// Largest extension of the horizontal directions.
        Tension = "tension",
        /// Largest compression along z.
        Compression = "compression",
    }
}

section! {
    /// Passes to failure by the largest strain ε of the material, passes (strain/ε)^exponent.
    #[derive(Copy)]
    pub struct StrainLifeSection = STRAIN_LIFE {
        /// strain under which the material lasts `passes`, not in microstrain: 2e-4 is 200 µε
        pub strain: f64 = Key::new(&[PART], "2e-4"),
        /// passes to failure under `strain`
        pub passes: f64 = Key::new(&[SIZE], "1e6"),
        /// power of the strain with which the passes fall
        pub exponent: f64 = Key::new(&[SIZE], "3.291"),
        /// the strain that counts: the largest horizontal tension, or the largest vertical compression
        pub direction: DirectionWord = Key::new(&[Form::Word(DirectionWord::WORDS)], "\"tension\""),
    }
}

impl StrainLifeSection {
    fn strain_life(&self) -> Result<StrainLife, MaterialError> {
        let direction = match self.direction {
            DirectionWord::Tension => StrainDirection::Tension,
            DirectionWord::Compression => StrainDirection::Compression,
        };
        StrainLife::new(self.strain, self.passes, self.exponent, direction)
    }
}

/// Refuses a limit of bending that is too far above that of torsion.
fn tension_does_no_good(limits: &EnduranceSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    let bending = section.value("bending")?;
    limits.endurance().map(drop).map_err(|error| {
        Refusal::new(bending.node.span, format!("`{}`: {error}", bending.path), "too large beside `torsion`")
            .help("√3 is that of a ductile material by von Mises, and others have less")
    })
}

/// Refuses a part of failures without the slope of their distribution.
fn scatter_has_a_slope(law: &FatigueSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    if law.failures.is_none() || law.weibull_slope.is_some() {
        return Ok(());
    }
    let failures = section.value("failures")?;
    let message = format!("`{}` needs `weibull_slope`, by which the passes scatter", failures.path);
    Err(Refusal::new(failures.node.span, message, "of a distribution that is not known")
        .help("give the slope, or the passes of that part of failures and no `failures`"))
}

impl FatigueSection {
    /// The law; with a scatter that of the part of failures: 1 − exp(−(N/η)^β) have failed after N passes, half of all after `passes`.
    pub(super) fn fatigue(&self) -> Result<Fatigue, MaterialError> {
        let part =
            self.scatter().map_or(1.0, |[slope, failures]| ((-failures).ln_1p() / 0.5f64.ln()).powf(1.0 / slope));
        Fatigue::new(self.amplitude, self.passes * part, self.exponent)
    }

    /// Slope of the Weibull distribution of the passes, and the part that has failed at those of the law; `None` without a scatter.
    fn scatter(&self) -> Option<[f64; 2]> {
        Some([self.weibull_slope?, self.failures.unwrap_or(FAILURES)])
    }
}

/// The parts of failures for which the laws of fatigue of a serialised case state passes, each once, ascending; empty without a scatter.
pub fn failures_of(case: &Value) -> Vec<f64> {
    let mut found = Vec::new();
    let mut below = vec![case];
    while let Some(value) = below.pop() {
        if value["weibull_slope"].is_number() {
            found.push(value["failures"].as_f64().unwrap_or(FAILURES));
        }
        match value {
            Value::Object(keys) => below.extend(keys.values()),
            Value::Array(items) => below.extend(items),
            _ => {}
        }
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

impl EnduranceSection {
    fn endurance(&self) -> Result<Endurance, MaterialError> {
        Endurance::new(self.torsion, self.bending)
    }
}

/// The durability of a material by its keys.
pub(super) fn durability(
    hardness: Option<f64>,
    wear: Option<f64>,
    fatigue: Option<FatigueSection>,
    endurance: Option<EnduranceSection>,
    strain_life: Option<StrainLifeSection>,
) -> Result<Durability, MaterialError> {
    let fatigue = fatigue.map(|section| section.fatigue()).transpose()?;
    let endurance = endurance.map(|section| section.endurance()).transpose()?;
    let strain_life = strain_life.map(|section| section.strain_life()).transpose()?;
    Ok(Durability { hardness, wear, fatigue, endurance, strain_life })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, Source};
    use percoat_core::body::Side;

    const CASE: &str = "lattice = { kind = \"square\", period = 4 }\nlevels = [{ shape = \"paraboloid\", radius = 1 }]\n\
                        load = { mean_pressure = 1e-3 }\n";
    const LAW: &str = "{ amplitude = 0.4, passes = 1e6, exponent = 8 }";

    fn read(bodies: &str) -> Case {
        let source = Source { name: "case.toml".to_owned(), text: format!("{CASE}{bodies}"), ..Source::default() };
        Case::read(&source, &[]).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn every_sublayer_has_the_durability_of_its_layer_and_the_last_one_the_fatigue_of_the_lower_face() {
        let graded = "graded = { young = [3, 2], poisson = [0.2, 0.3], sublayers = 3 }";
        let by_strain = "strain_life = { strain = 2e-4, passes = 1e6, exponent = 4, direction = \"compression\" }";
        let keys =
            format!("hardness = 0.3, wear = 1e-6, endurance = {{ torsion = 0.03, bending = 0.05 }}, {by_strain}");
        let case = read(&format!(
            "layers = [{{ thickness = 1, {graded}, {keys}, fatigue = {LAW}, interface_fatigue = {LAW} }}]\n\
             substrate = {{ young = 1, poisson = 0.3, fatigue = {LAW} }}\n"
        ));
        let law = Fatigue::new(0.4, 1e6, 8.0).unwrap();
        let expected = Durability {
            hardness: Some(0.3),
            wear: Some(1e-6),
            fatigue: Some(law),
            endurance: Some(Endurance::new(0.03, 0.05).unwrap()),
            strain_life: Some(StrainLife::new(2e-4, 1e6, 4.0, StrainDirection::Compression).unwrap()),
        };
        let base = Durability { fatigue: Some(law), ..Durability::default() };
        let found: Vec<Durability> = case.half_space().durabilities().collect();
        assert_eq!(found, [expected, expected, expected, base]);
        let faces: Vec<Option<Fatigue>> =
            case.half_space().layers().iter().map(|layer| layer.interface_fatigue()).collect();
        assert_eq!(faces, [None, None, Some(law)]);
        assert_eq!(case.problem().bodies().hardness(), Some((0.3, Side::Body)));
    }

    #[test]
    fn a_rigid_counterbody_with_a_surface_is_rigid() {
        let substrate = "substrate = { young = 1, poisson = 0.3, hardness = 0.3 }\n";
        let plain = read(substrate);
        for (key, hardness, wear) in [
            ("hardness = 0.1", (0.1, Side::Counterbody), 0.0),
            ("hardness = 0.4", (0.3, Side::Body), 0.0),
            ("wear = 1e-6", (0.3, Side::Body), 1e-6),
        ] {
            let case = read(&format!("{substrate}counterbody = {{ rigid = true, {key} }}\n"));
            let bodies = case.problem().bodies();
            assert_eq!((bodies.hardness(), bodies.wear(Side::Counterbody)), (Some(hardness), wear));
            assert_eq!((bodies.counterbody(), bodies.body()), (None, plain.half_space()));
            assert!(case.counterbody.as_ref().is_some_and(|counterbody| !counterbody.is_elastic()));
        }
    }

    /// The rolling bearing's rule: with the slope 1.5 half of all have failed after 3.51 times the passes of a tenth, with the slope 10/9 after
    /// 5.45 times.
    #[test]
    fn passes_with_a_scatter_are_those_of_the_first_failures() {
        let law = |more: &str| {
            let law = format!("{{ amplitude = 0.4, passes = 1e6, exponent = 8{more} }}");
            let case = read(&format!("substrate = {{ young = 1, poisson = 0.3, fatigue = {law} }}\n"));
            let parts = failures_of(&serde_json::json!(case));
            (case.half_space().durabilities().next().unwrap().fatigue.unwrap().passes(), parts)
        };
        for (slope, ratio) in [(1.5, 3.51), (10.0 / 9.0, 5.45)] {
            let (passes, parts) = law(&format!(", weibull_slope = {slope}"));
            assert!((1e6 / passes / ratio - 1.0).abs() < 2e-3, "{passes}");
            assert_eq!(parts, [0.1]);
        }
        let (passes, parts) = law(", weibull_slope = 3.0, failures = 0.5");
        assert!((passes - 1e6).abs() < 1e-6, "{passes}");
        assert_eq!((parts, law("")), (vec![0.5], (1e6, vec![])));
    }

    #[test]
    fn a_life_without_keys_has_its_defaults() {
        let substrate = "substrate = { young = 1, poisson = 0.3 }\n";
        let life = |text: &str| {
            read(&format!("{substrate}{text}")).life.map(|life| (life.passes, life.distance, life.tolerance))
        };
        assert_eq!((life(""), life("life = {}")), (None, Some((None, None, 1e-2))));
        assert_eq!(life("life = { passes = 1e7, distance = 4, tolerance = 1e-3 }"), Some((Some(1e7), Some(4.0), 1e-3)));
    }
}
