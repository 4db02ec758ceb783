//! Conjugate gradients preconditioned with C⁻¹ on the active set, in single precision around a gap in double precision.
//!
//! 1. w = A p, g = w + f − δ with δ = Σ p(w + f)/Σ p, or as prescribed (`certificate`; carried by its changes: `update`).
//! 2. Terminate on the criteria of convergence (`certificate`, `stopping`).
//! 3. Active set I = ({p > 0} ∪ {g < 0}) ∖ {p = H, g ≤ 0} with the hardness H, r = g on I (`update`).
//! 4. Direction t = z + βt with z = M r, M = P_I Eᵀ C⁻¹ E P_I (E continues the residual beyond I, `extension`),
//!    β = max(0, ⟨r − r′, z⟩/⟨r′, z′⟩) (Polak–Ribière, primes of the iteration before). Under load control r and z are freed
//!    of their mean on I, so that the load stays: M is then symmetric on the admissible directions (`direction`).
//! 5. Step p ← min(max(p − τt, 0), H) with τ = ⟨g, t⟩/⟨t, Ct⟩, scaled back to the mean or, where any of it is H, shifted to it:
//!    p ← min(max(p − τt + λ, 0), H), λ on I (`update`).
//!
//! C⁻¹ makes the spectrum of the iteration nearly independent of the grid, E nearly independent of how ragged the contact is.
//! `plain` is the same method in plain lines.
//!
//! **Descent.** Clipping can raise the energy. Its change along the step d that was really taken is ⟨g, d⟩ + ½⟨d, Cd⟩; where
//! that is positive a shorter step is clipped afresh (ending at the minimum along d instead would bring back what was clipped,
//! to be clipped again and again), and where d leads uphill it is not taken, and the next direction starts anew. The first step
//! on a grid is not restricted: it has to remove what interpolation has left.
//!
//! **Sliding.** Under coupled friction the operator has a skew part D, T = C⁻¹D, and there is no energy. Where its largest |T|,
//! f, is small the gap is carried with it (the traction is updated), and the iteration is not disturbed: ⟨t, Dt⟩ = 0. Else D p
//! of the last gap in double precision is kept (the traction lags behind); then there is an energy again: minimising
//!
//! ½⟨p − p_k, C(p − p_k)⟩ + ω⟨g_k, p⟩  over p ≥ 0,  ω = 1/(1 + f²),
//!
//! is the iteration above from p_k and the gap ωg_k on, and these **outer** iterations (forward–backward splitting in the
//! energy's norm, in which C⁻¹(C + D) is monotone with the constants 1 and √(1 + f²)) contract as f/√(1 + f²) at least,
//! whatever f. Each ends when the criteria have fallen to a third.
//!
//! **Precision.** The gap is carried by its changes, g ← g + Cd, in single precision and in units of the largest f. The
//! pressure is double, and when the criteria are met, or single precision is exhausted, the gap is computed afresh in double
//! precision: that alone decides about convergence.

use super::check::ConvergenceCheck;
use super::fields::Unknowns;
use super::inner_iteration::{InnerIteration, LastDirection, Variant};
use super::problem::ContactProblem;
use super::report::{Progress, Report, Route, Stop};
use super::stopping::StallDetector;
use crate::spectral::operator::{ElasticOperator, TractionUpdate};

/// First window of the stall detector, iterations.
const FIRST_WINDOW: usize = 30;
/// Reduction of the criteria from one gap in double precision to the next: single precision carries no further.
const SINGLE_PRECISION_REDUCTION: f64 = 1e-5;
/// Most iterations from one gap in double precision to the next.
const REFRESH_INTERVAL: usize = 20;
/// Reduction of the criteria in an outer iteration.
pub(super) const OUTER_REDUCTION: f64 = 0.3;

/// Iterates from and into `unknowns`; `iterations` are those before.
pub(super) fn solve<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    variant: Variant,
    mut iterations: usize,
    unknowns: &mut Unknowns,
) -> Report {
    let mut stall = StallDetector::new(FIRST_WINDOW);
    let (tolerance, max_iterations) = (problem.settings.tolerance, problem.settings.max_iterations);
    let coupling = problem.operator.coupling();
    // ω, and the part of the criteria at which the gap is computed afresh.
    let (share, reduction) = match variant.traction {
        TractionUpdate::Updated => (1.0, SINGLE_PRECISION_REDUCTION),
        TractionUpdate::Lagged => (1.0 / (1.0 + coupling * coupling), OUTER_REDUCTION / (1.0 + coupling * coupling)),
    };
    let mut last = LastDirection::NONE;
    loop {
        let check = fresh_check(problem, unknowns);
        let end = match check.converged(tolerance) {
            true => Some(Stop::Converged),
            _ if iterations >= max_iterations => Some(Stop::IterationLimit),
            _ => stall.detected(check.measure()).then_some(Stop::Stalled),
        };
        if let Some(stop) = end {
            return Report::new(stop, Route::Direct, iterations, check.residual);
        }
        problem.outer += usize::from(coupling > 0.0);
        let mut inner = InnerIteration::new(problem, unknowns, check, share, variant);
        for number in 1.. {
            let at_limit = iterations >= max_iterations;
            let ends = number > 1 && (at_limit || stall.detected(inner.check.measure()));
            if ends || !inner.step(problem, unknowns, &mut last) {
                let check = fresh_check(problem, unknowns);
                let stop = match (check.converged(tolerance), at_limit) {
                    (true, _) => Stop::Converged,
                    (false, true) => Stop::IterationLimit,
                    (false, false) => Stop::Stalled,
                };
                return Report::new(stop, Route::Direct, iterations, check.residual);
            }
            iterations += 1;
            if (problem.progress)(Progress { iteration: iterations, residual: inner.check.residual }).is_break() {
                let ConvergenceCheck { residual, .. } = fresh_check(problem, unknowns);
                return Report::new(Stop::Interrupted, Route::Direct, iterations, residual);
            }
            let is_met = inner.check.converged(tolerance);
            if is_met || number == REFRESH_INTERVAL || inner.check.measure() < reduction * check.measure() {
                break;
            }
        }
    }
}

/// Convergence check of the pressure, made admissible.
fn fresh_check<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) -> ConvergenceCheck {
    unknowns.admit(problem.load, problem.admissible);
    ConvergenceCheck::new(problem, unknowns)
}
