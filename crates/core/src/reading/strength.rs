//! Failure criteria and their utilisations in a load step.
//!
//! The **utilisation** of a criterion is 1 where it fails: von Mises over the yield strength, σ₁ over the tensile strength,
//! √((⟨σ_zz⟩/σ_c)² + (τ/(τ_c + f⟨−σ_zz⟩))²) of an interface; the largest strain over that of a law of life, N₀ passes at 1 and N₀ u⁻ⁿ at u;
//! of endurance limits, under any number of passes of the counterbody, [√J₂,a +
//! (3τ₋₁/σ₋₁ − √3) σ_H]/τ₋₁ (Crossland) and [τ_a + 3(τ₋₁/σ₋₁ − ½) σ_H]/τ₋₁ (Dang Van) along the path of sliding. It is no safety factor: contact is not linear, and the load at which it
//! reaches 1 is found by solving ([`crate::Run::limits`]).

use super::StressReading;
use super::verdict::Verdict;
use crate::body::{Bodies, Endurance, HalfSpace, InterfaceId, MaterialId, Name, Side, StrainDirection, StrainLife};
use crate::numeric::serialised;
use crate::quantity::quantities;
use crate::stress::{Compliance, PathPeak, Peak, StressState};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A failure criterion of a material or an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(tag = "criterion", rename_all = "snake_case")]
pub enum Criterion {
    /// A material yields: von Mises.
    Yield(MaterialId),
    /// A material cracks: largest principal stress.
    Cracking(MaterialId),
    /// An interface comes off.
    Delamination(InterfaceId),
    /// A material lasts the passes of its law of life by strain, no more.
    StrainLife(MaterialId),
    /// A material tires under many passes, by the criterion of Crossland.
    Crossland(MaterialId),
    /// A material tires under many passes, by the criterion of Dang Van.
    DangVan(MaterialId),
}

impl Criterion {
    /// All that the bodies have strengths for, those of the body first: yield and cracking from the surface down, then the
    /// interfaces, then lives by strain and the endurance of materials.
    pub fn all(bodies: &Bodies) -> Vec<Self> {
        bodies.each().flat_map(Self::of).collect()
    }

    /// All that a half-space has strengths and endurance limits for.
    fn of(half_space: &HalfSpace) -> Vec<Self> {
        let strengths = || (1..).zip(half_space.strengths());
        let yields = strengths().filter(|(_, strength)| strength.yielding.is_some());
        let cracks = strengths().filter(|(_, strength)| strength.tensile.is_some());
        let interfaces = (1..).zip(half_space.layers()).filter(|(_, layer)| !layer.interface_strength().is_empty());
        let lasts = (1..).zip(half_space.durabilities()).filter(|(_, durability)| durability.strain_life.is_some());
        let endures = (1..).zip(half_space.durabilities()).filter(|(_, durability)| durability.endurance.is_some());
        yields
            .map(|(number, _)| Self::Yield(half_space.material_id(number)))
            .chain(cracks.map(|(number, _)| Self::Cracking(half_space.material_id(number))))
            .chain(interfaces.map(|(number, _)| Self::Delamination(half_space.interface_id(number))))
            .chain(lasts.map(|(number, _)| Self::StrainLife(half_space.material_id(number))))
            .chain(endures.flat_map(|(number, _)| {
                let material = half_space.material_id(number);
                [Self::Crossland(material), Self::DangVan(material)]
            }))
            .collect()
    }

    /// Yield of the material with this number, from 1, without its name.
    pub const fn yield_of(material: usize) -> Self {
        Self::Yield(MaterialId::numbered(material))
    }

    /// Cracking of the material with this number, from 1, without its name.
    pub const fn cracking_of(material: usize) -> Self {
        Self::Cracking(MaterialId::numbered(material))
    }

    /// Delamination of the interface with this number, from 1, without its name.
    pub const fn delamination_of(interface: usize) -> Self {
        Self::Delamination(InterfaceId::numbered(interface))
    }

