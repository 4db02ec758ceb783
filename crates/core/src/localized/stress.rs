//! Stresses below a localized solution, at single points.
//!
//! Under uncoupled friction every force has its shear force: stresses superpose.
//!
//! Elements of the spot itself act as forces at the 2 × 2 points of Gauss' rule, which errs by 1e-4 of an element's
//! stress from a depth of two elements on; those of its neighbours as forces at their centres. The pressure outside the
//! circle is p̄ everywhere, whose lateral stress is that of [`MeanStress`], minus p̄ on the disc (`subsurface.rs`).

use super::solution::Solution;
use super::subsurface::{ForceStress, Subsurface, add, add_sheared};
use crate::body::{Depth, MeanStress};
use crate::friction::Friction;
use crate::numeric::parallel;
use crate::stress::StressState;

/// Least depth at which stresses are computed, in elements.
pub const LEAST_DEPTH: f64 = 2.0;

/// The stress field of a localized solution.
#[derive(Debug, Clone)]
pub struct LocalizedField<'a> {
    solution: &'a Solution,
    subsurface: Subsurface,
    mean: Vec<f64>,
    residual: Vec<f64>,
    /// μ **e** of a sliding counterbody; `None` without traction.
    traction: Option<[f64; 2]>,
}

impl<'a> LocalizedField<'a> {
    /// Field of a solution, under the traction that uncoupled `friction` adds to its pressure.
    pub fn new(solution: &'a Solution, friction: Option<&Friction>, mean: MeanStress) -> Self {
        let half_space = solution.system().half_space();
        Self {
            solution,
            subsurface: Subsurface::new(half_space),
            mean: mean.lateral(half_space),
            residual: half_space.residual_stresses().collect(),
            traction: friction.map(Friction::traction).filter(|traction| *traction != [0.0; 2]),
        }
    }

    /// Whether the depth `z` is large enough for elements to act as point forces.
    pub fn reaches(&self, z: f64) -> bool {
        let element = self.solution.spots.iter().map(|spot| spot.mesh.size).fold(0.0, f64::max);
        z >= LEAST_DEPTH * element
    }

    /// Stresses (no displacements) at one depth and at points (x, y) measured from the axis of the spot `centre` of
    /// the solution; `None` above two element sizes.
    pub fn points(&self, centre: usize, depth: Depth, points: &[[f64; 2]]) -> Option<Vec<StressState>> {
        if !self.reaches(depth.z) {
            return None;
        }
        let spot = &self.solution.spots[centre];
        let forces = self.forces(centre);
        let distance = |p: &[f64; 2], f: &([f64; 2], f64)| (p[0] - f.0[0]).hypot(p[1] - f.0[1]);
        let reach = points.iter().flat_map(|p| forces.iter().map(move |f| distance(p, f))).fold(0.0, f64::max);
        let pressed = ForceStress::new(|r| self.subsurface.force(depth, r), depth.z, reach);
        let sheared = self
            .traction
            .map(|traction| (traction, ForceStress::new(|r| self.subsurface.shear_force(depth, r), depth.z, reach)));
        let mean_pressure = self.solution.mean_pressure;
        let residual = self.residual[depth.material - 1];
        let states = parallel::map_items(points, |&[x, y]| {
            let mut state = StressState { xx: residual, yy: residual, ..StressState::default() };
            for &([u, v], force) in &forces {
                let (distance, away) = ((x - u).hypot(y - v), [x - u, y - v]);
                add(&mut state, pressed.at(distance), away, force);
                if let Some((traction, sheared)) = &sheared {
                    add_sheared(&mut state, sheared.at(distance), away, traction.map(|t| t * force));
                }
            }
            if spot.radius.is_finite() {
                let lateral = self.mean[depth.material - 1];
                (state.xx, state.yy) = (state.xx + mean_pressure * lateral, state.yy + mean_pressure * lateral);
                state.zz -= mean_pressure;
                let disc = self.subsurface.disc(depth, spot.radius, x.hypot(y));
                add(&mut state, disc, [x, y], -mean_pressure);
                if let Some([tx, ty]) = self.traction {
                    (state.xz, state.yz) = (state.xz - mean_pressure * tx, state.yz - mean_pressure * ty);
                    let disc = self.subsurface.sheared_disc(depth, spot.radius, x.hypot(y));
                    add_sheared(&mut state, disc, [x, y], [-mean_pressure * tx, -mean_pressure * ty]);
                }
            }
            state
        });
        Some(states)
    }

    /// Points (x, y) from the axis of a spot, lengths, and forces of all elements inside its circle.
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
}
