//! The fit of a model to a measured curve.

use super::Measurement;
use super::curve::{self, CurveError, IndentationCurve, Perturbed};
use super::least_squares::{self, Minimum};
use crate::notation::number;
use crate::problem::Problem;
use crate::spectral::Settings;
use std::fmt;

/// Largest standard error of a parameter, relative to it, with which it is stated.
pub const MOST_UNCERTAIN: f64 = 0.5;
/// Step of difference quotients, in parameters whose scale is 1.
const STEP: f64 = 2e-3;
/// Farthest that a logarithm is searched from its start: a factor of 1000.
const FARTHEST: f64 = 6.9;
/// Correlation of two parameters from which on one of them must be known from elsewhere.
const CORRELATED: f64 = 0.9;

/// What a parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A quantity above 0 of the model, searched by its logarithm.
    Positive,
    /// A quantity of the model of the order of 1, searched by itself, as Poisson's ratio.
    Number,
    /// δ₀, which is added to all penetrations: a zero that was missed. It starts from 0.
    Offset,
    /// C_f of the frame, by which C_f P is added to penetrations, a length per force. It starts from 0.
    FrameCompliance,
}

/// A parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// What it is.
    pub quantity: Quantity,
    /// Its value at the beginning.
    pub start: f64,
}

/// The model: its problem at values of all parameters.
pub struct Model<'a, E> {
    /// The problem of one indenter alone at the values, in the order of the parameters; the error refuses values.
    pub problem: &'a (dyn Fn(&[f64]) -> Result<Problem, E> + Sync),
    /// Samples along a side of a window, of which contact takes up about two thirds.
    pub points: usize,
    /// How loads are solved.
    pub settings: Settings,
}

impl<E> fmt::Debug for Model<'_, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { points, settings, .. } = self;
        f.debug_struct("Model").field("points", points).field("settings", settings).finish_non_exhaustive()
    }
}

/// A parameter found.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The parameter.
    pub parameter: Parameter,
    /// Its value.
    pub value: f64,
    /// Its standard error, in the unit of the value.
    pub error: f64,
    /// The interval that holds it with a probability of 95 %.
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
    /// Its standard error, by that of the parameters, a length.
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

/// Why parameters are not found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IdentificationError<E> {
    /// The values of the start are refused.
    #[error("{0}")]
    Model(E),
    /// The model has no indentation curve.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// As many parameters as points, or more.
    #[error("{points} points do not determine {parameters} parameters: more points than parameters are needed")]
    TooFew {
        /// Points of the curve.
        points: usize,
        /// Parameters to be found.
        parameters: usize,
    },
    /// A parameter on which penetrations do not depend.
    #[error("{0} has no influence on the penetrations: it cannot be found from them")]
    NoInfluence(String),
    /// The search does not end.
    #[error("the search for the parameters does not converge: start nearer to them, or free fewer")]
    NotConverged,
    /// The curve does not contain a parameter.
    #[error("{0}")]
    Undetermined(Undetermined),
}

/// A parameter that the curve does not contain.
#[derive(Debug, Clone, PartialEq)]
pub struct Undetermined {
    /// Its name.
    pub name: String,
    /// Its value, and its standard error; infinite where parameters cannot be told apart.
    pub value: f64,
    /// Standard error.
    pub error: f64,
    /// The parameter that it is mixed up with, and their correlation.
    pub mixed: Option<(String, f64)>,
    /// Contact radii of the fit, lengths.
    pub radii: [f64; 2],
}

impl fmt::Display for Undetermined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value, error, mixed, radii: [least, most] } = self;
        if error.is_finite() {
            write!(f, "the curve does not determine {name}: {} ± {}", number(*value), number(*error))?;
        } else {
            write!(f, "the curve does not determine {name}")?;
        }
        if let Some((other, correlation)) = mixed {
            write!(f, ", it cannot be told from {other} (correlation {correlation:.3})")?;
        }
        write!(
            f,
            "; give one of them a known value, or measure where it matters: contact radii are {} to {} here",
            number(*least),
            number(*most)
        )
    }
}

impl Parameter {
    fn is_of_model(&self) -> bool {
        matches!(self.quantity, Quantity::Positive | Quantity::Number)
    }

    /// Its value at t, where `unit` is that of an offset or a compliance.
    fn value(&self, t: f64, unit: f64) -> f64 {
        match self.quantity {
            Quantity::Positive => self.start * t.exp(),
            Quantity::Number => self.start + t,
            Quantity::Offset | Quantity::FrameCompliance => unit * t,
        }
    }

