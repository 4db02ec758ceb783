//! The measures whose largest values are looked for.

use super::tensor::StressState;
use crate::body::InterfaceStrength;
use crate::numeric::search::first_largest;
use std::sync::atomic::{AtomicU64, Ordering};

/// How much rounding there may be in a bound, relatively.
const ROUNDING_MARGIN: f64 = 1e-9;

/// A measure to be maximised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StressMeasure {
    /// τ₁.
    Tau1,
    /// σ₁.
    Tension,
    /// The stress of von Mises.
    Mises,
    /// σ_zz on an interface.
    Opening,
    /// √(σ_xz² + σ_yz²) on an interface.
    Shear,
    /// What an interface of this strength bears, of what it can.
    Delamination(InterfaceStrength),
}

/// What is looked for in every material.
pub(super) const MATERIAL_MEASURES: [StressMeasure; 3] =
    [StressMeasure::Tau1, StressMeasure::Tension, StressMeasure::Mises];

impl StressMeasure {
    /// What is looked for on an interface besides.
    pub fn of_interface(strength: InterfaceStrength) -> impl Iterator<Item = Self> {
        let delamination = (!strength.is_empty()).then_some(Self::Delamination(strength));
        [Self::Opening, Self::Shear].into_iter().chain(delamination)
    }

    /// Whether it is what an interface bears of its strength.
    pub fn is_delamination(&self) -> bool {
        matches!(self, Self::Delamination(_))
    }

    /// By how much it grows where the stresses of a state grow by so much.
    pub fn rise(self, state: &StressState, by: f64) -> f64 {
        match self {
            Self::Delamination(strength) => {
                let (normal, shear) = (state.zz, state.interface_shear());
                strength.utilisation(normal + by, shear + by) - strength.utilisation(normal, shear)
            }
            _ => by,
        }
    }

    /// Its value.
    pub fn of(self, state: &StressState) -> f64 {
        match self {
            Self::Tau1 => state.tau1(),
            Self::Tension => state.s1(),
            Self::Mises => state.mises(),
            Self::Opening => state.zz,
            Self::Shear => state.interface_shear(),
            Self::Delamination(strength) => strength.utilisation(state.zz, state.interface_shear()),
        }
    }

    /// What it is at most, without principal stresses: τ₁ ≤ √J₂, σ₁ ≤ σ_kk/3 + 2√(J₂/3); of the others the value itself, but for
    /// rounding. `mean` is σ_kk/3, `root` √J₂.
    fn bound(self, state: &StressState, mean: f64, root: f64) -> f64 {
        match self {
            Self::Tau1 => root,
            Self::Tension => mean + 2.0 / 3f64.sqrt() * root,
            Self::Mises => 3f64.sqrt() * root,
            _ => self.of(state),
        }
    }
}

/// The largest value that has been found of each measure, by whichever thread. What is surely below need not be known: it is
/// not the largest of all, and so the threads' order does not reach the result.
#[derive(Debug)]
pub(super) struct RunningMaxima<'a> {
    measures: &'a [StressMeasure],
    largest: Vec<AtomicU64>,
}

impl<'a> RunningMaxima<'a> {
    /// Nothing yet.
    pub fn new(measures: &'a [StressMeasure]) -> Self {
        Self { measures, largest: measures.iter().map(|_| AtomicU64::new(0)).collect() }
    }

    /// Index and value of the largest of each measure at `count` states, of which there is one at least; a lower value where
    /// another one that was found is larger than all of them.
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
        let own = self.measures.iter().zip(&self.largest).zip(bounds.chunks_exact(count));
        own.map(|((measure, found), bounds)| {
            let (promising, bound) = first_largest(bounds.iter().copied()).unwrap_or((0, f64::NEG_INFINITY));
            let known = from_ordered(found.load(Ordering::Relaxed));
            if bound < known - ROUNDING_MARGIN * known.abs() {
                return (promising, f64::NEG_INFINITY);
            }
            let enough = measure.of(&state(promising)).max(known);
            // What cannot be larger need not be known; what is not a number is larger.
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

/// A whole number that grows with a number; 0 is below all.
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

    #[test]
    fn bounds_hold_and_the_largest_is_the_first_of_equals() {
        let state = |k: usize| {
            StressState::from_stresses(std::array::from_fn(|c| ((k * k * 37 + 11 * c * k + c) % 101) as f64 - 50.0))
        };
        let states: Vec<StressState> = (0..200).map(state).chain((0..200).map(state)).collect();
        let strength = InterfaceStrength { normal: Some(30.0), shear: Some(7.0) };
        let measures: Vec<StressMeasure> =
            MATERIAL_MEASURES.into_iter().chain(StressMeasure::of_interface(strength)).collect();
        // All at once, and part by part: the largest of all is among what the parts give.
        let found = RunningMaxima::new(&measures);
        let parts: Vec<_> = states.chunks(50).map(|part| found.add(part.len(), |j| part[j])).collect();
        let whole = RunningMaxima::new(&measures).add(states.len(), |j| states[j]);
        for (k, measure) in measures.iter().enumerate() {
            let values: Vec<f64> = states.iter().map(|state| measure.of(state)).collect();
            for (state, value) in states.iter().zip(&values) {
                let (mean, j2) = state.invariants();
                assert!(*value <= measure.bound(state, mean, j2.sqrt()) + 1e-12 * value.abs());
            }
            let largest = first_largest(values.into_iter());
            assert_eq!(Some(whole[k]), largest);
            let (part, value) = first_largest(parts.iter().map(|part| part[k].1)).unwrap();
            assert_eq!(Some((50 * part + parts[part][k].0, value)), largest);
        }
    }

    #[test]
    fn numbers_keep_their_order_as_whole_ones() {
        let numbers = [f64::NEG_INFINITY, -3.0, -1e-300, -0.0, 0.0, 1e-300, 2.5, f64::INFINITY];
        let whole = numbers.map(ordered);
        assert!(0 < whole[0] && whole.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(numbers.iter().zip(whole).all(|(own, number)| from_ordered(number).to_bits() == own.to_bits()));
        assert_eq!(from_ordered(0), f64::NEG_INFINITY);
    }
}
