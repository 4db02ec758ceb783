//! Parameters by unloadings, with their standard errors, and the contact of each unloading.

use super::contact::{BareModulus, Contact, Measured, NoContact, UnloadingModel};
use super::record::Unloading;
use super::search::{Contacts, Search};
use crate::identification::covariance::{Covariance, MOST_UNCERTAIN};
use crate::identification::curve;
use crate::identification::error::{IdentificationError, NoValue};
use crate::identification::estimate::{Estimate, at_minimum, estimates};
use crate::identification::least_squares::{self, Linearised, Minimum};
use crate::identification::parameter::Parameter;
use crate::identification::search::Listener;
use crate::identification::sensitivity::{NoDerivative, Sensitivity};
use std::f64::consts::PI;
use std::fmt;

/// h_f/h from which on the material usually piles up around the contact (Oliver & Pharr, J. Mater. Res. 19 (2004) 3).
const PILES_UP: f64 = 0.7;
/// Exponents m of elastic unloading, from that of a flat punch to that of a cone, and a twentieth beyond for the scatter.
const EXPONENTS: [f64; 2] = [0.95, 2.1];
/// Root mean square of the residuals of the power law over h − h_f from which on a doubt names their pattern.
const LARGE: f64 = 2e-3;

/// The contact of an unloading in the model that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnloadingContact {
    /// Contact depth h_c, a length.
    pub depth: f64,
    /// Contact radius a = √(A/π), a length.
    pub radius: f64,
    /// ε of the layered bodies.
    pub epsilon: f64,
    /// dP/dh of the model with the frame of the instrument, a force per length.
    pub stiffness: f64,
    /// S as measured, without the frame of the instrument, a force per length.
    pub measured_stiffness: f64,
    /// Hardness H = P/A, a pressure.
    pub hardness: f64,
    /// Standard error of H by those of h and S, a pressure.
    pub hardness_error: f64,
    /// The modulus by the formula for bare bodies.
    pub bare: BareModulus,
}

/// Why what was found by unloadings may not hold.
#[derive(Debug, Clone, PartialEq)]
pub enum UnloadingDoubt {
    /// The unloading of this index is no power law beyond its scatter.
    NoPowerLaw(usize),
    /// The exponent m of the unloading of this index is none of elastic unloading.
    Exponent(usize, f64),
    /// The unloading of this index leaves the part h_f/h of its penetration: material may pile up.
    PileUp(usize, f64),
    /// The unloadings differ by more than their errors: Σ(residual/deviation)² over the degrees of freedom.
    Scatter(f64),
    /// The model has no stiffness beside the values of numbers that were taken as known.
    NoDerivative(NoDerivative),
}

/// Parameters found by unloadings.
#[derive(Debug, Clone, PartialEq)]
pub struct FromUnloading {
    /// The parameters.
    pub estimates: Vec<Estimate>,
    /// Correlation of each two.
    pub correlation: Vec<Vec<f64>>,
    /// The contact of each unloading.
    pub contacts: Vec<UnloadingContact>,
    /// Unloadings less parameters.
    pub freedom: usize,
    /// Σ(residual/deviation)² over the degrees of freedom; `None` without any.
    pub reduced_chi_square: Option<f64>,
    /// Root mean square of the differences of P/S of measurement and model, a length.
    pub rms: f64,
    /// Largest estimated relative error of the stiffness by the solver.
    pub model_error: f64,
    /// Least and largest contact radius, lengths.
    pub radii: [f64; 2],
    /// Derivatives of the parameters by what was taken as known.
    pub sensitivities: Vec<Sensitivity>,
    /// Why it may not hold, and which derivatives are missing.
    pub doubts: Vec<UnloadingDoubt>,
    /// Steps of the search.
    pub steps: usize,
}