    /// Its derivative by t.
    fn slope(&self, t: f64, unit: f64) -> f64 {
        match self.quantity {
            Quantity::Positive => self.value(t, unit),
            Quantity::Number => 1.0,
            Quantity::Offset | Quantity::FrameCompliance => unit,
        }
    }
}

/// A search for parameters.
struct Search<'a, E> {
    model: &'a Model<'a, E>,
    parameters: &'a [Parameter],
    measured: &'a Measurement,
    /// Units of offset and frame compliance.
    units: [f64; 2],
    windows: Vec<f64>,
    last: Option<IndentationCurve>,
    failure: Option<CurveError>,
}

impl<E: Send> Search<'_, E> {
    fn unit(&self, parameter: &Parameter) -> f64 {
        match parameter.quantity {
            Quantity::Offset => self.units[0],
            Quantity::FrameCompliance => self.units[1],
            Quantity::Positive | Quantity::Number => 1.0,
        }
    }

    /// The problem at t, of which the entry `moved` is changed by a step.
    fn problem(&self, t: &[f64], moved: Option<(usize, f64)>) -> Result<Problem, E> {
        let at = |(k, parameter): (usize, &Parameter)| {
            let by = moved.filter(|(own, _)| *own == k).map_or(0.0, |(_, by)| by);
            parameter.value(t[k] + by, self.unit(parameter))
        };
        let values: Vec<f64> = self.parameters.iter().enumerate().map(at).collect();
        (self.model.problem)(&values)
    }

    /// The problem at t, and its difference quotients; one-sided where values on one side are refused.
    fn perturbed(&self, t: &[f64]) -> Result<Perturbed, E> {
        let problem = self.problem(t, None)?;
        let quotient = |k: usize| {
            let sides = [STEP, -STEP].map(|by| self.problem(t, Some((k, by))).ok().map(|own| (by, own)));
            let whole = match &sides {
                [Some(_), Some(_)] => 2.0 * STEP,
                _ => STEP,
            };
            let mut parts: Vec<(f64, Problem)> =
                sides.into_iter().flatten().map(|(by, own)| (by.signum() / whole, own)).collect();
            if let [(weight, _)] = parts[..] {
                parts.push((-weight, problem.clone()));
            }
            parts
        };
        let of_model = (0..self.parameters.len()).filter(|&k| self.parameters[k].is_of_model());
        let quotients = of_model.map(quotient).collect();
        Ok(Perturbed { problem, quotients })
    }

    /// Residuals and Jacobian at t; `None` where the model refuses the values.
    fn linearised(&mut self, t: &[f64]) -> Option<least_squares::Linearised> {
        let too_far = |(t, own): (&f64, &Parameter)| own.quantity == Quantity::Positive && t.abs() > FARTHEST;
        if t.iter().zip(self.parameters).any(too_far) {
            return None;
        }
        let perturbed = self.perturbed(t).ok()?;
        let forces = self.measured.forces();
        let range = [forces.iter().copied().fold(f64::INFINITY, f64::min), forces.iter().copied().fold(0.0, f64::max)];
        let Model { points, settings, .. } = *self.model;
        let curve = match IndentationCurve::new(&perturbed, range, points, settings, &mut self.windows) {
            Ok(curve) => curve,
            Err(error) => {
                self.failure = Some(error);
                return None;
            }
        };
        let rows = (0..forces.len()).map(|i| {
            let (fitted, derivatives) = self.fitted(&curve, t, forces[i]);
            let deviation = self.deviation(i);
            let residual = (fitted - self.measured.penetrations()[i]) / deviation;
            (residual, derivatives.into_iter().map(|own| own / deviation).collect())
        });
        let linearised = rows.unzip();
        self.last = Some(curve);
        Some(linearised)
    }

    /// Penetration of the fit under a force, and its derivatives by t.
    fn fitted(&self, curve: &IndentationCurve, t: &[f64], force: f64) -> (f64, Vec<f64>) {
        let (mut penetration, of_model) = curve.at(force);
        let mut of_model = of_model.into_iter();
        let mut derivative = |(k, parameter): (usize, &Parameter)| {
            let unit = self.unit(parameter);
            match parameter.quantity {
                Quantity::Positive | Quantity::Number => of_model.next().unwrap_or(0.0),
                Quantity::Offset => {
                    penetration += unit * t[k];
                    unit
                }
                Quantity::FrameCompliance => {
                    penetration += unit * t[k] * force;
                    unit * force
                }
            }
        };
        let derivatives = self.parameters.iter().enumerate().map(&mut derivative).collect();
        (penetration, derivatives)
    }
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
        let (points, count) = (measured.forces().len(), parameters.len());
        if points <= count {
            return Err(IdentificationError::TooFew { points, parameters: count });
        }
        let largest = |all: &[f64]| all.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let (penetration, force) = (largest(measured.penetrations()), largest(measured.forces()));
        let units = [penetration, penetration / force];
        let (windows, last, failure) = (Vec::new(), None, None);
        let mut search = Search { model, parameters, measured, units, windows, last, failure };
        let start = vec![0.0; count];
        curve::check(&search.problem(&start, None).map_err(IdentificationError::Model)?)?;
        let found = least_squares::minimise(start, |t| search.linearised(t));
        let Some(found) = found else {
            return Err(search.failure.map_or(IdentificationError::NotConverged, IdentificationError::Curve));
        };
        // The curve of the last trial is that of a step that did not lower the sum, next to the minimum.
        let curve = search.last.take().ok_or(IdentificationError::NotConverged)?;
        let estimated = search.estimated(&found, &curve);
        // A search along what the curve does not contain has no end: that is the reason to be given.
        if !found.converged && estimated.is_ok() {
            return Err(IdentificationError::NotConverged);
        }
        estimated
    }
}

