//! From a place inside a material to the local maximum above it.
//!
//! 3 × 3 points around at three depths: while one of them is higher, it is the next middle. Otherwise the next one is the top
//! of the paraboloid through them, and the steps become smaller. Steps in depth end at the faces of the material.

use super::field::StressField;
use super::quantity::Quantity;
use super::search::{Candidate, SEARCH_REACH};
use super::slice::{Slice, Stresses};
use super::tensor::State;
use crate::body::Depth;

/// How often the steps become smaller, and how many steps there are at most.
const TOPS: usize = 4;
const MOVES: usize = 32;
/// Smaller steps over the ones before.
const SMALLER: f64 = 0.3;
/// The points around the middle of a plane: first those along x and y, then the corners.
const AROUND: [[f64; 2]; 8] =
    [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0], [-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];

/// Values in the middle of a plane and at [`AROUND`] of it; above and below the last corner is left out.
type Values = [f64; 9];

impl StressField {
    /// Stresses at places (x, y) of a slice.
    pub(super) fn searched(&self, slice: &Slice, places: &[[f64; 2]]) -> Vec<State> {
        self.at(places, &Stresses(slice)).into_iter().map(State::from_stresses).collect()
    }

    /// The local maximum from a candidate on, at depths within [low, high], with `rise` the first step in depth; 0 for
    /// none.
    pub(super) fn climbed(&self, from: &Candidate, rise: f64, [low, high]: [f64; 2], quantity: Quantity) -> Candidate {
        let material = from.depth.material;
        let value = |z: f64, places: &[[f64; 2]]| -> Vec<f64> {
            let slice = self.slice(Depth { z, material }, SEARCH_REACH);
            self.searched(&slice, places).iter().map(|state| quantity.of(state)).collect()
        };
        let mut best = Candidate { depth: Depth { z: from.depth.z.clamp(low, high), material }, ..*from };
        best.value = value(best.depth.z, &[best.place])[0];
        let (mut rise, mut tops) = (rise, 0);
        for _ in 0..MOVES {
            let ([x, y], z, step) = (best.place, best.depth.z, best.step);
            let place = |[u, v]: [f64; 2]| [x + u * step, y + v * step];
            let [above, below] = [(z - rise).max(low), (z + rise).min(high)];
            let around = AROUND.map(place);
            let mut levels: Vec<(f64, Values)> = Vec::new();
            let own = value(z, &around);
            levels.push((z, std::array::from_fn(|k| if k == 0 { best.value } else { own[k - 1] })));
            for depth in [above, below].into_iter().filter(|depth| *depth != z) {
                // Eight together cost as one.
                let places: [[f64; 2]; 8] = std::array::from_fn(|k| if k == 0 { [x, y] } else { around[k - 1] });
                let own = value(depth, &places);
                levels.push((depth, std::array::from_fn(|k| own.get(k).copied().unwrap_or(f64::NEG_INFINITY))));
            }
            let all = levels.iter().flat_map(|(z, values)| (0..9).map(move |k| (*z, k, values[k])));
            let Some((depth, k, highest)) = all.reduce(|a, b| if b.2 > a.2 { b } else { a }) else { return best };
            if highest > best.value {
                best.value = highest;
                best.depth.z = depth;
                best.place = if k == 0 { [x, y] } else { around[k - 1] };
                continue;
            }
            let is_centred = levels.len() == 3 && (z - above - (below - z)).abs() < 1e-9 * z;
            let [dx, dy, dz] = top(&levels, is_centred);
            let (moved, depth) = (place([dx, dy]), (z + dz * rise).clamp(low, high));
            let there = value(depth, &[moved])[0];
            if there > best.value {
                (best.value, best.place, best.depth.z) = (there, moved, depth);
            }
            best.step *= SMALLER;
            rise *= SMALLER;
            tops += 1;
            if tops == TOPS {
                break;
            }
        }
        best
    }
}

/// Where the paraboloid is highest, in steps from the middle, no farther than one; its axes alone where it is no hill.
fn top(levels: &[(f64, Values)], is_centred: bool) -> [f64; 3] {
    let own = &levels[0].1;
    let (gx, gy) = (0.5 * (own[2] - own[1]), 0.5 * (own[4] - own[3]));
    let (xx, yy) = (own[1] + own[2] - 2.0 * own[0], own[3] + own[4] - 2.0 * own[0]);
    let xy = 0.25 * (own[5] + own[8] - own[6] - own[7]);
    let (mut gz, mut zz, mut xz, mut yz) = (0.0, -1.0, 0.0, 0.0);
    if is_centred {
        let (up, down) = (&levels[1].1, &levels[2].1);
        gz = 0.5 * (down[0] - up[0]);
        zz = up[0] + down[0] - 2.0 * own[0];
        xz = 0.25 * (down[2] - down[1] - up[2] + up[1]);
        yz = 0.25 * (down[4] - down[3] - up[4] + up[3]);
    }
    // −H d = g by Cramer's rule; −H is positive definite on a hill.
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

    #[test]
    fn the_top_of_a_leaning_paraboloid_is_found_at_once() {
        let value = |x: f64, y: f64, z: f64| {
            let (x, y, z) = (x - 0.3, y + 0.2, z - 0.1);
            2.0 - x * x - 2.0 * y * y - 1.5 * z * z + 0.6 * x * z - 0.4 * y * z + 0.3 * x * y
        };
        let level = |z: f64| {
            let own = |k: usize| if k == 0 { value(0.0, 0.0, z) } else { value(AROUND[k - 1][0], AROUND[k - 1][1], z) };
            (z, std::array::from_fn(own))
        };
        let found = top(&[level(0.0), level(-1.0), level(1.0)], true);
        assert!(found.iter().zip([0.3, -0.2, 0.1]).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
    }
}
