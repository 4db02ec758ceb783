//! How the parameters found follow from what was taken as known: ∂θ/∂φ = −(JᵀJ)⁻¹Jᵀ ∂r/∂φ at the minimum, to first order in the residuals.

use super::covariance::Covariance;
use super::error::NoValue;
use super::parameter::Parameter;
use super::search::{Model, Search};
use std::fmt;
use std::ops::Range;

/// Derivatives of the parameters found by a number that was taken as known.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The number; its start is its value.
    pub fixed: Parameter,
    /// Derivative of each parameter found by it, in the order of the parameters; units of the parameter over that of the number.
    pub derivatives: Vec<f64>,
}

/// Numbers that were taken as known, and by which there are no derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct NoDerivative {
    /// Names of the numbers.
    pub names: Vec<String>,
    /// Why the model has no penetrations beside their values.
    pub reason: String,
}

/// A minimum at which parameters are differentiated: t of the parameters, their values, and the Jacobian.
pub(super) struct Differentiated<'a, E> {
    pub search: &'a Search<'a, E>,
    pub place: &'a [f64],
    pub values: &'a [f64],
    pub jacobian: &'a [Vec<f64>],
    pub covariance: &'a Covariance,
}

impl<E: Send + fmt::Display> Differentiated<'_, E> {
    /// The sensitivities by the numbers `fixed`, whose values the model takes behind those found. Where it refuses some of them, those
    /// by the others.
    pub fn by(&self, fixed: &[Parameter]) -> (Vec<Sensitivity>, Vec<NoDerivative>) {
        let (mut known, mut missing) = (Vec::new(), Vec::<NoDerivative>::new());
        if fixed.is_empty() {
            return (known, missing);
        }
        if let Ok(all) = self.by_some(fixed, 0..fixed.len()) {
            return (all, missing);
        }
        for (index, parameter) in fixed.iter().enumerate() {
            match self.by_some(fixed, index..index + 1) {
                Ok(found) => known.extend(found),
                Err(error) => {
                    let reason = error.to_string().lines().next().unwrap_or_default().to_owned();
                    match missing.iter_mut().find(|other| other.reason == reason) {
                        Some(other) => other.names.push(parameter.name.clone()),
                        None => missing.push(NoDerivative { names: vec![parameter.name.clone()], reason }),
                    }
                }
            }
        }
        (known, missing)
    }

    /// The sensitivities by some of the numbers, the others at their values.
    fn by_some(&self, fixed: &[Parameter], some: Range<usize>) -> Result<Vec<Sensitivity>, NoValue<E>> {
        let Self { search, place, values, jacobian, covariance } = self;
        let starts: Vec<f64> = fixed.iter().map(|parameter| parameter.start).collect();
        let problem = |moved: &[f64]| {
            let mut all = starts.clone();
            all[some.clone()].copy_from_slice(moved);
            (search.model.problem)(&[values, &all[..]].concat())
        };
        let model = Model { problem: &problem, points: search.model.points, settings: search.model.settings };
        let mut beside = Search::new(&model, &fixed[some.clone()], search.measured);
        beside.windows = search.windows.clone();
        let by = beside.linearised(&vec![0.0; some.len()])?.jacobian;
        let of = |(f, parameter): (usize, &Parameter)| {
            let column: Vec<f64> = by.iter().map(|row| row[f]).collect();
            let taken = covariance.taken_up(jacobian, &column);
            let per = beside.free.slope(f, 0.0);
            let derivative = |(k, t): (usize, &f64)| -t * search.free.slope(k, place[k]) / per;
            Sensitivity { fixed: parameter.clone(), derivatives: taken.iter().enumerate().map(derivative).collect() }
        };
        Ok(fixed[some.clone()].iter().enumerate().map(of).collect())
    }
}
