//! What a pressure proves about itself, from one convolution.
//!
//! For the energy E(p) = ½⟨p, Cp⟩ + ⟨p, f⟩ over all p ≥ 0 with the same load, convexity gives for the minimum E*
//!
//! E(p) − E* ≤ ⟨p, g⟩ − min_s ⟨s, g⟩ = Σ p (g − min g),
//!
//! the Frank–Wolfe gap (g may be shifted by any constant). Divided by the elastic energy ½⟨p, Cp⟩ it bounds the
//! relative excess of energy whatever route led to p. Under displacement control the multiplier δ is given and no
//! other p ≥ 0 of at most the same load has less energy ½⟨p, Cp⟩ + ⟨p, f − δ⟩ than by Σ p (g − min(0, min g)).
//!
//! In complete contact a uniform pressure is free, and the rounding of g under it would rule the gap. Without p ≥ 0 the
//! minimum is at Cp + f = δ, so that the excess is at most ½⟨g, C⁻¹g⟩ there: the smaller of the two bounds is taken.

use super::{Check, Control, State};
use crate::field;
use crate::operator::Operator;
use std::fmt;

/// Bounds on the error of a pressure, all dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// Σ p (g − min g) over ½⟨p, Cp⟩ (min(0, min g) under displacement control): bound on the relative excess of energy.
    pub energy_gap: f64,
    /// Deepest penetration outside contact over δ, ≥ 0.
    pub penetration: f64,
    /// Deviation of what was prescribed: |mean p − p̄|/p̄ under load control, |Σp(w+f)/Σp − δ|/δ under displacement
    /// control.
    pub load: f64,
}

impl Certificate {
    /// Certificate of `state.pressure`; leaves the fresh gap, penetration and displacement w = C p behind.
    pub fn new(
        operator: &mut Operator,
        shape: &[f64],
        control: Control,
        state: &mut State,
        displacement: &mut [f64],
    ) -> Self {
        operator.displacement(&state.pressure, displacement);
        state.gap.copy_from_slice(displacement);
        judge(operator, shape, control, state).certificate
    }
}

/// How `state.pressure` stands, whose displacement w = C p is in `state.gap`; leaves gap and penetration in `state`.
pub(super) fn judge(operator: &mut Operator, shape: &[f64], control: Control, state: &mut State) -> Check {
    // A flat counterbody is in complete contact without any deformation: nothing to be relative to.
    let relative = |part: f64, scale: f64| if scale <= 0.0 || part <= 0.0 { 0.0 } else { part / scale };
    let load_control = matches!(control, Control::MeanPressure(_));
    let State { pressure: p, gap, image, .. } = state;
    let (w, len) = (&*gap, shape.len());
    // ⟨1, w⟩ = 0, so that a uniform part of p adds nothing but rounding to the elastic energy.
    let uniform = if let Control::MeanPressure(mean) = control { mean } else { 0.0 };
    let [load, energy, work, open] = field::sums(len, |i| {
        [p[i], 0.5 * (p[i] - uniform) * w[i], p[i] * (w[i] + shape[i]), if p[i] > 0.0 { 0.0 } else { 1.0 }]
    });
    let (penetration, deviation) = match control {
        Control::MeanPressure(mean) => (relative(work, load), relative((load / len as f64 - mean).abs(), mean)),
        Control::Penetration(given) => (given, relative((work - load * given).abs(), load * given)),
    };
    state.penetration = penetration;
    field::update(gap, |i, w| w + shape[i] - penetration);
    let g = &*gap;
    let outside = field::least(len, |i| if p[i] > 0.0 { 0.0 } else { g[i] });
    let least = field::least(len, |i| g[i]);
    let least = if load_control { least } else { least.min(0.0) };
    let [mut excess, complementarity] = field::sums(len, |i| [p[i] * (g[i] - least), p[i] * g[i].abs()]);
    if load_control && open == 0.0 {
        operator.precondition(g, image);
        let [free] = field::sums(len, |i| [0.5 * g[i] * image[i]]);
        excess = excess.min(free);
    }
    Check {
        // Without any pressure the constraint g ≥ 0 alone decides.
        residual: relative(complementarity, load * penetration),
        certificate: Certificate {
            energy_gap: relative(excess, energy),
            penetration: relative(-outside, penetration),
            load: deviation,
        },
    }
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "energy within {:.1e} of its minimum, penetration {:.1e}, load {:.1e}",
            self.energy_gap, self.penetration, self.load
        )
    }
}
