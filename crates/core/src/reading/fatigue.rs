//! Fatigue by a load step: damage in one pass of the counterbody, and the passes after which each material and interface first has the
//! damage 1.
//!
//! While the counterbody slides over the body a point (y, z) of it meets the stresses of all x. Each cycle of the principal shear stress
//! along that path, of the range Δτ₁ = max τ₁ − min τ₁, does the damage (1/N₀)(Δτ₁/τ₀)^m of the material's [law](crate::body::Fatigue),
//! on an interface that transmits shear each cycle of the traction (σ_xz, σ_yz) with its sign: one that reverses counts twice. Damage
//! adds, over the cycles of a pass, counted by rainflow (ASTM E1049), and over passes, so that a life is 1/max Q passes. A relative error
//! e of the range is one of m·e of the passes.
//!
//! A pass is one period of a cell, in which a point meets each level once or more, and each of them makes its cycles: a cell of two
//! periods has half the passes and the same distance. The [`SlidingPath`] says along which way. An elastic counterbody is not swept: its
//! points stay under the contact, and one pass is loading it and unloading it, with Δτ₁ = |τ₁ − τ₁ at rest|.

use super::strength::Criterion;
use super::stress::{Tip, beside_site, contact_radii};
use super::{Reading, Utilisation};
use crate::body::{Bodies, Fatigue, HalfSpace, InterfaceId, MaterialId, Side, StrainDirection};
use crate::measured::Measured;
use crate::notation::power_error;
use crate::numeric::serialised;
use crate::problem::Problem;
use crate::quantity::quantities;
use crate::spectral::Step;
use crate::stress::{
    Others, PassOver, PathPeak, PathPeaks, PathSought, RangePlane, SlidingPath, StressField, StressFields, transmitted,
};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A material or an interface, which tires.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum FatiguePart {
    /// A material with a life by strain.
    Strained(StrainedMaterial),
    /// A material.
    Material(MaterialId),
    /// An interface.
    Interface(InterfaceId),
}

/// A material and the strain by which its life is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct StrainedMaterial {
    /// The material.
    #[serde(flatten)]
    pub material: MaterialId,
    /// Horizontal tension or vertical compression.
    pub strain: StrainDirection,
}

impl FatiguePart {
    /// Whether a life goes on without the part: one of an elastic counterbody, and a material that fails by strain, are not followed.
    pub fn is_followed(self) -> bool {
        !self.is_counterbody() && !matches!(self, Self::Strained(_))
    }

    /// Whether it is one of an elastic counterbody.
    pub fn is_counterbody(self) -> bool {
        match self {
            Self::Strained(strained) => strained.material.is_counterbody(),
            Self::Material(material) => material.side == Some(Side::Counterbody),
            Self::Interface(interface) => interface.is_counterbody(),
        }
    }
}

impl fmt::Display for FatiguePart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Strained(StrainedMaterial { material, strain: StrainDirection::Tension }) => {
                write!(f, "{material} by horizontal strain")
            }
            Self::Strained(StrainedMaterial { material, strain: StrainDirection::Compression }) => {
                write!(f, "{material} by vertical compression")
            }
            Self::Material(material) => material.fmt(f),
            Self::Interface(interface) => interface.fmt(f),
        }
    }
}

quantities! {
    /// How long a material or an interface lasts.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct Life {
        /// The material or interface that tires.
        #[serde(flatten)]
        pub part: FatiguePart,
        /// Largest range of τ₁ along the path, or of the shear traction of an interface, a pressure: that of one cycle that does the damage
        /// of all cycles of a pass; by strain the largest strain. Infinite under a tip.
        #[serde(deserialize_with = "serialised::infinite")]
        pub range: f64,
        /// Damage in one pass by that range; infinite under a tip.
        #[serde(deserialize_with = "serialised::infinite")]
        pub damage: f64,
        /// Passes until the damage first reaches 1; infinite without a range.
        #[serde(deserialize_with = "serialised::infinite")]
        pub passes: f64 = Passes "passes to damage" "N"
            by |life: &Life| Some(Measured::new(life.passes, life.error.map(|error| error * life.passes))),
        /// Estimated relative error of the passes by the grid, m times that of the range; `None` without a coarser grid, and where the passes
        /// are zero or infinite.
        pub error: Option<f64>,
        /// Place x, y, z of the damage, lengths: x is where τ₁ is largest, in the frame of the counterbody.
        #[serde(flatten, with = "serialised::place")]
        pub position: [f64; 3],
    }
    table LifeQuantities as LIFE;
}

