//! Conjugate gradients preconditioned with C⁻¹ on the active set.
//!
//! On I = {p > 0} ∪ {g < 0} the direction is t = z + βt with z = P_I F⁻¹C⁻¹F P_I g (Polak–Ribière β ≥ 0; a restart
//! where I has grown). Under load control g and z are freed of their mean on I first, so that the load stays: the
//! preconditioner is then symmetric on the admissible directions. Step τ = ⟨g,t⟩/⟨t,Ct⟩, p ← max(p − τt, 0), and p is
//! scaled back to its mean. C⁻¹ makes the spectrum of the iteration nearly independent of the grid.

use super::{Check, Control, Patience, Progress, Report, Settings, State, StopReason};
use crate::field;
use crate::operator::Operator;

/// First window of the patience, iterations.
const PATIENCE: usize = 30;

pub(super) fn solve(
    operator: &mut Operator,
    shape: &[f64],
    control: Control,
    settings: &Settings,
    state: &mut State,
    callback: &mut dyn FnMut(Progress),
) -> Report {
    let len = shape.len();
    let load_control = matches!(control, Control::MeanPressure(_));
    let mut patience = Patience::new(PATIENCE);
    let mut norm_before = 0.0;
    let mut iterations = 0;
    state.direction.fill(0.0);
    state.active.fill(false);
    state.admit(control);
    loop {
        let check = Check::new(operator, shape, control, state);
        if let Some(stop) = check.stop(settings, &mut patience, iterations) {
            return Report { stop, iterations, fell_back: false, residual: check.residual };
        }
        iterations += 1;

        let State { pressure: p, gap: g, direction: t, image, previous, active, .. } = state;
        let belongs = |i: usize| p[i] > 0.0 || g[i] < 0.0;
        let [size, sum, grown] =
            field::sums(len, |i| if belongs(i) { [1.0, g[i], f64::from(u8::from(!active[i]))] } else { [0.0; 3] });
        let mean = if load_control { sum / size } else { 0.0 };
        field::update(active, |i, _| belongs(i));
        field::update(g, |i, g| if active[i] { g - mean } else { 0.0 });
        operator.precondition(g, image);
        let z_mean = if load_control {
            let [sum] = field::sums(len, |i| [if active[i] { image[i] } else { 0.0 }]);
            sum / size
        } else {
            0.0
        };
        field::update(image, |i, z| if active[i] { z - z_mean } else { 0.0 });
        let [norm, overlap] = field::sums(len, |i| [g[i] * image[i], previous[i] * image[i]]);
        let beta = if grown > 0.0 || norm_before <= 0.0 { 0.0 } else { ((norm - overlap) / norm_before).max(0.0) };
        norm_before = norm;
        field::update(t, |i, t| if active[i] { image[i] + beta * t } else { 0.0 });
        previous.copy_from_slice(g);

        operator.displacement(t, image);
        let [descent, curvature] = field::sums(len, |i| [g[i] * t[i], t[i] * image[i]]);
        let step = descent / curvature;
        if !(step.is_finite() && curvature > 0.0) {
            return Report { stop: StopReason::Stalled, iterations, fell_back: false, residual: check.residual };
        }
        field::update(p, |i, p| if active[i] { p - step * t[i] } else { 0.0 });
        state.admit(control);
        callback(Progress { iteration: iterations, residual: check.residual });
    }
}
