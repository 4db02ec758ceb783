//! The iteration of the settings and, where it stalls, a more robust one: the preconditioned iteration without the
//! continuation of the residual, then the baseline.
//!
//! Under coupled friction, or with materials that relax, what is skew is updated in every step while it displaces little. Where it displaces
//! much the operator is [split](super::splitting) on a periodic cell; in a window, and where the updated one stalls, it lags behind, for whole
//! outer iterations. The baseline, made for a symmetric operator, is no
//! fallback there.

use super::fields::Unknowns;
use super::full_step::full_steps;
use super::inner_iteration::Continuation::{Fading, Zero};
use super::inner_iteration::Variant;
use super::problem::{ContactProblem, Method};
use super::report::{Report, Route, Stop};
use super::stopping::unless_rounding;
use super::{polonsky_keer, preconditioned, splitting};
use crate::spectral::operator::ElasticOperator;
use crate::spectral::operator::TractionUpdate::{Lagged, Updated};

/// Largest coupling at which the traction is updated in every step.
const MAX_UPDATED_COUPLING: f64 = 0.4;

/// Variants of the preconditioned iteration, in the order in which they are tried, and their routes.
fn variants(coupling: f64) -> &'static [(Variant, Route)] {
    const DIRECT: (Variant, Route) = (Variant { continuation: Fading, traction: Updated }, Route::Direct);
    const WITHOUT_CONTINUATION: (Variant, Route) =
        (Variant { continuation: Zero, traction: Updated }, Route::WithoutContinuation);
    const OUTER: (Variant, Route) = (Variant { continuation: Fading, traction: Lagged }, Route::Outer);
    const OUTER_WITHOUT_CONTINUATION: (Variant, Route) =
        (Variant { continuation: Zero, traction: Lagged }, Route::Outer);
    match coupling {
        0.0 => &[DIRECT, WITHOUT_CONTINUATION],
        ..=MAX_UPDATED_COUPLING => &[DIRECT, OUTER, OUTER_WITHOUT_CONTINUATION],
        _ => &[OUTER, OUTER_WITHOUT_CONTINUATION],
    }
}

/// Splitting of an operator with its parts; under a given penetration it stalls, and leaves the rest to a search for the load.
fn split<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    iterations: usize,
    unknowns: &mut Unknowns,
) -> Report {
    let report = splitting::solve(problem, iterations, unknowns);
    let report = report.unwrap_or_else(|| Report::new(Stop::Stalled, Route::Splitting, iterations, f64::INFINITY));
    Report { stop: unless_rounding(problem, unknowns, report.stop), ..report }
}

/// Iterates from and into `unknowns`, with a hardness after [full steps](super::full_step); `iterations` are those before.
pub(super) fn iterate<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    iterations: usize,
    unknowns: &mut Unknowns,
) -> Report {
    full_steps(problem, unknowns);
    if problem.settings.method == Method::PolonskyKeer {
        let report = polonsky_keer::solve(problem, iterations, unknowns);
        return Report { stop: unless_rounding(problem, unknowns, report.stop), ..report };
    }
    let coupling = problem.operator.coupling();
    if coupling > MAX_UPDATED_COUPLING && problem.operator.resolvent().is_some() {
        return split(problem, iterations, unknowns);
    }
    let mut report = Report::new(Stop::Stalled, Route::Direct, iterations, f64::INFINITY);
    for &(variant, route) in variants(coupling) {
        report = Report { route, ..preconditioned::solve(problem, variant, report.iterations, unknowns) };
        report.stop = unless_rounding(problem, unknowns, report.stop);
        if report.stop != Stop::Stalled {
            return report;
        }
    }
    if coupling > 0.0 {
        return report;
    }
    let rest = polonsky_keer::solve(problem, report.iterations, unknowns);
    let stop = unless_rounding(problem, unknowns, rest.stop);
    Report { stop, route: Route::BaselineAfterStall, ..rest }
}
