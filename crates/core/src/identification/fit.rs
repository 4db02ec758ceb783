//! The fit of a model to a measured curve: parameters with their standard errors, and the fitted penetrations with theirs.

use super::Measurement;
use super::covariance::{Covariance, MOST_UNCERTAIN};
use super::curve::{self, IndentationCurve};
use super::doubt::{AtMinimum, Doubt, Missing};
use super::early::EarlyCheck;
use super::error::{IdentificationError, NoValue};
use super::estimate::{Estimate, at_minimum, estimates};
use super::least_squares::{self, Linearised, Minimum};
use super::parameter::{Parameter, Quantity};
use super::pattern::Pattern;
use super::search::{Listener, Model, Search};
use super::sensitivity::{Differentiated, Sensitivity};
use crate::notation::number;
use std::fmt;
use std::ops::ControlFlow;

/// Parameters found from a measured curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Identification {
    /// The parameters.
    pub estimates: Vec<Estimate>,
    /// Correlation of each two.
    pub correlation: Vec<Vec<f64>>,
    /// Penetration of the fit under each measured force, a length.
    pub fitted: Vec<f64>,
    /// Standard error of each fitted penetration by the errors of the parameters alone, a length: the mean of many
    /// measurements lies within it, a single one scatters by its deviation besides.
    pub band: Vec<f64>,
    /// Root mean square of measured minus fitted penetrations, a length.
    pub rms: f64,
    /// Root mean square of measured minus fitted penetrations of each curve, lengths.
    pub rms_of_curves: Vec<f64>,
    /// Points less parameters.
    pub freedom: usize,
    /// Σ(residual/deviation)² over the degrees of freedom, where deviations are known: about 1 for a model that holds.
    pub reduced_chi_square: Option<f64>,
    /// Largest estimated relative error of the fitted penetrations by the discretisation; `None` where none is known.
    pub model_error: Option<f64>,
    /// Contact radii of the fit under the least and the largest force, lengths.
    pub radii: [f64; 2],
    /// Largest pressure of the elastic fit under each measured force, the mean one under a tip, whose largest is infinite.
    pub peaks: Vec<f64>,
    /// Derivatives of the parameters by what was taken as known; of what has none [`Doubt::NoDerivative`] says why.
    pub sensitivities: Vec<Sensitivity>,
    /// Why the standard errors may not hold, and which derivatives are missing; empty where nothing says so.
    pub doubts: Vec<Doubt>,
    /// Steps of the search.
    pub steps: usize,
}

impl Identification {
    /// Finds the parameters of a model from a measured curve, by least squares from their starts.
    ///
    /// # Errors
    /// [`IdentificationError`] for a model of another contact, for values that it refuses, where the search does not converge, and where
    /// the curve does not determine a parameter.
    pub fn new<E: Send + fmt::Display>(
        model: &Model<'_, E>,
        parameters: &[Parameter],
        measured: &Measurement,
    ) -> Result<Self, IdentificationError<E>> {
        Self::new_with_progress(model, parameters, measured, &mut |_| ControlFlow::Continue(()))
    }

    /// Finds the parameters as [`Identification::new`] does. Calls `progress` after each trial of values; `Break` ends
    /// the search.
    ///
    /// # Errors
    /// Errors of [`Identification::new`], and [`IdentificationError::Stopped`].
    pub fn new_with_progress<E: Send + fmt::Display>(
        model: &Model<'_, E>,
        parameters: &[Parameter],
        measured: &Measurement,
        progress: &mut Listener<'_>,
    ) -> Result<Self, IdentificationError<E>> {
        Self::with_fixed(model, (parameters, &[]), measured, progress)
    }

    /// Finds the parameters as [`Identification::new_with_progress`] does, with their derivatives by the numbers
    /// `fixed`, whose starts are their values: the model has a problem at the values of the parameters alone, and at
    /// these and then those of `fixed`.
    ///
    /// # Errors
    /// Errors of [`Identification::new_with_progress`].
    pub fn with_fixed<E: Send + fmt::Display>(
        model: &Model<'_, E>,
        (parameters, fixed): (&[Parameter], &[Parameter]),
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
        let mut early = EarlyCheck::new(measured);
        let found = least_squares::minimise(start, |t| {
            if early.refusal.is_some() {
                return Err(NoValue::Stopped);
            }
            let linearised = search.trial(t, progress)?;
            if early.is_hopeless(search.free, t, &linearised) { Err(NoValue::Stopped) } else { Ok(linearised) }
        });
        if let Some(undetermined) = early.refusal {
            return Err(IdentificationError::Undetermined(undetermined));
        }
        let found = found.map_err(NoValue::at_the_start)?;
        at_minimum(found, |found| Self::at(&search, fixed, found))
    }