    /// Name of the failure in one word, as in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Yield(_) => "yield",
            Self::Cracking(_) => "cracking",
            Self::Delamination(_) => "delamination",
            Self::StrainLife(_) => "strain_life",
            Self::Crossland(_) => "crossland",
            Self::DangVan(_) => "dang_van",
        }
    }

    /// Code of the criterion by number, as in files: "yield of material 2".
    pub fn code(self) -> String {
        match self {
            Self::Yield(material)
            | Self::Cracking(material)
            | Self::StrainLife(material)
            | Self::Crossland(material)
            | Self::DangVan(material) => {
                format!("{} of {}", self.name(), material.code())
            }
            Self::Delamination(interface) => format!("{} of {}", self.name(), interface.code()),
        }
    }

    /// Code of the criterion with the name of its material or interface behind: "yield of material 2 (TiN)".
    pub fn code_with_name(self) -> String {
        self.subject().map_or_else(|| self.code(), |name| format!("{} ({name})", self.code()))
    }

    /// Name of the material or interface of the criterion; `None` where it was given none.
    pub fn subject(self) -> Option<Name> {
        match self {
            Self::Yield(material)
            | Self::Cracking(material)
            | Self::StrainLife(material)
            | Self::Crossland(material)
            | Self::DangVan(material) => material.name,
            Self::Delamination(interface) => interface.name,
        }
    }

    /// The criteria of several cases, each once; without a name where the cases give different ones.
    pub fn distinct(all: impl IntoIterator<Item = Self>) -> Vec<Self> {
        let mut distinct: Vec<Self> = Vec::new();
        for criterion in all {
            match distinct.iter_mut().find(|known| **known == criterion) {
                None => distinct.push(criterion),
                Some(known) if known.subject() == criterion.subject() => {}
                Some(known) => *known = criterion.without_name(),
            }
        }
        distinct
    }

    fn without_name(self) -> Self {
        match self {
            Self::Yield(material) => Self::Yield(material.without_name()),
            Self::Cracking(material) => Self::Cracking(material.without_name()),
            Self::Delamination(interface) => Self::Delamination(interface.without_name()),
            Self::StrainLife(material) => Self::StrainLife(material.without_name()),
            Self::Crossland(material) => Self::Crossland(material.without_name()),
            Self::DangVan(material) => Self::DangVan(material.without_name()),
        }
    }

    /// The body whose material or interface fails; `None` where only one is elastic.
    pub fn side(self) -> Option<Side> {
        match self {
            Self::Yield(material)
            | Self::Cracking(material)
            | Self::StrainLife(material)
            | Self::Crossland(material)
            | Self::DangVan(material) => material.side,
            Self::Delamination(interface) => interface.side,
        }
    }

    /// The law of a life by strain; `None` of other criteria.
    pub(super) fn strain_life(self, bodies: &Bodies) -> Option<StrainLife> {
        let Self::StrainLife(material) = self else { return None };
        bodies.on(material.side).durabilities().nth(material.number - 1)?.strain_life
    }

    /// Strength of the criterion, a pressure; the strain of a law of life; 1 for interfaces and endurance limits, whose utilisations are searched themselves.
    fn strength(self, bodies: &Bodies) -> Option<f64> {
        let half_space = bodies.on(self.side());
        match self {
            Self::Yield(material) => half_space.strengths().nth(material.number - 1)?.yielding,
            Self::Cracking(material) => half_space.strengths().nth(material.number - 1)?.tensile,
            Self::StrainLife(_) => self.strain_life(bodies).map(|life| life.strain()),
            Self::Delamination(_) | Self::Crossland(_) | Self::DangVan(_) => Some(1.0),
        }
    }

    /// Utilisation by residual stress alone: in a layer under σ_r in both directions, von Mises is |σ_r|; in a cycle without an amplitude
    /// the hydrostatic stress is ⅔σ_r; strains are those of Hooke's law.
    pub fn at_rest(self, bodies: &Bodies) -> f64 {
        let half_space = bodies.on(self.side());
        let residual = |material: MaterialId| half_space.residual_stresses().nth(material.number - 1).unwrap_or(0.0);
        let endured = |material: MaterialId, utilisation: fn(&Endurance, f64) -> f64| {
            let endurance =
                half_space.durabilities().nth(material.number - 1).and_then(|durability| durability.endurance);
            endurance.map_or(0.0, |endurance| utilisation(&endurance, 2.0 / 3.0 * residual(material)).max(0.0))
        };
        let stress = match self {
            Self::Yield(material) => residual(material).abs(),
            Self::Cracking(material) => residual(material).max(0.0),
            Self::Delamination(_) => 0.0,
            Self::StrainLife(material) => {
                let of = half_space.materials().nth(material.number - 1).map(Compliance::from);
                let residual = residual(material);
                let state = StressState { xx: residual, yy: residual, ..StressState::default() };
                let strain = of.map(|compliance| compliance.strain(&state)).unwrap_or_default();
                match self.strain_life(bodies).map(|life| life.direction()) {
                    Some(StrainDirection::Compression) => (-strain.zz).max(0.0),
                    _ => strain.horizontal().max(0.0),
                }
            }
            Self::Crossland(material) => {
                endured(material, |endurance, hydrostatic| endurance.crossland(0.0, hydrostatic))
            }
            Self::DangVan(material) => endured(material, |endurance, hydrostatic| endurance.dang_van(0.0, hydrostatic)),
        };
        self.strength(bodies).map_or(0.0, |strength| stress / strength)
    }
}

