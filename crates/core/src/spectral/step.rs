//! One load step, solved.

use super::contact::{Contact, Shear};
use super::frictional_heat::Hottest;
use super::hysteresis::Hysteresis;
use super::iteration::{Certificate, Report};
use crate::counterbody::Surface;
use crate::lattice::Grid;
use crate::load::Load;
use crate::notation::number;
use crate::numeric::array::field;
use crate::problem::Problem;
use ndarray::{Array2, ArrayView2};
use std::fmt;
use std::sync::Arc;

/// Friction by hysteresis of a load step.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionLoss {
    /// Friction on the finest grid, then on the coarser ones that the step keeps.
    pub grids: Vec<Hysteresis>,
    /// Bound on the error of the coefficient by that of the solution on the finest grid.
    pub bound: f64,
    /// Largest ratio of lost to stored work among the waves of the finest grid, tan δ; with friction that couples, of the skew part.
    pub loss_tangent: f64,
}

/// Largest temperatures of a load step.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatStep {
    /// Temperatures of all materials on the finest grid, then on the next coarser one that the step keeps.
    pub grids: Vec<Vec<Hottest>>,
    /// Least part of the compliance of a wave that swelling by heat leaves: no steady state is unique from 0 down.
    pub left: f64,
}

/// A solved load step. It shares grid, surface and problem, and its fields never change: it can be kept, sent to another
/// thread, and read after the solver is gone.
#[derive(Debug, Clone)]
pub struct Step {
    /// The prescribed load.
    pub load: Load,
    /// Report of the solution on the finest grid.
    pub report: Report,
    /// Bounds on the error of the pressure.
    pub certificate: Certificate,
    /// Convolutions on all grids, as equivalents of the finest one.
    pub convolutions: f64,
    /// Friction by hysteresis below a load that moves steadily; `None` at rest, and without contact.
    pub motion: Option<MotionLoss>,
    /// Largest temperatures by frictional heat; `None` where nothing heats.
    pub heat: Option<HeatStep>,
    pub(super) finest: Contact,
    pub(super) coarser: Vec<Contact>,
}

impl Step {
    /// The contact on the finest grid.
    pub fn finest(&self) -> &Contact {
        &self.finest
    }

    /// The contact of this load on the next two coarser grids, the finer one first; none for the baseline method, on grids too
    /// coarse for any, and from a grid on that the prescribed penetration is beyond complete contact.
    pub fn coarser(&self) -> &[Contact] {
        &self.coarser
    }

    /// The step with partial slip on the finest grid.
    pub(super) fn with_shear(self, shear: Shear) -> Self {
        Self { finest: self.finest.with_shear(shear), ..self }
    }

    /// The step with the contact of another one, solved on the next coarser grid, in the place of its coarser ones.
    pub(super) fn with_coarser(self, coarser: Self) -> Self {
        Self { coarser: vec![coarser.finest], ..self }
    }

    /// The step in bodies that creep, with the energies that they store on the finest grid and on the coarser ones.
    pub(super) fn creeping(self, stored: &[f64]) -> Self {
        let [finest, coarser @ ..] = stored else { return self };
        let of = |(contact, stored): (Contact, &f64)| contact.creeping(*stored);
        Self {
            finest: self.finest.creeping(*finest),
            coarser: self.coarser.into_iter().zip(coarser).map(of).collect(),
            ..self
        }
    }

    /// The step with the mean of the pressures of several moments on the finest grid, sample by sample, a₂ fastest.
    pub(crate) fn with_mean_pressure(&self, pressure: Vec<f64>) -> Self {
        Self { finest: self.finest.with_pressure(pressure), ..self.clone() }
    }

    /// The problem.
    pub fn problem(&self) -> &Arc<Problem> {
        self.finest.problem()
    }

    /// The finest grid.
    pub fn grid(&self) -> &Arc<Grid> {
        self.finest.grid()
    }

    /// The counterbody's surface on it.
    pub fn surface(&self) -> &Arc<Surface> {
        self.finest.surface()
    }

    /// Pressure p ≥ 0, in the unit of Young's modulus; axes along a₁ and a₂.
    pub fn pressure(&self) -> ArrayView2<'_, f64> {
        self.finest.pressure()
    }

    /// Displacement w into the body, a length, on a periodic cell with zero mean, on a rigid base from that; axes along a₁ and a₂.
    pub fn displacement(&self) -> Array2<f64> {
        if !self.finest.creeps() && self.finest.net_pressures().iter().all(|&p| p == 0.0) {
            return Array2::zeros(self.grid().points());
        }
        &self.gap() - &self.surface().initial_gap() + self.penetration()
    }

    /// Gap g = w + f − δ, a length; axes along a₁ and a₂.
    pub fn gap(&self) -> ArrayView2<'_, f64> {
        self.finest.gap()
    }

    /// Penetration δ, a length; see [`Contact::penetration`].
    pub fn penetration(&self) -> f64 {
        self.finest.penetration()
    }

    /// Depths that the softer surface is pressed in for good by this load and those before it, lengths ≥ 0; axes along a₁ and a₂. `None`
    /// without hardness.
    pub fn indentation(&self) -> Option<Array2<f64>> {
        self.finest.indentation().map(|depths| field(self.grid().points(), depths))
    }

    /// Elastic energy ½∫ p w d²x of one cell, a pressure times a cubed length; see [`Contact::elastic_energy`].
    pub fn elastic_energy(&self) -> f64 {
        self.finest.elastic_energy()
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let penetration = number(self.penetration());
        write!(f, "{} on {}: penetration {penetration}\n{}\n{}", self.load, self.grid(), self.report, self.certificate)
    }
}
