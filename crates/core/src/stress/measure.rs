//! Stress measures whose largest values are searched.

use super::strain::Compliance;
use super::tensor::StressState;
use crate::body::{HalfSpace, InterfaceStrength, StrainDirection, StrainLife, Strength};
use crate::numeric::search::first_largest;
use std::sync::atomic::{AtomicU64, Ordering};

/// Largest relative rounding error of a bound.
const ROUNDING_MARGIN: f64 = 1e-9;

/// A scalar measure of the stresses at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StressMeasure {
    /// Principal shear stress τ₁.
    Tau1,
    /// Largest principal stress σ₁.
    Tension,
    /// Von Mises stress.
    Mises,
    /// Largest principal strain ε₁ in a material of this compliance.
    Strain(Compliance),
    /// Largest normal strain of the horizontal directions.
    HorizontalStrain(Compliance),
    /// Compression along z, −ε_zz.
    Compression(Compliance),
    /// Opening stress σ_zz on an interface.
    Opening,
    /// Shear stress √(σ_xz² + σ_yz²) on an interface.
    Shear,
    /// Utilisation of the strength of an interface, dimensionless.
    Delamination(InterfaceStrength),
}

/// Measures of stress that are maximised in every material.
pub(super) const MATERIAL_MEASURES: [StressMeasure; 3] =
    [StressMeasure::Tau1, StressMeasure::Tension, StressMeasure::Mises];

/// Largest stresses that are searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sought {
    /// All measures of stress of each material, each face and each interface, and those of strain where `strains` is set.
    All { strains: bool },
    /// Measures by which strengths are judged, where there are strengths.
    Strengths,
}

impl Sought {
    /// Whether strains of a body are sought.
    pub fn strains(self, half_space: &HalfSpace) -> bool {
        match self {
            Self::All { strains } => strains,
            Self::Strengths => half_space.durabilities().any(|durability| durability.strain_life.is_some()),
        }
    }

    /// Measures of a material of this strength and life by strain, and of this compliance.
    pub fn in_material(
        self,
        (strength, life): (Strength, Option<StrainLife>),
        compliance: Compliance,
    ) -> Vec<StressMeasure> {
        let is_sought = |measure: &StressMeasure| match (self, measure) {
            (Self::All { .. }, _) => true,
            (Self::Strengths, StressMeasure::Tension) => strength.tensile.is_some(),
            (Self::Strengths, StressMeasure::Mises) => strength.yielding.is_some(),
            (Self::Strengths, _) => false,
        };
        let of_strain = StressMeasure::of_strain(compliance);
        let of_strain = of_strain.iter().filter(|measure| match self {
            Self::All { strains } => strains,
            Self::Strengths => life.is_some_and(|life| measure.is_of_life(life)),
        });
        MATERIAL_MEASURES.iter().filter(|measure| is_sought(measure)).chain(of_strain).copied().collect()
    }

    /// Further measures on an interface of this strength.
    pub fn on_interface(self, strength: InterfaceStrength) -> Vec<StressMeasure> {
        let all = StressMeasure::of_interface(strength);
        all.filter(|measure| self != Self::Strengths || measure.is_delamination()).collect()
    }
}

impl StressMeasure {
    /// Further measures that are maximised on an interface of the given strength.
    fn of_interface(strength: InterfaceStrength) -> impl Iterator<Item = Self> {
        let delamination = (!strength.is_empty()).then_some(Self::Delamination(strength));
        [Self::Opening, Self::Shear].into_iter().chain(delamination)
    }

    /// Measures of strain in a material of this compliance.
    fn of_strain(compliance: Compliance) -> [Self; 3] {
        [Self::Strain, Self::HorizontalStrain, Self::Compression].map(|measure| measure(compliance))
    }

    /// Whether the measure is one of an interface, not of a material.
    pub fn is_of_interface(&self) -> bool {
        matches!(self, Self::Opening | Self::Shear | Self::Delamination(_))
    }

    /// Whether the measure is a tension or an extension, which is small where a material is incompressible.
    pub fn is_tensile(&self) -> bool {
        matches!(self, Self::Tension | Self::Strain(_) | Self::HorizontalStrain(_))
    }

    /// Whether the measure is a strain.
    pub fn is_strain(&self) -> bool {
        matches!(self, Self::Strain(_) | Self::HorizontalStrain(_) | Self::Compression(_))
    }

    /// Whether the measure is the strain of a law of life.
    pub fn is_of_life(&self, life: StrainLife) -> bool {
        match life.direction() {
            StrainDirection::Tension => matches!(self, Self::HorizontalStrain(_)),
            StrainDirection::Compression => matches!(self, Self::Compression(_)),
        }
    }

    /// Whether the measure is one by which laws of life count strains.
    pub fn is_counted_strain(&self) -> bool {
        matches!(self, Self::HorizontalStrain(_) | Self::Compression(_))
    }

    /// Whether the measure is the utilisation of an interface.
    pub fn is_delamination(&self) -> bool {
        matches!(self, Self::Delamination(_))
    }