impl fmt::Display for Criterion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Yield(material) => write!(f, "yield of {material}"),
            Self::Cracking(material) => write!(f, "cracking of {material}"),
            Self::Delamination(interface) => write!(f, "delamination of {interface}"),
            Self::StrainLife(material) => write!(f, "strain life of {material}"),
            Self::Crossland(material) => write!(f, "fatigue of {material} by Crossland"),
            Self::DangVan(material) => write!(f, "fatigue of {material} by Dang Van"),
        }
    }
}

impl FromStr for Criterion {
    type Err = String;

    /// Reads a [code](Criterion::code), with a name behind it or without.
    fn from_str(text: &str) -> Result<Self, String> {
        let (code, name) = match text.strip_suffix(')').and_then(|text| text.split_once(" (")) {
            Some((code, name)) => (code, Some(name)),
            None => (text, None),
        };
        let name = name.map(Name::new);
        let material = |start: &str| Some(MaterialId { name, ..MaterialId::of_code(code.strip_prefix(start)?)? });
        let interface = |start: &str| Some(InterfaceId { name, ..InterfaceId::of_code(code.strip_prefix(start)?)? });
        let yields = material("yield of ").map(Self::Yield);
        let cracks = || material("cracking of ").map(Self::Cracking);
        let parts = || interface("delamination of ").map(Self::Delamination);
        let lasts = || material("strain_life of ").map(Self::StrainLife);
        let tires =
            || material("crossland of ").map(Self::Crossland).or_else(|| material("dang_van of ").map(Self::DangVan));
        yields
            .or_else(cracks)
            .or_else(parts)
            .or_else(lasts)
            .or_else(tires)
            .ok_or_else(|| format!("criterion {text:?} is not known"))
    }
}

quantities! {
    /// The utilisation of a criterion, and its place.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct Utilisation {
        /// The criterion.
        #[serde(flatten)]
        pub criterion: Criterion,
        /// Stress over strength: 1 where the criterion fails; infinite under a tip.
        #[serde(flatten, with = "serialised::utilisation")]
        pub value: f64 = Utilisation "utilisation" "u" code "utilisation" error error,
        /// Estimated error of the value by the grid.
        pub error: Option<f64>,
        /// Whether the criterion fails, by value and error.
        #[serde(rename = "state")]
        pub verdict: Verdict,
        /// Place x, y, z of the largest utilisation; lengths.
        #[serde(flatten, with = "serialised::place")]
        pub position: [f64; 3],
        /// Another place (x, y, z), lengths, where the utilisation may be largest within the errors; see [`Peak::rival`].
        #[serde(with = "serialised::place_or_none")]
        pub rival: Option<[f64; 3]>,
    }
    table UtilisationQuantities as UTILISATION;
}

impl Utilisation {
    /// The utilisation of a criterion with its error, at a place.
    pub fn new(criterion: Criterion, value: f64, error: Option<f64>, position: [f64; 3]) -> Self {
        let half = error.unwrap_or(0.0);
        let verdict = Verdict::of(value - half, value + half);
        Self { criterion, value, error, verdict, position, rival: None }
    }

    /// The value less its error.
    pub fn least(&self) -> f64 {
        self.value - self.error.unwrap_or(0.0)
    }

    /// The value plus its error.
    pub fn most(&self) -> f64 {
        self.value + self.error.unwrap_or(0.0)
    }

    /// The utilisation of every criterion of the bodies by the largest stresses of a step; those of endurance limits depend on the path
    /// of sliding and are not among them.
    pub fn all(bodies: &Bodies, stress: &StressReading) -> Vec<Self> {
        let of = |criterion: Criterion| {
            let peak: Peak = match criterion {
                Criterion::Yield(material) => stress.in_material(material)?.mises,
                Criterion::Cracking(material) => stress.in_material(material)?.tension,
                Criterion::Delamination(interface) => stress.on_interface(interface)?.delamination?,
                Criterion::StrainLife(material) => {
                    let extremes = stress.in_material(material)?;
                    match criterion.strain_life(bodies)?.direction() {
                        StrainDirection::Tension => extremes.horizontal_strain?,
                        StrainDirection::Compression => extremes.compression?,
                    }
                }
                Criterion::Crossland(_) | Criterion::DangVan(_) => return None,
            };
            Self::by_peak(bodies, criterion, peak)
        };
        Criterion::all(bodies).into_iter().filter_map(of).collect()
    }

