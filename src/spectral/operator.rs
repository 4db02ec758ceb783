//! The boundary operator: pressure on the cell → normal surface displacement.
//!
//! ŵ(q) = C(q) p̂(q) with the layered compliance C(q) at the shortest alias of each grid wavevector; its inverse makes the
//! preconditioner. Both are diagonal in Fourier space. Under coupled friction the traction μ p **e** displaces too,
//!
//! ŵ = (C − iμK cos θ) p̂ = C(1 − iT) p̂,  T = μ (K/C) cos θ,
//!
//! θ between **q** and **e**: a skew part, which is odd in **q**, so that tied aliases are averaged and what is its own
//! conjugate has none. Pressures and displacements that count are
//! convolved in double precision; what only leads to them in single precision, in units in which the compliance at the
//! least wavenumber is one.

use super::convolution::{Convolution, Convolved, rows_of, rows_to};
use super::multiplier::{Action, Multiplier, Turns};
use crate::body::{Compliances, TransferFunction};
use crate::friction::Friction;
use crate::lattice::Grid;
use crate::numeric::aligned::Aligned;
use crate::numeric::lanes::Real;
use crate::numeric::rows::Parts;
use rayon::prelude::*;

/// Memory that convolutions work in, for any number of grids in turn.
#[derive(Debug, Default)]
pub struct Workspace {
    room: Aligned<f64>,
}

impl Workspace {
    fn of(&mut self, size: usize) -> &mut [f64] {
        if self.room.len() < size {
            self.room = Aligned::new(size);
        }
        &mut self.room[..size]
    }
}

/// The traction of coupled friction while the pressure changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coupling {
    /// It follows.
    Follows,
    /// It stands still.
    Stands,
}

/// Displacement operator of a layered half-space on a grid, with its inverse.
#[derive(Debug)]
pub struct Operator {
    double: Convolution<f64>,
    single: Convolution<f32>,
    compliance: Multiplier,
    /// T, and the largest |T|.
    coupling: Option<(Turns, f64)>,
    /// Compliance at the least wavenumber.
    unit: f64,
    convolutions: f64,
}

impl Operator {
    /// Operator of the half-space with the given transfer function, without friction.
    pub fn new(grid: &Grid, transfer: &TransferFunction) -> Self {
        let compliances = Compliances::new(transfer, range(grid), grid.len() / 2);
        Self::with(grid, transfer, &compliances)
    }

    /// The same under a counterbody that slides with `friction`.
    pub fn sliding(grid: &Grid, transfer: &TransferFunction, friction: &Friction) -> Self {
        let [x, y] = friction.traction();
        if !friction.couples() {
            return Self::new(grid, transfer);
        }
        let compliances = Compliances::coupled(transfer, range(grid), grid.len() / 2);
        let own = Self::with(grid, transfer, &compliances);
        let turn = |component| match grid.mean_direction(component) {
            [0.0, 0.0] => 0.0,
            [nx, ny] => (x * nx + y * ny) * compliances.coupling_ratio(grid.wavenumber(component)),
        };
        let turns = own.double.turns(|[k1, k2], values| {
            values.iter_mut().zip(k2..).for_each(|(value, k2)| *value = turn([k1, k2]));
        });
        let largest = turns.largest();
        Self { coupling: Some((turns, largest)), ..own }
    }

