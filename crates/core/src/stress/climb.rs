//! Local maximum of a stress measure inside a material, by a trust-region method.
//!
//! The stresses are [expanded](super::expansion) to second order at a point, and the highest value of the expansion within a
//! trust region around it gives the next point. The region keeps its size after a step to its border, and shrinks otherwise. The
//! search ends where the expansion predicts no further rise; the value stated is the exact sum at the last point. Steps in depth
//! end at the faces of the material.
//!
//! Within the region 3 × 3 points at three depths are compared: while one of them is higher, it is the next middle. Otherwise the
//! next middle is the top of the paraboloid through them, and their distances shrink.

use super::constants::DEEP_OPENING_ERROR;
use super::depth_response::{DepthResponse, StressComponents};
use super::field::StressField;
use super::measure::StressMeasure;
use super::plane_search::Candidate;
use super::taylor::Expansion;
use super::tensor::StressState;
use crate::body::Depth;

/// Largest number of expansions of one search.
const MAX_EXPANSIONS: usize = 24;
/// Largest number of times that the distances shrink within a trust region.
const MAX_REFINEMENTS: usize = 3;
/// Largest number of steps within a trust region.
const MAX_MOVES: usize = 12;
/// Factor by which distances and trust regions shrink.
const SHRINKAGE: f64 = 0.3;
/// Part of the least error that is stated of a maximum, below which a search goes no further.
const PART_OF_ERROR: f64 = 0.1;
/// Largest rise that is left, over the size of the stresses of the waves.
const MOST_LEFT: f64 = 1e-8;
/// Rise that may be rounding, over the size of all stresses.
const ROUNDING: f64 = 1e-14;
/// Least part of a step along the surface that the border of a window leaves; with less the search goes on in depth alone.
const HELD: f64 = 1e-6;
/// Offsets from the middle of a plane to the points around it: first along x and y, then the corners.
const NEIGHBOURS: [[f64; 2]; 8] =
    [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0], [-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];

/// Values in the middle of a plane and at [`NEIGHBOURS`] around it.
type NinePoints = [f64; 9];

/// Offsets from the middle of an expansion: at most `step` along x and y, within `depths` in depth; lengths.
#[derive(Debug, Clone, Copy)]
struct TrustRegion {
    step: f64,
    depths: [f64; 2],
}

impl TrustRegion {
    fn clamped(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [x, y] = [x, y].map(|d| d.clamp(-self.step, self.step));
        [x, y, z.clamp(self.depths[0], self.depths[1])]
    }

    /// Whether an offset lies on the border of the region.
    fn ends_at(&self, [x, y, z]: [f64; 3]) -> bool {
        let near = |d: f64, end: f64| end != 0.0 && (d - end).abs() <= 1e-9 * end.abs();
        near(x.abs(), self.step) || near(y.abs(), self.step) || self.depths.iter().any(|&end| near(z, end))
    }
}

impl StressField {
    /// Stresses at the points (x, y) of a depth, displacements left out.
    pub(super) fn stresses_at(&self, response: &DepthResponse, places: &[[f64; 2]]) -> Vec<StressState> {
        self.at(places, &StressComponents(response)).into_iter().map(StressState::from_stresses).collect()
    }

