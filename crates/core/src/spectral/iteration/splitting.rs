//! Contact under a strong skew part: Douglas–Rachford splitting in the metric M = |A|, with guarded trials of an active set.
//!
//! p ≥ 0 with its load solves the variational inequality ⟨Ap + f, s − p⟩ ≥ 0 for all such s. The symmetric part C of A is positive, so that the
//! problem is strongly monotone and has one solution; there is no energy. On a state z:
//!
//! ```text
//! y = argmin ½⟨p − z, M(p − z)⟩ over the admissible p       an ordinary contact of the operator M and the gap −Mz
//! x = (A + M)⁻¹ (M(2y − z) − f), of the same mean              wave by wave
//! z ← z + x − y
//! ```
//!
//! (J. Douglas & H. Rachford, Trans. AMS 82 (1956) 421; P.-L. Lions & B. Mercier, SIAM J. Numer. Anal. 16 (1979) 964) converges from any z: the
//! reflection of x contracts by tan(φ/2), φ the largest phase of A. Forward–backward splitting, of which the iteration with a lagged
//! traction is one, contracts by sin φ and stands still where |Im A| is many times Re A.
//!
//! **Trials.** Close to the solution the samples in contact are nearly known. I = {p > 0} ∪ {g < 0}; on I the gap is made uniform by a linear
//! solve ([`SampleSet`]), what becomes negative is cut, and I is taken anew: a Newton iteration, which may cycle. A trial is kept only if it
//! converges; where coupling is so strong that trials cycle none is made.

use super::check::ConvergenceCheck;
use super::fields::Unknowns;
use super::problem::{ContactProblem, Method, Settings};
use super::report::{Progress, Report, Route, Stop};
use super::set_system::{Invertible, SampleSet};
use super::stopping::StallDetector;
use crate::load::Control;
use crate::numeric::sums;
use crate::spectral::operator::{ElasticOperator, SkewParts, Workspace};
use std::ops::ControlFlow;
use std::sync::Arc;

/// Largest coupling at which trials are made.
const MAX_TRIAL_COUPLING: f64 = 8.0;
/// Criteria below which the first trial is made, and their part below which the next one is.
const FIRST_TRIAL: f64 = 1e-3;
const NEXT_TRIAL: f64 = 0.1;
/// Most sets of a trial.
const MAX_SETS: usize = 10;
/// Part to which the linear solve on a set reduces its residual.
const ON_SET: f64 = 0.1;
/// Criteria of the inner contact over those of the last y.
const INNER: f64 = 0.1;
/// First window of the stall detector, outer iterations.
const FIRST_WINDOW: usize = 40;
/// Tolerance of the contact from which a search for the load begins.
const START: f64 = 1e-2;

/// A and A⁻¹ of the operator of a problem.
struct Whole<'a, O> {
    operator: &'a mut O,
    workspace: &'a mut Workspace,
}

impl<O: ElasticOperator> Invertible for Whole<'_, O> {
    fn apply(&mut self, field: &mut [f64]) {
        self.operator.displace(field, self.workspace);
    }

    fn invert(&mut self, field: &mut [f64]) {
        self.operator.whole_pressure(field, self.workspace);
    }
}

/// Iterates from and into `unknowns`; `iterations` are those before. `None` for an operator without its parts. Under a given penetration it
/// [starts](start) alone, and stalls: the rest is a search for the load.
pub(super) fn solve<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    iterations: usize,
    unknowns: &mut Unknowns,
) -> Option<Report> {
    problem.operator.resolvent()?;
    let Control::MeanPressure(mean) = problem.load else {
        let iterations = iterations + start(problem, unknowns);
        return Some(Report::new(Stop::Stalled, Route::Splitting, iterations, f64::INFINITY));
    };
    let end = |stop, iterations, residual| Some(Report::new(stop, Route::Splitting, iterations, residual));
    let (tolerance, most) = (problem.settings.tolerance, problem.settings.max_iterations);
    let mut splitting = Splitting { mean, iterations, next_trial: FIRST_TRIAL };
    unknowns.admit(problem.load, problem.admissible);
    let mut check = whole_check(problem, unknowns);
    let mut stall = StallDetector::new(FIRST_WINDOW);
    let mut state: Option<Vec<f64>> = None;
    loop {
        if check.converged(tolerance) {
            return end(Stop::Converged, splitting.iterations, check.residual);
        }
        if let Some(found) = splitting.tried(problem, unknowns, check) {
            return end(Stop::Converged, splitting.iterations, found.residual);
        }
        let is_stalled = stall.detected(check.measure());
        if splitting.iterations >= most || is_stalled {
            let stop = if is_stalled { Stop::Stalled } else { Stop::IterationLimit };
            return end(stop, splitting.iterations, check.residual);
        }
        let z = match state.take() {
            None => splitting.start(problem, unknowns),
            Some(z) => splitting.next(problem, z, &unknowns.pressure),
        };
        let stop = splitting.nearest(problem, &z, check, unknowns);
        state = Some(z);
        check = whole_check(problem, unknowns);
        if stop == Stop::Interrupted || splitting.is_cut(problem, check) {
            return end(Stop::Interrupted, splitting.iterations, check.residual);
        }
    }
}

/// Convergence check by the gap of the whole operator, which is counted.
fn whole_check<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> ConvergenceCheck {
    problem.outer += 1;
    ConvergenceCheck::new(problem, unknowns)
}

