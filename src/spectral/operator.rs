//! The boundary operator C: pressure on the cell → normal surface displacement.
//!
//! ŵ(q) = C(q) p̂(q) with the layered compliance C(q) at the shortest alias of each grid wavevector; its inverse makes the
//! preconditioner. Both are diagonal in Fourier space, and done in place. Pressures and displacements that count are
//! convolved in double precision; what only leads to them in single precision, in units in which the
//! compliance at the least wavenumber is one.

use super::fourier::{self, Action, Fourier, Multiplier};
use crate::body::TransferFunction;
use crate::lattice::Grid;

/// Displacement operator of a layered half-space on a grid, with its inverse.
#[derive(Debug)]
pub struct Operator {
    double: (Fourier<f64>, Multiplier<f64>),
    single: (Fourier<f32>, Multiplier<f32>),
    softest: f64,
    convolutions: f64,
}

/// Buffers of the transforms, for any number of grids in turn.
#[derive(Debug, Default)]
pub struct Workspace {
    double: fourier::Workspace<f64>,
    single: fourier::Workspace<f32>,
}

impl Operator {
    /// Operator of the half-space with the given transfer function.
    pub fn new(grid: &Grid, transfer: &TransferFunction) -> Self {
        let (double, single) = (Fourier::new(grid.points()), Fourier::new(grid.points()));
        let softest = transfer.compliance(grid.least_wavenumber());
        // The mean displacement of a loaded half-space is infinite: displacements have zero mean. The inverse must stay
        // positive: it takes the mean for the softest component.
        let compliance = double.multiplier(grid.cell().is_rectangular(), |component| match component {
            [0, 0] => softest,
            component => transfer.compliance(grid.wavenumber(component)),
        });
        let scaled = compliance.single(1.0 / softest);
        Self { double: (double, compliance), single: (single, scaled), softest, convolutions: 0.0 }
    }

    /// Compliance at the least wavenumber, a length per pressure: the unit of the convolutions in single precision.
    pub fn softest(&self) -> f64 {
        self.softest
    }

    /// Convolutions done so far; one in single precision counts half.
    pub fn convolutions(&self) -> f64 {
        self.convolutions
    }

    /// p → w = C p: displacement into the body with zero mean (a length), from pressure.
    pub fn displacement(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        let (fourier, compliance) = &self.double;
        fourier.convolve(Action::Times, compliance, field, &mut workspace.double, |_, _| []);
    }

    /// w → C⁻¹ w: the pressure that displaces so. The mean is treated like the softest component.
    pub fn pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        let (fourier, compliance) = &self.double;
        fourier.convolve(Action::Over, compliance, field, &mut workspace.double, |_, _| []);
    }

    /// p → C p/C(least q) in single precision; `finish` sees each row, and what it returns is added up.
    pub(super) fn displacement_single<const K: usize>(
        &mut self,
        field: &mut [f32],
        workspace: &mut Workspace,
        finish: impl Fn(usize, &mut [f32]) -> [f64; K] + Sync,
    ) -> [f64; K] {
        self.convolutions += 0.5;
        let (fourier, compliance) = &self.single;
        fourier.convolve(Action::Times, compliance, field, &mut workspace.single, finish)
    }

    /// w → C(least q) C⁻¹ w in single precision.
    pub(super) fn pressure_single(&mut self, field: &mut [f32], workspace: &mut Workspace) {
        self.convolutions += 0.5;
        let (fourier, compliance) = &self.single;
        fourier.convolve(Action::Over, compliance, field, &mut workspace.single, |_, _| []);
    }
}
