//! Local compliance: the surfaces give way where they are pressed, beside what the bodies displace.
//!
//! A sample gives way by c p under its own pressure p, and by a⟨p⟩ under the mean on its line along the direction of sliding
//! ([`SlidingMean`]). In Fourier space that is c for every wave, and a for those that are constant along the line: an
//! [operator](super::LayeredOperator::soften) adds both to its tables for a while.

use super::sliding_mean::SlidingMean;
use crate::numeric::array::field;
use ndarray::Array2;

/// Compliance of the surfaces themselves on one grid.
#[derive(Debug)]
pub(super) struct LocalCompliance {
    points: [usize; 2],
    /// a, a length per pressure, and the mean; `None` where nothing gives way to it.
    on_lines: Option<(f64, SlidingMean)>,
    /// c, a length per pressure.
    uniform: f64,
}

impl LocalCompliance {
    /// Compliance on a grid of `points`: a under the mean on a line, `uniform` = c under the pressure of a sample, lengths per pressure.
    pub fn new(points: [usize; 2], on_lines: Option<(f64, SlidingMean)>, uniform: f64) -> Self {
        Self { points, on_lines, uniform }
    }

    /// c, a length per pressure: the compliance of every wave.
    pub fn uniform(&self) -> f64 {
        self.uniform
    }

    /// Compliance of the wave q = 0, a length per pressure.
    pub fn mean(&self) -> f64 {
        self.uniform + self.on_lines.as_ref().map_or(0.0, |(factor, _)| *factor)
    }

    /// Components (k₁, k₂) of the grid that are constant on the lines, each once with its further compliance, a length per pressure.
    pub fn of_lines(&self) -> Vec<([usize; 2], f64)> {
        let times = |(factor, mean): &(f64, SlidingMean)| scaled(*factor, mean.components());
        self.on_lines.as_ref().map(times).unwrap_or_default()
    }

    /// Components as in [`Self::of_lines`], for a window that is padded to a grid of `points`.
    pub fn of_lines_padded(&self, points: [usize; 2]) -> Vec<([usize; 2], f64)> {
        let times = |(factor, mean): &(f64, SlidingMean)| scaled(*factor, &mean.padded(points));
        self.on_lines.as_ref().map(times).unwrap_or_default()
    }

    /// Displacements by the mean on a line and by the pressure of a sample, lengths, axes along a₁ and a₂; `None` where nothing gives way
    /// to it.
    pub fn displacements(&self, pressure: &[f64]) -> [Option<Array2<f64>>; 2] {
        let on_lines = self.on_lines.as_ref().map(|(factor, mean)| field(self.points, mean.of(pressure)) * *factor);
        let uniform =
            (self.uniform > 0.0).then(|| field(self.points, pressure.iter().map(|p| self.uniform * p).collect()));
        [on_lines, uniform]
    }
}

fn scaled(factor: f64, parts: &[([usize; 2], f64)]) -> Vec<([usize; 2], f64)> {
    parts.iter().map(|&(component, part)| (component, factor * part)).collect()
}
