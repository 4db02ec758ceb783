//! Displacement control by load control: the mean pressure whose solution has the prescribed penetration.
//!
//! Close to complete contact the direct iteration under displacement control stalls: a uniform pressure causes no
//! displacement, and only the few open samples hold it. The penetration grows with the mean pressure, so that its root
//! is bracketed and found by regula falsi (Illinois), each trial starting from the last. A trial is accepted by the
//! criteria of displacement control; it is solved more sharply than these, because its own error moves its penetration.

use super::check::Check;
use super::iterate::iterate;
use super::problem::GridProblem;
use super::report::{Report, Route, Stop};
use super::settings::Settings;
use super::unknowns::Unknowns;
use crate::load::Load;
use crate::numeric::sums;

/// Trials of the mean pressure before the search counts as stalled.
const TRIALS: usize = 60;
/// Tolerance of a trial over that of the search.
const SHARPER: f64 = 0.1;

/// Searches from and into `unknowns` for the `penetration` of `problem`; `iterations` are those before.
pub(super) fn solve(
    problem: &mut GridProblem<'_>,
    penetration: f64,
    iterations: usize,
    unknowns: &mut Unknowns,
) -> Report {
    let settings = problem.settings;
    let sharper = Settings { tolerance: SHARPER * settings.tolerance, ..settings };
    let mut pressure = sums::mean(&unknowns.pressure);
    // Mean pressures and what their penetrations lack, on either side of the root.
    let (mut low, mut high) = ((0.0, -penetration), None);
    let mut last = Report {
        stop: Stop::Stalled,
        route: Route::LoadSearch { trials: 0 },
        iterations,
        outer: 0,
        residual: f64::INFINITY,
    };
    for trials in 1..=TRIALS {
        if !(pressure.is_finite() && pressure > 0.0) {
            break;
        }
        let mut trial = GridProblem {
            operator: &mut *problem.operator,
            working: &mut *problem.working,
            load: Load::MeanPressure(pressure),
            settings: sharper,
            progress: &mut *problem.progress,
            ..*problem
        };
        let report = iterate(&mut trial, last.iterations, unknowns);
        problem.outer = trial.outer;
        let lack = unknowns.penetration - penetration;
        let check = Check::new(problem, unknowns);
        last = Report { route: Route::LoadSearch { trials }, residual: check.residual, ..report };
        if check.converged(settings.tolerance) {
            return Report { stop: Stop::Converged, ..last };
        }
        if !report.stop.solved() {
            return last;
        }
        // Illinois: an end that stays has its value halved.
        if lack < 0.0 {
            low = (pressure, lack);
            high = high.map(|(p, lack)| (p, 0.5 * lack));
        } else {
            high = Some((pressure, lack));
            low.1 *= 0.5;
        }
        pressure = match high {
            None => 2.0 * pressure,
            Some(high) => low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1),
        };
    }
    Report { stop: Stop::Stalled, ..last }
}
