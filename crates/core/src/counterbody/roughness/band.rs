//! The waves of a cell up to a wavenumber.

use crate::lattice::Cell;
use std::f64::consts::TAU;

/// Relative tolerance within which wavenumbers are equal to a cut-off.
pub(super) const CUTOFF_TOLERANCE: f64 = 1e-9;

/// One of each pair ±**q** of a cell's waves up to a wavenumber: κ₂ > 0, or κ₂ = 0 and κ₁ > 0.
pub(super) struct WaveBand {
    reciprocal: [[f64; 2]; 2],
    /// Largest |κ₁| and |κ₂|: κᵢ = **q**·**a**ᵢ/2π.
    pub most: [i32; 2],
}

impl WaveBand {
    /// Band of the waves up to the wavenumber `high`, 1/length.
    pub fn new(cell: Cell, high: f64) -> Self {
        let most = cell.vectors().map(|[x, y]| (high * x.hypot(y) / TAU * (1.0 + CUTOFF_TOLERANCE)) as i32);
        Self { reciprocal: cell.reciprocal(), most }
    }

    /// All κ₂ of the band.
    pub fn rows(&self) -> std::ops::RangeInclusive<i32> {
        0..=self.most[1]
    }

    /// Waves of one κ₂, each with its wavevector, 1/length; those in the corners lie beyond the wavenumber.
    pub fn waves(&self, k2: i32) -> impl Iterator<Item = ([i32; 2], [f64; 2])> + '_ {
        let [b1, b2] = self.reciprocal;
        let first = if k2 == 0 { 1 } else { -self.most[0] };
        let at = move |k1: i32| [0, 1].map(|c| f64::from(k1) * b1[c] + f64::from(k2) * b2[c]);
        (first..=self.most[0]).map(move |k1| ([k1, k2], at(k1)))
    }
}
