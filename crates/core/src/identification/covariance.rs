//! The covariance s²(JᵀJ)⁻¹ of the parameters t at a minimum, and the refusal where the curve does not tell them.

use super::error::{IdentificationError, Undetermined};
use super::least_squares;
use super::parameter::FreeParameters;

/// Largest standard error of a parameter with which it is stated, relative to its value; of one between bounds, to half of the way between
/// them.
pub const MOST_UNCERTAIN: f64 = 0.5;
/// Correlation of two parameters from which on one of them must be known from elsewhere.
const CORRELATED: f64 = 0.9;

/// The covariance of parameters at a minimum.
#[derive(Debug)]
pub(super) struct Covariance {
    /// s²: the sum of squares over the degrees of freedom.
    variance: f64,
    /// (JᵀJ)⁻¹.
    inverse: Vec<Vec<f64>>,
}

impl Covariance {
    /// The covariance of parameters that the curve determines, at t with the Jacobian there and the variance s² of a residual. `radii` are those of the contact
    /// at the minimum, lengths. `most_uncertain` is the largest relative standard error with which a parameter is stated.
    ///
    /// # Errors
    /// [`IdentificationError::NoInfluence`], and [`IdentificationError::Undetermined`] for parameters that change all penetrations in
    /// proportion, and for the one of the largest relative error where that is beyond `most_uncertain`.
    pub(super) fn new<E>(
        free: FreeParameters<'_>,
        (place, jacobian): (&[f64], &[Vec<f64>]),
        variance: f64,
        radii: [f64; 2],
        most_uncertain: f64,
    ) -> Result<Self, IdentificationError<E>> {
        let normal = least_squares::normal(jacobian);
        if let Some(k) = (0..normal.len()).find(|&k| normal[k][k] <= 1e-16 * jacobian.len() as f64) {
            return Err(IdentificationError::NoInfluence(free.name(k)));
        }
        let undetermined = match least_squares::inverse(&normal) {
            None => parallel(free, place, &normal, radii),
            Some(inverse) => {
                let covariance = Self { variance, inverse };
                match covariance.undetermined(free, place, radii, most_uncertain) {
                    None => return Ok(covariance),
                    Some(undetermined) => undetermined,
                }
            }
        };
        Err(IdentificationError::Undetermined(undetermined))
    }

    /// Standard error of t.
    pub(super) fn deviation(&self, k: usize) -> f64 {
        (self.variance * self.inverse[k][k]).sqrt()
    }

    pub(super) fn correlation(&self, k: usize, other: usize) -> f64 {
        self.inverse[k][other] / (self.inverse[k][k] * self.inverse[other][other]).sqrt()
    }

    /// Correlation of each two parameters.
    pub(super) fn correlations(&self) -> Vec<Vec<f64>> {
        let all = || 0..self.inverse.len();
        all().map(|k| all().map(|other| self.correlation(k, other)).collect()).collect()
    }

    /// (JᵀJ)⁻¹Jᵀc: the change of t that takes up a column c of the residuals.
    pub(super) fn taken_up(&self, jacobian: &[Vec<f64>], column: &[f64]) -> Vec<f64> {
        let count = self.inverse.len();
        let gradient = |k: usize| jacobian.iter().zip(column).map(|(row, c)| row[k] * c).sum::<f64>();
        let gradient: Vec<f64> = (0..count).map(gradient).collect();
        (0..count).map(|k| (0..count).map(|other| self.inverse[k][other] * gradient[other]).sum()).collect()
    }

    /// Standard error of a number with these derivatives by t.
    pub(super) fn along(&self, derivatives: &[f64]) -> f64 {
        let count = derivatives.len();
        let along = |k: usize| (0..count).map(|other| self.inverse[k][other] * derivatives[other]).sum::<f64>();
        let square: f64 = (0..count).map(|k| derivatives[k] * along(k)).sum();
        (self.variance * square).sqrt()
    }

    /// The parameter of the largest relative error where that is beyond `most_uncertain`.
    fn undetermined(
        &self,
        free: FreeParameters<'_>,
        place: &[f64],
        radii: [f64; 2],
        most_uncertain: f64,
    ) -> Option<Undetermined> {
        let count = self.inverse.len();
        let relative = |k: usize| free.relative(k, self.deviation(k));
        let worst = (0..count).max_by(|&a, &b| relative(a).total_cmp(&relative(b)));
        let worst = worst.filter(|&worst| relative(worst).is_nan() || relative(worst) > most_uncertain)?;
        let others = (0..count).filter(|&other| other != worst);
        let mixed =
            others.max_by(|&a, &b| self.correlation(worst, a).abs().total_cmp(&self.correlation(worst, b).abs()));
        let mixed = mixed.map(|other| (free.name(other), self.correlation(worst, other)));
        Some(Undetermined {
            name: free.name(worst),
            value: free.value(worst, place[worst]),
            error: self.deviation(worst) * free.slope(worst, place[worst]).abs(),
            mixed: mixed.filter(|(_, correlation)| correlation.abs() > CORRELATED),
            radii,
            at_start: false,
        })
    }
}

/// Two parameters that change all penetrations in proportion.
fn parallel(free: FreeParameters<'_>, place: &[f64], normal: &[Vec<f64>], radii: [f64; 2]) -> Undetermined {
    let parallel = |k: usize, other: usize| normal[k][other] / (normal[k][k] * normal[other][other]).sqrt();
    let pairs = (0..place.len()).flat_map(|k| (0..k).map(move |other| (k, other)));
    let worst = pairs.max_by(|a, b| parallel(a.0, a.1).abs().total_cmp(&parallel(b.0, b.1).abs()));
    let index = worst.map_or(0, |(k, _)| k);
    Undetermined {
        name: free.name(index),
        value: free.value(index, place[index]),
        error: f64::INFINITY,
        mixed: worst.map(|(k, other)| (free.name(other), -parallel(k, other))),
        radii,
        at_start: false,
    }
}
