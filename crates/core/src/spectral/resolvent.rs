//! Parts into which a strongly coupled operator A = C(1 − iT) is split on a periodic cell: its magnitude M = |A|, wave by wave, and the
//! resolvent (A + M)⁻¹.

use super::convolution::Convolution;
use super::layered_operator::{LayeredOperator, Transforms, in_place};
use super::multiplier::{Action, Multiplier, SkewRatio};
use super::operator::Workspace;

/// Magnitude and resolvent of an operator.
#[derive(Debug)]
pub struct Resolvent {
    /// M: symmetric and positive.
    magnitude: LayeredOperator,
    transform: Convolution<f64>,
    sum: Multiplier,
    ratio: SkewRatio,
    applied: usize,
}

impl Resolvent {
    /// Parts of the operator with this multiplier and skew part, whose compliance at the least wavenumber is `unit`, and under a uniform
    /// pressure `mean`.
    pub(super) fn new(
        transforms: &Transforms,
        (compliance, skew): (&Multiplier, &SkewRatio),
        [unit, mean]: [f64; 2],
    ) -> Self {
        let (sum, ratio) = compliance.with_magnitude(skew);
        let magnitude = LayeredOperator::of(transforms.clone(), compliance.magnitude(skew), unit).with_mean(mean);
        Self { magnitude, transform: transforms.double.clone(), sum, ratio, applied: 0 }
    }

    /// Convolutions so far, see [`LayeredOperator::convolutions`].
    pub fn convolutions(&self) -> f64 {
        self.magnitude.convolutions() + self.applied as f64
    }

    /// The magnitude M.
    pub fn magnitude(&mut self) -> &mut LayeredOperator {
        &mut self.magnitude
    }

    /// w → (A + M)⁻¹ w in place. Where displacements have zero mean it is treated like a component of the least wavenumber.
    pub fn apply(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.applied += 1;
        in_place(&self.transform, Action::DivideSkewed(1.0, &self.ratio), &self.sum, field, workspace);
    }
}
