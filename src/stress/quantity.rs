//! The quantities whose largest values are looked for.

use super::tensor::State;
use crate::body::InterfaceStrength;
use crate::numeric::search::first_largest;

/// How much rounding there may be in a bound, relatively.
const ROUNDING: f64 = 1e-9;

/// A quantity to be maximised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Quantity {
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
pub(super) const OVERALL: [Quantity; 3] = [Quantity::Tau1, Quantity::Tension, Quantity::Mises];

impl Quantity {
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
    pub fn rise(self, state: &State, by: f64) -> f64 {
        match self {
            Self::Delamination(strength) => {
                let (normal, shear) = (state.zz, state.interface_shear());
                strength.utilisation(normal + by, shear + by) - strength.utilisation(normal, shear)
            }
            _ => by,
        }
    }

    /// Its value.
    pub fn of(self, state: &State) -> f64 {
        match self {
            Self::Tau1 => state.tau1(),
            Self::Tension => state.s1(),
            _ => self.bound(state),
        }
    }

    /// What it is at most, without principal stresses: τ₁ ≤ √J₂, σ₁ ≤ σ_kk/3 + 2√(J₂/3); of the others the value itself.
    fn bound(self, state: &State) -> f64 {
        match self {
            Self::Tau1 => state.invariants().1.sqrt(),
            Self::Tension => {
                let (mean, j2) = state.invariants();
                mean + 2.0 * (j2 / 3.0).sqrt()
            }
            Self::Mises => state.mises(),
            Self::Opening => state.zz,
            Self::Shear => state.interface_shear(),
            Self::Delamination(strength) => strength.utilisation(state.zz, state.interface_shear()),
        }
    }

    /// Index and value of the largest at some states, of which there is one at least.
    pub fn largest(self, states: &[State]) -> (usize, f64) {
        let bounds: Vec<f64> = states.iter().map(|state| self.bound(state)).collect();
        let promising = first_largest(bounds.iter().copied()).map_or(0, |(index, _)| index);
        let enough = self.of(&states[promising]);
        // What cannot be larger need not be known; what is not a number is larger.
        let worth = |&j: &usize| bounds[j].is_nan() || bounds[j] >= enough - ROUNDING * enough.abs();
        let numbers: Vec<usize> = (0..states.len()).filter(worth).collect();
        let largest = first_largest(numbers.iter().map(|&j| self.of(&states[j])));
        largest.map_or((promising, enough), |(k, value)| (numbers[k], value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_and_the_largest_is_the_first_of_equals() {
        let state = |k: usize| {
            State::from_stresses(std::array::from_fn(|c| ((k * k * 37 + 11 * c * k + c) % 101) as f64 - 50.0))
        };
        let states: Vec<State> = (0..200).map(state).chain((0..200).map(state)).collect();
        let strength = InterfaceStrength { normal: Some(30.0), shear: Some(7.0) };
        for quantity in OVERALL.into_iter().chain(Quantity::of_interface(strength)) {
            let values: Vec<f64> = states.iter().map(|state| quantity.of(state)).collect();
            assert!(
                states.iter().zip(&values).all(|(state, value)| *value <= quantity.bound(state) + 1e-14 * value.abs())
            );
            assert_eq!(Some(quantity.largest(&states)), first_largest(values.into_iter()));
        }
    }
}
