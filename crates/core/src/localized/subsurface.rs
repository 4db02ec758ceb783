//! Stresses of the layered half-space below a unit force and below a uniformly loaded disc.
//!
//! A unit force on the surface causes, with the amplitudes of [`crate::body::Interior`] and x = qr,
//!
//! σ_zz = (1/2π) ∫ s_zz J₀ q dq,  σ_rz = (1/2π) ∫ s_qz J₁ q dq,
//! σ_rr = (1/2π) ∫ [s_qq (J₀ − J₁/x) + s_tt J₁/x] q dq,  σ_tt = (1/2π) ∫ [s_qq J₁/x + s_tt (J₀ − J₁/x)] q dq.
//!
//! A unit shear force along **e** causes at the angle φ from **e**, with the amplitudes under a traction along the
//! wavevector and those across it ([`crate::body::Antiplane`]),
//!
//! σ_zz = cos φ/2π ∫ s_zz J₁ q dq,  σ_rr = cos φ/2π ∫ [s_qq (J₁ − J₂/x) + (s_tt + 2s_qt) J₂/x] q dq,
//! σ_tt = cos φ/2π ∫ [s_qq J₂/x + s_tt (J₁ − J₂/x) − 2s_qt J₂/x] q dq,
//! σ_rt = −sin φ/2π ∫ [(s_qq − s_tt) J₂/x + s_qt (J₁ − 2J₂/x)] q dq,
//! σ_rz = cos φ/2π ∫ [s_qz (J₀ − J₁/x) + s_tz J₁/x] q dq,  σ_tz = −sin φ/2π ∫ [s_qz J₁/x + s_tz (J₀ − J₁/x)] q dq.
//!
//! Below a disc of the radius R under a unit pressure or traction the same integrals hold with R J₁(qR) in the place of q/2π.

use super::quadrature::{Bessel, hankel};
use crate::body::{Amplitudes, Antiplane, Depth, HalfSpace, InPlane, LayeredResponse};
use crate::numeric::chebyshev::{self, Chebyshev};
use crate::stress::StressState;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// qz beyond which all amplitudes are negligible.
const DEPTH_CUTOFF: f64 = 45.0;
/// Relative tolerance of the integrals: amplitudes are exact to some 1e-11 of the pressure.
const QUADRATURE: f64 = 1e-9;
/// Number of terms of one Chebyshev series of a radial function.
const SERIES_TERMS: usize = 20;

/// Stresses of a normal load around its axis: σ_rr, σ_tt, σ_zz, σ_rz.
pub(super) type NormalComponents = [f64; 4];
/// Stresses of a shear load along **e**: σ_zz, σ_rr, σ_tt, σ_rz over cos φ, and σ_rt, σ_tz over −sin φ.
pub(super) type ShearComponents = [f64; 6];

/// Stresses of the half-space at one depth under a unit force, as series in the distance.
#[derive(Debug, Clone)]
pub(super) struct ForceStress<const K: usize> {
    /// Upper ends of the intervals of r, lengths, and the series of the components over each.
    intervals: Vec<(f64, [Chebyshev<SERIES_TERMS>; K])>,
}

/// Amplitudes of the layered half-space, from which stresses are integrated.
#[derive(Debug, Clone)]
pub(super) struct Subsurface {
    transfer: Arc<LayeredResponse>,
}

impl Subsurface {
    /// Amplitudes below the surface of a `half_space`.
    pub fn new(half_space: &HalfSpace) -> Self {
        Self { transfer: Arc::clone(half_space.response()) }
    }

