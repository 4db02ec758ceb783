//! The search for the largest stresses of each material and each face.
//!
//! 1. **Planes** at depths that thicken towards the faces of each material: the largest sample of each is a candidate.
//!    A plane holds as many points as the waves that reach its depth need, and is used up row by row.
//! 2. **Refinement** of the best candidate of a material: parabolas through neighbouring points horizontally and golden
//!    sections in depth, in turn, on the exact sum over waves, until nothing moves. On a face the depth stays.
//!
//! Within two samples of the surface, where the series converges slowly, the samples of the pressure's own grid are taken as
//! they are.

use super::crest::Crest;
use super::field::StressField;
use super::maxima::{Carried, Extremes, Maxima, NEAR};
use super::peak::Peak;
use super::quantity::{OVERALL, Quantity};
use super::slice::{Slice, Stresses};
use super::surface::Flat;
use super::tensor::State;
use super::transform::Transform;
use crate::body::{Depth, Layer};
use crate::numeric::fourier::fast_points;
use crate::numeric::search::{first_largest, golden_maximum};
use std::sync::Arc;

/// Ratio of successive distances from a face.
const RATIO: f64 = 1.35;
/// Waves with qz beyond this are left out of the search: e^{−25} of the pressure.
const SEARCH_REACH: f64 = 25.0;
/// The same on planes, whose largest samples the search starts from.
const PLANE_REACH: f64 = 10.0;

/// How often the steps become smaller, and how many steps there are at most.
const TOPS: usize = 4;
const MOVES: usize = 24;

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

/// A plane that was searched.
#[derive(Debug)]
struct Searched {
    /// The best sample for each quantity that was looked for.
    best: Vec<(Quantity, Candidate)>,
    /// Peaks, where the plane is a face.
    peaks: Vec<(Quantity, Peak)>,
}

impl Searched {
    fn candidate(&self, quantity: Quantity) -> &Candidate {
        &found(&self.best, quantity).expect("every plane was searched for it").1
    }

    fn peak(&self, quantity: Quantity) -> Option<Peak> {
        found(&self.peaks, quantity).map(|&(_, peak)| peak)
    }
}

fn found<T>(all: &[(Quantity, T)], quantity: Quantity) -> Option<&(Quantity, T)> {
    all.iter().find(|(own, _)| *own == quantity)
}

impl StressField {
    /// Maxima over all materials, faces and interfaces. `radii`: the smallest and the largest contact radius (or half the
    /// width of a contact), lengths.
    pub fn maxima(&self, radii: [f64; 2]) -> Maxima {
        let (mut faces, mut materials, mut interfaces) = (Vec::new(), Vec::new(), Vec::new());
        let crests = self.crests();
        for material in 1..=self.materials() {
            let strength = self.half_space().layers().get(material - 1).map(Layer::interface_strength);
            let depths = self.search_depths(material, radii);
            let plane = |index: usize| {
                let is_interface = index + 1 == depths.len();
                let tractions = strength.filter(|_| is_interface).into_iter().flat_map(Quantity::of_interface);
                let quantities: Vec<Quantity> = OVERALL.into_iter().chain(tractions).collect();
                let is_face = index == 0 || strength.is_some() && is_interface;
                let depth = Depth { z: depths[index], material };
                let crests = if depth == Depth::SURFACE { &crests[..] } else { &[] };
                self.search_plane(depth, radii[0], &quantities, is_face, crests)
            };
            let planes: Vec<Searched> = (0..depths.len()).map(plane).collect();
            let overall = |quantity: Quantity| {
                let value = |index: usize| planes[index].candidate(quantity).value;
                let best = (0..planes.len()).max_by(|&a, &b| value(a).total_cmp(&value(b))).unwrap_or(0);
                let inside = planes[best]
                    .peak(quantity)
                    .unwrap_or_else(|| self.refined(planes[best].candidate(quantity), quantity, &depths, best));
                planes.iter().filter_map(|plane| plane.peak(quantity)).fold(inside, Peak::higher)
            };
            materials.push(extremes(overall));
            let on_face = |plane: &Searched| extremes(|quantity| plane.peak(quantity).expect("a face has its peaks"));
            faces.extend(planes.iter().filter(|plane| !plane.peaks.is_empty()).map(on_face));
            if let Some((strength, lower)) = strength.zip(planes.last()) {
                let peak = |quantity: Quantity| lower.peak(quantity);
                if let Some((normal, shear)) = peak(Quantity::Opening).zip(peak(Quantity::Shear)) {
                    let delamination = peak(Quantity::Delamination(strength));
                    interfaces.push(Carried { interface: material, normal, shear, delamination });
                }
            }
        }
        let crest = |quantity: Quantity| found(&crests, quantity).map(|&(_, crest)| crest);
        let (resolution, spacing) = (self.regions().least_resolution(), self.grid().spacing());
        let others = [Quantity::Tau1, Quantity::Mises].map(crest);
        Maxima { materials, faces, interfaces, crest: crest(Quantity::Tension), others, resolution, spacing }
    }

