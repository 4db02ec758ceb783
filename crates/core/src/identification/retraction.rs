//! Parameters from the curve of drawing off surfaces that adhere: forces P at penetrations δ, from the largest penetration to the least force.
//!
//! The model is the path of a rigid grip in the window of the problem, P(δ) at a few penetrations, between which it is interpolated. Residuals are
//! forces, and their Jacobian by difference quotients: at pull-off the force does not change with the penetration, and a penetration under a force
//! is not known. A zero that was missed by δ₀ and a frame of the compliance C_f shift the penetration of a point, δ = h − δ₀ − C_f P.

use super::Instrument;
use super::covariance::{Covariance, MOST_UNCERTAIN};
use super::curve::CurveError;
use super::error::{IdentificationError, NoValue};
use super::estimate::{Estimate, at_minimum, estimates};
use super::least_squares::{self, Linearised, Minimum};
use super::parameter::{FreeParameters, Parameter, Quantity};
use super::pattern::Pattern;
use super::search::{Listener, Model, Trial};
use crate::load::Load;
use crate::numeric::limited_cubic::slopes;
use crate::problem::Problem;
use crate::spectral::{AdhesiveNumbers, AdhesiveSolver, zone_law};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::fmt;
use std::ops::ControlFlow;

/// Step of difference quotients, in parameters whose scale is 1: forces step where samples join the contact, some 1e-4 of them.
const STEP: f64 = 2e-2;
/// Penetrations at which a path is solved, and the part of their range by which they reach beyond those that are measured.
const NODES: usize = 16;
const BEYOND: f64 = 0.04;
/// Fewest points of a curve.
const FEWEST: usize = 4;

/// Forces at the measured points with the path that they are of.
type Followed<E> = Result<(Vec<f64>, Path), NoValue<E>>;

/// A measured curve of drawing off: penetrations that fall, and forces.
#[derive(Debug, Clone, PartialEq)]
pub struct Retraction {
    forces: Vec<f64>,
    penetrations: Vec<f64>,
}

/// Why points are no curve of drawing off.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RetractionError {
    /// Other numbers of forces and penetrations.
    #[error("{0} forces, but {1} penetrations")]
    Unequal(usize, usize),
    /// A value that is not finite, at this index.
    #[error("point {}: force and penetration must be finite", .0 + 1)]
    NotFinite(usize),
    /// No force below 0.
    #[error("no force is below 0: nothing adheres, or the sign of the force is turned round")]
    NoTension,
    /// Too few points between the largest penetration and the least force.
    #[error(
        "{0} points lie between the largest penetration and the least force, and {FEWEST} are needed: take all points of drawing off"
    )]
    Few(usize),
}

impl Retraction {
    /// The points from the largest penetration to the least force, in the order in which they were measured; others are left out.
    ///
    /// # Errors
    /// [`RetractionError`].
    pub fn new(forces: &[f64], penetrations: &[f64]) -> Result<Self, RetractionError> {
        if forces.len() != penetrations.len() {
            return Err(RetractionError::Unequal(forces.len(), penetrations.len()));
        }
        let is_finite = |k: &usize| forces[*k].is_finite() && penetrations[*k].is_finite();
        if let Some(index) = (0..forces.len()).find(|k| !is_finite(k)) {
            return Err(RetractionError::NotFinite(index));
        }
        let least = (0..forces.len()).min_by(|a, b| forces[*a].total_cmp(&forces[*b]));
        let Some(least) = least.filter(|k| forces[*k] < 0.0) else { return Err(RetractionError::NoTension) };
        // The last of the largest penetrations before the least force: a hold comes before it.
        let deepest = penetrations[..=least].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let first = (0..=least).rev().find(|k| penetrations[*k] >= deepest).unwrap_or(0);
        let count = least + 1 - first;
        if count < FEWEST {
            return Err(RetractionError::Few(count));
        }
        Ok(Self { forces: forces[first..=least].to_vec(), penetrations: penetrations[first..=least].to_vec() })
    }

    /// Forces, a pressure times a length squared.
    pub fn forces(&self) -> &[f64] {
        &self.forces
    }

    /// Penetrations, lengths.
    pub fn penetrations(&self) -> &[f64] {
        &self.penetrations
    }
}

/// Parameters found by a curve of drawing off.
#[derive(Debug, Clone, PartialEq)]
pub struct FromRetraction {
    /// The parameters.
    pub estimates: Vec<Estimate>,
    /// Correlation of each two.
    pub correlation: Vec<Vec<f64>>,
    /// Force of the fit at each point.
    pub fitted: Vec<f64>,
    /// Standard error of each fitted force by the errors of the parameters alone.
    pub band: Vec<f64>,
    /// Root mean square of measured minus fitted forces.
    pub rms: f64,
    /// Points less parameters.
    pub freedom: usize,
    /// Least force of the fitted path.
    pub pull_off: f64,
    /// Estimated relative error of the pull-off by the grid.
    pub model_error: f64,
    /// Contact radii of the fit at the least and the largest penetration, lengths.
    pub radii: [f64; 2],
    /// Runs of one sign of the residuals, where they are no scatter.
    pub pattern: Option<Pattern>,
    /// Steps of the search.
    pub steps: usize,
}

