//! The method of the settings, and the baseline where it stalls.

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
            let report = preconditioned::solve(problem, iterations, unknowns);
            if report.stop != Stop::Stalled {
                return report;
            }
            let rest = polonsky_keer::solve(problem, report.iterations, unknowns);
            Report { route: Route::BaselineAfterStall, ..rest }
        }
    }
}
