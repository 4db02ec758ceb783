//! The fit of a model to a measured curve: parameters with their standard errors, and the fitted penetrations with theirs.

use super::Measurement;
use super::covariance::Covariance;
use super::curve::{self, IndentationCurve};
use super::error::{IdentificationError, NoValue};
use super::least_squares::{self, End, Linearised, Minimum};
use super::parameter::Parameter;
use super::search::{Listener, Model, Search};
use super::student;
use crate::notation::number;
use std::fmt;
use std::ops::ControlFlow;

/// A parameter found.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The parameter.
    pub parameter: Parameter,
    /// Its value.
    pub value: f64,
    /// Its standard error, in the unit of the value.
    pub error: f64,
    /// The interval that holds it with a probability of 95 %, as far as its bounds reach.
    pub interval: [f64; 2],
}

/// Parameters found from a measured curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Identification {
    /// The parameters.
    pub estimates: Vec<Estimate>,
    /// Correlation of each two.
    pub correlation: Vec<Vec<f64>>,
    /// Penetration of the fit under each measured force, a length.
    pub fitted: Vec<f64>,
    /// Its standard error, by that of the parameters alone, a length: the mean of many measurements lies within it, a single one
    /// scatters by its own deviation besides.
    pub band: Vec<f64>,
    /// Root mean square of measured minus fitted penetrations, a length.
    pub rms: f64,
    /// Points less parameters.
    pub freedom: usize,
    /// Σ(residual/deviation)² over the degrees of freedom, where deviations are known: about 1 for a model that holds.
    pub reduced_chi_square: Option<f64>,
    /// Largest estimated relative error of the fitted penetrations by the discretisation; `None` where none is known.
    pub model_error: Option<f64>,
    /// Contact radii of the fit under the least and the largest force, lengths.
    pub radii: [f64; 2],
    /// Steps of the search.
    pub steps: usize,
}

impl Identification {
    /// Finds the parameters of a model from a measured curve, by least squares from their starts.
    ///
    /// # Errors
    /// [`IdentificationError`] for a model of another contact, for values that it refuses, where the search does not converge, and where
    /// the curve does not determine a parameter.
    pub fn new<E: Send>(
        model: &Model<'_, E>,
        parameters: &[Parameter],
        measured: &Measurement,
    ) -> Result<Self, IdentificationError<E>> {
        Self::new_with_progress(model, parameters, measured, &mut |_| ControlFlow::Continue(()))
    }

    /// As [`Identification::new`]. Calls `progress` after each trial of values; `Break` ends the search.
    ///
    /// # Errors
    /// Those of [`Identification::new`], and [`IdentificationError::Stopped`].
    pub fn new_with_progress<E: Send>(
        model: &Model<'_, E>,
        parameters: &[Parameter],
        measured: &Measurement,
        progress: &mut Listener<'_>,
    ) -> Result<Self, IdentificationError<E>> {
        let (points, count) = (measured.forces().len(), parameters.len());
        if points <= count {
            return Err(IdentificationError::TooFew { points, parameters: count });
        }
        let mut search = Search::new(model, parameters, measured);
        let start = vec![0.0; count];
        curve::check(&search.problem(&start, None).map_err(IdentificationError::Model)?)?;
        let found = least_squares::minimise(start, |t| search.trial(t, progress)).map_err(NoValue::at_the_start)?;
        if matches!(found.end, End::Refused(NoValue::Stopped)) {
            return Err(IdentificationError::Stopped);
        }
        // A search along what the curve does not contain has no end: that is the reason to be given.
        let estimated = Self::at(&search, measured, &found)?;
        match found.end {
            End::Converged => Ok(estimated),
            End::Refused(reason) => Err(IdentificationError::Refused(reason)),
            End::Exhausted => Err(IdentificationError::NotConverged),
        }
    }

    /// Values, standard errors and fitted curve at the minimum that a search has found.
    fn at<E: Send>(
        search: &Search<'_, E>,
        measured: &Measurement,
        found: &Minimum<IndentationCurve, NoValue<E>>,
    ) -> Result<Self, IdentificationError<E>> {
        let Linearised { residuals, jacobian, model: curve } = &found.linearised;
        let count = found.place.len();
        let freedom = residuals.len() - count;
        let reduced = least_squares::sum(residuals) / freedom as f64;
        // Known deviations are taken as they are, unless the fit is worse.
        let variance = if measured.deviations().is_some() { reduced.max(1.0) } else { reduced };
        let radii = curve.radii();
        let covariance = Covariance::new(search.free, (&found.place, jacobian), variance, radii)?;
        let estimate = |k: usize| {
            let (t, deviation) = (found.place[k], covariance.deviation(k));
            let reach = student::quantile(freedom) * deviation;
            Estimate {
                parameter: search.free.all[k].clone(),
                value: search.free.value(k, t),
                error: deviation * search.free.slope(k, t).abs(),
                interval: [t - reach, t + reach].map(|t| search.free.bounded(k, t)),
            }
        };
        let lengths = search.lengths(residuals);
        Ok(Self {
            estimates: (0..count).map(estimate).collect(),
            correlation: (0..count)
                .map(|k| (0..count).map(|other| covariance.correlation(k, other)).collect())
                .collect(),
            fitted: lengths.iter().zip(measured.penetrations()).map(|(r, measured)| measured + r).collect(),
            band: jacobian.iter().enumerate().map(|(i, row)| search.deviation(i) * covariance.along(row)).collect(),
            rms: search.rms(residuals),
            freedom,
            reduced_chi_square: measured.deviations().map(|_| reduced),
            model_error: curve.error(),
            radii,
            steps: found.steps,
        })
    }
}

impl fmt::Display for Identification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for own in &self.estimates {
            writeln!(f, "{} = {} ± {}", own.parameter.name, number(own.value), number(own.error))?;
        }
        write!(f, "residual {} (root mean square), {} degrees of freedom", number(self.rms), self.freedom)
    }
}