/// Lives of all that tires in a load step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FatigueReading {
    /// The path on which points of the body meet the stresses.
    pub path: SlidingPath,
    /// The shortest life.
    pub first: Life,
    /// Lives of the materials with a law of fatigue, from the surface down, then of such interfaces; an elastic counterbody follows
    /// the body; lives by strain follow both.
    pub lives: Vec<Life>,
}

impl Life {
    /// The life of a part by a law, under a range with its error, pressures, at a place.
    pub fn new(part: FatiguePart, law: Fatigue, range: f64, error: Option<f64>, position: [f64; 3]) -> Self {
        let relative = error.map(|error| law.exponent() * error / range);
        Self::of_damage(part, range, law.damage(range), relative, position)
    }

    /// The life by strain of a material whose strain has a utilisation; `None` of other criteria.
    fn by_strain(bodies: &Bodies, utilisation: &Utilisation) -> Option<Self> {
        let Utilisation { criterion, value, error, position, .. } = *utilisation;
        let (Criterion::StrainLife(material), law) = (criterion, criterion.strain_life(bodies)?) else { return None };
        let part = FatiguePart::Strained(StrainedMaterial { material, strain: law.direction() });
        let (strain, relative) = (value * law.strain(), error.map(|error| law.exponent() * error / value));
        Some(Self::of_damage(part, strain, law.damage(strain), relative, position))
    }

    fn of_damage(part: FatiguePart, range: f64, damage: f64, relative: Option<f64>, position: [f64; 3]) -> Self {
        let passes = 1.0 / damage;
        let is_known = passes > 0.0 && passes.is_finite();
        Self { part, range, damage, passes, error: relative.filter(|_| is_known), position }
    }

    /// The life in words, numbers formatted by `format`: "TiN after 3.2e6 passes ± 8 %".
    pub fn in_words(&self, format: impl Fn(f64) -> String) -> String {
        let error = power_error(self.error);
        match self.passes {
            0.0 => format!("{} in the first pass, under a tip", self.part),
            passes if passes.is_finite() => format!("{} after {} passes{error}", self.part, format(passes)),
            _ => format!("{} after no number of passes", self.part),
        }
    }
}

impl FatigueReading {
    /// A reading of some lives; `None` without any.
    pub fn new(path: SlidingPath, lives: Vec<Life>) -> Option<Self> {
        // The first one of equal lives.
        let shorter = |a: Life, b: Life| if b.passes < a.passes { b } else { a };
        let first = lives.iter().copied().reduce(shorter)?;
        Some(Self { path, first, lives })
    }

    /// The fatigue by a step that has contact and whose `reading` is known, by its stress `fields`; `None` where nothing has a law of
    /// fatigue.
    pub fn of(step: &Step, reading: &Reading, fields: &StressFields) -> Option<Self> {
        let sought = PathSought { fatigue: true, endurance: false, map: false };
        PathReading::of_while(step, reading, fields, sought, &|| true).and_then(|path| path.fatigue)
    }

    /// A reading, or none, with the lives by strain of the `utilisations` of a problem.
    pub(crate) fn with_strains(of: Option<Self>, problem: &Problem, utilisations: &[Utilisation]) -> Option<Self> {
        let lives: Vec<Life> =
            utilisations.iter().filter_map(|utilisation| Life::by_strain(problem.bodies(), utilisation)).collect();
        if lives.is_empty() {
            return of;
        }
        let (path, all) = match of {
            Some(Self { path, lives, .. }) => (path, lives),
            None => (SlidingPath::of(problem.cell(), problem.direction()), Vec::new()),
        };
        Self::new(path, [all, lives].concat())
    }

    /// The life of a part.
    pub fn life(&self, part: FatiguePart) -> Option<&Life> {
        self.lives.iter().find(|life| life.part == part)
    }
}

/// A pass of the counterbody.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pass<'a> {
    /// Length of one way over a lattice, a length; `None`: one period. A point comes past an isolated contact once in one way.
    pub way: Option<f64>,
    /// The contact on the way back, solved on the same grids, where the counterbody goes to and fro.
    pub back: Option<&'a Step>,
    /// The other steps of a cycle, in their order, on the same grids, in which points stay in place; empty where the counterbody slides.
    pub moments: &'a [Step],
}

