//! The quantities whose largest values are looked for.

use super::tensor::State;
use crate::numeric::search::first_largest;

/// How much rounding there may be in a bound, relatively.
const ROUNDING: f64 = 1e-9;

/// A quantity to be maximised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Tau1,
    Tension,
}

/// Both, in the order of their numbers.
pub(super) const QUANTITIES: [Quantity; 2] = [Quantity::Tau1, Quantity::Tension];

impl Quantity {
    /// Its value.
    pub fn of(self, state: &State) -> f64 {
        match self {
            Self::Tau1 => state.tau1(),
            Self::Tension => state.s1(),
        }
    }

    /// What it is at most, without principal stresses: τ₁ ≤ √J₂, σ₁ ≤ σ_kk/3 + 2√(J₂/3).
    fn bound(self, state: &State) -> f64 {
        let (mean, j2) = state.invariants();
        match self {
            Self::Tau1 => j2.sqrt(),
            Self::Tension => mean + 2.0 * (j2 / 3.0).sqrt(),
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
        for quantity in QUANTITIES {
            let values: Vec<f64> = states.iter().map(|state| quantity.of(state)).collect();
            assert!(states.iter().zip(&values).all(|(state, value)| *value <= quantity.bound(state) * (1.0 + 1e-14)));
            assert_eq!(Some(quantity.largest(&states)), first_largest(values.into_iter()));
        }
    }
}