    /// The local maximum of a measure near a candidate, and the state there, at depths within [low, high] and where the field holds;
    /// `rise` is the first step in depth, a length, 0 for a search at one depth. The value errs by less than a tenth of the least error
    /// that is stated, [0.01/n²](DEEP_OPENING_ERROR) of the stresses of the waves with n samples along the radius of a spot, and by less than
    /// 10⁻⁸ of them.
    pub(super) fn local_maximum(
        &self,
        from: &Candidate,
        rise: f64,
        [low, high]: [f64; 2],
        measure: StressMeasure,
    ) -> (Candidate, StressState) {
        let material = from.depth.material;
        let mut here = self.expanded(Depth { z: from.depth.z.clamp(low, high), material }, from.place);
        let mut value = measure.of(&here.state());
        let (mut step, mut rise) = (from.step, rise);
        let mut top = None;
        for _ in 0..MAX_EXPANSIONS {
            let (z, [x, y]) = (here.depth.z, here.place);
            let within = TrustRegion { step, depths: [(low - z).max(-rise), (high - z).min(rise)] };
            let (moved, promised) = highest(&here, within, value, measure);
            // A value that is not a number predicts no rise.
            if promised.is_nan() || value.is_nan() || promised <= value + self.least_rise(&here, measure) {
                top = Some(moved).filter(|moved| promised > value && !within.ends_at(*moved));
                break;
            }
            let depth = Depth { z: (z + moved[2]).clamp(low, high), material };
            let place = self.grid().cell().nearest_point([x + moved[0], y + moved[1]]);
            if (place[0] - x).hypot(place[1] - y) <= HELD * moved[0].hypot(moved[1]) && depth.z == z {
                step = 0.0;
                continue;
            }
            let there = self.expanded(depth, place);
            let risen = measure.of(&there.state());
            let is_higher = risen > value && !self.is_hidden(there.place);
            if is_higher {
                (here, value) = (there, risen);
            }
            if !(is_higher && within.ends_at(moved)) {
                step *= SHRINKAGE;
                rise *= SHRINKAGE;
            }
        }
        let middle = Candidate { value, depth: here.depth, place: here.place, step };
        top.and_then(|top| self.at_top(&here, &middle, top, [low, high], measure)).unwrap_or((middle, here.state()))
    }

    /// Least predicted rise of a measure for which a search goes on from an expansion.
    fn least_rise(&self, here: &Expansion, measure: StressMeasure) -> f64 {
        let (state, n) = (here.state(), self.regions().least_resolution());
        // A field around a window has no spots.
        let part =
            if n.is_finite() { (PART_OF_ERROR * DEEP_OPENING_ERROR / (n * n)).min(MOST_LEFT) } else { MOST_LEFT };
        measure.rise(&state, part * self.size_of_waves(here.depth, &state) + ROUNDING * state.size())
    }

    /// The top of an expansion at an offset from its `middle`, with the state there; a middle on a face keeps its depth. `None` where the
    /// field does not hold, or the top is no higher.
    fn at_top(
        &self,
        here: &Expansion,
        middle: &Candidate,
        [x, y, z]: [f64; 3],
        faces: [f64; 2],
        measure: StressMeasure,
    ) -> Option<(Candidate, StressState)> {
        let z = if faces.contains(&here.depth.z) { 0.0 } else { z };
        let (state, place) = (here.at([x, y, z]), [here.place[0] + x, here.place[1] + y]);
        let value = measure.of(&state);
        let depth = Depth { z: here.depth.z + z, ..here.depth };
        let is_there = self.grid().cell().contains(place) && !self.is_hidden(place);
        let holds = value >= middle.value && (faces[0]..=faces[1]).contains(&depth.z) && is_there;
        holds.then_some((Candidate { value, depth, place, ..*middle }, state))
    }
}

