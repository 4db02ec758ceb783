//! Displacement control by load control: the mean pressure whose solution has the prescribed penetration.
//!
//! Close to complete contact the direct iteration under displacement control stalls: a uniform pressure causes no
//! displacement, and only the few open samples hold it. The penetration grows with the mean pressure, so that its root
//! is bracketed and found by regula falsi (Illinois), each trial starting from the last. A trial is accepted by the
//! criteria of displacement control; it is solved more sharply than these, because its own error moves its penetration.

use super::{Check, Control, Progress, Report, Settings, State, StopReason, iterate};
use crate::field;
use crate::operator::Operator;

/// Trials of the mean pressure before the search counts as stalled.
const TRIALS: usize = 60;
/// Tolerance of a trial over that of the search.
const SHARPER: f64 = 0.1;

pub(super) fn solve(
    operator: &mut Operator,
    shape: &[f64],
    penetration: f64,
    settings: &Settings,
    iterations_before: usize,
    state: &mut State,
    callback: &mut dyn FnMut(Progress),
) -> Report {
    let sharper = Settings { tolerance: SHARPER * settings.tolerance, ..*settings };
    let mut iterations = iterations_before;
    let mut pressure = field::mean(&state.pressure);
    // Mean pressures and what their penetrations lack, on either side of the root.
    let (mut low, mut high) = ((0.0, -penetration), None);
    let mut last = Report { stop: StopReason::Stalled, iterations, fell_back: true, residual: f64::INFINITY };
    for _ in 0..TRIALS {
        if !(pressure.is_finite() && pressure > 0.0) {
            break;
        }
        let report = iterate(operator, shape, Control::MeanPressure(pressure), &sharper, state, callback);
        iterations += report.iterations;
        let lack = state.penetration - penetration;
        let check = Check::new(operator, shape, Control::Penetration(penetration), state);
        last = Report { stop: report.stop, iterations, fell_back: true, residual: check.residual };
        if check.converged(settings.tolerance) {
            return Report { stop: StopReason::Converged, ..last };
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
    Report { stop: StopReason::Stalled, ..last }
}
