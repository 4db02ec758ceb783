//! Transforms of fields on the samples of one grid, in both precisions.

use super::by_rows::{ResultRows, rows_of, rows_to};
use super::convolution::Convolution;
use super::multiplier::{Action, Multiplier};
use super::operator::Workspace;
use crate::numeric::lanes::Real;

/// Transforms of a field in both precisions.
#[derive(Debug, Clone)]
pub(super) struct Transforms {
    pub double: Convolution<f64>,
    pub single: Convolution<f32>,
}

impl Transforms {
    /// Transforms of `points` = [N₁, N₂].
    pub fn new(points: [usize; 2]) -> Self {
        Self { double: Convolution::new(points), single: Convolution::new(points) }
    }

    /// Transforms of `points` = [N₁, N₂], the samples outside a `window` of the first ones being zero.
    pub fn padded(window: [usize; 2], points: [usize; 2]) -> Self {
        Self { double: Convolution::padded(window, points), single: Convolution::padded(window, points) }
    }
}

/// Convolution of a field, in its place.
pub(super) fn in_place<T: Real>(
    convolution: &Convolution<T>,
    action: Action<'_>,
    compliance: &Multiplier,
    field: &mut [T],
    workspace: &mut Workspace,
) {
    let (blocks, memory) = (convolution.blocks(), workspace.of(convolution.memory()));
    rayon::scope(|_| {
        let convolved = convolution.convolve(action, compliance, memory, rows_of(blocks, field));
        convolved.rows(rows_to(blocks, field));
    });
}