impl FromUnloading {
    /// Finds the parameters of a model from unloadings, by least squares from their starts, with their derivatives by the numbers `fixed`,
    /// whose starts are their values: the model has a problem at the values of the parameters alone, and at these and then those of `fixed`.
    /// Calls `progress` after each trial of values; `Break` ends the search.
    ///
    /// # Errors
    /// [`IdentificationError`].
    pub fn new<E: Send + fmt::Display>(
        model: &UnloadingModel<'_, E>,
        (parameters, fixed): (&[Parameter], &[Parameter]),
        unloadings: &[Unloading],
        progress: &mut Listener<'_>,
    ) -> Result<Self, IdentificationError<E>> {
        let (curves, count) = (unloadings.len(), parameters.len());
        if curves < count || curves == 0 {
            return Err(IdentificationError::TooFewUnloadings { curves, parameters: count });
        }
        let mut search = Search::new(model, parameters, unloadings);
        let start = vec![0.0; count];
        curve::check(&search.problem(&start).map_err(IdentificationError::Model)?)?;
        let found = least_squares::minimise(start, |t| search.trial(t, progress)).map_err(NoValue::at_the_start)?;
        at_minimum(found, |found| Self::at(&search, fixed, found))
    }

    /// Values, standard errors and contacts at the minimum that a search has found.
    fn at<E: Send + fmt::Display>(
        search: &Search<'_, E>,
        fixed: &[Parameter],
        found: &Minimum<Contacts, NoValue<E>>,
    ) -> Result<Self, IdentificationError<E>> {
        let Linearised { residuals, jacobian, model: Contacts { problem, contacts, .. } } = &found.linearised;
        let (place, count) = (&found.place, found.place.len());
        let scatter = Scatter::of(residuals, count, search.unloadings);
        let all = || contacts.iter().map(|contact| contact.radius);
        let radii = [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)];
        let covariance = Covariance::new(search.free, (place, jacobian), scatter.variance, radii, MOST_UNCERTAIN)?;
        let estimates = estimates(search.free, place, &covariance, scatter.freedom);
        let measured = search.measured(place);
        let read = |(measured, contact): (&Measured<'_>, &Contact)| -> Result<_, NoContact> {
            let hardness = |values| {
                let radius = measured.contact(problem, values, contact.epsilon)?.radius;
                Ok(measured.unloading.force / (PI * radius * radius))
            };
            Ok(UnloadingContact {
                depth: contact.depth,
                radius: contact.radius,
                epsilon: contact.epsilon,
                stiffness: contact.stiffness,
                measured_stiffness: measured.without_frame(measured.unloading.stiffness)?,
                hardness: hardness(measured.values())?,
                hardness_error: measured.error_of(hardness)?,
                bare: measured.bare(problem)?,
            })
        };
        let read: Result<Vec<UnloadingContact>, NoContact> = measured.iter().zip(contacts).map(read).collect();
        let mut doubts = doubts(search.unloadings);
        doubts.extend(scatter.doubt);
        let (sensitivities, missing) = sensitivities(search, fixed, found, &covariance);
        doubts.extend(missing.into_iter().map(UnloadingDoubt::NoDerivative));
        Ok(Self {
            estimates,
            correlation: covariance.correlations(),
            contacts: read.map_err(IdentificationError::Contact)?,
            freedom: residuals.len() - count,
            reduced_chi_square: scatter.reduced,
            rms: search.rms(contacts),
            model_error: contacts.iter().fold(0.0, |most, contact| contact.error.max(most)),
            radii,
            sensitivities,
            doubts,
            steps: found.steps,
        })
    }
}

/// Scatter of the residuals.
struct Scatter {
    /// Σ residuals² over the degrees of freedom; `None` without any.
    reduced: Option<f64>,
    /// Variance of a residual, and the degrees of freedom by which it is known.
    variance: f64,
    freedom: usize,
    doubt: Option<UnloadingDoubt>,
}

