//! Frictionless normal contact on one grid: p ≥ 0, g = w + f − δ ≥ 0, p g = 0, with w = C p.
//!
//! It is the minimum of ½⟨p, Cp⟩ + ⟨p, f⟩ over p ≥ 0 with a given mean (load control), or of ½⟨p, Cp⟩ + ⟨p, f − δ⟩ over
//! p ≥ 0 with a given δ (displacement control). Two conjugate-gradient methods are offered,
//! `preconditioned` and `polonsky_keer`; what they return is judged by the [`certificate`] of the pressure alone.
//!
//! **Stopping.** On what is certified, with one tolerance:
//!
//! - energy gap: Σ p (g − min g) / ½⟨p, Cp⟩ < 20 tolerance (min(0, min g) under displacement control);
//! - residual: ε = Σ p|g| / (δ Σp) < tolerance;
//! - deepest penetration outside contact < 10 tolerance · δ,
//!
//! where δ is the penetration below first touch, the scale of the deformation: dimensionless, so the unit of length
//! does not matter, and as sharp at first touch as near full contact. ε is an average: a start interpolated onto a fine
//! grid errs on the few samples of the edges alone, and ε lets it pass; the energy gap does not. Under load control
//! Σ pg = 0, the gap is |min g| Σp, and ½⟨p, Cp⟩ ≤ ½ δ Σp: the first line then holds |min g|, in contact too, to the
//! third line's 10 tolerance · δ. That is where the 20 comes from.

pub mod certificate;
mod load_search;
mod polonsky_keer;
mod preconditioned;
mod stopping;

pub use certificate::Certificate;
pub use stopping::{ENERGY_GAP, PENETRATION};

use crate::field;
use crate::operator::Operator;
use serde::Serialize;
use std::fmt;
use stopping::{Check, Patience};

/// What is prescribed in a load step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Control {
    /// Mean pressure p̄ ≥ 0 over the cell.
    MeanPressure(f64),
    /// Penetration δ below first touch, a length; at most the mean of f, where contact is complete.
    Penetration(f64),
}

/// Which conjugate-gradient method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Preconditioned with C⁻¹ on the active set: iterations do not grow with the grid.
    #[default]
    Preconditioned,
    /// Polonsky & Keer, Wear 231 (1999) 206.
    PolonskyKeer,
}

/// Dimensionless tolerance and limits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// Which method starts; the preconditioned one falls back to the other when it stalls.
    pub method: Method,
    /// Bound on ε; the energy gap of a converged solution is below [`ENERGY_GAP`] times it, the deepest penetration
    /// outside contact below [`PENETRATION`] times it and δ.
    pub tolerance: f64,
    /// Largest number of iterations on one grid.
    pub max_iterations: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { method: Method::default(), tolerance: 1e-8, max_iterations: 10_000 }
    }
}

/// Why the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopReason {
    /// ε < tolerance, energy gap < 20 tolerance and penetration outside contact < 10 tolerance · δ.
    Converged,
    /// Over the last window of iterations the criteria's mean was not below 0.9 of the window's before, half as long.
    Stalled,
    /// As many iterations as allowed, tolerance not reached.
    IterationLimit,
    /// Nothing to solve: the load or the penetration is zero.
    NoContact,
    /// At the prescribed penetration at most four samples are in contact, a touching indenter (of a topography, in
    /// all): contact is no wider than the grid's spacing, and its load a matter of where the samples lie.
    Unresolved,
    /// The prescribed penetration is not below the mean of f, where contact is complete: no finite load reaches it.
    BeyondFullContact,
}

impl StopReason {
    /// Whether the returned pressure solves the problem to the tolerance.
    pub fn solved(self) -> bool {
        matches!(self, Self::Converged | Self::NoContact)
    }
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Converged => "converged",
            Self::Stalled => "stalled",
            Self::IterationLimit => "iteration limit",
            Self::NoContact => "no contact",
            Self::Unresolved => "unresolved",
            Self::BeyondFullContact => "beyond full contact",
        })
    }
}