    /// Largest rise of the measure of a state when stresses of the size √(Σσᵢⱼ²) = `by`, a pressure, are added.
    pub fn rise(self, state: &StressState, by: f64) -> f64 {
        match self {
            Self::Delamination(strength) => {
                let (normal, shear) = (state.zz, state.interface_shear());
                strength.utilisation(normal + by, shear + by) - strength.utilisation(normal, shear)
            }
            // √(3/2 s:s) of a deviator no larger than the stresses.
            Self::Mises => 1.5f64.sqrt() * by,
            _ => self.per_stress() * by,
        }
    }

    /// The measure that a stress of size 1 makes at most: 1 of a stress, one over a pressure of a strain.
    pub fn per_stress(self) -> f64 {
        match self {
            Self::Strain(compliance) | Self::HorizontalStrain(compliance) | Self::Compression(compliance) => {
                compliance.size()
            }
            _ => 1.0,
        }
    }

    /// Value of the measure.
    pub fn of(self, state: &StressState) -> f64 {
        match self {
            Self::Tau1 => state.tau1(),
            Self::Tension => state.s1(),
            Self::Mises => state.mises(),
            Self::Strain(compliance) => compliance.first(state.s1(), state.mean()),
            Self::HorizontalStrain(compliance) => compliance.strain(state).horizontal(),
            Self::Compression(compliance) => -compliance.strain(state).zz,
            Self::Opening => state.zz,
            Self::Shear => state.interface_shear(),
            Self::Delamination(strength) => strength.utilisation(state.zz, state.interface_shear()),
        }
    }

    /// Upper bound of the measure without principal stresses: τ₁ ≤ √J₂, σ₁ ≤ σ_kk/3 + 2√(J₂/3), and ε₁ by σ₁; for the other measures the
    /// value itself, up to rounding. `mean` is σ_kk/3, `root` is √J₂.
    fn bound(self, state: &StressState, mean: f64, root: f64) -> f64 {
        match self {
            Self::Tau1 => root,
            Self::Tension => mean + 2.0 / 3f64.sqrt() * root,
            Self::Strain(compliance) => compliance.first(mean + 2.0 / 3f64.sqrt() * root, mean),
            Self::Mises => 3f64.sqrt() * root,
            _ => self.of(state),
        }
    }
}

/// Running maximum of each measure over all threads. States whose bound lies below it are not evaluated: none of them is the
/// largest, so that the result does not depend on the order of the threads.
#[derive(Debug)]
pub(super) struct RunningMaxima<'a> {
    measures: &'a [StressMeasure],
    largest: Vec<AtomicU64>,
}

impl<'a> RunningMaxima<'a> {
    /// Without any value yet.
    pub fn new(measures: &'a [StressMeasure]) -> Self {
        Self { measures, largest: measures.iter().map(|_| AtomicU64::new(0)).collect() }
    }

    /// Index and value of the largest of `count` ≥ 1 states by each measure; a lower value where the running maximum exceeds all of
    /// them.
    pub fn add(&self, count: usize, state: impl Fn(usize) -> StressState) -> Vec<(usize, f64)> {
        let mut bounds = vec![0.0; self.measures.len() * count];
        for j in 0..count {
            let state = state(j);
            let (mean, j2) = state.invariants();
            let root = j2.sqrt();
            for (k, measure) in self.measures.iter().enumerate() {
                bounds[k * count + j] = measure.bound(&state, mean, root);
            }
        }
        let rows = self.measures.iter().zip(&self.largest).zip(bounds.chunks_exact(count));
        rows.map(|((measure, found), bounds)| {
            let (promising, bound) = first_largest(bounds.iter().copied()).unwrap_or((0, f64::NEG_INFINITY));
            let known = from_ordered(found.load(Ordering::Relaxed));
            if bound < known - ROUNDING_MARGIN * known.abs() {
                return (promising, f64::NEG_INFINITY);
            }
            let enough = measure.of(&state(promising)).max(known);
            // States that cannot be larger are skipped; values that are not numbers are kept.
            let worth = |&j: &usize| bounds[j].is_nan() || bounds[j] >= enough - ROUNDING_MARGIN * enough.abs();
            let numbers: Vec<usize> = (0..count).filter(worth).collect();
            let largest = first_largest(numbers.iter().map(|&j| measure.of(&state(j))));
            let Some((k, value)) = largest else { return (promising, f64::NEG_INFINITY) };
            if !value.is_nan() {
                found.fetch_max(ordered(value), Ordering::Relaxed);
            }
            (numbers[k], value)
        })
        .collect()
    }
}