/// Parameters at the minimum, with their covariance.
struct Covariance<'a, 'b, E> {
    search: &'a Search<'b, E>,
    found: &'a Minimum,
    /// s²: the sum of squares over the degrees of freedom.
    variance: f64,
    /// (JᵀJ)⁻¹.
    inverse: Vec<Vec<f64>>,
    radii: [f64; 2],
}

impl<E: Send> Search<'_, E> {
    fn estimated(&self, found: &Minimum, curve: &IndentationCurve) -> Result<Identification, IdentificationError<E>> {
        let (residuals, jacobian) = &found.linearised;
        let count = self.parameters.len();
        let normal = least_squares::normal(jacobian);
        if let Some(k) = (0..count).find(|&k| normal[k][k] <= 1e-16 * jacobian.len() as f64) {
            return Err(IdentificationError::NoInfluence(self.parameters[k].name.clone()));
        }
        let freedom = residuals.len() - count;
        let reduced = least_squares::sum(residuals) / freedom as f64;
        // Known deviations are taken as they are, unless the fit is worse.
        let variance = if self.measured.deviations().is_some() { reduced.max(1.0) } else { reduced };
        let radii = curve.radii();
        let inverse = least_squares::inverse(&normal).ok_or_else(|| self.parallel(found, &normal, radii))?;
        let own = Covariance { search: self, found, variance, inverse, radii };
        own.determined()?;
        let penetrations = self.measured.penetrations();
        let lengths: Vec<f64> = residuals.iter().enumerate().map(|(i, r)| r * self.deviation(i)).collect();
        Ok(Identification {
            estimates: (0..count).map(|k| own.estimate(k, freedom)).collect(),
            correlation: (0..count).map(|k| (0..count).map(|other| own.correlation(k, other)).collect()).collect(),
            fitted: lengths.iter().zip(penetrations).map(|(r, measured)| measured + r).collect(),
            band: (0..residuals.len()).map(|i| own.band(i)).collect(),
            rms: (least_squares::sum(&lengths) / lengths.len() as f64).sqrt(),
            freedom,
            reduced_chi_square: self.measured.deviations().map(|_| reduced),
            model_error: curve.error(),
            radii,
            steps: found.steps,
        })
    }

    /// Length by which a residual is measured: the deviation of its point, or the largest penetration.
    fn deviation(&self, point: usize) -> f64 {
        self.measured.deviations().map_or(self.units[0], |all| all[point])
    }

    /// The refusal of two parameters that change all penetrations in proportion.
    fn parallel(&self, found: &Minimum, normal: &[Vec<f64>], radii: [f64; 2]) -> IdentificationError<E> {
        let parallel = |k: usize, other: usize| normal[k][other] / (normal[k][k] * normal[other][other]).sqrt();
        let pairs = (0..self.parameters.len()).flat_map(|k| (0..k).map(move |other| (k, other)));
        let worst = pairs.max_by(|a, b| parallel(a.0, a.1).abs().total_cmp(&parallel(b.0, b.1).abs()));
        let own = &self.parameters[worst.map_or(0, |(k, _)| k)];
        IdentificationError::Undetermined(Undetermined {
            name: own.name.clone(),
            value: own.value(found.place[worst.map_or(0, |(k, _)| k)], self.unit(own)),
            error: f64::INFINITY,
            mixed: worst.map(|(k, other)| (self.parameters[other].name.clone(), -parallel(k, other))),
            radii,
        })
    }
}