/// The pressure of the magnitude M under a given penetration, where there is none to begin from; its iterations.
fn start<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> usize {
    if unknowns.pressure.iter().any(|p| *p > 0.0) {
        return 0;
    }
    let ContactProblem { working, initial_gap, largest_gap, admissible, load, settings, .. } = problem;
    let Some(parts) = problem.operator.resolvent() else { return 0 };
    ContactProblem {
        operator: parts.magnitude(),
        working,
        initial_gap,
        largest_gap: *largest_gap,
        admissible: *admissible,
        load: *load,
        settings: Settings { tolerance: START, ..*settings },
        outer: 0,
        progress: &mut |_| ControlFlow::Continue(()),
    }
    .solve(unknowns)
    .iterations
}

/// The iteration under a mean pressure.
struct Splitting {
    mean: f64,
    iterations: usize,
    next_trial: f64,
}

impl Splitting {
    /// z = p − M⁻¹(g − δ), of the mean of p: where p is the solution, y is p.
    fn start<O: ElasticOperator>(&self, problem: &mut ContactProblem<'_, O>, unknowns: &Unknowns) -> Vec<f64> {
        let mut z = unknowns.gap.to_vec();
        let workspace = &mut problem.working.transforms;
        if let Some(parts) = problem.operator.resolvent() {
            parts.magnitude().symmetric_pressure(&mut z, workspace);
        }
        sums::update(&mut z, |i, z| unknowns.pressure[i] - z);
        self.of_mean(z)
    }

    /// z + x − y with x = (A + M)⁻¹ (M(2y − z) − f).
    fn next<O: ElasticOperator>(&self, problem: &mut ContactProblem<'_, O>, mut z: Vec<f64>, y: &[f64]) -> Vec<f64> {
        let mut x = z.clone();
        sums::update(&mut x, |i, z| 2.0 * y[i] - z);
        let (f, workspace) = (problem.initial_gap, &mut problem.working.transforms);
        if let Some(parts) = problem.operator.resolvent() {
            parts.magnitude().displace(&mut x, workspace);
            sums::update(&mut x, |i, w| w - f[i]);
            parts.resolve(&mut x, workspace);
        }
        let x = self.of_mean(x);
        sums::update(&mut z, |i, z| z + x[i] - y[i]);
        z
    }

    /// A field with the mean of the pressure.
    fn of_mean(&self, mut field: Vec<f64>) -> Vec<f64> {
        let excess = sums::mean(&field) - self.mean;
        sums::update(&mut field, |_, x| x - excess);
        field
    }

    /// The admissible pressure nearest to z in the metric, from and into that of `unknowns`.
    fn nearest<O: ElasticOperator>(
        &mut self,
        problem: &mut ContactProblem<'_, O>,
        z: &[f64],
        check: ConvergenceCheck,
        unknowns: &mut Unknowns,
    ) -> Stop {
        let ContactProblem { working, admissible, load, settings, .. } = problem;
        let Some(parts) = problem.operator.resolvent() else { return Stop::Stalled };
        let mut gap = z.to_vec();
        parts.magnitude().displace(&mut gap, &mut working.transforms);
        let largest = -sums::least(gap.len(), |i| -gap[i]);
        sums::update(&mut gap, |_, w| largest - w);
        let report = ContactProblem {
            operator: parts.magnitude(),
            working,
            largest_gap: -sums::least(gap.len(), |i| -gap[i]),
            initial_gap: &gap,
            admissible: *admissible,
            load: *load,
            settings: Settings {
                method: Method::Preconditioned,
                tolerance: INNER * check.measure().clamp(settings.tolerance, 1.0),
                ..*settings
            },
            outer: 0,
            progress: &mut |_| ControlFlow::Continue(()),
        }
        .solve(unknowns);
        self.iterations += report.iterations;
        report.stop
    }

    /// Tries to end from the pressure of a `check` that is small enough; the check of the end, in `unknowns`.
    fn tried<O: ElasticOperator>(
        &mut self,
        problem: &mut ContactProblem<'_, O>,
        unknowns: &mut Unknowns,
        check: ConvergenceCheck,
    ) -> Option<ConvergenceCheck> {
        let is_near = check.measure() < self.next_trial && problem.operator.coupling() < MAX_TRIAL_COUPLING;
        if !is_near || problem.admissible.bounds().is_finite() || !problem.admissible.is_everywhere() {
            return None;
        }
        self.next_trial = NEXT_TRIAL * check.measure();
        let mut trial = unknowns.clone();
        let mut before = check.measure();
        for set in 0..MAX_SETS {
            self.iterations += on_set(problem, &mut trial)?;
            let check = whole_check(problem, &mut trial);
            if check.converged(problem.settings.tolerance) {
                *unknowns = trial;
                return Some(check);
            }
            if self.is_cut(problem, check) || set > 1 && check.measure() > before {
                return None;
            }
            before = check.measure().min(before);
        }
        None
    }

    /// Whether the step is to end here.
    fn is_cut<O: ElasticOperator>(&self, problem: &mut ContactProblem<'_, O>, check: ConvergenceCheck) -> bool {
        (problem.progress)(Progress { iteration: self.iterations, residual: check.residual }).is_break()
    }
}

/// Makes the gap uniform on the set of the present pressure and gap, and cuts what becomes negative; the steps of the linear solve.
fn on_set<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> Option<usize> {
    let (pressure, gap) = (Arc::make_mut(&mut unknowns.pressure), &unknowns.gap);
    let set = SampleSet::of(pressure.len(), |i| pressure[i] > 0.0 || gap[i] < 0.0);
    let right = set.samples().map(|i| -gap[i]).collect();
    let (operator, workspace) = (&mut *problem.operator, &mut problem.working.transforms);
    let found = set.solve(right, ON_SET, &mut Whole { operator, workspace })?;
    set.samples().zip(found.change).for_each(|(i, change)| pressure[i] = (pressure[i] + change).max(0.0));
    problem.admissible.project(pressure, problem.load);
    Some(found.steps)
}