    /// Amplitudes at a depth, as a function of the wavenumber.
    fn amplitudes(&self, depth: Depth) -> impl Fn(f64) -> Amplitudes + use<'_> {
        move |q| self.transfer.interior(InPlane::Normal, q).at(depth)
    }

    /// Stresses at the distance r from the axis of a unit force.
    pub fn force(&self, depth: Depth, r: f64) -> NormalComponents {
        let amplitudes = self.amplitudes(depth);
        let end = DEPTH_CUTOFF / depth.z;
        let part = |bessel, f: &dyn Fn(&Amplitudes) -> f64| {
            hankel(bessel, r, end, QUADRATURE, |q| f(&amplitudes(q)) * q / (2.0 * PI)).value
        };
        // J₁(x)/x = ½ on the axis.
        let ratio = |f: &dyn Fn(&Amplitudes) -> f64| {
            if r > 0.0 {
                hankel(Bessel::One, r, end, QUADRATURE, |q| f(&amplitudes(q)) / (2.0 * PI * r)).value
            } else {
                hankel(Bessel::Zero, 0.0, end, QUADRATURE, |q| 0.5 * f(&amplitudes(q)) * q / (2.0 * PI)).value
            }
        };
        let difference = ratio(&|a| a.stt - a.sqq);
        [
            part(Bessel::Zero, &|a| a.sqq) + difference,
            part(Bessel::Zero, &|a| a.stt) - difference,
            part(Bessel::Zero, &|a| a.szz),
            if r > 0.0 { part(Bessel::One, &|a| a.sqz) } else { 0.0 },
        ]
    }

    /// Amplitudes at a depth under shear tractions, as a function of the wavenumber.
    fn shear_amplitudes(&self, depth: Depth) -> impl Fn(f64) -> (Amplitudes, Antiplane) + use<'_> {
        move |q| (self.transfer.interior(InPlane::Along, q).at(depth), self.transfer.antiplane(q, depth))
    }

    /// Stresses at the distance r from the axis of a unit shear force.
    pub fn shear_force(&self, depth: Depth, r: f64) -> ShearComponents {
        let amplitudes = self.shear_amplitudes(depth);
        let end = DEPTH_CUTOFF / depth.z;
        let integral = |bessel: Bessel, f: &dyn Fn(&Amplitudes, &Antiplane, f64) -> f64| {
            let integrand = |q: f64| {
                let (along, across) = amplitudes(q);
                f(&along, &across, q) / (2.0 * PI)
            };
            hankel(bessel, r, end, QUADRATURE, integrand).value
        };
        if r == 0.0 {
            // J₀ = 1, J₁/x = ½, and J₁, J₂/x vanish.
            let both = integral(Bessel::Zero, &|a, t, q| 0.5 * (a.sqz + t.stz) * q);
            return [0.0, 0.0, 0.0, both, 0.0, both];
        }
        // J₂/x and J₁/x, of which x = qr.
        let second = integral(Bessel::Two, &|a, t, _| (a.stt - a.sqq + 2.0 * t.sqt) / r);
        let twist = integral(Bessel::Two, &|a, t, _| (a.sqq - a.stt - 2.0 * t.sqt) / r);
        let first = integral(Bessel::One, &|a, t, _| (t.stz - a.sqz) / r);
        [
            integral(Bessel::One, &|a, _, q| a.szz * q),
            integral(Bessel::One, &|a, _, q| a.sqq * q) + second,
            integral(Bessel::One, &|a, _, q| a.stt * q) - second,
            integral(Bessel::Zero, &|a, _, q| a.sqz * q) + first,
            integral(Bessel::One, &|_, t, q| t.sqt * q) + twist,
            integral(Bessel::Zero, &|_, t, q| t.stz * q) - first,
        ]
    }

    /// Stresses at the distance s from the axis of a disc of the given radius under unit pressure.
    pub fn disc(&self, depth: Depth, radius: f64, s: f64) -> NormalComponents {
        let amplitudes = self.amplitudes(depth);
        let end = DEPTH_CUTOFF / depth.z;
        let part = |f: &dyn Fn(&Amplitudes, f64) -> f64| {
            hankel(Bessel::One, radius, end, QUADRATURE, |q| radius * f(&amplitudes(q), q * s)).value
        };
        [
            part(&|a, x| a.sqq * (Bessel::Zero.at(x) - first_ratio(x)) + a.stt * first_ratio(x)),
            part(&|a, x| a.sqq * first_ratio(x) + a.stt * (Bessel::Zero.at(x) - first_ratio(x))),
            part(&|a, x| a.szz * Bessel::Zero.at(x)),
            part(&|a, x| a.sqz * Bessel::One.at(x)),
        ]
    }

    /// Stresses at the distance s from the axis of a disc of the given radius under a unit shear traction.
    pub fn sheared_disc(&self, depth: Depth, radius: f64, s: f64) -> ShearComponents {
        let amplitudes = self.shear_amplitudes(depth);
        let end = DEPTH_CUTOFF / depth.z;
        let part = |f: &dyn Fn(&Amplitudes, &Antiplane, f64) -> f64| {
            let integrand = |q: f64| {
                let (along, across) = amplitudes(q);
                radius * f(&along, &across, q * s)
            };
            hankel(Bessel::One, radius, end, QUADRATURE, integrand).value
        };
        let [zero, one] = [Bessel::Zero, Bessel::One].map(|bessel| move |x: f64| bessel.at(x));
        [
            part(&|a, _, x| a.szz * one(x)),
            part(&|a, t, x| a.sqq * (one(x) - second_ratio(x)) + (a.stt + 2.0 * t.sqt) * second_ratio(x)),
            part(&|a, t, x| {
                a.sqq * second_ratio(x) + a.stt * (one(x) - second_ratio(x)) - 2.0 * t.sqt * second_ratio(x)
            }),
            part(&|a, t, x| a.sqz * (zero(x) - first_ratio(x)) + t.stz * first_ratio(x)),
            part(&|a, t, x| (a.sqq - a.stt) * second_ratio(x) + t.sqt * (one(x) - 2.0 * second_ratio(x))),
            part(&|a, t, x| a.sqz * first_ratio(x) + t.stz * (zero(x) - first_ratio(x))),
        ]
    }
}

