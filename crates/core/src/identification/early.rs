//! Whether a search has any prospect: at its first values, before it goes on.
//!
//! The scatter s of the points is known, or is that of ln δ about a cubic in ln P, which every elastic curve follows closely. With
//! s²(JᵀJ)⁻¹ at the first values a parameter may be known so badly that no values beside them say more.

use super::Measurement;
use super::covariance::{Covariance, MOST_UNCERTAIN};
use super::curve::IndentationCurve;
use super::error::{IdentificationError, Undetermined};
use super::least_squares::{self, Linearised};
use super::parameter::FreeParameters;

/// Relative standard error, over the one with which a parameter is stated, from which on it is hopeless: other values than the first ones
/// have another influence on the curve, but hardly so much.
const HOPELESS: f64 = 4.0;
/// Trials, one after the other from the start, at which a parameter must be hopeless.
const TRIALS: usize = 3;

/// Coefficients of a cubic.
const TERMS: usize = 4;

/// The check of the first trials of a search.
#[derive(Debug)]
pub(super) struct EarlyCheck {
    /// Variance of a residual, 0 where it is not known before a fit; `None` once the search has prospects.
    variance: Option<f64>,
    trials: usize,
    /// The refusal, once the search is hopeless.
    pub refusal: Option<Undetermined>,
}

impl EarlyCheck {
    pub fn new(measured: &Measurement) -> Self {
        let variance = if measured.deviations().is_some() { 1.0 } else { scatter(measured).unwrap_or(0.0) };
        Self { variance: Some(variance), trials: 0, refusal: None }
    }

    /// Whether the search is hopeless at this trial and at all before it.
    pub fn is_hopeless(
        &mut self,
        free: FreeParameters<'_>,
        t: &[f64],
        linearised: &Linearised<IndentationCurve>,
    ) -> bool {
        let Some(variance) = self.variance.filter(|_| self.trials < TRIALS) else { return false };
        let place = (t, &linearised.jacobian[..]);
        let most = HOPELESS * MOST_UNCERTAIN;
        let found = Covariance::new::<()>(free, place, variance, linearised.model.radii(), most);
        let Err(IdentificationError::Undetermined(undetermined)) = found else {
            self.variance = None;
            return false;
        };
        self.trials += 1;
        if self.trials == TRIALS {
            self.refusal = Some(Undetermined { at_start: true, ..undetermined });
        }
        self.refusal.is_some()
    }
}

/// Variance of residuals in the largest penetration, by the scatter of ln δ about a cubic in ln P; `None` of few points, and of
/// penetrations not above 0; nor of several curves, whose zeros differ.
fn scatter(measured: &Measurement) -> Option<f64> {
    let (forces, penetrations) = (measured.forces(), measured.penetrations());
    let (largest, freedom) = (penetrations.iter().copied().fold(0.0, f64::max), forces.len().checked_sub(TERMS)?);
    if freedom < 3 || measured.lengths().len() > 1 || penetrations.iter().any(|penetration| *penetration <= 0.0) {
        return None;
    }
    let logarithm = |x: &f64| x.ln();
    let middle = forces.iter().map(logarithm).sum::<f64>() / forces.len() as f64;
    let rows: Vec<Vec<f64>> =
        forces.iter().map(|force| (0..TERMS as i32).map(|k| (force.ln() - middle).powi(k)).collect()).collect();
    let inverse = least_squares::inverse(&least_squares::normal(&rows))?;
    let along =
        |k: usize| rows.iter().zip(penetrations).map(|(row, penetration)| row[k] * penetration.ln()).sum::<f64>();
    let gradient: Vec<f64> = (0..TERMS).map(along).collect();
    let fit: Vec<f64> = inverse.iter().map(|row| row.iter().zip(&gradient).map(|(a, g)| a * g).sum()).collect();
    let residual = |(row, penetration): (&Vec<f64>, &f64)| {
        let fitted: f64 = row.iter().zip(&fit).map(|(x, c)| x * c).sum();
        (penetration / largest * (penetration.ln() - fitted)).powi(2)
    };
    Some(rows.iter().zip(penetrations).map(residual).sum::<f64>() / freedom as f64)
}
