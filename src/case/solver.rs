//! `[solver]`: how the contact problem is solved, and how far.

use serde::Serialize;

use super::error::Refusal;
use super::reader::Section;

/// The section `[solver]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SolverSection {
    /// Which iteration.
    pub method: Method,
    /// Relative residual at which it stops, dimensionless.
    pub tolerance: f64,
    /// Iterations after which it gives up.
    pub max_iterations: usize,
}

/// Iteration that solves the contact problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Conjugate gradients preconditioned in Fourier space.
    Preconditioned,
    /// The conjugate gradients of Polonsky & Keer (1999).
    PolonskyKeer,
}

impl Default for SolverSection {
    fn default() -> Self {
        Self { method: Method::Preconditioned, tolerance: 1e-8, max_iterations: 10_000 }
    }
}

impl SolverSection {
    pub(super) fn read(section: Option<&Section<'_>>) -> Result<Self, Refusal> {
        let mut solver = Self::default();
        let Some(section) = section else { return Ok(solver) };
        section.only(&["method", "tolerance", "max_iterations"], &[])?;
        if let Some(method) = section.optional("method") {
            let choices = [("preconditioned", Method::Preconditioned), ("polonsky-keer", Method::PolonskyKeer)];
            solver.method = method.choice(&choices)?;
        }
        if let Some(tolerance) = section.optional("tolerance") {
            solver.tolerance = tolerance.number(1e-14..=1e-2)?;
        }
        if let Some(limit) = section.optional("max_iterations") {
            solver.max_iterations = limit.integer(1..=usize::MAX)?;
        }
        Ok(solver)
    }
}
