//! Conjugate gradients of Polonsky & Keer, Wear 231 (1999) 206, the baseline.
//!
//! On {p > 0}: t = g + δ′ (G/G₀) t with G = Σ g² (δ′ = 0 right after samples have joined), τ = ⟨g,t⟩/⟨t,Ct⟩, p ← max(p
//! − τt, 0); samples outside contact that penetrate join with p ← −τ g. Under load control g is freed of its mean over
//! contact, Ct likewise, and p is scaled back to its mean.

use super::{Check, Control, Patience, Progress, Report, Settings, State, StopReason};
use crate::field;
use crate::operator::Operator;

/// First window of the patience, iterations: the method is rougher on its way than the preconditioned one.
const PATIENCE: usize = 100;

pub(super) fn solve(
    operator: &mut Operator,
    shape: &[f64],
    control: Control,
    settings: &Settings,
    iterations_before: usize,
    state: &mut State,
    callback: &mut dyn FnMut(Progress),
) -> Report {
    let len = shape.len();
    let load_control = matches!(control, Control::MeanPressure(_));
    let mut patience = Patience::new(PATIENCE);
    let (mut norm_before, mut conjugate) = (1.0, false);
    let mut iterations = iterations_before;
    state.direction.fill(0.0);
    state.admit(control);
    loop {
        let check = Check::new(operator, shape, control, state);
        if let Some(stop) = check.stop(settings, &mut patience, iterations) {
            return Report { stop, iterations, fell_back: false, residual: check.residual };
        }
        iterations += 1;

        let State { pressure: p, gap: g, direction: t, image, .. } = state;
        let over_contact = |field: &[f64]| {
            let [size, sum] = field::sums(len, |i| if p[i] > 0.0 { [1.0, field[i]] } else { [0.0; 2] });
            if load_control && size > 0.0 { sum / size } else { 0.0 }
        };
        let mean = over_contact(g);
        field::update(g, |_, g| g - mean);
        let [norm, violation] =
            field::sums(len, |i| if p[i] > 0.0 { [g[i] * g[i], 0.0] } else { [0.0, g[i].min(0.0).powi(2)] });
        let beta = if conjugate { norm / norm_before } else { 0.0 };
        norm_before = norm;
        // Contact of one sample (or of equal ones) leaves no direction within contact: the penetrating samples lead.
        let lonely = norm <= 1e-24 * violation;
        field::update(t, |i, t| if p[i] > 0.0 || (lonely && g[i] < 0.0) { g[i] + beta * t } else { 0.0 });

        operator.displacement(t, image);
        let image_mean = if lonely { 0.0 } else { over_contact(image) };
        let [descent, curvature] = field::sums(len, |i| [g[i] * t[i], (image[i] - image_mean) * t[i]]);
        let step = descent / curvature;
        if !(step.is_finite() && curvature > 0.0) {
            // Samples that left contact can spoil the direction; steepest descent cannot fail that way.
            if beta > 0.0 {
                conjugate = false;
                continue;
            }
            return Report { stop: StopReason::Stalled, iterations, fell_back: false, residual: check.residual };
        }
        field::update(p, |i, p| if p > 0.0 { (p - step * t[i]).max(0.0) } else { p });
        let [joined] = field::sums(len, |i| [f64::from(u8::from(p[i] == 0.0 && g[i] < 0.0))]);
        field::update(p, |i, p| if p == 0.0 && g[i] < 0.0 { -step * g[i] } else { p });
        conjugate = joined == 0.0;
        state.admit(control);
        callback(Progress { iteration: iterations, residual: check.residual });
    }
}