/// Offset from the middle of an expansion to its highest point within a trust region, and the measure there; `value` is the
/// measure in the middle.
fn highest(expansion: &Expansion, within: TrustRegion, value: f64, measure: StressMeasure) -> ([f64; 3], f64) {
    let at = |offset: [f64; 3]| measure.of(&expansion.at(offset));
    let (mut best, mut value) = ([0.0; 3], value);
    let (mut step, mut rise) = (within.step, within.depths[1].max(-within.depths[0]));
    let mut tops = 0;
    for _ in 0..MAX_MOVES {
        let [x, y, z] = best;
        let around = |depth: f64| {
            std::array::from_fn::<[f64; 3], 9, _>(|k| {
                let [u, v] = if k == 0 { [0.0; 2] } else { NEIGHBOURS[k - 1] };
                within.clamped([x + u * step, y + v * step, depth])
            })
        };
        let [above, below] = [z - rise, z + rise].map(|depth| depth.clamp(within.depths[0], within.depths[1]));
        let depths = [above, below].into_iter().filter(|depth| *depth != z);
        let levels: Vec<(f64, [[f64; 3]; 9])> = [z].into_iter().chain(depths).map(|z| (z, around(z))).collect();
        let is_middle = |level: usize, k: usize| level == 0 && k == 0;
        let values: Vec<(f64, NinePoints)> = levels
            .iter()
            .enumerate()
            .map(|(level, (z, places))| {
                (*z, std::array::from_fn(|k| if is_middle(level, k) { value } else { at(places[k]) }))
            })
            .collect();
        let all = values.iter().zip(&levels).flat_map(|((_, values), (_, places))| values.iter().zip(places));
        let Some((&higher, &place)) = all.reduce(|a, b| if b.0 > a.0 { b } else { a }) else { break };
        if higher > value {
            // At the border too: where the measure is constant along one direction, the error of the expansion along it would
            // hide the maximum along the others.
            (best, value) = (place, higher);
            continue;
        }
        let is_centred = values.len() == 3 && (z - above - (below - z)).abs() < 1e-9 * rise;
        let [dx, dy, dz] = top(&values, is_centred);
        let moved = within.clamped([x + dx * step, y + dy * step, z + dz * rise]);
        let there = at(moved);
        if there > value {
            (best, value) = (moved, there);
        }
        step *= SHRINKAGE;
        rise *= SHRINKAGE;
        tops += 1;
        if tops == MAX_REFINEMENTS {
            break;
        }
    }
    (best, value)
}