/// The path of a model: penetrations that rise, forces, and contact radii at both ends.
#[derive(Debug, Clone)]
struct Path {
    penetrations: Vec<f64>,
    forces: Vec<f64>,
    slopes: Vec<f64>,
    radii: [f64; 2],
    model_error: f64,
}

impl Path {
    /// The path between two penetrations, which is followed from the largest on.
    fn new(problem: &Problem, [least, most]: [f64; 2], model: &Model<'_, impl Sized>) -> Result<Self, CurveError> {
        let mut solver = AdhesiveSolver::new(problem.clone(), [model.points; 2], model.settings)?;
        let reach = BEYOND * (most - least);
        let (from, length) = (most + reach, most - least + 2.0 * reach);
        // In contact first, from where the path goes on.
        let touching = from.max(reach);
        let mut nodes = Vec::with_capacity(NODES);
        if touching > from {
            follow(&mut solver, touching)?;
        }
        for k in 0..NODES {
            let place = from - length * k as f64 / (NODES - 1) as f64;
            let numbers = follow(&mut solver, place)?;
            nodes.push((place, numbers.force, (numbers.contact_area / PI).sqrt()));
        }
        nodes.reverse();
        let radii = [nodes[0].2, nodes[NODES - 1].2];
        let (penetrations, forces): (Vec<f64>, Vec<f64>) = nodes.iter().map(|node| (node.0, node.1)).unzip();
        let slopes = slopes(&penetrations, &forces);
        Ok(Self { slopes, penetrations, forces, radii, model_error: zone_law(solver.samples_across()) })
    }

    /// Force at a penetration, by cubics between the nodes.
    fn at(&self, penetration: f64) -> f64 {
        let k = self.penetrations.partition_point(|place| *place <= penetration).clamp(1, NODES - 1) - 1;
        let width = self.penetrations[k + 1] - self.penetrations[k];
        let t = (penetration - self.penetrations[k]) / width;
        let [a, b] = [self.forces[k], self.forces[k + 1]];
        let [c, d] = [self.slopes[k] * width, self.slopes[k + 1] * width];
        a + t * (c + t * (3.0 * (b - a) - 2.0 * c - d + t * (2.0 * (a - b) + c + d)))
    }

    /// Least force of the nodes and of the places between them.
    fn least(&self) -> f64 {
        let [first, last] = [self.penetrations[0], self.penetrations[NODES - 1]];
        let count = 20 * NODES;
        (0..=count).map(|k| self.at(first + (last - first) * k as f64 / count as f64)).fold(f64::INFINITY, f64::min)
    }
}

/// The next state of a path, at a penetration.
fn follow(solver: &mut AdhesiveSolver, penetration: f64) -> Result<AdhesiveNumbers, CurveError> {
    solver.follow(Load::Penetration(penetration)).map_err(|stop| CurveError::NotFollowed(penetration, stop))
}

/// A search for parameters.
struct Search<'a, E> {
    model: &'a Model<'a, E>,
    free: FreeParameters<'a>,
    measured: &'a Retraction,
    instrument: Instrument,
    /// Unit of the residuals: the largest force.
    unit: f64,
    trials: usize,
}