impl<E: Send> Covariance<'_, '_, E> {
    /// Standard error of t.
    fn deviation(&self, k: usize) -> f64 {
        (self.variance * self.inverse[k][k]).sqrt()
    }

    fn correlation(&self, k: usize, other: usize) -> f64 {
        self.inverse[k][other] / (self.inverse[k][k] * self.inverse[other][other]).sqrt()
    }

    /// The parameter, t, and its unit.
    fn parameter(&self, k: usize) -> (&Parameter, f64, f64) {
        let own = &self.search.parameters[k];
        (own, self.found.place[k], self.search.unit(own))
    }

    fn estimate(&self, k: usize, freedom: usize) -> Estimate {
        let ((own, t, unit), reach) = (self.parameter(k), student(freedom) * self.deviation(k));
        Estimate {
            parameter: own.clone(),
            value: own.value(t, unit),
            error: self.deviation(k) * own.slope(t, unit).abs(),
            interval: [t - reach, t + reach].map(|t| own.value(t, unit)),
        }
    }

    /// Standard error of the fitted penetration of a point, a length.
    fn band(&self, point: usize) -> f64 {
        let row = &self.found.linearised.1[point];
        let along = |k: usize| (0..row.len()).map(|other| self.inverse[k][other] * row[other]).sum::<f64>();
        let square: f64 = (0..row.len()).map(|k| row[k] * along(k)).sum();
        self.search.deviation(point) * (self.variance * square).sqrt()
    }

    /// Refuses the parameter of the largest relative error where that is beyond [`MOST_UNCERTAIN`].
    fn determined(&self) -> Result<(), IdentificationError<E>> {
        let count = self.inverse.len();
        let relative = |k: usize| match self.parameter(k).0.quantity {
            Quantity::Positive | Quantity::Number => self.deviation(k),
            // They may well be 0.
            Quantity::Offset | Quantity::FrameCompliance => 0.0,
        };
        let worst = (0..count).max_by(|&a, &b| relative(a).total_cmp(&relative(b)));
        let Some(worst) = worst.filter(|&worst| relative(worst).is_nan() || relative(worst) > MOST_UNCERTAIN) else {
            return Ok(());
        };
        let others = (0..count).filter(|&other| other != worst);
        let mixed =
            others.max_by(|&a, &b| self.correlation(worst, a).abs().total_cmp(&self.correlation(worst, b).abs()));
        let mixed = mixed.map(|other| (self.parameter(other).0.name.clone(), self.correlation(worst, other)));
        let (own, t, unit) = self.parameter(worst);
        Err(IdentificationError::Undetermined(Undetermined {
            name: own.name.clone(),
            value: own.value(t, unit),
            error: self.deviation(worst) * own.slope(t, unit).abs(),
            mixed: mixed.filter(|(_, correlation)| correlation.abs() > CORRELATED),
            radii: self.radii,
        }))
    }
}

/// Quantile 0.975 of Student's distribution, to 0.2 % (Abramowitz & Stegun 26.7.5).
fn student(freedom: usize) -> f64 {
    let z: f64 = 1.959_963_985;
    let n = freedom as f64;
    match freedom {
        1 => 12.7062,
        2 => 4.3027,
        _ => {
            let g1 = (z.powi(3) + z) / 4.0;
            let g2 = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
            let g3 = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
            let g4 =
                (79.0 * z.powi(9) + 776.0 * z.powi(7) + 1482.0 * z.powi(5) - 1920.0 * z.powi(3) - 945.0 * z) / 92160.0;
            z + g1 / n + g2 / (n * n) + g3 / n.powi(3) + g4 / n.powi(4)
        }
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

#[cfg(test)]
mod tests {
    use super::student;

    /// Abramowitz & Stegun, table 26.10.
    #[test]
    fn quantiles_of_student_are_those_of_the_table() {
        for (freedom, known) in [(1, 12.706), (2, 4.303), (3, 3.182), (5, 2.571), (10, 2.228), (30, 2.042), (120, 1.98)]
        {
            assert!((student(freedom) / known - 1.0).abs() < 2e-3, "{freedom}: {}", student(freedom));
        }
    }
}
