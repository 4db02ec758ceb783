//! One load step on one grid, as the methods receive it.

use super::report::Progress;
use super::settings::Settings;
use crate::load::Load;
use std::fmt;

/// The half-space as an iteration meets it: symmetric linear maps between fields of one grid, one value per sample, a₂
/// fastest. Implementations may panic when a field has another number of samples.
pub trait Compliance {
    /// w = C p: displacement into the body with zero mean (a length), from pressure.
    fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]);

    /// z ≈ C⁻¹ g, positive definite: the preconditioner.
    fn precondition(&mut self, gap: &[f64], result: &mut [f64]);
}

/// One load step on one grid: everything that the methods receive.
pub struct GridProblem<'a> {
    /// The half-space.
    pub compliance: &'a mut dyn Compliance,
    /// f ≥ 0, a length, one value per sample, measured from first touch.
    pub initial_gap: &'a [f64],
    /// What is prescribed.
    pub load: Load,
    /// Tolerance and limits.
    pub settings: Settings,
    /// Hears of each iteration.
    pub progress: &'a mut dyn FnMut(Progress),
}

impl fmt::Debug for GridProblem<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "contact of {} samples under {}", self.initial_gap.len(), self.load)
    }
}
