//! Parameters found, with their standard errors.

use super::covariance::Covariance;
use super::error::{IdentificationError, NoValue};
use super::least_squares::{End, Minimum};
use super::parameter::{FreeParameters, Parameter};
use super::student::{self, Quantile};

/// A parameter found.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The parameter.
    pub parameter: Parameter,
    /// Value of the parameter.
    pub value: f64,
    /// Standard error, in the unit of the value.
    pub error: f64,
    /// Interval that holds the parameter with a probability of 95 %, as far as its bounds reach.
    pub interval: [f64; 2],
}

/// The parameters at a place of a search with their covariance, by Student's distribution of these degrees of freedom.
pub(super) fn estimates(
    free: FreeParameters<'_>,
    place: &[f64],
    covariance: &Covariance,
    freedom: usize,
) -> Vec<Estimate> {
    let quantile = student::quantile(Quantile::TwoSided95, freedom);
    let estimate = |(k, &t): (usize, &f64)| {
        let deviation = covariance.deviation(k);
        let reach = quantile * deviation;
        Estimate {
            parameter: free.all[k].clone(),
            value: free.value(k, t),
            error: deviation * free.slope(k, t).abs(),
            interval: [t - reach, t + reach].map(|t| free.bounded(k, t)),
        }
    };
    place.iter().enumerate().map(estimate).collect()
}

/// Result of `at` for the place where a search ended, if that is a minimum.
///
/// # Errors
/// Why the search did not end at a minimum; but first the error of what follows: a search along what the measurement does not contain has no
/// end, and that is the reason to be given.
pub(super) fn at_minimum<M, E, T>(
    found: Minimum<M, NoValue<E>>,
    at: impl FnOnce(&Minimum<M, NoValue<E>>) -> Result<T, IdentificationError<E>>,
) -> Result<T, IdentificationError<E>> {
    if matches!(found.end, End::Refused(NoValue::Stopped)) {
        return Err(IdentificationError::Stopped);
    }
    let estimated = at(&found)?;
    match found.end {
        End::Converged => Ok(estimated),
        End::Refused(reason) => Err(IdentificationError::Refused(reason)),
        End::Exhausted => Err(IdentificationError::NotConverged),
    }
}
