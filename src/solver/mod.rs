//! Frictionless normal contact on one grid: p ≥ 0, g = w + f − δ ≥ 0, p g = 0, with w = C p.
//!
//! It is the minimum of ½⟨p, Cp⟩ + ⟨p, f⟩ over p ≥ 0 with a given mean (load control), or of ½⟨p, Cp⟩ + ⟨p, f − δ⟩ over
//! p ≥ 0 with a given δ (displacement control). Two conjugate-gradient methods are offered,
//! `preconditioned` and `polonsky_keer`; what they return is judged by the [`certificate`] of the pressure alone.
//!
//! **Stopping.** ε = Σ p|g| / (δ Σp) < tolerance and the deepest penetration outside contact < 10 tolerance · δ, where
//! δ is the penetration below first touch, the scale of the deformation: dimensionless, so the unit of length does not
//! matter, and as sharp at first touch as near full contact.

pub mod certificate;
mod load_search;
mod polonsky_keer;
mod preconditioned;

pub use certificate::Certificate;

use crate::field;
use crate::operator::Operator;
use serde::Serialize;
use std::fmt;

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
    /// Tolerance on ε.
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
    /// ε < tolerance and penetration outside contact < 10 tolerance · δ.
    Converged,
    /// ε has not fallen below 0.9 of its best value for as many iterations as the method is granted.
    Stalled,
    /// As many iterations as allowed, tolerance not reached.
    IterationLimit,
    /// Nothing to solve: the load or the penetration is zero.
    NoContact,
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

/// How the iterate stands, from one convolution.
#[derive(Debug, Clone, Copy)]
struct Check {
    residual: f64,
    /// Deepest penetration outside contact over δ, ≥ 0.
    deepest: f64,
}

/// How many iterations without progress are granted, and when ε counts as progress.
struct Patience {
    granted: usize,
    best: f64,
    since: usize,
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

    /// Gap, penetration and residual of the present pressure: one convolution.
    fn check(&mut self, operator: &mut Operator, shape: &[f64], control: Control) -> Check {
        operator.displacement(&self.pressure, &mut self.gap);
        let p = &self.pressure;
        field::update(&mut self.gap, |i, w| w + shape[i]);
        let len = p.len();
        let [load, work] = field::sums(len, |i| [p[i], p[i] * self.gap[i]]);
        self.penetration = match control {
            Control::MeanPressure(_) => work / load,
            Control::Penetration(penetration) => penetration,
        };
        let penetration = self.penetration;
        field::update(&mut self.gap, |_, g| g - penetration);
        let g = &self.gap;
        let [complementarity] = field::sums(len, |i| [p[i] * g[i].abs()]);
        let deepest = -field::least(len, |i| if p[i] > 0.0 { 0.0 } else { g[i] });
        Check {
            // Without any pressure the constraint g ≥ 0 alone decides.
            residual: if load > 0.0 { complementarity / (load * penetration) } else { 0.0 },
            deepest: deepest / penetration,
        }
    }
}

impl Check {
    /// Why the iteration has to end here, if it has to.
    fn stop(&self, settings: &Settings, patience: &mut Patience, iterations: usize) -> Option<StopReason> {
        if self.residual < settings.tolerance && self.deepest < 10.0 * settings.tolerance {
            Some(StopReason::Converged)
        } else if patience.ends(self.measure()) {
            Some(StopReason::Stalled)
        } else {
            (iterations >= settings.max_iterations).then_some(StopReason::IterationLimit)
        }
    }

    /// One number that falls as both criteria do.
    fn measure(&self) -> f64 {
        self.residual.max(0.1 * self.deepest)
    }
}

impl Patience {
    fn new(granted: usize) -> Self {
        Self { granted, best: f64::INFINITY, since: 0 }
    }

    /// Notes a new measure; true when patience is at its end.
    fn ends(&mut self, measure: f64) -> bool {
        if measure < 0.9 * self.best {
            (self.best, self.since) = (measure, 0);
        } else {
            self.since += 1;
        }
        self.since > self.granted
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