/// Lives and utilisations of a step by the stresses along the path of sliding.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct PathReading {
    /// Lives; `None` where nothing has a law of fatigue, or none is sought.
    pub fatigue: Option<FatigueReading>,
    /// Utilisations of endurance limits.
    pub utilisations: Vec<Utilisation>,
    /// Range of τ₁ on planes of the materials of the body that have a law of fatigue.
    pub planes: Vec<RangePlane>,
}

impl PathReading {
    /// The readings that are `sought` of a step that has contact; `None` when `goes_on`, called many times a second during the search, returns false.
    pub fn of_while(
        step: &Step,
        reading: &Reading,
        fields: &StressFields,
        sought: PathSought,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<Self> {
        Self::of_pass(step, reading, fields, (sought, &Pass::default()), goes_on)
    }

    /// The reading `sought` of a step in a pass, as [`Self::of_while`].
    pub fn of_pass(
        step: &Step,
        reading: &Reading,
        fields: &StressFields,
        (sought, pass): (PathSought, &Pass<'_>),
        goes_on: &dyn Fn() -> bool,
    ) -> Option<Self> {
        let has_any = |half_space: &HalfSpace| {
            let durabilities = || half_space.durabilities();
            let tires = durabilities().any(|durability| durability.fatigue.is_some())
                || half_space.layers().iter().any(|layer| transmitted(layer).is_some());
            sought.fatigue && tires
                || sought.endurance && durabilities().any(|durability| durability.endurance.is_some())
        };
        let wanted: Vec<&StressField> = fields.each().filter(|field| has_any(field.half_space())).collect();
        if wanted.is_empty() {
            return Some(Self::default());
        }
        let coarser = step.coarser().first().and_then(|contact| fields.of_other(contact));
        let back = pass.back.and_then(|step| fields.of_other(step.finest()));
        let coarser_back = pass.back.and_then(|step| fields.of_other(step.coarser().first()?));
        let moments: Vec<StressFields> =
            pass.moments.iter().filter_map(|step| fields.of_other(step.finest())).collect();
        let coarser_moments: Vec<StressFields> =
            pass.moments.iter().filter_map(|step| fields.of_other(step.coarser().first()?)).collect();
        let (direction, radii) = (step.problem().direction(), contact_radii(step, reading));
        let (mut lives, mut utilisations, mut path, mut planes) = (Vec::new(), Vec::new(), None, Vec::new());
        for field in wanted {
            let side = field.half_space().side();
            let coarser = coarser.as_ref().map(|coarser| coarser.on(side));
            let over = PassOver {
                way: pass.way.filter(|_| side != Some(Side::Counterbody)),
                others: others(back.as_ref(), &moments, side),
                coarser: others(coarser_back.as_ref(), &coarser_moments, side),
            };
            // A cycle has no error without all of its steps on the next coarser grid.
            let coarser = coarser.filter(|_| over.coarser.moments.len() == over.others.moments.len());
            let mut peaks = field.path_peaks_of_pass(direction, radii, (sought, over), coarser, goes_on)?;
            peaks.each().for_each(|peak| peak.position = beside_site(step, peak.position));
            if let Some(tip) = Tip::of(step, reading, field.half_space()) {
                peaks.in_surface().for_each(|peak| tip.press_path(peak));
            }
            path = path.or(Some(peaks.path));
            if side != Some(Side::Counterbody) {
                planes = std::mem::take(&mut peaks.planes);
            }
            lives.extend(lives_of(field.half_space(), &peaks));
            utilisations.extend(utilisations_of(field.half_space(), &peaks));
        }
        Some(Self { fatigue: path.and_then(|path| FatigueReading::new(path, lives)), utilisations, planes })
    }
}

/// Stresses that points of the body on a side meet on the way back and at other moments: a counterbody stays below the contact.
fn others<'a>(back: Option<&'a StressFields>, moments: &'a [StressFields], side: Option<Side>) -> Others<'a> {
    Others {
        back: back.filter(|_| side != Some(Side::Counterbody)).map(StressFields::body),
        moments: moments.iter().map(|moment| moment.on(side)).collect(),
    }
}

/// Lives of a body's materials and interfaces.
fn lives_of<'a>(half_space: &'a HalfSpace, peaks: &'a PathPeaks) -> impl Iterator<Item = Life> + 'a {
    let life =
        |part: FatiguePart, law: Fatigue, peak: PathPeak| Life::new(part, law, peak.value, peak.error, peak.position);
    let materials = (1..).zip(half_space.durabilities()).zip(&peaks.materials);
    let materials = materials.filter_map(move |((number, durability), peaks)| {
        Some(life(FatiguePart::Material(half_space.material_id(number)), durability.fatigue?, peaks.range?))
    });
    let interfaces = (1..).zip(half_space.layers()).zip(&peaks.interfaces);
    let interfaces = interfaces.filter_map(move |((number, layer), peak)| {
        Some(life(FatiguePart::Interface(half_space.interface_id(number)), transmitted(layer)?, (*peak)?))
    });
    materials.chain(interfaces)
}

/// Utilisations of the endurance limits of a body's materials.
fn utilisations_of<'a>(half_space: &'a HalfSpace, peaks: &'a PathPeaks) -> impl Iterator<Item = Utilisation> + 'a {
    (1..).zip(&peaks.materials).flat_map(move |(number, peaks)| {
        let material = half_space.material_id(number);
        let crossland = peaks.crossland.map(|peak| Utilisation::by_path(Criterion::Crossland(material), peak));
        let dang_van = peaks.dang_van.map(|peak| Utilisation::by_path(Criterion::DangVan(material), peak));
        crossland.into_iter().chain(dang_van)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(exponent: f64) -> Fatigue {
        Fatigue::new(0.4, 1e6, exponent).unwrap()
    }

    #[test]
    fn twice_the_amplitude_lasts_longer_by_the_power_of_two_and_the_error_is_that_of_the_range_by_the_exponent() {
        let part = FatiguePart::Material(MaterialId::numbered(1));
        let life =
            |amplitude: f64| Life::new(part, Fatigue::new(amplitude, 1e6, 8.0).unwrap(), 0.2, Some(0.002), [0.0; 3]);
        let [once, twice] = [0.4, 0.8].map(life);
        assert!((twice.passes / once.passes / 256.0 - 1.0).abs() < 1e-13);
        assert!((once.damage * once.passes - 1.0).abs() < 1e-15 && (once.error.unwrap() - 0.08).abs() < 1e-15);
        assert_eq!(once.in_words(|x| format!("{x:.2e}")), "material 1 after 2.56e8 passes ± 8 %");
        let none = Life::new(part, law(8.0), 0.0, Some(0.1), [0.0; 3]);
        assert_eq!((none.passes, none.error), (f64::INFINITY, None));
        assert_eq!(Life::new(part, law(8.0), f64::INFINITY, None, [0.0; 3]).passes, 0.0);
    }

    #[test]
    fn the_shortest_life_is_the_first() {
        let [one, two] =
            [FatiguePart::Material(MaterialId::numbered(1)), FatiguePart::Interface(InterfaceId::numbered(1))];
        let life = |part: FatiguePart, range: f64| Life::new(part, law(6.0), range, None, [0.0, 1.0, 2.0]);
        let path = SlidingPath::LatticeVector([1, 0]);
        let reading = FatigueReading::new(path, vec![life(one, 0.1), life(two, 0.3)]).unwrap();
        assert_eq!((reading.first.part, reading.life(one).unwrap().range), (two, 0.1));
        assert_eq!(FatigueReading::new(path, Vec::new()), None);
    }

    #[test]
    fn a_reading_is_read_back_from_its_json() {
        let [one, two] =
            [FatiguePart::Material(MaterialId::numbered(1)), FatiguePart::Interface(InterfaceId::numbered(2))];
        let strained = StrainedMaterial { material: MaterialId::numbered(3), strain: StrainDirection::Compression };
        assert_eq!(
            strained.material.to_string() + " by vertical compression",
            FatiguePart::Strained(strained).to_string()
        );
        let strained = FatiguePart::Strained(strained);
        let life = |part: FatiguePart, range: f64| Life::new(part, law(6.0), range, Some(1e-3), [0.5, 1.0, 2.0]);
        for path in [SlidingPath::LatticeVector([1, -2]), SlidingPath::WholePlane, SlidingPath::FromFarAway] {
            let lives = vec![life(one, 0.3), life(two, 0.0), life(two, f64::INFINITY), life(strained, 2e-4)];
            let reading = FatigueReading::new(path, lives).unwrap();
            let text = serde_json::to_string(&reading).unwrap();
            let back: FatigueReading = serde_json::from_str(&text).unwrap();
            assert_eq!(back, reading, "{text}");
        }
    }
}
