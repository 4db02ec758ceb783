//! The method of the settings, and where it stalls the next more patient one: without the continuation of the residual,
//! then the baseline.
//!
//! Under coupled friction the traction follows every step as long as it displaces little, and stands still for whole outer
//! iterations where it displaces much or where that stalls. The baseline, made for a symmetric operator, does not follow.

use super::preconditioned::Beyond::{self, Continued, Zero};
use super::problem::GridProblem;
use super::report::{Report, Route, Stop};
use super::settings::Method;
use super::unknowns::Unknowns;
use super::{polonsky_keer, preconditioned, rounding};
use crate::spectral::operator::Coupling::{self, Follows, Stands};

/// Largest part of the operator that coupling may be for the traction to follow every step.
const FOLLOWED: f64 = 0.4;

type Way = ((Beyond, Coupling), Route);

/// Iterates from and into `unknowns`; `iterations` are those before.
pub(super) fn iterate(problem: &mut GridProblem<'_>, iterations: usize, unknowns: &mut Unknowns) -> Report {
    if problem.settings.method == Method::PolonskyKeer {
        let report = polonsky_keer::solve(problem, iterations, unknowns);
        return Report { stop: unless_rounding(problem, unknowns, report.stop), ..report };
    }
    let coupling = problem.operator.coupling();
    let ways: &[Way] = match coupling {
        0.0 => &[((Continued, Follows), Route::Direct), ((Zero, Follows), Route::WithoutContinuation)],
        ..=FOLLOWED => &[
            ((Continued, Follows), Route::Direct),
            ((Continued, Stands), Route::Outer),
            ((Zero, Stands), Route::Outer),
        ],
        _ => &[((Continued, Stands), Route::Outer), ((Zero, Stands), Route::Outer)],
    };
    let mut report =
        Report { stop: Stop::Stalled, route: Route::Direct, iterations, outer: 0, residual: f64::INFINITY };
    for &(way, route) in ways {
        report = Report { route, ..preconditioned::solve(problem, way, report.iterations, unknowns) };
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

/// That an iteration has stalled or come to its limit, unless rounding is all that keeps it from the tolerance.
pub(super) fn unless_rounding(problem: &mut GridProblem<'_>, unknowns: &mut Unknowns, stop: Stop) -> Stop {
    let ended = matches!(stop, Stop::Stalled | Stop::IterationLimit);
    let rounding = ended && rounding::is_all_that_is_left(problem, unknowns);
    if rounding { Stop::Rounding } else { stop }
}
