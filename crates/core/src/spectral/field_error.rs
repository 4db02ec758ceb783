//! Errors of fields that are given to a solver.

use crate::lattice::NotOnGrid;

/// Reason why a field cannot be given to a solver.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// Another shape than that of the finest grid.
    #[error(transparent)]
    Shape(#[from] NotOnGrid),
    /// An initial gap that is negative or not finite.
    #[error("an initial gap must be finite and not negative, not {value} as at sample ({}, {})", sample[0], sample[1])]
    Gap {
        /// [i, j], from 0.
        sample: [usize; 2],
        /// The value.
        value: f64,
    },
    /// A mask without any sample where contact may occur.
    #[error("the mask leaves no sample where contact may occur")]
    EmptyMask,
}
