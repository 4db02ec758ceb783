//! Doubts about a fit: residuals that are a pattern, and what of the instrument would take it up.
//!
//! A number a that would be added to the fit along the column c of the residuals, c = 1/σᵢ for a missed zero and Pᵢ/σᵢ for the compliance
//! of the frame, is found without another search: with c⊥ = c − J(JᵀJ)⁻¹Jᵀc it is −c⊥·r/|c⊥|², known to s/|c⊥| (the score test).

use super::covariance::Covariance;
use super::pattern::Pattern;
use super::sensitivity::NoDerivative;
use super::student::{self, Quantile};

/// Part of a column that must not be one of the parameters', for its number to be told.
const APART: f64 = 1e-3;

/// Why the standard errors of a fit may not hold, or what of it is missing.
#[derive(Debug, Clone, PartialEq)]
pub enum Doubt {
    /// Residuals are no scatter over the force.
    Systematic(Pattern),
    /// A zero that was missed would explain them, and is neither known nor to be found.
    Offset(Missing),
    /// The compliance of a frame would explain them, and is neither known nor to be found.
    FrameCompliance(Missing),
    /// The model has no penetrations beside the values of numbers that were taken as known.
    NoDerivative(NoDerivative),
}

/// A number of the instrument that the residuals ask for.
#[derive(Debug, Clone, PartialEq)]
pub struct Missing {
    /// Value, to first order: a length, or a length per force.
    pub value: f64,
    /// Standard error of the value.
    pub error: f64,
    /// Parameters with the number, to first order.
    pub estimates: Vec<f64>,
}

/// A minimum: residuals and Jacobian, and whether residuals are in known deviations.
#[derive(Debug, Clone, Copy)]
pub(super) struct AtMinimum<'a> {
    pub residuals: &'a [f64],
    pub jacobian: &'a [Vec<f64>],
    pub covariance: &'a Covariance,
    pub are_known: bool,
}

impl AtMinimum<'_> {
    /// The number along a column that residuals ask for beyond chance, with its standard error and the changes of t with it; `None`
    /// where they do not, or the parameters have it.
    pub fn missing(&self, column: &[f64]) -> Option<(f64, f64, Vec<f64>)> {
        let Self { residuals, jacobian, covariance, are_known } = *self;
        let count = jacobian.first().map_or(0, Vec::len);
        let freedom = residuals.len().checked_sub(count + 1).filter(|freedom| *freedom > 0)?;
        let taken = covariance.taken_up(jacobian, column);
        let along = |row: &[f64]| row.iter().zip(&taken).map(|(j, t)| j * t).sum::<f64>();
        let apart: Vec<f64> = column.iter().zip(jacobian).map(|(c, row)| c - along(row)).collect();
        let square = |all: &[f64]| all.iter().map(|x| x * x).sum::<f64>();
        let squares = square(&apart);
        if squares <= APART * APART * square(column) {
            return None;
        }
        let value = -apart.iter().zip(residuals).map(|(c, r)| c * r).sum::<f64>() / squares;
        let left = (square(residuals) - value * value * squares).max(0.0) / freedom as f64;
        let error = (if are_known { left.max(1.0) } else { left } / squares).sqrt();
        let is_needed = value.abs() > student::quantile(Quantile::TwoSided400, freedom) * error;
        is_needed.then(|| (value, error, taken.iter().map(|t| -value * t).collect()))
    }
}