/// Order-preserving map of a number to an integer; 0 is below all numbers.
fn ordered(value: f64) -> u64 {
    let bits = value.to_bits();
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

fn from_ordered(number: u64) -> f64 {
    if number == 0 {
        return f64::NEG_INFINITY;
    }
    f64::from_bits(if number >> 63 == 1 { number & !(1 << 63) } else { !number })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Material;

    /// A state whose stresses lie between −50 and 50.
    fn state(k: usize) -> StressState {
        StressState::from_stresses(std::array::from_fn(|c| ((k * k * 37 + 11 * c * k + c) % 101) as f64 - 50.0))
    }

    /// All measures, those of strains for two materials, one of them incompressible.
    fn every_measure() -> Vec<StressMeasure> {
        let strength = InterfaceStrength { normal: Some(30.0), shear: Some(7.0), friction: 0.3 };
        let materials = [(210.0, 0.3), (2.0, 0.5)].map(|(young, nu)| Material::from_young(young, nu).unwrap());
        let of_strain = materials.into_iter().flat_map(|material| StressMeasure::of_strain(material.into()));
        MATERIAL_MEASURES.into_iter().chain(of_strain).chain(StressMeasure::of_interface(strength)).collect()
    }

    #[test]
    fn bounds_hold_and_the_largest_is_the_first_of_equals() {
        let states: Vec<StressState> = (0..200).map(state).chain((0..200).map(state)).collect();
        let measures = every_measure();
        // All at once, and part by part: the largest of all is among what the parts give.
        let found = RunningMaxima::new(&measures);
        let parts: Vec<_> = states.chunks(50).map(|part| found.add(part.len(), |j| part[j])).collect();
        let whole = RunningMaxima::new(&measures).add(states.len(), |j| states[j]);
        for (k, measure) in measures.iter().enumerate() {
            let values: Vec<f64> = states.iter().map(|state| measure.of(state)).collect();
            for (state, value) in states.iter().zip(&values) {
                let (mean, j2) = state.invariants();
                let rounding = 1e-12 * measure.per_stress() * state.size();
                assert!(*value <= measure.bound(state, mean, j2.sqrt()) + rounding, "{measure:?}");
            }
            let largest = first_largest(values.into_iter());
            assert_eq!(Some(whole[k]), largest);
            let (part, value) = first_largest(parts.iter().map(|part| part[k].1)).unwrap();
            assert_eq!(Some((50 * part + parts[part][k].0, value)), largest);
        }
    }

    #[test]
    fn strains_are_those_of_the_tensor_and_no_added_stresses_raise_a_measure_by_more() {
        let of_size_one = |k: usize| {
            let added = state(3 * k + 1).components();
            StressState::from_components(added.map(|component| component / state(3 * k + 1).size()))
        };
        for measure in every_measure().into_iter().filter(|measure| !measure.is_delamination()) {
            let mut largest = 0.0f64;
            for (k, by) in (0..200).map(|k| (k, 0.01 * (1 + k % 7) as f64)) {
                let (base, added) = (state(k), of_size_one(k));
                let sum: [f64; 9] = std::array::from_fn(|c| base.components()[c] + by * added.components()[c]);
                let rise = measure.of(&StressState::from_components(sum)) - measure.of(&base);
                assert!(rise <= measure.rise(&base, by) * (1.0 + 1e-9), "{measure:?}: {rise}");
                largest = largest.max(rise / measure.rise(&base, by));
            }
            assert!(largest > 0.5, "{measure:?}: {largest}");
        }
        let material = Material::from_young(210.0, 0.3).unwrap();
        let strain = Compliance::from(material).strain(&state(3));
        let [first, horizontal, compression] =
            StressMeasure::of_strain(material.into()).map(|measure| measure.of(&state(3)));
        assert!((first - strain.principal()[0]).abs() < 1e-14 && (horizontal - strain.horizontal()).abs() < 1e-14);
        assert!((compression + strain.zz).abs() < 1e-14);
    }

    /// The bound is reached by the stresses [(1 + ν) n_i n_j − ν δ_ij], which strain along **n** most for their size.
    #[test]
    fn the_stresses_that_strain_most_for_their_size_reach_the_rise() {
        let nu = 0.3;
        let material = Material::from_young(210.0, nu).unwrap();
        let along = |n: [f64; 3]| {
            let of = |i: usize, j: usize| (1.0 + nu) * n[i] * n[j] - if i == j { nu } else { 0.0 };
            StressState::from_stresses([of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(0, 2), of(1, 2)])
        };
        let [first, horizontal, compression] = StressMeasure::of_strain(material.into());
        let rest = StressState::default();
        for (measure, stress) in [(first, along([0.6, 0.0, 0.8])), (horizontal, along([0.6, 0.8, 0.0]))] {
            assert!((measure.of(&stress) / measure.rise(&rest, stress.size()) - 1.0).abs() < 1e-12);
        }
        let pressed = StressState::from_components(along([0.0, 0.0, 1.0]).components().map(|component| -component));
        assert!((compression.of(&pressed) / compression.rise(&rest, pressed.size()) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn numbers_keep_their_order_as_whole_ones() {
        let numbers = [f64::NEG_INFINITY, -3.0, -1e-300, -0.0, 0.0, 1e-300, 2.5, f64::INFINITY];
        let whole = numbers.map(ordered);
        assert!(0 < whole[0] && whole.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(numbers.iter().zip(whole).all(|(number, whole)| from_ordered(whole).to_bits() == number.to_bits()));
        assert_eq!(from_ordered(0), f64::NEG_INFINITY);
    }
}
