//! The search for the largest stresses of each material and each face.
//!
//! 1. **Planes** at depths that thicken towards the faces of each material: the largest sample of each is a candidate.
//!    A plane holds as many points as the waves that reach its depth need, and is used up row by row.
//! 2. **Refinement** of the best candidate of a material: parabolas through neighbouring points horizontally and golden
//!    sections in depth, in turn, on the exact sum over waves, until nothing moves. On a face the depth stays.
//!
//! Within two samples of the surface, where the series converges slowly, the samples of the pressure's own grid are taken as
//! they are.

use super::field::StressField;
use super::maxima::{Extremes, Maxima, NEAR};
use super::peak::Peak;
use super::quantity::{QUANTITIES, Quantity};
use super::slice::{Slice, Stresses};
use super::surface::Flat;
use super::tensor::State;
use super::transform::Transform;
use crate::body::Depth;
use crate::numeric::fourier::fast_points;
use crate::numeric::search::{first_largest, golden_maximum};
use std::sync::Arc;

/// Ratio of successive distances from a face.
const RATIO: f64 = 1.35;
/// Waves with qz beyond this are left out of the search: e^{−25} of the pressure.
const SEARCH_REACH: f64 = 25.0;
/// The same on planes, whose largest samples the search starts from.
const PLANE_REACH: f64 = 10.0;

/// Relative accuracy of a depth.
const DEPTH_TOLERANCE: f64 = 2e-3;

/// The best sample of a plane.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    value: f64,
    depth: Depth,
    place: [f64; 2],
    /// Distance to neighbouring samples.
    step: f64,
}

impl StressField {
    /// Maxima over all materials and faces. `radii`: the smallest and the largest contact radius (or half the width of
    /// a contact), lengths.
    pub fn maxima(&self, radii: [f64; 2]) -> Maxima {
        let mut faces = Vec::new();
        let mut materials = Vec::new();
        let crest = self.crest();
        for material in 1..=self.materials() {
            let depths = self.search_depths(material, radii);
            let mut candidates: Vec<[Candidate; 2]> =
                depths.iter().map(|&z| self.candidates(Depth { z, material }, radii[0])).collect();
            let crest = crest.filter(|_| material == 1);
            if let Some(crest) = crest {
                candidates[0][Quantity::Tension as usize].value = crest.peak.value;
            }
            let on_face = |index: usize| {
                Extremes::of(|quantity| match crest {
                    Some(crest) if index == 0 && quantity == Quantity::Tension => crest.peak,
                    _ => self.face_peak(&candidates[index][quantity as usize], quantity),
                })
            };
            let is_finite = self.half_space().faces(material).1.is_finite();
            let own: Vec<(usize, Extremes)> = [Some(0), is_finite.then_some(depths.len() - 1)]
                .into_iter()
                .flatten()
                .map(|k| (k, on_face(k)))
                .collect();
            materials.push(Extremes::of(|quantity| {
                let value = |index: usize| candidates[index][quantity as usize].value;
                let best = (0..depths.len()).max_by(|&a, &b| value(a).total_cmp(&value(b))).unwrap_or(0);
                let inside = match own.iter().find(|&&(index, _)| index == best) {
                    Some((_, extremes)) => extremes.get(quantity),
                    None => self.refined(&candidates[best][quantity as usize], quantity, &depths, best),
                };
                own.iter().map(|(_, extremes)| extremes.get(quantity)).fold(inside, Peak::higher)
            }));
            faces.extend(own.into_iter().map(|(_, extremes)| extremes));
        }
        let (resolution, spacing) = (self.regions().least_resolution(), self.grid().spacing());
        Maxima { materials, faces, crest, resolution, spacing }
    }

    /// Depths at which planes are searched, ascending, faces first and last.
    fn search_depths(&self, material: usize, [small, large]: [f64; 2]) -> Vec<f64> {
        let (top, bottom) = self.half_space().faces(material);
        let least = 0.1 * if small > 0.0 { small } else { self.grid().spacing() };
        // Below some six radii, or the cell, and a few coating thicknesses stresses only fall.
        let reach = 6.0 * large.min(self.grid().cell().reduced().longer_side()) + 3.0 * top;
        let most = if bottom.is_finite() { 0.5 * (bottom - top) } else { reach };
        let mut depths = vec![top];
        let mut distance = least;
        while distance < most.min(reach) {
            depths.push(top + distance);
            if bottom.is_finite() {
                depths.push(bottom - distance);
            }
            distance *= RATIO;
        }
        if bottom.is_finite() {
            depths.extend([0.5 * (top + bottom), bottom]);
        }
        depths.sort_by(f64::total_cmp);
        depths.dedup();
        depths
    }

    /// The best samples of the plane at a depth, for τ₁ and σ₁.
    fn candidates(&self, depth: Depth, radius: f64) -> [Candidate; 2] {
        let grid = self.grid();
        let lengths = grid.cell().vectors().map(|[x, y]| x.hypot(y));
        let points = [0, 1].map(|k| {
            let (n, length) = (grid.points()[k], lengths[k]);
            let needed = (PLANE_REACH * length / (std::f64::consts::PI * depth.z)).max(8.0 * length / radius);
            if needed < n as f64 { fast_points(needed.ceil() as usize).min(n) } else { n }
        });
        let largest_of_rows = self.largest_of_rows(depth, &Transform::new(points));
        let [n1, n2] = points.map(|n| n as f64);
        QUANTITIES.map(|quantity| {
            let of_rows = || largest_of_rows.iter().map(|row| row[quantity as usize]);
            let (i, value) = first_largest(of_rows().map(|(_, value)| value)).unwrap_or((0, f64::NEG_INFINITY));
            let j = of_rows().nth(i).map_or(0, |(j, _)| j);
            let place = grid.cell().point([i as f64 / n1, j as f64 / n2]);
            Candidate { value, depth, place, step: 0.5 * (lengths[0] / n1).min(lengths[1] / n2) }
        })
    }