/// J₁(x)/x, ½ at x = 0.
fn first_ratio(x: f64) -> f64 {
    if x > 1e-4 { Bessel::One.at(x) / x } else { 0.5 - x * x / 16.0 }
}

/// J₂(x)/x, 0 at x = 0.
fn second_ratio(x: f64) -> f64 {
    if x > 1e-4 { Bessel::Two.at(x) / x } else { 0.125 * x }
}

/// Adds `factor` times stresses in cylindrical components around an axis that lies at −`[x, y]`.
pub(super) fn add(state: &mut StressState, [rr, tt, zz, rz]: NormalComponents, [x, y]: [f64; 2], factor: f64) {
    let r = x.hypot(y);
    let (c, s) = if r > 0.0 { (x / r, y / r) } else { (1.0, 0.0) };
    state.xx += factor * (rr * c * c + tt * s * s);
    state.yy += factor * (rr * s * s + tt * c * c);
    state.xy += factor * (rr - tt) * c * s;
    state.zz += factor * zz;
    state.xz += factor * rz * c;
    state.yz += factor * rz * s;
}

/// Adds stresses under a unit shear force, around an axis that lies at −`[x, y]`, times the `force` [Q_x, Q_y].
pub(super) fn add_sheared(
    state: &mut StressState,
    [zz, rr, tt, rz, rt, tz]: ShearComponents,
    [x, y]: [f64; 2],
    force: [f64; 2],
) {
    let r = x.hypot(y);
    let (c, s) = if r > 0.0 { (x / r, y / r) } else { (1.0, 0.0) };
    // Q cos φ and Q sin φ.
    let (along, across) = (force[0] * c + force[1] * s, force[0] * s - force[1] * c);
    let [zz, rr, tt, rz] = [zz, rr, tt, rz].map(|stress| stress * along);
    let [rt, tz] = [rt, tz].map(|stress| -stress * across);
    state.xx += rr * c * c + tt * s * s - 2.0 * rt * s * c;
    state.yy += rr * s * s + tt * c * c + 2.0 * rt * s * c;
    state.xy += (rr - tt) * s * c + rt * (c * c - s * s);
    state.zz += zz;
    state.xz += rz * c - tz * s;
    state.yz += rz * s + tz * c;
}

impl<const K: usize> ForceStress<K> {
    /// Series on [0, z/2], [z/2, 0.8 z] and so on by 1.6 up to `reach`, of the function `exact` of the distance.
    pub fn new(exact: impl Fn(f64) -> [f64; K] + Sync, z: f64, reach: f64) -> Self {
        let mut bounds = vec![0.0, 0.5 * z];
        while bounds[bounds.len() - 1] < reach {
            bounds.push(1.6 * bounds[bounds.len() - 1]);
        }
        let fit = |ends: &[f64]| {
            let values = Chebyshev::nodes().map(|x| exact(chebyshev::place([ends[0], ends[1]], x)));
            let series =
                |k: usize| Chebyshev::<SERIES_TERMS>::through(&values.each_ref().map(|components| components[k]));
            (ends[1], std::array::from_fn(series))
        };
        Self { intervals: bounds.par_windows(2).map(fit).collect() }
    }

    pub fn at(&self, r: f64) -> [f64; K] {
        let index = self.intervals.partition_point(|(end, _)| *end < r).min(self.intervals.len() - 1);
        let start = if index == 0 { 0.0 } else { self.intervals[index - 1].0 };
        let (end, series) = &self.intervals[index];
        let x = chebyshev::inside([start, *end], r);
        series.each_ref().map(|series| series.at(x))
    }
}
