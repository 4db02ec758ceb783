//! Displacement control by load control: the mean pressure whose solution has the prescribed penetration.
//!
//! Close to complete contact the direct iteration under displacement control stalls: a uniform pressure causes no
//! displacement, and only the few open samples hold it. The penetration grows with the mean pressure, so that its root
//! is bracketed and found by regula falsi (Illinois), each trial starting from the last.

use super::{Control, Progress, Report, Settings, State, StopReason, iterate};
use crate::field;
use crate::operator::Operator;

/// Trials of the mean pressure before the search counts as stalled.
const TRIALS: usize = 60;

pub(super) fn solve(
    operator: &mut Operator,
    shape: &[f64],
    penetration: f64,
    settings: &Settings,
    iterations_before: usize,
    state: &mut State,
    callback: &mut dyn FnMut(Progress),
) -> Report {
    let mut iterations = iterations_before;
    let mut pressure = field::mean(&state.pressure);
    // Mean pressures and what their penetrations lack, on either side of the root.
    let (mut low, mut high) = ((0.0, -penetration), None);
    let mut last = Report { stop: StopReason::Stalled, iterations, fell_back: true, residual: f64::INFINITY };
    for _ in 0..TRIALS {
        if !(pressure.is_finite() && pressure > 0.0) {
            break;
        }
        let report = iterate(operator, shape, Control::MeanPressure(pressure), settings, state, callback);
        iterations += report.iterations;
        last = Report { iterations, fell_back: true, ..report };
        let lack = state.penetration - penetration;
        if !report.stop.solved() || lack.abs() < settings.tolerance * penetration {
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