/// Top of the paraboloid through the points, in steps from the middle, at most one along each axis; axis by axis where the
/// paraboloid has no top.
fn top(levels: &[(f64, NinePoints)], is_centred: bool) -> [f64; 3] {
    let middle = &levels[0].1;
    let (gx, gy) = (0.5 * (middle[2] - middle[1]), 0.5 * (middle[4] - middle[3]));
    let (xx, yy) = (middle[1] + middle[2] - 2.0 * middle[0], middle[3] + middle[4] - 2.0 * middle[0]);
    let xy = 0.25 * (middle[5] + middle[8] - middle[6] - middle[7]);
    let (mut gz, mut zz, mut xz, mut yz) = (0.0, -1.0, 0.0, 0.0);
    if is_centred {
        let (up, down) = (&levels[1].1, &levels[2].1);
        gz = 0.5 * (down[0] - up[0]);
        zz = up[0] + down[0] - 2.0 * middle[0];
        xz = 0.25 * (down[2] - down[1] - up[2] + up[1]);
        yz = 0.25 * (down[4] - down[3] - up[4] + up[3]);
    }
    // −H d = g by Cramer's rule; −H is positive definite where there is a top.
    let [a, b, c, d, e, f] = [-xx, -yy, -zz, -xy, -xz, -yz];
    let minor = a * b - d * d;
    let all = a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e);
    let within = |t: f64| if t.is_finite() { t.clamp(-1.0, 1.0) } else { 0.0 };
    if a > 0.0 && minor > 0.0 && all > 0.0 {
        let x = gx * (b * c - f * f) - d * (gy * c - f * gz) + e * (gy * f - b * gz);
        let y = a * (gy * c - gz * f) - gx * (d * c - f * e) + e * (d * gz - gy * e);
        let z = a * (b * gz - f * gy) - d * (d * gz - gy * e) + gx * (d * f - b * e);
        return [x / all, y / all, z / all].map(within);
    }
    let axis = |slope: f64, curvature: f64| if curvature < 0.0 { within(-slope / curvature) } else { 0.0 };
    [axis(gx, xx), axis(gy, yy), axis(gz, zz)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material, MeanStress};
    use crate::lattice::{Cell, Grid};
    use ndarray::Array2;
    use std::f64::consts::{E, TAU};
    use std::sync::Arc;

    /// Under a wave of the pressure τ₁ is p̂ qz e^{−qz} at every x: a ridge, on which an expansion errs along x.
    #[test]
    fn a_ridge_is_climbed_to_its_height() {
        let half_space = HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap());
        let grid = Arc::new(Grid::new(Cell::square(1.0).unwrap(), [16, 16]).unwrap());
        let wave = Array2::from_shape_fn([16, 16], |(i, _)| (TAU * i as f64 / 16.0).cos());
        let field = StressField::under(&grid, wave.view(), &half_space, None, MeanStress::Confined).unwrap();
        for (z, place) in [(0.13, [0.0; 2]), (0.2, [0.13, 0.4])] {
            let start = Candidate { value: f64::NAN, depth: Depth { z, material: 1 }, place, step: 0.04 };
            let (found, state) = field.local_maximum(&start, 0.03, [0.0, f64::MAX], StressMeasure::Tau1);
            assert!((found.value * E - 1.0).abs() < 1e-10 && state.tau1() == found.value, "{found:?}");
            assert!((TAU * found.depth.z - 1.0).abs() < 1e-5, "{found:?}");
        }
    }

    /// Two waves of the pressure, across each other and out of phase: the place is that of the exact sums around it, and belongs to its state.
    #[test]
    fn place_state_and_value_belong_together() {
        let half_space = HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap());
        let grid = Arc::new(Grid::new(Cell::square(1.0).unwrap(), [16, 16]).unwrap());
        let phase = |i: usize, shift: f64| TAU * (i as f64 / 16.0 - shift);
        let waves = Array2::from_shape_fn([16, 16], |(i, j)| phase(i, 0.21).cos() + 0.7 * phase(j, 0.38).cos());
        let field = StressField::under(&grid, waves.view(), &half_space, None, MeanStress::Confined).unwrap();
        let start =
            Candidate { value: f64::NAN, depth: Depth { z: 0.13, material: 1 }, place: [0.19, 0.41], step: 0.04 };
        let (found, state) = field.local_maximum(&start, 0.03, [0.0, f64::MAX], StressMeasure::Mises);
        let exact = |[x, y, z]: [f64; 3]| {
            let depth = Depth { z: found.depth.z + z, ..found.depth };
            field.points(depth, &[[found.place[0] + x, found.place[1] + y]])[0].mises()
        };
        assert!((exact([0.0; 3]) / found.value - 1.0).abs() < 2.0 * MOST_LEFT && state.mises() == found.value);
        // A thousandth of the cell beside it stresses are lower by some 10⁻⁵.
        for axis in 0..3 {
            for by in [-1e-3, 1e-3] {
                let mut offset = [0.0; 3];
                offset[axis] = by;
                assert!(exact(offset) < found.value * (1.0 - 10.0 * MOST_LEFT), "{axis} {by}: {found:?}");
            }
        }
    }

    #[test]
    fn the_top_of_a_leaning_paraboloid_is_found_at_once() {
        let value = |x: f64, y: f64, z: f64| {
            let (x, y, z) = (x - 0.3, y + 0.2, z - 0.1);
            2.0 - x * x - 2.0 * y * y - 1.5 * z * z + 0.6 * x * z - 0.4 * y * z + 0.3 * x * y
        };
        let level = |z: f64| {
            let of_point = |k: usize| {
                if k == 0 { value(0.0, 0.0, z) } else { value(NEIGHBOURS[k - 1][0], NEIGHBOURS[k - 1][1], z) }
            };
            (z, std::array::from_fn(of_point))
        };
        let found = top(&[level(0.0), level(-1.0), level(1.0)], true);
        assert!(found.iter().zip([0.3, -0.2, 0.1]).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
    }
}