impl<E: Send> Search<'_, E> {
    /// The instrument at t.
    fn instrument(&self, t: &[f64]) -> Instrument {
        let at = |quantity: Quantity, known: f64| {
            let free = self.free.all.iter().position(|parameter| parameter.quantity == quantity);
            free.map_or(known, |k| self.free.value(k, t[k]))
        };
        Instrument {
            offset: at(Quantity::Offset, self.instrument.offset),
            frame_compliance: at(Quantity::FrameCompliance, self.instrument.frame_compliance),
        }
    }

    /// Forces of the model at t at the measured points, and its path.
    fn forces(&self, t: &[f64]) -> Followed<E> {
        let values: Vec<f64> = (0..t.len()).map(|k| self.free.value(k, t[k])).collect();
        let problem = (self.model.problem)(&values).map_err(NoValue::Model)?;
        let instrument = self.instrument(t);
        let points = self.measured.penetrations.iter().zip(&self.measured.forces);
        let places: Vec<f64> = points.map(|(h, force)| h - instrument.adds(*force)).collect();
        let range = [f64::min, f64::max].map(|of| places.iter().copied().reduce(of).unwrap_or(0.0));
        let path = Path::new(&problem, range, self.model)?;
        Ok((places.iter().map(|place| path.at(*place)).collect(), path))
    }

    /// Residuals and Jacobian at t, with the path there; calls the listener with them.
    fn trial(&mut self, t: &[f64], listener: &mut Listener<'_>) -> Result<Linearised<Path>, NoValue<E>> {
        if let Some(outside) = self.free.outside(t) {
            return Err(NoValue::Outside(outside));
        }
        // The model at t, and on both sides of each parameter.
        let places: Vec<Vec<f64>> = std::iter::once(t.to_vec())
            .chain((0..2 * t.len()).map(|side| {
                let mut moved = t.to_vec();
                moved[side / 2] += if side % 2 == 0 { STEP } else { -STEP };
                moved
            }))
            .collect();
        let all: Vec<Followed<E>> =
            if t.is_empty() { Vec::new() } else { places.par_iter().map(|place| self.forces(place)).collect() };
        let mut all = all.into_iter();
        let (forces, path) = all.next().ok_or(NoValue::Stopped)??;
        let sides: Vec<Option<Vec<f64>>> = all.map(|side| side.ok().map(|(forces, _)| forces)).collect();
        let measured = &self.measured.forces;
        let residuals: Vec<f64> =
            forces.iter().zip(measured).map(|(found, force)| (found - force) / self.unit).collect();
        let slope = |k: usize, i: usize| match (&sides[2 * k], &sides[2 * k + 1]) {
            (Some(high), Some(low)) => (high[i] - low[i]) / (2.0 * STEP),
            (Some(high), None) => (high[i] - forces[i]) / STEP,
            (None, Some(low)) => (forces[i] - low[i]) / STEP,
            (None, None) => 0.0,
        };
        let row = |i: usize| (0..t.len()).map(|k| slope(k, i) / self.unit).collect();
        let jacobian = (0..measured.len()).map(row).collect();
        self.trials += 1;
        let rms = Some(self.unit * (least_squares::sum(&residuals) / residuals.len() as f64).sqrt());
        match listener(Trial { number: self.trials, rms, is_of_forces: true }) {
            ControlFlow::Continue(()) => Ok(Linearised { residuals, jacobian, model: path }),
            ControlFlow::Break(()) => Err(NoValue::Stopped),
        }
    }
}

impl FromRetraction {
    /// Finds the parameters of a model from a curve of drawing off that an instrument has measured, by least squares from their starts. Calls
    /// `progress` after each trial of values; `Break` ends the search.
    ///
    /// # Errors
    /// [`IdentificationError`].
    pub fn new<E: Send + fmt::Display>(
        model: &Model<'_, E>,
        parameters: &[Parameter],
        (measured, instrument): (&Retraction, Instrument),
        progress: &mut Listener<'_>,
    ) -> Result<Self, IdentificationError<E>> {
        let (points, count) = (measured.forces.len(), parameters.len());
        if points <= count {
            return Err(IdentificationError::TooFew { points, parameters: count });
        }
        let largest = |all: &[f64]| all.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
        let (unit, length) = (largest(&measured.forces), largest(&measured.penetrations));
        let free = FreeParameters { all: parameters, units: [length, length / unit] };
        let mut search = Search { model, free, measured, instrument, unit, trials: 0 };
        let start = vec![0.0; count];
        let values: Vec<f64> = (0..count).map(|k| free.value(k, 0.0)).collect();
        let problem = (model.problem)(&values).map_err(IdentificationError::Model)?;
        problem.lone_indenter().ok_or(CurveError::NotAlone)?;
        problem.adhesion().ok_or(CurveError::NoAdhesion)?;
        let found = least_squares::minimise(start, |t| search.trial(t, progress)).map_err(NoValue::at_the_start)?;
        at_minimum(found, |found| Self::at(&search, found))
    }

    /// Values and standard errors at the minimum that a search has found.
    fn at<E: Send>(search: &Search<'_, E>, found: &Minimum<Path, NoValue<E>>) -> Result<Self, IdentificationError<E>> {
        let Linearised { residuals, jacobian, model: path } = &found.linearised;
        let freedom = residuals.len() - found.place.len();
        let variance = least_squares::sum(residuals) / freedom as f64;
        let covariance = Covariance::new(search.free, (&found.place, jacobian), variance, path.radii, MOST_UNCERTAIN)?;
        let pattern = Pattern::of(residuals);
        let is_beyond = variance.sqrt() > path.model_error;
        Ok(Self {
            estimates: estimates(search.free, &found.place, &covariance, freedom),
            correlation: covariance.correlations(),
            fitted: residuals.iter().zip(&search.measured.forces).map(|(r, force)| force + r * search.unit).collect(),
            band: jacobian.iter().map(|row| search.unit * covariance.along(row)).collect(),
            rms: search.unit * (least_squares::sum(residuals) / residuals.len() as f64).sqrt(),
            freedom,
            pull_off: path.least(),
            model_error: path.model_error,
            radii: path.radii,
            pattern: (pattern.is_systematic() && is_beyond).then_some(pattern),
            steps: found.steps,
        })
    }
}