impl Scatter {
    /// The scatter of residuals about a fit of `count` parameters: as large as the errors of the unloadings say, unless chance leaves so much in
    /// fewer than 1 of 20 cases.
    fn of(residuals: &[f64], count: usize, unloadings: &[Unloading]) -> Self {
        let freedom = residuals.len() - count;
        let reduced = (freedom > 0).then(|| least_squares::sum(residuals) / freedom as f64);
        // χ² over n (Wilson & Hilferty, Proc. Natl. Acad. Sci. 17 (1931) 684).
        let part = 2.0 / (9.0 * freedom.max(1) as f64);
        let most = (1.0 - part + 1.645 * part.sqrt()).powi(3);
        match reduced.filter(|reduced| *reduced > most) {
            Some(variance) => Self { reduced, variance, freedom, doubt: Some(UnloadingDoubt::Scatter(variance)) },
            None => {
                let freedom = unloadings.iter().map(Unloading::freedom).sum();
                Self { reduced, variance: 1.0, freedom, doubt: None }
            }
        }
    }
}

/// Signs that unloadings are not as the method takes them.
fn doubts(unloadings: &[Unloading]) -> Vec<UnloadingDoubt> {
    let each = unloadings.iter().enumerate().flat_map(|(curve, unloading)| {
        let Unloading { exponent, residual_depth, penetration, rms, is_systematic, .. } = *unloading;
        let is_large = rms > LARGE * (penetration - residual_depth).abs();
        let is_elastic = (EXPONENTS[0]..=EXPONENTS[1]).contains(&exponent);
        let left = residual_depth / penetration;
        [
            (is_systematic && is_large).then_some(UnloadingDoubt::NoPowerLaw(curve)),
            (!is_elastic).then_some(UnloadingDoubt::Exponent(curve, exponent)),
            (left > PILES_UP).then_some(UnloadingDoubt::PileUp(curve, left)),
        ]
    });
    each.flatten().collect()
}

/// Derivatives of the parameters by the numbers `fixed`, one by one, and those of them that the model does not allow to vary.
fn sensitivities<E: Send + fmt::Display>(
    search: &Search<'_, E>,
    fixed: &[Parameter],
    found: &Minimum<Contacts, NoValue<E>>,
    covariance: &Covariance,
) -> (Vec<Sensitivity>, Vec<NoDerivative>) {
    let values: Vec<f64> = (0..found.place.len()).map(|k| search.free.value(k, found.place[k])).collect();
    let starts: Vec<f64> = fixed.iter().map(|parameter| parameter.start).collect();
    let (mut known, mut missing) = (Vec::new(), Vec::new());
    for (index, parameter) in fixed.iter().enumerate() {
        let problem = |moved: &[f64]| {
            let mut all = starts.clone();
            all[index] = moved[0];
            (search.model.problem)(&[&values[..], &all].concat())
        };
        // Free numbers of the instrument have their values.
        let instrument =
            search.measured(&found.place).first().map_or(search.model.instrument, |first| first.instrument);
        let model = UnloadingModel { problem: &problem, instrument, beta: search.model.beta };
        let beside = Search::new(&model, &fixed[index..=index], search.unloadings);
        match beside.slopes(&[0.0], 0, &found.linearised.model.contacts) {
            Ok(slopes) => {
                let deviations = &found.linearised.model.deviations;
                let column: Vec<f64> =
                    slopes.iter().zip(deviations).map(|(slope, deviation)| slope / deviation).collect();
                let taken = covariance.taken_up(&found.linearised.jacobian, &column);
                let per = beside.free.slope(0, 0.0);
                let derivative = |(k, t): (usize, &f64)| -t * search.free.slope(k, found.place[k]) / per;
                let derivatives = taken.iter().enumerate().map(derivative).collect();
                known.push(Sensitivity { fixed: parameter.clone(), derivatives });
            }
            Err(error) => {
                let reason = error.to_string().lines().next().unwrap_or_default().to_owned();
                missing.push(NoDerivative { names: vec![parameter.name.clone()], reason });
            }
        }
    }
    (known, missing)
}
