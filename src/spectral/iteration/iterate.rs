//! The method of the settings, and where it stalls the next more patient one: without the continuation of the residual,
//! then the baseline.

use super::preconditioned::Beyond;
use super::problem::GridProblem;
use super::report::{Report, Route, Stop};
use super::settings::Method;
use super::unknowns::Unknowns;
use super::{polonsky_keer, preconditioned};

/// Iterates from and into `unknowns`; `iterations` are those before.
pub(super) fn iterate(problem: &mut GridProblem<'_>, iterations: usize, unknowns: &mut Unknowns) -> Report {
    match problem.settings.method {
        Method::PolonskyKeer => polonsky_keer::solve(problem, iterations, unknowns),
        Method::Preconditioned => {
            let mut spent = iterations;
            for (beyond, route) in [(Beyond::Continued, Route::Direct), (Beyond::Zero, Route::WithoutContinuation)] {
                let report = preconditioned::solve(problem, beyond, spent, unknowns);
                if report.stop != Stop::Stalled {
                    return Report { route, ..report };
                }
                spent = report.iterations;
            }
            let rest = polonsky_keer::solve(problem, spent, unknowns);
            Report { route: Route::BaselineAfterStall, ..rest }
        }
    }
}