    /// Index and value of the largest τ₁ and σ₁ of each row of a plane.
    fn largest_of_rows(&self, depth: Depth, transform: &Transform) -> Vec<[(usize, f64); 2]> {
        let slice = self.slice(depth, PLANE_REACH);
        let largest = |states: Vec<State>| QUANTITIES.map(|quantity| quantity.largest(&states));
        if depth == Depth::SURFACE {
            // σ_zz is −p, and the shear what friction makes of it.
            let [tx, ty] = self.traction();
            let columns = self.series.on_plane(transform, Vec::new(), &Flat::new(&Arc::new(slice), |_| 1.0));
            return columns.map(|_, [xx, yy, xy, p]| {
                let state = |j: usize| State {
                    xx: xx[j],
                    yy: yy[j],
                    xy: xy[j],
                    zz: -p[j],
                    xz: -tx * p[j],
                    yz: -ty * p[j],
                    ..State::default()
                };
                largest((0..p.len()).map(state).collect())
            });
        }
        let columns = self.series.on_plane(transform, Vec::new(), &Stresses(&slice));
        columns.map(|_, row| {
            largest((0..row[0].len()).map(|j| State::from_stresses(row.map(|component| component[j]))).collect())
        })
    }

    /// The peak on a face: between the samples of the plane by the exact sum, or, where that converges slowly, the
    /// sample itself.
    fn face_peak(&self, candidate: &Candidate, quantity: Quantity) -> Peak {
        if candidate.depth.z < NEAR * self.grid().spacing() {
            return self.peak(candidate);
        }
        self.peak(&self.horizontally(candidate, quantity))
    }

    /// The best peak near the candidate of plane `index`, the depth between those of the neighbouring planes.
    fn refined(&self, candidate: &Candidate, quantity: Quantity, depths: &[f64], index: usize) -> Peak {
        if candidate.depth.z < NEAR * self.grid().spacing() {
            return self.peak(candidate);
        }
        let low = depths[index.saturating_sub(1)];
        let high = depths.get(index + 1).copied().unwrap_or(candidate.depth.z);
        let mut best = *candidate;
        for _ in 0..3 {
            best = self.horizontally(&best, quantity);
            let before = best.depth.z;
            best = self.vertically(&best, quantity, [low, high]);
            if (best.depth.z - before).abs() < 1e-3 * before {
                break;
            }
        }
        self.peak(&best)
    }

    /// A candidate as it is, with the direction of σ₁ there.
    fn peak(&self, candidate: &Candidate) -> Peak {
        let [x, y] = candidate.place;
        let state = self.searched(&self.slice(candidate.depth, SEARCH_REACH), &[candidate.place])[0];
        Peak {
            value: candidate.value,
            position: [x, y, candidate.depth.z],
            material: candidate.depth.material,
            direction: state.s1_direction(),
        }
    }

    /// Stresses at places (x, y) of a slice.
    fn searched(&self, slice: &Slice, places: &[[f64; 2]]) -> Vec<State> {
        self.at(places, &Stresses(slice)).into_iter().map(State::from_stresses).collect()
    }

    /// Moves a candidate to the top of the paraboloid through 3 × 3 points around it, with smaller and smaller steps.
    fn horizontally(&self, candidate: &Candidate, quantity: Quantity) -> Candidate {
        let mut best = *candidate;
        let slice = self.slice(best.depth, SEARCH_REACH);
        for _ in 0..4 {
            let [x, y] = best.place;
            let step = best.step;
            let around: Vec<[f64; 2]> =
                (0..9).map(|k| [x + (f64::from(k / 3) - 1.0) * step, y + (f64::from(k % 3) - 1.0) * step]).collect();
            let values: Vec<f64> = self.searched(&slice, &around).iter().map(|state| quantity.of(state)).collect();
            let highest = (0..9).max_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(4);
            best.value = values[highest];
            best.place = around[highest];
            if highest == 4 {
                let [dx, dy] = [[1, 7], [3, 5]].map(|[before, after]| {
                    let curvature = values[before] + values[after] - 2.0 * values[4];
                    let slope = 0.5 * (values[after] - values[before]);
                    if curvature < 0.0 { (-slope / curvature).clamp(-1.0, 1.0) * step } else { 0.0 }
                });
                let moved = [x + dx, y + dy];
                let value = quantity.of(&self.searched(&slice, &[moved])[0]);
                if value > best.value {
                    (best.value, best.place) = (value, moved);
                }
                best.step *= 0.3;
            }
        }
        best
    }

    /// Moves a candidate in depth within [low, high] by golden sections.
    fn vertically(&self, candidate: &Candidate, quantity: Quantity, [low, high]: [f64; 2]) -> Candidate {
        let material = candidate.depth.material;
        let value = |z: f64| {
            let slice = self.slice(Depth { z, material }, SEARCH_REACH);
            quantity.of(&self.searched(&slice, &[candidate.place])[0])
        };
        let [z, found] = golden_maximum([low, high], DEPTH_TOLERANCE, value);
        if found > candidate.value {
            Candidate { value: found, depth: Depth { z, material }, ..*candidate }
        } else {
            *candidate
        }
    }
}
