//! What the returned pressure proves about itself, from one fresh convolution.
//!
//! For the energy E(p) = ½⟨p, Cp⟩ + ⟨p, f⟩ over all p ≥ 0 with the same load, convexity gives for the minimum E*
//!
//! E(p) − E* ≤ ⟨p, g⟩ − min_s ⟨s, g⟩ = Σ p (g − min g),
//!
//! the Frank–Wolfe gap (g may be shifted by any constant). Divided by the elastic energy ½⟨p, Cp⟩ it bounds the
//! relative excess of energy whatever route led to p.

use super::{Control, State};
use crate::field;
use crate::operator::Operator;
use std::fmt;

/// Bounds on the error of a pressure, all dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// Σ p (g − min g) over ½⟨p, Cp⟩: bound on the relative excess of energy.
    pub energy_gap: f64,
    /// Deepest penetration outside contact over the range of f, ≥ 0.
    pub penetration: f64,
    /// Deviation of what was prescribed: |mean p − p̄|/p̄ under load control, |Σp(w+f)/Σp − δ|/δ under displacement
    /// control.
    pub load: f64,
}

impl Certificate {
    /// Certificate of `state.pressure`; leaves the fresh gap and displacement w = C p behind.
    pub fn new(
        operator: &mut Operator,
        shape: &[f64],
        range: f64,
        control: Control,
        state: &mut State,
        displacement: &mut [f64],
    ) -> Self {
        let (p, len) = (&state.pressure, shape.len());
        operator.displacement(p, displacement);
        let w = &*displacement;
        let [load, energy, work] = field::sums(len, |i| [p[i], 0.5 * p[i] * w[i], p[i] * (w[i] + shape[i])]);
        if load <= 0.0 {
            return Self { energy_gap: 0.0, penetration: 0.0, load: 0.0 };
        }
        let own = work / load;
        let deviation = match control {
            Control::MeanPressure(mean) => {
                state.penetration = own;
                (load / len as f64 - mean).abs() / mean
            }
            Control::Penetration(penetration) => {
                state.penetration = penetration;
                (own - penetration).abs() / penetration
            }
        };
        let penetration = state.penetration;
        field::update(&mut state.gap, |i, _| w[i] + shape[i] - penetration);
        let g = &state.gap;
        let least = field::least(len, |i| g[i]);
        let [gap] = field::sums(len, |i| [p[i] * (g[i] - least)]);
        let outside = field::least(len, |i| if p[i] > 0.0 { 0.0 } else { g[i] });
        // A flat counterbody is in complete contact without any deformation: nothing to be relative to.
        let relative = |excess: f64, scale: f64| if scale > 0.0 { (excess / scale).max(0.0) } else { 0.0 };
        Self { energy_gap: relative(gap, energy), penetration: relative(-outside, range), load: deviation }
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
