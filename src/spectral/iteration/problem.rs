//! One load step on one grid, as the methods receive it.

use super::report::Progress;
use super::settings::Settings;
use super::working::Working;
use crate::load::Load;
use crate::spectral::operator::Operator;
use std::fmt;
use std::ops::ControlFlow;

/// One load step on one grid: everything that the methods receive.
pub struct GridProblem<'a> {
    /// The half-space.
    pub operator: &'a mut Operator,
    /// Fields that the methods work on.
    pub working: &'a mut Working,
    /// f ≥ 0, a length, one value per sample, a₂ fastest, measured from first touch.
    pub initial_gap: &'a [f64],
    /// Its largest value.
    pub largest_gap: f64,
    /// What is prescribed.
    pub load: Load,
    /// Tolerance and limits.
    pub settings: Settings,
    /// Outer iterations so far, see [`Report::outer`](super::Report::outer).
    pub outer: usize,
    /// Hears of each iteration, and says whether there shall be another.
    pub progress: &'a mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
}

impl GridProblem<'_> {
    /// w = C p, from p to w in place.
    pub(super) fn displacement(&mut self, field: &mut [f64]) {
        self.operator.displacement(field, &mut self.working.transforms);
    }
}

impl fmt::Debug for GridProblem<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "contact of {} samples under {}", self.initial_gap.len(), self.load)
    }
}
