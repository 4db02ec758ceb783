//! The search for parameters: residuals (δ(P; t) + δ₀ + C_f P − δ_measured)/σ of a model at values of its parameters, and their
//! Jacobian, of which [`least_squares`] finds the minimum.

use super::Measurement;
use super::curve::{IndentationCurve, Perturbed};
use super::error::NoValue;
use super::least_squares::{self, Linearised};
use super::parameter::{FreeParameters, Parameter, Quantity};
use crate::problem::Problem;
use crate::spectral::Settings;
use std::fmt;
use std::ops::ControlFlow;

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

/// Progress of a search: a trial of values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// Number of the trial, from 1.
    pub number: usize,
    /// Root mean square of measured minus computed penetrations, a length, or forces; `None` where the model has no value.
    pub rms: Option<f64>,
    /// Whether forces are compared.
    pub is_of_forces: bool,
}

/// Called with each trial of a search; `Break` ends it.
pub type Listener<'a> = dyn FnMut(Trial) -> ControlFlow<()> + 'a;

/// A search for parameters.
pub(super) struct Search<'a, E> {
    pub(super) model: &'a Model<'a, E>,
    pub(super) free: FreeParameters<'a>,
    pub(super) measured: &'a Measurement,
    /// Windows of the last curve; empty before the first.
    pub(super) windows: Vec<f64>,
    trials: usize,
    is_stopped: bool,
}

impl<'a, E: Send> Search<'a, E> {
    pub(super) fn new(model: &'a Model<'a, E>, parameters: &'a [Parameter], measured: &'a Measurement) -> Self {
        let largest = |all: &[f64]| all.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let (penetration, force) = (largest(measured.penetrations()), largest(measured.forces()));
        let free = FreeParameters { all: parameters, units: [penetration, penetration / force] };
        Self { model, free, measured, windows: Vec::new(), trials: 0, is_stopped: false }
    }

    /// The problem at t, of which the entry `moved` is changed by a step.
    pub(super) fn problem(&self, t: &[f64], moved: Option<(usize, f64)>) -> Result<Problem, E> {
        let at = |k: usize| {
            let by = moved.filter(|(entry, _)| *entry == k).map_or(0.0, |(_, by)| by);
            self.free.value(k, t[k] + by)
        };
        let values: Vec<f64> = (0..t.len()).map(at).collect();
        (self.model.problem)(&values)
    }

    /// The problem at t, and its difference quotients; one-sided where values on one side are refused, and the error where those on both are.
    fn perturbed(&self, t: &[f64]) -> Result<Perturbed, E> {
        let problem = self.problem(t, None)?;
        let quotient = |k: usize| {
            let sides = match [STEP, -STEP].map(|by| self.problem(t, Some((k, by))).map(|changed| (by, changed))) {
                [Err(error), Err(_)] => return Err(error),
                sides => sides.map(Result::ok),
            };
            let whole = match &sides {
                [Some(_), Some(_)] => 2.0 * STEP,
                _ => STEP,
            };
            let mut parts: Vec<(f64, Problem)> =
                sides.into_iter().flatten().map(|(by, changed)| (by.signum() / whole, changed)).collect();
            if let [(weight, _)] = parts[..] {
                parts.push((-weight, problem.clone()));
            }
            Ok(parts)
        };
        let of_model = (0..t.len()).filter(|&k| self.free.all[k].is_of_model());
        let quotients = of_model.map(quotient).collect::<Result<_, _>>()?;
        Ok(Perturbed { problem, quotients })
    }

    /// Residuals and Jacobian at t, with the curve there; calls the listener with them.
    pub(super) fn trial(
        &mut self,
        t: &[f64],
        listener: &mut Listener<'_>,
    ) -> Result<Linearised<IndentationCurve>, NoValue<E>> {
        if self.is_stopped {
            return Err(NoValue::Stopped);
        }
        let linearised = self.linearised(t);
        self.trials += 1;
        let rms = linearised.as_ref().ok().map(|linearised| self.rms(&linearised.residuals));
        match listener(Trial { number: self.trials, rms, is_of_forces: false }) {
            ControlFlow::Continue(()) => linearised,
            ControlFlow::Break(()) => {
                self.is_stopped = true;
                Err(NoValue::Stopped)
            }
        }
    }

    pub(super) fn linearised(&mut self, t: &[f64]) -> Result<Linearised<IndentationCurve>, NoValue<E>> {
        if let Some(outside) = self.free.outside(t) {
            return Err(NoValue::Outside(outside));
        }
        let perturbed = self.perturbed(t).map_err(NoValue::Model)?;
        let forces = self.measured.forces();
        let range = [forces.iter().copied().fold(f64::INFINITY, f64::min), forces.iter().copied().fold(0.0, f64::max)];
        let Model { points, settings, .. } = *self.model;
        // Windows of contacts that are not solved are no start for others.
        let mut windows = self.windows.clone();
        let model = IndentationCurve::new(&perturbed, range, points, settings, &mut windows)?;
        self.windows = windows;
        let rows = (0..forces.len()).map(|i| {
            let (fitted, derivatives) = self.fitted(&model, t, i);
            let deviation = self.deviation(i);
            let added = self.measured.instrument().adds(forces[i]);
            let residual = (fitted + added - self.measured.penetrations()[i]) / deviation;
            (residual, derivatives.into_iter().map(|derivative| derivative / deviation).collect())
        });
        let (residuals, jacobian) = rows.unzip();
        Ok(Linearised { residuals, jacobian, model })
    }

    /// Penetration of the fit at a point, and its derivatives by t.
    fn fitted(&self, curve: &IndentationCurve, t: &[f64], point: usize) -> (f64, Vec<f64>) {
        let force = self.measured.forces()[point];
        let (mut penetration, of_model) = curve.at(force);
        let mut of_model = of_model.into_iter();
        let mut derivative = |k: usize| {
            let part = match self.free.all[k].quantity {
                Quantity::Positive | Quantity::Bounded(_) => return of_model.next().unwrap_or(0.0),
                Quantity::Offset => 1.0,
                Quantity::OffsetOf(curve) => f64::from(u8::from(curve == self.measured.curve_of(point))),
                Quantity::FrameCompliance => force,
            };
            penetration += self.free.value(k, t[k]) * part;
            self.free.slope(k, t[k]) * part
        };
        let derivatives = (0..t.len()).map(&mut derivative).collect();
        (penetration, derivatives)
    }

    /// Fitted minus measured penetrations of residuals, lengths.
    pub(super) fn lengths(&self, residuals: &[f64]) -> Vec<f64> {
        residuals.iter().enumerate().map(|(i, r)| r * self.deviation(i)).collect()
    }

    /// Root mean square of measured minus fitted penetrations, a length.
    pub(super) fn rms(&self, residuals: &[f64]) -> f64 {
        (least_squares::sum(&self.lengths(residuals)) / residuals.len() as f64).sqrt()
    }

    /// Length by which a residual is measured: the deviation of its point, or the largest penetration.
    pub(super) fn deviation(&self, point: usize) -> f64 {
        self.measured.deviations().map_or(self.free.units[0], |all| all[point])
    }
}