    /// Values, standard errors and fitted curve at the minimum that a search has found.
    fn at<E: Send + fmt::Display>(
        search: &Search<'_, E>,
        fixed: &[Parameter],
        found: &Minimum<IndentationCurve, NoValue<E>>,
    ) -> Result<Self, IdentificationError<E>> {
        let Linearised { residuals, jacobian, model: curve } = &found.linearised;
        let measured = search.measured;
        let count = found.place.len();
        let freedom = residuals.len() - count;
        let reduced = least_squares::sum(residuals) / freedom as f64;
        // Known deviations are taken as they are, unless the fit is worse.
        let variance = if measured.deviations().is_some() { reduced.max(1.0) } else { reduced };
        let radii = curve.radii();
        let covariance = Covariance::new(search.free, (&found.place, jacobian), variance, radii, MOST_UNCERTAIN)?;
        let lengths = search.lengths(residuals);
        let estimates = estimates(search.free, &found.place, &covariance, freedom);
        let at = AtMinimum { residuals, jacobian, covariance: &covariance, are_known: measured.deviations().is_some() };
        let mut doubts = doubts(search, &at, (&found.place, curve), &lengths);
        let values: Vec<f64> = estimates.iter().map(|estimate| estimate.value).collect();
        let place = &found.place;
        let at = Differentiated { search, place, values: &values, jacobian, covariance: &covariance };
        let (sensitivities, missing) = at.by(fixed);
        doubts.extend(missing.into_iter().map(Doubt::NoDerivative));
        Ok(Self {
            estimates,
            correlation: covariance.correlations(),
            fitted: lengths.iter().zip(measured.penetrations()).map(|(r, measured)| measured + r).collect(),
            band: jacobian.iter().enumerate().map(|(i, row)| search.deviation(i) * covariance.along(row)).collect(),
            rms: search.rms(residuals),
            rms_of_curves: rms_of_curves(measured.lengths(), &lengths),
            freedom,
            reduced_chi_square: measured.deviations().map(|_| reduced),
            model_error: curve.error(),
            radii,
            peaks: measured.forces().iter().map(|&force| curve.peak(force)).collect(),
            sensitivities,
            doubts,
            steps: found.steps,
        })
    }
}

/// Root mean squares of the residuals of curves of these numbers of points, one curve after the other.
fn rms_of_curves(curves: &[usize], mut residuals: &[f64]) -> Vec<f64> {
    let mut all = Vec::with_capacity(curves.len());
    for &length in curves {
        let (curve, rest) = residuals.split_at(length);
        all.push((least_squares::sum(curve) / length as f64).sqrt());
        residuals = rest;
    }
    all
}

/// Signs at a minimum that its standard errors do not hold: beyond chance, and beyond the error of the fitted penetrations, `lengths`
/// of the residuals, by the grid.
fn doubts<E: Send>(
    search: &Search<'_, E>,
    at: &AtMinimum<'_>,
    (place, curve): (&[f64], &IndentationCurve),
    lengths: &[f64],
) -> Vec<Doubt> {
    let measured = search.measured;
    let (forces, largest) = (measured.forces(), measured.forces().iter().copied().fold(0.0, f64::max));
    let root = |all: &[f64]| (least_squares::sum(all) / all.len() as f64).sqrt();
    let grid = curve.error().unwrap_or(0.0);
    let mut order: Vec<usize> = (0..forces.len()).collect();
    order.sort_by(|&a, &b| forces[a].total_cmp(&forces[b]));
    let pattern = Pattern::of(&order.iter().map(|&i| at.residuals[i]).collect::<Vec<_>>());
    let fitted: Vec<f64> = forces.iter().map(|&force| curve.at(force).0).collect();
    let is_beyond = root(lengths) > grid * root(&fitted);
    let systematic = (pattern.is_systematic() && is_beyond).then_some(Doubt::Systematic(pattern));
    let missing = |quantity: Quantity, per: &dyn Fn(usize) -> f64, most: f64| {
        let is_it = |parameter: &Parameter| match parameter.quantity {
            Quantity::OffsetOf(_) => quantity == Quantity::Offset,
            other => other == quantity,
        };
        if search.free.all.iter().any(is_it) {
            return None;
        }
        let column: Vec<f64> = (0..forces.len()).map(|i| per(i) / search.deviation(i)).collect();
        let (value, error, changes) = at.missing(&column)?;
        let estimates = changes.iter().enumerate().map(|(k, by)| search.free.value(k, place[k] + by)).collect();
        (value.abs() * most > grid * curve.at(largest).0).then_some(Missing { value, error, estimates })
    };
    let offset = missing(Quantity::Offset, &|_| 1.0, 1.0);
    let frame = missing(Quantity::FrameCompliance, &|i| forces[i], largest);
    // One makes up for the other: the one that explains more is told.
    let certain = |found: &Option<Missing>| found.as_ref().map_or(0.0, |found| (found.value / found.error).abs());
    let better = match certain(&offset) >= certain(&frame) {
        true => offset.map(Doubt::Offset),
        false => frame.map(Doubt::FrameCompliance),
    };
    [systematic, better].into_iter().flatten().collect()
}

impl fmt::Display for Identification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for estimate in &self.estimates {
            writeln!(f, "{} = {} ± {}", estimate.parameter.name, number(estimate.value), number(estimate.error))?;
        }
        write!(f, "residual {} (root mean square), {} degrees of freedom", number(self.rms), self.freedom)
    }
}