    /// The utilisation of a criterion by its largest stress; `None` without a strength.
    pub(super) fn by_peak(bodies: &Bodies, criterion: Criterion, peak: Peak) -> Option<Self> {
        let strength = criterion.strength(bodies)?;
        let error = peak.error.map(|error| error / strength);
        let rival = peak.rival.map(|rival| rival.position);
        Some(Self { rival, ..Self::taken(criterion, peak.value / strength, error, peak.position) })
    }

    /// The utilisation of an endurance limit along the path of sliding.
    pub(super) fn by_path(criterion: Criterion, peak: PathPeak) -> Self {
        Self::taken(criterion, peak.value, peak.error, peak.position)
    }

    /// The utilisation by what is taken up of a strength, below zero where it is pressed: nothing fails by being pressed, and the error
    /// is that of what is above 0. What is not a number stays so.
    fn taken(criterion: Criterion, taken: f64, error: Option<f64>, position: [f64; 3]) -> Self {
        let (value, error) =
            if taken < 0.0 { (0.0, error.map(|error| (taken + error).max(0.0))) } else { (taken, error) };
        Self::new(criterion, value, error, position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, InterfaceStrength, Layer, Material, Strength};

    #[test]
    fn a_code_is_read_back_with_its_name() {
        let name = Some(Name::new("TiN (PVD)"));
        let named = [
            Criterion::Yield(MaterialId { name, ..MaterialId::numbered(2) }),
            Criterion::Delamination(InterfaceId { name, ..InterfaceId::numbered(1) }),
        ];
        let tires = [
            Criterion::DangVan(MaterialId::numbered(2)),
            Criterion::Crossland(MaterialId { name, ..MaterialId::numbered(1) }),
            Criterion::StrainLife(MaterialId { name, ..MaterialId::numbered(3) }),
        ];
        for criterion in named.into_iter().chain([Criterion::cracking_of(3)]).chain(tires) {
            let read: Criterion = criterion.code_with_name().parse().unwrap();
            assert_eq!((read, read.subject()), (criterion, criterion.subject()));
        }
        assert_eq!(named.map(|criterion| criterion.to_string()), ["yield of TiN (PVD)", "delamination of TiN (PVD)"]);
        assert_eq!(named[0].code_with_name(), "yield of material 2 (TiN (PVD))");
        assert!("yield of TiN".parse::<Criterion>().is_err());
    }

    #[test]
    fn criteria_of_several_cases_keep_a_name_that_all_have() {
        let named =
            |name: &str| Criterion::Yield(MaterialId { name: Some(Name::new(name)), ..MaterialId::numbered(1) });
        let texts =
            |all: &[Criterion]| Criterion::distinct(all.to_vec()).iter().map(Criterion::to_string).collect::<Vec<_>>();
        assert_eq!(
            texts(&[named("TiN"), Criterion::cracking_of(1), named("TiN")]),
            ["yield of TiN", "cracking of material 1"]
        );
        assert_eq!(texts(&[named("TiN"), named("CrN"), named("CrN")]), ["yield of material 1"]);
    }

    #[test]
    fn residual_stress_takes_up_its_part_of_yield_and_in_tension_of_cracking() {
        let material = Material::from_young(1.0, 0.3).unwrap();
        let strength = Strength { yielding: Some(4.0), tensile: Some(2.0) };
        let bears = InterfaceStrength { normal: Some(1.0), ..Default::default() };
        let layer = |residual: f64| {
            let layer = Layer::new(material, 1.0, Interface::Bonded).unwrap().with_residual_stress(residual).unwrap();
            layer.with_strengths(strength, bears).unwrap()
        };
        for (residual, known) in [(-3.0, [0.75, 0.0, 0.0]), (3.0, [0.75, 1.5, 0.0])] {
            let bodies = Bodies::from(HalfSpace::new(vec![layer(residual)], material));
            let all = Criterion::all(&bodies);
            let expected = [Criterion::yield_of(1), Criterion::cracking_of(1), Criterion::delamination_of(1)];
            assert_eq!(all, expected);
            assert_eq!(all.iter().map(|criterion| criterion.at_rest(&bodies)).collect::<Vec<_>>(), known);
        }
    }
}
