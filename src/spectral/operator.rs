//! The boundary operator C: pressure on the cell → normal surface displacement.
//!
//! ŵ(q) = C(q) p̂(q) with the layered compliance C(q) at the shortest alias of each grid wavevector, and its inverse as
//! preconditioner. Both are diagonal in Fourier space.

use super::fourier::{Fourier, Multiplier, Workspace};
use super::iteration::Compliance;
use crate::body::TransferFunction;
use crate::lattice::Grid;

/// What a diagonal operator does to the mean of a field (q = 0).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ZeroMode {
    /// The mean of the result is zero: the mean displacement of a loaded half-space is infinite,
    /// so displacements are measured from the mean plane of the deformed surface.
    ZeroMean,
    /// The mean is treated as the component that gets the smallest factor: a preconditioner must stay positive.
    LikeSmallest,
}

/// Displacement operator of a layered half-space on a grid, with its preconditioner.
#[derive(Debug)]
pub struct Operator {
    fourier: Fourier,
    compliance: Multiplier,
    stiffness: Multiplier,
    workspace: Workspace,
    convolutions: usize,
}

impl Operator {
    /// Operator of the half-space with the given transfer function.
    pub fn new(grid: &Grid, transfer: &TransferFunction) -> Self {
        let fourier = Fourier::new(grid.points());
        let mean = |zero: ZeroMode| match zero {
            ZeroMode::ZeroMean => 0.0,
            ZeroMode::LikeSmallest => 1.0 / transfer.compliance(grid.least_wavenumber()),
        };
        let compliance = fourier.multiplier(|component| match component {
            [0, 0] => mean(ZeroMode::ZeroMean),
            component => transfer.compliance(grid.wavenumber(component)),
        });
        let stiffness = compliance.inverse(mean(ZeroMode::LikeSmallest));
        let workspace = fourier.workspace();
        Self { fourier, compliance, stiffness, workspace, convolutions: 0 }
    }

    /// Convolutions done so far.
    pub fn convolutions(&self) -> usize {
        self.convolutions
    }
}

impl Compliance for Operator {
    fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.convolutions += 1;
        self.fourier.convolve(&self.compliance, pressure, displacement, &mut self.workspace);
    }

    /// The mean is treated like the softest component.
    fn precondition(&mut self, gap: &[f64], result: &mut [f64]) {
        self.convolutions += 1;
        self.fourier.convolve(&self.stiffness, gap, result, &mut self.workspace);
    }
}
