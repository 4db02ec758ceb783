//! The boundary operator C: pressure on the cell → normal surface displacement.
//!
//! ŵ(q) = C(q) p̂(q) with the layered compliance C(q) at the shortest alias of each grid wavevector; its inverse makes the
//! preconditioner. Both are diagonal in Fourier space, and done in place. Pressures and displacements that count are
//! convolved in double precision; what only leads to them in single precision, in units in which the compliance at the
//! least wavenumber is one.

use super::fourier::{Action, Convolved, Fourier, Multiplier, rows_of, rows_to};
use crate::body::TransferFunction;
use crate::lattice::Grid;
use rayon::prelude::*;

pub use super::fourier::Workspace;

/// Displacement operator of a layered half-space on a grid, with its inverse.
#[derive(Debug)]
pub struct Operator {
    double: Fourier<f64>,
    single: Fourier<f32>,
    compliance: Multiplier,
    /// Compliance at the least wavenumber.
    unit: f64,
    convolutions: f64,
}

impl Operator {
    /// Operator of the half-space with the given transfer function.
    pub fn new(grid: &Grid, transfer: &TransferFunction) -> Self {
        let (double, single) = (Fourier::new(grid.points()), Fourier::new(grid.points()));
        let unit = transfer.compliance(grid.least_wavenumber());
        // The mean displacement of a loaded half-space is infinite: displacements have zero mean. The inverse must stay
        // positive: it takes the mean for a component of the least wavenumber.
        let compliance = double.multiplier(grid.cell().is_rectangular(), |component| match component {
            [0, 0] => unit,
            component => transfer.compliance(grid.wavenumber(component)),
        });
        Self { double, single, compliance, unit, convolutions: 0.0 }
    }

    /// Compliance at the least wavenumber, a length per pressure: the unit of the convolutions in single precision.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// Convolutions done so far; one in single precision counts half.
    pub fn convolutions(&self) -> f64 {
        self.convolutions
    }

    /// p → w = C p: displacement into the body with zero mean (a length), from pressure.
    pub fn displacement(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.in_place(Action::Times(1.0), field, workspace);
    }

    /// w → C⁻¹ w: the pressure that displaces so. The mean is treated like a component of the least wavenumber.
    pub fn pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.in_place(Action::Over(1.0), field, workspace);
    }

    fn in_place(&mut self, action: Action, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        let points = self.double.points();
        // On the threads that share the work, where no pass has to wake them.
        rayon::scope(|_| {
            let convolved = self.double.convolve(action, &self.compliance, workspace, rows_of(field, points));
            convolved.rows(rows_to(field, points));
        });
    }

    /// p → C p by rows.
    pub(super) fn displaced<'a, S>(&'a mut self, workspace: &'a mut Workspace, pressure: S) -> Convolved<'a, f64>
    where
        S: IntoParallelIterator<Item: FnMut(&mut [f64]), Iter: IndexedParallelIterator>,
    {
        self.convolutions += 1.0;
        self.double.convolve(Action::Times(1.0), &self.compliance, workspace, pressure)
    }

    /// p → C p/C(least q) by rows, in single precision.
    pub(super) fn displaced_single<'a, S>(&'a mut self, workspace: &'a mut Workspace, pressure: S) -> Convolved<'a, f32>
    where
        S: IntoParallelIterator<Item: FnMut(&mut [f32]), Iter: IndexedParallelIterator>,
    {
        self.convolutions += 0.5;
        self.single.convolve(Action::Times(1.0 / self.unit), &self.compliance, workspace, pressure)
    }

    /// w → C(least q) C⁻¹ w by rows, in single precision.
    pub(super) fn pressed_single<'a, S>(
        &'a mut self,
        workspace: &'a mut Workspace,
        displacement: S,
    ) -> Convolved<'a, f32>
    where
        S: IntoParallelIterator<Item: FnMut(&mut [f32]), Iter: IndexedParallelIterator>,
    {
        self.convolutions += 0.5;
        self.single.convolve(Action::Over(self.unit), &self.compliance, workspace, displacement)
    }
}