    fn with(grid: &Grid, transfer: &TransferFunction, compliances: &Compliances<'_>) -> Self {
        let (double, single) = (Convolution::new(grid.points()), Convolution::new(grid.points()));
        let unit = transfer.compliance(grid.least_wavenumber());
        // The mean displacement of a loaded half-space is infinite: displacements have zero mean. The inverse must stay
        // positive: it takes the mean for a component of the least wavenumber.
        let compliance = double.multiplier(grid.cell().is_rectangular(), |first, values| {
            grid.wavenumbers(first, values);
            if first == [0, 0] {
                values[0] = grid.least_wavenumber();
            }
            compliances.replace(values);
        });
        Self { double, single, compliance, coupling: None, unit, convolutions: 0.0 }
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

    /// The largest part |T| that coupling adds to the operator; 0 without it.
    pub fn coupling(&self) -> f64 {
        self.coupling.as_ref().map_or(0.0, |&(_, largest)| largest)
    }

    /// p → w: displacement into the body with zero mean (a length), from pressure and the traction that goes with it.
    pub fn displacement(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        in_place(&self.double, times(1.0, &self.coupling), &self.compliance, field, workspace);
    }

    /// [`displacement`](Self::displacement) in single precision, by which iterations find their way.
    pub fn displacement_single(&mut self, field: &mut [f32], workspace: &mut Workspace) {
        self.convolutions += 0.5;
        in_place(&self.single, times(1.0, &self.coupling), &self.compliance, field, workspace);
    }

    /// w → p: the pressure that displaces so. The mean is treated like a component of the least wavenumber.
    pub fn pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        let action = self.coupling.as_ref().map_or(Action::Over(1.0), |(turns, _)| Action::OverTurned(1.0, turns));
        in_place(&self.double, action, &self.compliance, field, workspace);
    }

    /// w → p of a counterbody that does not slide: C⁻¹ of the symmetric part alone.
    pub fn frictionless_pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        in_place(&self.double, Action::Over(1.0), &self.compliance, field, workspace);
    }

    /// The memory of a convolution in double precision in two: that of one in single precision, and a field in single
    /// precision that lasts until the next one in double precision.
    pub(super) fn shared<'a>(&self, workspace: &'a mut Workspace) -> (&'a mut [f64], &'a mut [f32]) {
        let [n1, n2] = self.parts().points();
        // Of few columns a tile in single precision has as many bytes as those in double precision.
        let size = self.double.room().max(self.single.room() + (n1 * n2).div_ceil(2));
        let (room, rest) = workspace.of(size).split_at_mut(self.single.room());
        (room, &mut bytemuck::cast_slice_mut(rest)[..n1 * n2])
    }

    /// p → w by rows.
    pub(super) fn displaced<'a, S>(&'a mut self, workspace: &'a mut Workspace, pressure: S) -> Convolved<'a, f64>
    where
        S: IntoParallelIterator<Item: FnMut(&mut [f64]), Iter: IndexedParallelIterator>,
    {
        self.convolutions += 1.0;
        self.double.convolve(times(1.0, &self.coupling), &self.compliance, workspace.of(self.double.room()), pressure)
    }

    /// Changes of p → changes of w/C(least q) by rows, in single precision.
    pub(super) fn displaced_single<'a, S>(
        &'a mut self,
        traction: Coupling,
        room: &'a mut [f64],
        pressure: S,
    ) -> Convolved<'a, f32>
    where
        S: IntoParallelIterator<Item: FnMut(&mut [f32]), Iter: IndexedParallelIterator>,
    {
        self.convolutions += 0.5;
        let factor = 1.0 / self.unit;
        let action = match traction {
            Coupling::Follows => times(factor, &self.coupling),
            Coupling::Stands => Action::Times(factor),
        };
        self.single.convolve(action, &self.compliance, room, pressure)
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

/// Wavenumbers that a grid asks for.
fn range(grid: &Grid) -> [f64; 2] {
    [grid.least_wavenumber(), grid.largest_wavenumber()]
}

fn times(factor: f64, coupling: &Option<(Turns, f64)>) -> Action<'_> {
    coupling.as_ref().map_or(Action::Times(factor), |(turns, _)| Action::TimesTurned(factor, turns))
}

fn in_place<T: Real>(
    convolution: &Convolution<T>,
    action: Action<'_>,
    compliance: &Multiplier,
    field: &mut [T],
    workspace: &mut Workspace,
) {
    let (parts, room) = (convolution.parts(), workspace.of(convolution.room()));
    // On the threads that share the work, where no pass has to wake them.
    rayon::scope(|_| {
        let convolved = convolution.convolve(action, compliance, room, rows_of(parts, field));
        convolved.rows(rows_to(parts, field));
    });
}
