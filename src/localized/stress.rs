//! Stresses below a localized solution, at single points.
//!
//! A unit force on the surface causes, with the amplitudes of [`crate::body::Interior`] and x = qr,
//!
//! σ_zz = (1/2π) ∫ s_zz J₀ q dq,  σ_rz = (1/2π) ∫ s_qz J₁ q dq,
//! σ_rr = (1/2π) ∫ [s_qq (J₀ − J₁/x) + s_tt J₁/x] q dq,  σ_tt = (1/2π) ∫ [s_qq J₁/x + s_tt (J₀ − J₁/x)] q dq.
//!
//! Elements of the spot itself act as forces at the 2 × 2 points of Gauss' rule, which errs by 1e-4 of an element's
//! stress from a depth of two elements on; those of its neighbours as forces at their centres. The pressure outside the
//! circle is p̄ everywhere, whose lateral stress is named by [`MeanStress`], minus p̄ on the disc: the same integrals with R J₁(qR) in the place of q/2π.

use super::quadrature::{Bessel, hankel};
use super::solution::Solution;
use crate::body::{Amplitudes, Depth, Interior, MeanStress, TransferFunction};
use crate::numeric::chebyshev::{self, Chebyshev};
use crate::stress::State;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Least depth at which stresses are offered, in elements.
pub const LEAST_DEPTH: f64 = 2.0;
/// qz at which all amplitudes have died out.
const EXTINCT: f64 = 45.0;
/// Relative tolerance of the integrals: amplitudes are exact to some 1e-11 of the pressure.
const QUADRATURE: f64 = 1e-9;
/// Terms of one Chebyshev series of a radial function.
const TERMS: usize = 20;

/// Stresses in cylindrical components around the axis of a load.
#[derive(Debug, Clone, Copy, Default)]
struct Cylindrical {
    rr: f64,
    tt: f64,
    zz: f64,
    rz: f64,
}

/// The half-space's stresses at one depth under a unit force, up to a distance.
#[derive(Debug, Clone)]
struct ForceStress {
    /// Upper ends of the intervals of r, and the series of the four components over each.
    intervals: Vec<(f64, [Chebyshev<TERMS>; 4])>,
}

/// The stress field of a localized solution around one spot.
#[derive(Debug, Clone)]
pub struct LocalizedField<'a> {
    solution: &'a Solution,
    transfer: TransferFunction,
    mean: Vec<f64>,
}

impl<'a> LocalizedField<'a> {
    /// Field of a solution.
    pub fn new(solution: &'a Solution, mean: MeanStress) -> Self {
        let half_space = solution.system().half_space();
        Self { solution, transfer: TransferFunction::new(half_space), mean: mean.lateral(half_space) }
    }

    /// Whether `z` is deep enough for the elements to act as points.
    pub fn reaches(&self, z: f64) -> bool {
        let element = self.solution.spots.iter().map(|spot| spot.mesh.size).fold(0.0, f64::max);
        z >= LEAST_DEPTH * element
    }

    /// Stresses (no displacements) at one depth and at points (x, y) measured from the axis of the spot `centre` of
    /// the solution; `None` above two element sizes.
    pub fn points(&self, centre: usize, depth: Depth, points: &[[f64; 2]]) -> Option<Vec<State>> {
        if !self.reaches(depth.z) {
            return None;
        }
        let spot = &self.solution.spots[centre];
        let forces = self.forces(centre);
        let distance = |p: &[f64; 2], f: &([f64; 2], f64)| (p[0] - f.0[0]).hypot(p[1] - f.0[1]);
        let reach = points.iter().flat_map(|p| forces.iter().map(move |f| distance(p, f))).fold(0.0, f64::max);
        let kernel = ForceStress::new(|r| self.under_force(depth, r), depth.z, reach);
        let mean_pressure = self.solution.mean_pressure;
        let states = points.par_iter().map(|&[x, y]| {
            let mut state = State::default();
            for &([u, v], force) in &forces {
                add(&mut state, kernel.at((x - u).hypot(y - v)), [x - u, y - v], force);
            }
            if spot.radius.is_finite() {
                let lateral = self.mean[depth.material - 1];
                (state.xx, state.yy) = (state.xx + mean_pressure * lateral, state.yy + mean_pressure * lateral);
                state.zz -= mean_pressure;
                let disc = self.under_disc(depth, spot.radius, x.hypot(y));
                add(&mut state, disc, [x, y], -mean_pressure);
            }
            state
        });
        Some(states.collect())
    }

