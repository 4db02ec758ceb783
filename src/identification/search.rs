//! The search for parameters: residuals (δ(P; t) + δ₀ + C_f P − δ_measured)/σ of a model at values of its parameters, and their
//! Jacobian, of which [`least_squares`] finds the minimum.

use super::Measurement;
use super::curve::{CurveError, IndentationCurve, Perturbed};
use super::least_squares::Linearised;
use super::parameter::{FreeParameters, Parameter, Quantity};
use crate::problem::Problem;
use crate::spectral::Settings;
use std::fmt;

/// Step of difference quotients, in parameters whose scale is 1.
const STEP: f64 = 2e-3;

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

/// A search for parameters.
pub(super) struct Search<'a, E> {
    model: &'a Model<'a, E>,
    pub(super) free: FreeParameters<'a>,
    measured: &'a Measurement,
    windows: Vec<f64>,
    pub(super) last: Option<IndentationCurve>,
    pub(super) failure: Option<CurveError>,
}

impl<'a, E: Send> Search<'a, E> {
    pub(super) fn new(model: &'a Model<'a, E>, parameters: &'a [Parameter], measured: &'a Measurement) -> Self {
        let largest = |all: &[f64]| all.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let (penetration, force) = (largest(measured.penetrations()), largest(measured.forces()));
        let free = FreeParameters { all: parameters, units: [penetration, penetration / force] };
        Self { model, free, measured, windows: Vec::new(), last: None, failure: None }
    }

    /// The problem at t, of which the entry `moved` is changed by a step.
    pub(super) fn problem(&self, t: &[f64], moved: Option<(usize, f64)>) -> Result<Problem, E> {
        let at = |k: usize| {
            let by = moved.filter(|(own, _)| *own == k).map_or(0.0, |(_, by)| by);
            self.free.value(k, t[k] + by)
        };
        let values: Vec<f64> = (0..t.len()).map(at).collect();
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
        let of_model = (0..t.len()).filter(|&k| self.free.all[k].is_of_model());
        let quotients = of_model.map(quotient).collect();
        Ok(Perturbed { problem, quotients })
    }

    /// Residuals and Jacobian at t; `None` where the model refuses the values.
    pub(super) fn linearised(&mut self, t: &[f64]) -> Option<Linearised> {
        if self.free.is_too_far(t) {
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
        let mut derivative = |k: usize| {
            let part = match self.free.all[k].quantity {
                Quantity::Positive | Quantity::Number => return of_model.next().unwrap_or(0.0),
                Quantity::Offset => 1.0,
                Quantity::FrameCompliance => force,
            };
            penetration += self.free.value(k, t[k]) * part;
            self.free.slope(k, t[k]) * part
        };
        let derivatives = (0..t.len()).map(&mut derivative).collect();
        (penetration, derivatives)
    }

    /// Length by which a residual is measured: the deviation of its point, or the largest penetration.
    pub(super) fn deviation(&self, point: usize) -> f64 {
        self.measured.deviations().map_or(self.free.units[0], |all| all[point])
    }
}
