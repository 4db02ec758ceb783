//! How finely the cell is sampled.

/// The grid of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
pub enum Sampling {
    /// Samples along a₁ and a₂.
    Points([usize; 2]),
    /// Refine until peak pressures, loads, penetration and stresses change by less than this, relatively.
    Accuracy(f64),
}