/// How a solution was reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Why it ended.
    pub stop: StopReason,
    /// Iterations of all methods on this grid.
    pub iterations: usize,
    /// Whether the preconditioned method gave up and the baseline took over.
    pub fell_back: bool,
    /// ε = Σ p|g| / (δ Σp) of the last iterate.
    pub residual: f64,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} after {} iterations, ε = {:.1e}", self.stop, self.iterations, self.residual)?;
        if self.fell_back { write!(f, ", fell back to Polonsky–Keer") } else { Ok(()) }
    }
}

/// What a callback sees after each iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Iterations so far on this grid.
    pub iteration: usize,
    /// ε.
    pub residual: f64,
}

/// Unknowns of one grid: pressure in, pressure and gap out; all fields one value per sample.
#[derive(Debug, Clone)]
pub struct State {
    /// Pressure p.
    pub pressure: Vec<f64>,
    /// Gap g = w + f − δ of the last check.
    pub gap: Vec<f64>,
    /// Penetration δ of the last check.
    pub penetration: f64,
    direction: Vec<f64>,
    image: Vec<f64>,
    previous: Vec<f64>,
    active: Vec<bool>,
}

impl State {
    /// State with a starting pressure (one value per sample, any values; negative ones are dropped).
    pub fn new(pressure: Vec<f64>) -> Self {
        let zero = vec![0.0; pressure.len()];
        Self {
            gap: zero.clone(),
            direction: zero.clone(),
            image: zero.clone(),
            previous: zero,
            active: vec![false; pressure.len()],
            penetration: 0.0,
            pressure,
        }
    }

    /// Clips the pressure at zero and, under load control, scales it to the mean; uniform when nothing is left.
    fn admit(&mut self, control: Control) {
        field::update(&mut self.pressure, |_, p| p.max(0.0));
        let Control::MeanPressure(mean) = control else { return };
        let total = mean * self.pressure.len() as f64;
        let [sum] = field::sums(self.pressure.len(), |i| [self.pressure[i]]);
        if sum > 0.0 {
            let scale = total / sum;
            field::update(&mut self.pressure, |_, p| scale * p);
        } else {
            self.pressure.fill(mean);
        }
    }
}

/// Solves one load step on one grid, from and into `state`. `shape` is f ≥ 0, a length, one value per sample, measured
/// from first touch.
pub fn solve(
    operator: &mut Operator,
    shape: &[f64],
    control: Control,
    settings: &Settings,
    state: &mut State,
    callback: &mut dyn FnMut(Progress),
) -> Report {
    let prescribed = match control {
        Control::MeanPressure(value) | Control::Penetration(value) => value,
    };
    let done = |stop, residual| Report { stop, iterations: 0, fell_back: false, residual };
    if prescribed <= 0.0 {
        state.pressure.fill(0.0);
        state.gap.copy_from_slice(shape);
        state.penetration = prescribed.min(0.0);
        return done(StopReason::NoContact, 0.0);
    }
    match control {
        Control::MeanPressure(mean) if shape.iter().all(|f| *f == shape[0]) => {
            // A flat counterbody: complete contact at once.
            state.pressure.fill(mean);
            state.gap.fill(0.0);
            state.penetration = shape[0];
            done(StopReason::Converged, 0.0)
        }
        Control::MeanPressure(_) => iterate(operator, shape, control, settings, state, callback),
        Control::Penetration(penetration) => {
            if penetration >= field::mean(shape) {
                return done(StopReason::BeyondFullContact, f64::INFINITY);
            }
            let report = iterate(operator, shape, control, settings, state, callback);
            if report.stop != StopReason::Stalled {
                return report;
            }
            load_search::solve(operator, shape, penetration, settings, report.iterations, state, callback)
        }
    }
}

/// The method of the settings, and the baseline where it stalls.
fn iterate(
    operator: &mut Operator,
    shape: &[f64],
    control: Control,
    settings: &Settings,
    state: &mut State,
    callback: &mut dyn FnMut(Progress),
) -> Report {
    match settings.method {
        Method::PolonskyKeer => polonsky_keer::solve(operator, shape, control, settings, 0, state, callback),
        Method::Preconditioned => {
            let report = preconditioned::solve(operator, shape, control, settings, state, callback);
            if report.stop != StopReason::Stalled {
                return report;
            }
            let rest = polonsky_keer::solve(operator, shape, control, settings, report.iterations, state, callback);
            Report { fell_back: true, ..rest }
        }
    }
}