    /// The best samples of a plane, and the peaks of a face; the surface has `crests` of its own.
    fn search_plane(
        &self,
        depth: Depth,
        radius: f64,
        quantities: &[Quantity],
        is_face: bool,
        crests: &[(Quantity, Crest)],
    ) -> Searched {
        let mut best = self.candidates(depth, radius, quantities);
        for (quantity, candidate) in &mut best {
            if let Some((_, crest)) = found(crests, *quantity) {
                candidate.value = crest.peak.value;
            }
        }
        let peak = |(quantity, candidate): &(Quantity, Candidate)| {
            let crest = found(crests, *quantity).map(|(_, crest)| crest.peak);
            (*quantity, crest.unwrap_or_else(|| self.face_peak(candidate, *quantity)))
        };
        let peaks = if is_face { best.iter().map(peak).collect() } else { Vec::new() };
        Searched { best, peaks }
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

    /// The best samples of the plane at a depth.
    fn candidates(&self, depth: Depth, radius: f64, quantities: &[Quantity]) -> Vec<(Quantity, Candidate)> {
        let grid = self.grid();
        let lengths = grid.cell().vectors().map(|[x, y]| x.hypot(y));
        let points = [0, 1].map(|k| {
            let (n, length) = (grid.points()[k], lengths[k]);
            let needed = (PLANE_REACH * length / (std::f64::consts::PI * depth.z)).max(8.0 * length / radius);
            if needed < n as f64 { fast_points(needed.ceil() as usize).min(n) } else { n }
        });
        let largest_of_rows = self.largest_of_rows(depth, &Transform::new(points), quantities);
        let [n1, n2] = points.map(|n| n as f64);
        let candidate = |(index, &quantity): (usize, &Quantity)| {
            let of_rows = || largest_of_rows.iter().map(|row| row[index]);
            let (i, value) = first_largest(of_rows().map(|(_, value)| value)).unwrap_or((0, f64::NEG_INFINITY));
            let j = of_rows().nth(i).map_or(0, |(j, _)| j);
            let place = grid.cell().point([i as f64 / n1, j as f64 / n2]);
            (quantity, Candidate { value, depth, place, step: 0.5 * (lengths[0] / n1).min(lengths[1] / n2) })
        };
        quantities.iter().enumerate().map(candidate).collect()
    }

    /// Index and value of the largest of each quantity in each row of a plane.
    fn largest_of_rows(&self, depth: Depth, transform: &Transform, quantities: &[Quantity]) -> Vec<Vec<(usize, f64)>> {
        let slice = self.slice(depth, PLANE_REACH);
        let largest = |states: Vec<State>| quantities.iter().map(|quantity| quantity.largest(&states)).collect();
        if depth == Depth::SURFACE {
            let traction = self.traction();
            let columns = self.series.on_plane(transform, Vec::new(), &Flat::new(&Arc::new(slice), |_| 1.0));
            return columns.map(|_, row| {
                let state = |j: usize| State::on_surface(row.map(|component| component[j]), traction);
                largest((0..row[0].len()).map(state).collect())
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
            error: None,
            rival: None,
        }
    }

    /// Stresses at places (x, y) of a slice.
    fn searched(&self, slice: &Slice, places: &[[f64; 2]]) -> Vec<State> {
        self.at(places, &Stresses(slice)).into_iter().map(State::from_stresses).collect()
    }

    /// Moves a candidate to the top of the paraboloid through 3 × 3 points around it, with smaller and smaller steps, once it
    /// has climbed to where none of them is higher: along a ridge that may be far.
    fn horizontally(&self, candidate: &Candidate, quantity: Quantity) -> Candidate {
        let mut best = *candidate;
        let slice = self.slice(best.depth, SEARCH_REACH);
        let mut tops = 0;
        for _ in 0..MOVES {
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
                tops += 1;
                if tops == TOPS {
                    break;
                }
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

fn extremes(peak: impl Fn(Quantity) -> Peak) -> Extremes {
    Extremes { tau1: peak(Quantity::Tau1), tension: peak(Quantity::Tension), mises: peak(Quantity::Mises) }
}
