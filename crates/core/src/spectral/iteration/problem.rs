//! One load step on one grid, as the methods receive it.

use super::admissible::AdmissibleSet;
use super::fields::Working;
use super::report::Progress;
use crate::load::Control;
use crate::spectral::operator::ElasticOperator;
use serde::Serialize;
use std::fmt;
use std::ops::ControlFlow;

/// Conjugate-gradient method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Preconditioned with C⁻¹ between the active set and its surroundings: iterations do not grow with the grid.
    #[default]
    Preconditioned,
    /// Polonsky & Keer, Wear 231 (1999) 206. For a symmetric operator: under coupled friction it stalls.
    PolonskyKeer,
}

/// Dimensionless tolerance and limits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// The method that starts; the preconditioned one falls back to the other when it stalls, unless friction is coupled.
    pub method: Method,
    /// Bound on ε, greater than 0; the energy gap of a converged solution is below 20 times it, the deepest penetration
    /// outside contact below 10 times it and δ. A tolerance that is not greater than 0 is never reached.
    pub tolerance: f64,
    /// Largest number of iterations on one grid.
    pub max_iterations: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { method: Method::default(), tolerance: 1e-8, max_iterations: 10_000 }
    }
}

/// One load step on one grid: everything that the methods receive.
pub struct ContactProblem<'a, O> {
    /// The elastic body.
    pub operator: &'a mut O,
    /// Fields that the methods work on.
    pub working: &'a mut Working,
    /// f ≥ 0, a length, one value per sample, a₂ fastest, measured from first touch.
    pub initial_gap: &'a [f64],
    /// Largest value of the initial gap, a length.
    pub largest_gap: f64,
    /// The admissible pressures.
    pub admissible: AdmissibleSet<'a>,
    /// Prescribed mean pressure or penetration.
    pub load: Control,
    /// Tolerance and limits.
    pub settings: Settings,
    /// Outer iterations so far, see [`Report::outer`](super::Report::outer).
    pub outer: usize,
    /// Called after each iteration; `Break` ends the step.
    pub progress: &'a mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
}

impl<O: ElasticOperator> ContactProblem<'_, O> {
    /// p → w = A p in place.
    pub(super) fn displace(&mut self, field: &mut [f64]) {
        self.operator.displace(field, &mut self.working.transforms);
    }

    /// Scale of lengths: the largest initial gap or, under a flat counterbody that touches on a part of the cell, what the
    /// load displaces.
    pub(super) fn length(&self) -> f64 {
        match self.load {
            _ if self.largest_gap > 0.0 => self.largest_gap,
            Control::MeanPressure(mean) => mean * self.operator.unit(),
            Control::Penetration(penetration) => penetration,
        }
    }
}

impl<O> fmt::Debug for ContactProblem<'_, O> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "contact of {} samples under {}", self.initial_gap.len(), self.load)
    }
}
