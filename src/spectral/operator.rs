//! The boundary operator C: pressure on the cell → normal surface displacement.
//!
//! ŵ(q) = C(q) p̂(q) with the layered compliance C(q) at the shortest alias of each grid wavevector; its inverse makes the
//! preconditioner. Both are diagonal in Fourier space. Pressures and displacements that count are
//! convolved in double precision; what only leads to them in single precision, in units in which the compliance at the
//! least wavenumber is one.

use super::convolution::{Action, Convolution, Convolved, Multiplier, rows_of, rows_to};
use crate::body::{Compliances, TransferFunction};
use crate::lattice::Grid;
use crate::numeric::rows::Parts;
use rayon::prelude::*;

/// Memory that convolutions work in, for any number of grids in turn.
#[derive(Debug, Default)]
pub struct Workspace {
    room: Vec<f64>,
}

impl Workspace {
    fn of(&mut self, size: usize) -> &mut [f64] {
        if self.room.len() < size {
            self.room = vec![0.0; size];
        }
        &mut self.room[..size]
    }
}

/// Displacement operator of a layered half-space on a grid, with its inverse.
#[derive(Debug)]
pub struct Operator {
    double: Convolution<f64>,
    single: Convolution<f32>,
    compliance: Multiplier,
    /// Compliance at the least wavenumber.
    unit: f64,
    convolutions: f64,
}

impl Operator {
    /// Operator of the half-space with the given transfer function.
    pub fn new(grid: &Grid, transfer: &TransferFunction) -> Self {
        let (double, single) = (Convolution::new(grid.points()), Convolution::new(grid.points()));
        let (least, most) = (grid.least_wavenumber(), grid.largest_wavenumber());
        let (unit, compliances) =
            (transfer.compliance(least), Compliances::new(transfer, [least, most], grid.len() / 2));
        // The mean displacement of a loaded half-space is infinite: displacements have zero mean. The inverse must stay
        // positive: it takes the mean for a component of the least wavenumber.
        let compliance = double.multiplier(grid.cell().is_rectangular(), |component| match component {
            [0, 0] => unit,
            component => compliances.at(grid.wavenumber(component)),
        });
        Self { double, single, compliance, unit, convolutions: 0.0 }
    }

    /// Compliance at the least wavenumber, a length per pressure: the unit of the convolutions in single precision.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// The parts of the rows that sources and sinks of convolutions are asked for.
    pub(super) fn parts(&self) -> Parts {
        self.double.parts()
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
        let (parts, room) = (self.parts(), workspace.of(self.double.room()));
        // On the threads that share the work, where no pass has to wake them.
        rayon::scope(|_| {
            let convolved = self.double.convolve(action, &self.compliance, room, rows_of(parts, field));
            convolved.rows(rows_to(parts, field));
        });
    }

    /// The memory of a convolution in double precision in two: that of one in single precision, and a field in single
    /// precision that lasts until the next one in double precision.
    pub(super) fn shared<'a>(&self, workspace: &'a mut Workspace) -> (&'a mut [f64], &'a mut [f32]) {
        let [n1, n2] = self.parts().points();
        let (room, rest) = workspace.of(self.double.room()).split_at_mut(self.single.room());
        (room, &mut bytemuck::cast_slice_mut(rest)[..n1 * n2])
    }

    /// p → C p by rows.
    pub(super) fn displaced<'a, S>(&'a mut self, workspace: &'a mut Workspace, pressure: S) -> Convolved<'a, f64>
    where
        S: IntoParallelIterator<Item: FnMut(&mut [f64]), Iter: IndexedParallelIterator>,
    {
        self.convolutions += 1.0;
        self.double.convolve(Action::Times(1.0), &self.compliance, workspace.of(self.double.room()), pressure)
    }

    /// p → C p/C(least q) by rows, in single precision.
    pub(super) fn displaced_single<'a, S>(&'a mut self, room: &'a mut [f64], pressure: S) -> Convolved<'a, f32>
    where
        S: IntoParallelIterator<Item: FnMut(&mut [f32]), Iter: IndexedParallelIterator>,
    {
        self.convolutions += 0.5;
        self.single.convolve(Action::Times(1.0 / self.unit), &self.compliance, room, pressure)
    }

    /// w → C(least q) C⁻¹ w by rows, in single precision.
    pub(super) fn pressed_single<'a, S>(&'a mut self, room: &'a mut [f64], displacement: S) -> Convolved<'a, f32>
    where
        S: IntoParallelIterator<Item: FnMut(&mut [f32]), Iter: IndexedParallelIterator>,
    {
        self.convolutions += 0.5;
        self.single.convolve(Action::Over(self.unit), &self.compliance, room, displacement)
    }
}
