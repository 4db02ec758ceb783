//! The stresses around a point as a Taylor polynomial of second order.

use super::eight_waves::{STRESSES, TaylorTerms};
use super::tensor::StressState;
use crate::body::Depth;

/// Stresses around a point, to second order.
#[derive(Debug, Clone)]
pub(super) struct Expansion {
    pub depth: Depth,
    /// x, y; lengths.
    pub place: [f64; 2],
    pub terms: TaylorTerms,
}

impl Expansion {
    /// The state in the middle, displacements left out.
    pub fn state(&self) -> StressState {
        StressState::from_stresses(self.terms[0])
    }

    /// The state at the distance **d** = (x, y, z) from the middle, lengths; displacements left out.
    pub fn at(&self, [x, y, z]: [f64; 3]) -> StressState {
        let powers = [1.0, x, y, x * x, x * y, y * y, z, x * z, y * z, z * z];
        let mut stresses = [0.0; STRESSES];
        for (power, term) in powers.iter().zip(&self.terms) {
            for k in 0..STRESSES {
                stresses[k] += power * term[k];
            }
        }
        StressState::from_stresses(stresses)
    }
}