    /// All forces inside the circle around a spot, with their places from its axis.
    fn forces(&self, centre: usize) -> Vec<([f64; 2], f64)> {
        let spot = &self.solution.spots[centre];
        let mut forces = Vec::new();
        for (source, images) in self.solution.spots.iter().zip(&spot.circle.images) {
            let (size, offset) = (source.mesh.size, 0.5 * source.mesh.size / 3f64.sqrt());
            for (index, &p) in source.pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                let ([x, y], force) = (source.mesh.place(index), p * size * size);
                for &[u, v] in images {
                    if [u, v] == [0.0, 0.0] {
                        let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
                        forces.extend(corners.map(|(s, t)| ([x + s * offset, y + t * offset], 0.25 * force)));
                    } else {
                        forces.push(([x + u, y + v], force));
                    }
                }
            }
        }
        forces
    }

    /// Amplitudes at a depth, as a function of the wavenumber.
    fn amplitudes(&self, depth: Depth) -> impl Fn(f64) -> Amplitudes + use<'_> {
        move |q| Interior::new(&self.transfer, q).at(depth)
    }

    /// Stresses at the distance r from the axis of a unit force.
    fn under_force(&self, depth: Depth, r: f64) -> Cylindrical {
        let amplitudes = self.amplitudes(depth);
        let end = EXTINCT / depth.z;
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
        Cylindrical {
            rr: part(Bessel::Zero, &|a| a.sqq) + difference,
            tt: part(Bessel::Zero, &|a| a.stt) - difference,
            zz: part(Bessel::Zero, &|a| a.szz),
            rz: if r > 0.0 { part(Bessel::One, &|a| a.sqz) } else { 0.0 },
        }
    }

    /// Stresses at the distance s from the axis of a disc of the given radius under unit pressure.
    fn under_disc(&self, depth: Depth, radius: f64, s: f64) -> Cylindrical {
        let amplitudes = self.amplitudes(depth);
        let end = EXTINCT / depth.z;
        let part = |f: &dyn Fn(&Amplitudes, f64) -> f64| {
            hankel(Bessel::One, radius, end, QUADRATURE, |q| radius * f(&amplitudes(q), q * s)).value
        };
        let ratio = |x: f64| if x > 1e-4 { Bessel::One.at(x) / x } else { 0.5 - x * x / 16.0 };
        Cylindrical {
            rr: part(&|a, x| a.sqq * (Bessel::Zero.at(x) - ratio(x)) + a.stt * ratio(x)),
            tt: part(&|a, x| a.sqq * ratio(x) + a.stt * (Bessel::Zero.at(x) - ratio(x))),
            zz: part(&|a, x| a.szz * Bessel::Zero.at(x)),
            rz: part(&|a, x| a.sqz * Bessel::One.at(x)),
        }
    }
}

/// Adds `factor` times stresses in cylindrical components around an axis that lies at −`[x, y]`.
fn add(state: &mut State, stress: Cylindrical, [x, y]: [f64; 2], factor: f64) {
    let r = x.hypot(y);
    let (c, s) = if r > 0.0 { (x / r, y / r) } else { (1.0, 0.0) };
    let Cylindrical { rr, tt, zz, rz } = stress;
    state.xx += factor * (rr * c * c + tt * s * s);
    state.yy += factor * (rr * s * s + tt * c * c);
    state.xy += factor * (rr - tt) * c * s;
    state.zz += factor * zz;
    state.xz += factor * rz * c;
    state.yz += factor * rz * s;
}

impl ForceStress {
    /// Series on [0, z/2], [z/2, 0.8 z] and so on by 1.6 up to `reach`, of the function `exact` of the distance.
    fn new(exact: impl Fn(f64) -> Cylindrical + Sync, z: f64, reach: f64) -> Self {
        let mut bounds = vec![0.0, 0.5 * z];
        while bounds[bounds.len() - 1] < reach {
            bounds.push(1.6 * bounds[bounds.len() - 1]);
        }
        let fit = |ends: &[f64]| {
            let values = Chebyshev::nodes().map(|x| exact(chebyshev::place([ends[0], ends[1]], x)));
            let series =
                |component: fn(&Cylindrical) -> f64| Chebyshev::<TERMS>::through(&values.each_ref().map(component));
            (ends[1], [series(|c| c.rr), series(|c| c.tt), series(|c| c.zz), series(|c| c.rz)])
        };
        Self { intervals: bounds.par_windows(2).map(fit).collect() }
    }

    fn at(&self, r: f64) -> Cylindrical {
        let index = self.intervals.partition_point(|(end, _)| *end < r).min(self.intervals.len() - 1);
        let start = if index == 0 { 0.0 } else { self.intervals[index - 1].0 };
        let (end, series) = &self.intervals[index];
        let x = chebyshev::inside([start, *end], r);
        let [rr, tt, zz, rz] = series.each_ref().map(|series| series.at(x));
        Cylindrical { rr, tt, zz, rz }
    }
}
