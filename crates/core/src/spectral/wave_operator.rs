//! Any linear operator that is diagonal in the waves of a periodic grid, on fields in double precision: derivatives, temperatures, swelling.

use super::convolution::Convolution;
use super::multiplier::{Action, Multiplier, SkewPart};
use super::operator::Workspace;
use super::transforms::in_place;
use crate::lattice::Grid;
use crate::lattice::waves::WAVENUMBER_TOLERANCE;
use rustfft::num_complex::Complex64;

/// Operator û = F̂ f̂ on fields of a periodic grid; the mean of a result is zero.
#[derive(Debug)]
pub(super) struct WaveOperator {
    transform: Convolution<f64>,
    even: Multiplier,
    odd: SkewPart,
}

impl WaveOperator {
    /// Operator with the factors F̂(**k**) = F̂*(−**k**) of the wavevectors **k** ≠ 0, 1/length; tied aliases have their mean.
    pub fn new(grid: &Grid, factor: impl Fn([f64; 2]) -> Complex64 + Sync) -> Self {
        let transform = Convolution::new(grid.points());
        let (even, odd) = transform.complex_parts(|[k1, k2], values| {
            values.iter_mut().zip(k2..).for_each(|(value, k2)| {
                *value = if [k1, k2] == [0, 0] { Complex64::default() } else { of_component(grid, [k1, k2], &factor) };
            });
        });
        Self { transform, even, odd }
    }

    /// Derivative along a unit vector.
    pub fn derivative(grid: &Grid, [x, y]: [f64; 2]) -> Self {
        Self::new(grid, |[kx, ky]| Complex64::new(0.0, x * kx + y * ky))
    }

    /// Applies the operator to a field, in its place.
    pub fn apply(&self, field: &mut [f64], workspace: &mut Workspace) {
        in_place(&self.transform, Action::MultiplyComplex(1.0, &self.odd), &self.even, field, workspace);
    }

    /// The operator on a field.
    pub fn of(&self, field: &[f64], workspace: &mut Workspace) -> Vec<f64> {
        let mut field = field.to_vec();
        self.apply(&mut field, workspace);
        field
    }
}

/// Factor of a component of a grid that is not the mean: that of its shortest alias, or the mean of tied ones.
pub(super) fn of_component(grid: &Grid, component: [usize; 2], factor: &impl Fn([f64; 2]) -> Complex64) -> Complex64 {
    match grid.wavevector_and_ties(component) {
        (wavevector, 1) => factor(wavevector),
        _ => {
            let tied = grid.tied_wavevectors(component, WAVENUMBER_TOLERANCE);
            tied.iter().map(|&(_, wavevector)| factor(wavevector)).sum::<Complex64>() / tied.len() as f64
        }
    }
}
