//! The search for parameters by unloadings: residuals (S(t) − S)/σ, and their Jacobian by difference quotients.
//!
//! S(t) depends on the measured h and S too, by the contact depth, so that the deviation of a residual is
//! σ² = (1 − ∂S(t)/∂S)² σ_S² + (∂S(t)/∂h)² σ_h².

use super::contact::{Contact, Measured, UnloadingModel};
use super::record::Unloading;
use crate::identification::Instrument;
use crate::identification::error::NoValue;
use crate::identification::least_squares::{self, Linearised};
use crate::identification::parameter::{FreeParameters, Parameter, Quantity};
use crate::identification::search::{Listener, Trial};
use crate::problem::Problem;
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Step of difference quotients, in parameters whose scale is 1: its square, and rounding and the passes over ε, leave some 1e-6 of them.
const STEP: f64 = 1e-3;
/// ε from which the search for a contact begins.
const EPSILON: f64 = 0.75;

/// The unloadings in a model at t.
#[derive(Debug, Clone)]
pub(super) struct Contacts {
    pub problem: Problem,
    pub contacts: Vec<Contact>,
    /// Deviations σ of the residuals, forces per length.
    pub deviations: Vec<f64>,
}

/// A search for parameters.
pub(super) struct Search<'a, E> {
    pub model: &'a UnloadingModel<'a, E>,
    pub free: FreeParameters<'a>,
    pub unloadings: &'a [Unloading],
    trials: usize,
    is_stopped: bool,
}

impl<'a, E: Send> Search<'a, E> {
    pub fn new(model: &'a UnloadingModel<'a, E>, parameters: &'a [Parameter], unloadings: &'a [Unloading]) -> Self {
        let length = unloadings.iter().fold(0.0f64, |most, unloading| most.max(unloading.penetration.abs()));
        let force = unloadings.iter().fold(0.0f64, |most, unloading| most.max(unloading.force));
        let free = FreeParameters { all: parameters, units: [length, length / force] };
        Self { model, free, unloadings, trials: 0, is_stopped: false }
    }

    /// The problem at t.
    pub fn problem(&self, t: &[f64]) -> Result<Problem, E> {
        let values: Vec<f64> = (0..t.len()).map(|k| self.free.value(k, t[k])).collect();
        (self.model.problem)(&values)
    }

    /// The unloadings as they are measured by the instrument at t.
    pub fn measured(&self, t: &[f64]) -> Vec<Measured<'a>> {
        let at = |quantity: Quantity, known: f64| {
            let free = self.free.all.iter().position(|parameter| parameter.quantity == quantity);
            free.map_or(known, |k| self.free.value(k, t[k]))
        };
        let known = self.model.instrument;
        let instrument = Instrument {
            offset: at(Quantity::Offset, known.offset),
            frame_compliance: at(Quantity::FrameCompliance, known.frame_compliance),
        };
        let beta = self.model.beta;
        let measured = |(curve, unloading)| Measured { curve, unloading, instrument, beta };
        self.unloadings.iter().enumerate().map(measured).collect()
    }

    /// Residuals and Jacobian at t, with the contacts there; calls the listener with them.
    pub fn trial(&mut self, t: &[f64], listener: &mut Listener<'_>) -> Result<Linearised<Contacts>, NoValue<E>> {
        if self.is_stopped {
            return Err(NoValue::Stopped);
        }
        let linearised = self.linearised(t);
        self.trials += 1;
        let rms = linearised.as_ref().ok().map(|linearised| self.rms(&linearised.model.contacts));
        match listener(Trial { number: self.trials, rms, is_of_forces: false }) {
            ControlFlow::Continue(()) => linearised,
            ControlFlow::Break(()) => {
                self.is_stopped = true;
                Err(NoValue::Stopped)
            }
        }
    }

    pub fn linearised(&self, t: &[f64]) -> Result<Linearised<Contacts>, NoValue<E>> {
        if let Some(outside) = self.free.outside(t) {
            return Err(NoValue::Outside(outside));
        }
        let problem = self.problem(t).map_err(NoValue::Model)?;
        let measured = self.measured(t);
        let varied = |measured: &Measured<'_>| -> Result<(Contact, f64), NoValue<E>> {
            let contact = measured.contact(&problem, measured.values(), EPSILON)?;
            let residual = |values: [f64; 2]| -> Result<f64, NoValue<E>> {
                Ok(measured.contact(&problem, values, contact.epsilon)?.stiffness - values[1])
            };
            Ok((contact, measured.error_of(residual)?))
        };
        let (contacts, deviations): (Vec<Contact>, Vec<f64>) =
            measured.par_iter().map(varied).collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
        let columns: Vec<Vec<f64>> = (0..t.len()).map(|k| self.slopes(t, k, &contacts)).collect::<Result<_, _>>()?;
        let residual =
            |(i, contact): (usize, &Contact)| (contact.stiffness - self.unloadings[i].stiffness) / deviations[i];
        let residuals = contacts.iter().enumerate().map(residual).collect();
        let row = |i: usize| columns.iter().map(|column| column[i] / deviations[i]).collect();
        let jacobian = (0..contacts.len()).map(row).collect();
        Ok(Linearised { residuals, jacobian, model: Contacts { problem, contacts, deviations } })
    }

    /// ∂S/∂tₖ of each unloading; one-sided where one side is refused, and the error where both are.
    pub fn slopes(&self, t: &[f64], k: usize, contacts: &[Contact]) -> Result<Vec<f64>, NoValue<E>> {
        let side = |by: f64| -> Result<Vec<f64>, NoValue<E>> {
            let mut moved = t.to_vec();
            moved[k] += by;
            let problem = self.problem(&moved).map_err(NoValue::Model)?;
            let stiffness = |(measured, contact): (Measured<'_>, &Contact)| {
                let found = measured.contact(&problem, measured.values(), contact.epsilon)?;
                Ok(found.stiffness)
            };
            self.measured(&moved).into_par_iter().zip(contacts).map(stiffness).collect()
        };
        let base = || contacts.iter().map(|contact| contact.stiffness).collect();
        let (high, low, whole): (Vec<f64>, Vec<f64>, f64) = match [side(STEP), side(-STEP)] {
            [Ok(high), Ok(low)] => (high, low, 2.0 * STEP),
            [Ok(high), Err(_)] => (high, base(), STEP),
            [Err(_), Ok(low)] => (base(), low, STEP),
            [Err(error), Err(_)] => return Err(error),
        };
        Ok(high.iter().zip(low).map(|(high, low)| (high - low) / whole).collect())
    }

    /// Root mean square of the differences of P/S of model and measurement, a length.
    pub fn rms(&self, contacts: &[Contact]) -> f64 {
        let apart = |(unloading, contact): (&Unloading, &Contact)| {
            unloading.force * (1.0 / contact.stiffness - 1.0 / unloading.stiffness)
        };
        let all: Vec<f64> = self.unloadings.iter().zip(contacts).map(apart).collect();
        (least_squares::sum(&all) / all.len() as f64).sqrt()
    }
}
