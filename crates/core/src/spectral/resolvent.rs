//! Parts into which a strongly coupled operator A = C(1 − iT) is split on a periodic cell: its magnitude M = |A|, wave by wave, and the
//! resolvent (A + M)⁻¹.

use super::convolution::Convolution;
use super::multiplier::{Action, Multiplier, SkewRatio};
use super::operator::{ElasticOperator, SkewParts, Workspace};
use super::transforms::in_place;

/// Magnitude and resolvent of an operator.
#[derive(Debug)]
pub struct Resolvent<M> {
    /// M: symmetric and positive.
    magnitude: M,
    transform: Convolution<f64>,
    sum: Multiplier,
    ratio: SkewRatio,
    applied: usize,
}

impl<M: ElasticOperator> Resolvent<M> {
    /// Parts of an operator with this magnitude, and with the multiplier and the ratio of A + M.
    pub(super) fn new(magnitude: M, transform: Convolution<f64>, (sum, ratio): (Multiplier, SkewRatio)) -> Self {
        Self { magnitude, transform, sum, ratio, applied: 0 }
    }

    /// Convolutions so far; one in single precision counts half.
    pub fn convolutions(&self) -> f64 {
        self.magnitude.convolutions() + self.applied as f64
    }
}

impl<M: ElasticOperator> SkewParts for Resolvent<M> {
    type Magnitude = M;

    fn magnitude(&mut self) -> &mut M {
        &mut self.magnitude
    }

    fn resolve(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.applied += 1;
        in_place(&self.transform, Action::DivideSkewed(1.0, &self.ratio), &self.sum, field, workspace);
    }
}
