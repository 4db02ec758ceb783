//! Certificate of a pressure: bounds on its error, from one fresh convolution.
//!
//! For the energy E(p) = ½⟨p, Cp⟩ + ⟨p, f⟩ over all p ≥ 0 with the same load, convexity gives for the minimum E*
//!
//! E(p) − E* ≤ ⟨p, g⟩ − min_s ⟨s, g⟩ = Σ p (g − min g),
//!
//! the Frank–Wolfe gap (g may be shifted by any constant). Divided by the elastic energy ½⟨p, Cp⟩ it bounds the
//! relative excess of energy whatever route led to p. Under displacement control the multiplier δ is given and no
//! other p ≥ 0 of at most the same load has less energy ½⟨p, Cp⟩ + ⟨p, f − δ⟩ than by Σ p (g − min(0, min g)).
//!
//! **With hardness** the pressures are 0 ≤ p ≤ H. For any θ, min_s ⟨s, g⟩ ≥ θ Σp − H Σ max(θ − g, 0) over them, and with θ = 0
//!
//! E(p) − E* ≤ Σ p max(g, 0) + Σ (H − p) max(−g, 0):
//!
//! open gaps under pressure, and penetrations that the hardness does not excuse: sharp where much of the contact is full. Where little
//! is, θ = min g over p < H is sharper. The smaller bound is taken where a pressure is H, under both controls; where none is, H has no
//! part.
//!
//! In complete contact a uniform pressure is free, and the rounding of g under it would rule the gap. Without p ≥ 0 the
//! minimum is at Cp + f = δ, so that the excess is at most ½⟨g, C⁻¹g⟩ there: the smaller of the two bounds is taken. (In free
//! space contact is never complete, C⁻¹ is not known, and the first bound alone is taken.)
//!
//! **Under coupled friction** there is no energy: C is the symmetric part of the operator A = C + B, ⟨p, Bp⟩ = 0. Both
//! bounds hold (under displacement control while p* has at most the load of p) for the elastic energy of the error, ½⟨d, Cd⟩ with d = p − p*, which without friction is at most E(p) − E*:
//! ⟨d, Cd⟩ = ⟨d, Ad⟩ ≤ ⟨d, g⟩, as p* solves the problem, and ⟨d, g⟩ is at most the gap, and at most ⟨d, Cd⟩^½ ⟨g, C⁻¹g⟩^½.

use crate::numeric::serialised;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Bounds on the error of a pressure, all dimensionless.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Certificate {
    /// Σ p (g − min g) over ½⟨p, Cp⟩ (min(0, min g) under displacement control), or Σ p max(g, 0) + (H − p) max(−g, 0) over it where a
    /// pressure is that of the hardness H: bound on the elastic energy of the error
    /// over that of p, and without coupled friction on the relative excess of energy.
    #[serde(deserialize_with = "serialised::number")]
    pub energy_gap: f64,
    /// Deepest penetration outside contact over δ, ≥ 0.
    #[serde(deserialize_with = "serialised::number")]
    pub penetration: f64,
    /// Deviation of what was prescribed: |mean p − p̄|/p̄ under load control, |Σp(w+f)/Σp − δ|/δ under displacement
    /// control.
    #[serde(deserialize_with = "serialised::number")]
    pub load: f64,
}

impl Certificate {
    /// Largest energy gap of a converged solution, over the tolerance.
    pub const ENERGY_GAP: f64 = 20.0;
    /// Deepest penetration outside contact of a converged solution, over the tolerance.
    pub const PENETRATION: f64 = 10.0;
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "energy of the error below {:.1e} of the elastic, penetration {:.1e}, load {:.1e}",
            self.energy_gap, self.penetration, self.load
        )
    }
}
