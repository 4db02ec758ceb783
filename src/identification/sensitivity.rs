//! How the parameters found follow from what was taken as known: ∂θ/∂φ = −(JᵀJ)⁻¹Jᵀ ∂r/∂φ at the minimum, to first order in the residuals.

use super::covariance::Covariance;
use super::error::NoValue;
use super::parameter::Parameter;
use super::search::{Model, Search};

/// Derivatives of the parameters found by a number that was taken as known.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The number; its start is its value.
    pub fixed: Parameter,
    /// Derivative of each parameter found by it, in the order of the parameters; units of the parameter over that of the number.
    pub derivatives: Vec<f64>,
}

impl Sensitivity {
    /// The sensitivities by the numbers `fixed` at the minimum of a search, whose model takes their values behind those `found`; `place` and
    /// `jacobian` are t of the parameters and the Jacobian at the minimum.
    pub(super) fn all<E: Send>(
        search: &Search<'_, E>,
        (place, jacobian): (&[f64], &[Vec<f64>]),
        covariance: &Covariance,
        (fixed, found): (&[Parameter], &[f64]),
    ) -> Result<Vec<Self>, NoValue<E>> {
        if fixed.is_empty() {
            return Ok(Vec::new());
        }
        let problem = |values: &[f64]| (search.model.problem)(&[found, values].concat());
        let model = Model { problem: &problem, points: search.model.points, settings: search.model.settings };
        let mut beside = Search::new(&model, fixed, search.measured);
        beside.windows = search.windows.clone();
        let by = beside.linearised(&vec![0.0; fixed.len()])?.jacobian;
        let of = |(f, own): (usize, &Parameter)| {
            let column: Vec<f64> = by.iter().map(|row| row[f]).collect();
            let taken = covariance.taken_up(jacobian, &column);
            let per = beside.free.slope(f, 0.0);
            let derivative = |(k, t): (usize, &f64)| -t * search.free.slope(k, place[k]) / per;
            Self { fixed: own.clone(), derivatives: taken.iter().enumerate().map(derivative).collect() }
        };
        Ok(fixed.iter().enumerate().map(of).collect())
    }
}
