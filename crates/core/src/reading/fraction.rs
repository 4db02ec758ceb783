//! The fraction of the cell in contact with its uncertainty.

/// One reading of the fraction of the cell in contact, on one grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Fraction {
    /// The fraction, from 0 to 1.
    pub value: f64,
    /// Uncertainty of the fraction, estimated from the samples of this grid alone.
    pub uncertainty: f64,
}
