//! Values that may be the largest of a measure in a material: the best on the lines of a plane and between them, and between the planes.
//!
//! Values between lines and between depths are those of parabolas through three of them.

use super::lines::SearchedLines;
use super::pass::PathSearch;
use crate::body::Depth;
use crate::numeric::search::first_largest;
use crate::stress::constants::{MISSED_BY_SAMPLES, RISE_BETWEEN_PLANES};
use crate::stress::field::StressField;
use crate::stress::path_measure::PathMeasure;

/// Largest number of further planes of one maximum.
const MAX_PLANES: usize = 8;
/// Part of a value that a further plane must promise.
const LEAST_RISE: f64 = 2e-5;

/// The largest value of a measure on a plane, between the lines too.
#[derive(Debug, Clone, Copy)]
pub(super) struct Best {
    pub value: f64,
    pub depth: Depth,
    pub place: [f64; 2],
    pub y: f64,
    pub beyond: f64,
    pub gain: f64,
}

impl StressField {
    /// The largest value of a measure on a plane, read on lines and places that are denser.
    pub(super) fn finely(&self, depth: Depth, measure: PathMeasure, search: &PathSearch<'_>) -> Best {
        self.best(&self.searched_lines(depth, &[measure], search, (&search.pass.others, true)), 0, search)
    }

    /// The largest value of a measure, by its number, on a plane.
    pub(super) fn best(&self, plane: &SearchedLines, measure: usize, search: &PathSearch<'_>) -> Best {
        let most = first_largest(plane.values.iter().map(|values| values[measure].value)).map_or(0, |(line, _)| line);
        self.between_lines(plane, measure, most, search)
    }

    /// The largest value of a measure beside a line that has the largest one of its neighbours.
    pub(super) fn between_lines(
        &self,
        plane: &SearchedLines,
        measure: usize,
        line: usize,
        search: &PathSearch<'_>,
    ) -> Best {
        let n = plane.y.len();
        let Some(middle) = plane.values.get(line).map(|values| values[measure]) else {
            return Best { value: 0.0, depth: plane.depth, place: [0.0; 2], y: 0.0, beyond: 0.0, gain: 1.0 };
        };
        let is_closed = search.lines.is_closed();
        let beside = if plane.is_smooth && n >= 3 && (is_closed || (0 < line && line + 1 < n)) {
            [(line + n - 1) % n, (line + 1) % n].map(|next| plane.values[next][measure].value)
        } else {
            [f64::NEG_INFINITY; 2]
        };
        let (rise, offset) = vertex([-1.0, 0.0, 1.0], [beside[0], middle.value, beside[1]])
            .map_or((0.0, 0.0), |(t, value)| (value - middle.value, t));
        let step = search
            .lines
            .period_across()
            .map_or_else(|| plane.y.get(1).map_or(0.0, |y| y - plane.y[0]), |period| period / n as f64);
        let moved = offset * step;
        let [ex, ey] = search.direction;
        let place = [middle.place[0] - moved * ey, middle.place[1] + moved * ex];
        Best {
            value: middle.value + rise.max(0.0),
            depth: plane.depth,
            place,
            y: plane.y[line] + moved,
            beyond: middle.beyond,
            gain: middle.gain,
        }
    }

    /// Values that may be the largest of a material: on its faces, near the surface, and at the maxima over its depths.
    pub(super) fn contenders(
        &self,
        known: &[Best],
        measure: PathMeasure,
        search: &PathSearch<'_>,
    ) -> Option<Vec<Best>> {
        let near = self.shallow_depth();
        let is_shallow = |best: &&Best| best.depth.z < near;
        let shallow = known.iter().filter(is_shallow).copied();
        let mut all: Vec<Best> = shallow.reduce(|a, b| if b.value > a.value { b } else { a }).into_iter().collect();
        let mut deep: Vec<Best> = known.iter().filter(|best| !is_shallow(best)).copied().collect();
        let most = deep.iter().map(|best| best.value).fold(f64::NEG_INFINITY, f64::max);
        let starts: Vec<f64> = (0..deep.len())
            .filter(|&i| {
                let beside = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|j| deep.get(j));
                let value = deep[i].value;
                let drop = beside.clone().map(|neighbour| value - neighbour.value).fold(0.0, f64::max);
                let is_near = value + RISE_BETWEEN_PLANES * drop + MISSED_BY_SAMPLES * most.abs() >= most;
                // The first of equal depths.
                let is_first = i.checked_sub(1).is_none_or(|before| deep[before].value < value);
                is_near && is_first && beside.into_iter().all(|neighbour| neighbour.value <= value)
            })
            .map(|i| deep[i].depth.z)
            .collect();
        for start in starts {
            let best = self.between_depths(&mut deep, start, measure, search)?;
            all.push(match measure {
                PathMeasure::Range(_) if (search.goes_on)() => self.finely(best.depth, measure, search),
                _ => best,
            });
        }
        Some(all)
    }

    /// The largest value near a depth `start`, by further planes, which are added to the known ones.
    fn between_depths(
        &self,
        known: &mut Vec<Best>,
        start: f64,
        measure: PathMeasure,
        search: &PathSearch<'_>,
    ) -> Option<Best> {
        let mut at = known.iter().position(|peak| peak.depth.z == start).unwrap_or(0);
        for _ in 0..MAX_PLANES {
            let middle = at.clamp(1, known.len().saturating_sub(2).max(1));
            let Some(three) = known.get(middle - 1..middle + 2) else { break };
            let (z, values) = ([0, 1, 2].map(|k| three[k].depth.z), [0, 1, 2].map(|k| three[k].value));
            let Some((next, promised)) = vertex(z, values) else { break };
            // Depths that are as near as this have the same value.
            let least = 1e-3 * (z[2] - z[0]);
            if promised - known[at].value <= LEAST_RISE * known[at].value.abs()
                || z.iter().any(|z| (z - next).abs() < least)
            {
                break;
            }
            if !(search.goes_on)() {
                return None;
            }
            let depth = Depth { z: next, material: known[at].depth.material };
            let best = self.best(&self.own_lines(depth, &[measure], search), 0, search);
            let place = known.partition_point(|peak| peak.depth.z < next);
            known.insert(place, best);
            at = match best.value > known[if place <= at { at + 1 } else { at }].value {
                true => place,
                false if place <= at => at + 1,
                false => at,
            };
        }
        Some(known[at])
    }
}

/// Place and value of the top of the parabola through three points, kept within them; `None` where it has none.
fn vertex([a, b, c]: [f64; 3], [of_a, of_b, of_c]: [f64; 3]) -> Option<(f64, f64)> {
    let (left, right) = ((of_b - of_a) / (b - a), (of_c - of_b) / (c - b));
    let bend = (right - left) / (c - a);
    // f = f_b + slope (x − b) + bend (x − b)².
    let slope = left + bend * (b - a);
    if !(bend < 0.0 && bend.is_finite()) {
        return None;
    }
    let place = (b - 0.5 * slope / bend).clamp(a, c);
    Some((place, of_b + (slope + bend * (place - b)) * (place - b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found_from_unequal_steps() {
        let value = |x: f64| 3.0 - 2.0 * (x - 0.7) * (x - 0.7);
        let z = [0.1, 0.5, 1.6];
        let (place, top) = vertex(z, z.map(value)).unwrap();
        assert!((place - 0.7).abs() < 1e-14 && (top - 3.0).abs() < 1e-14);
        let (place, _) = vertex([0.8, 0.9, 1.0], [0.8, 0.9, 1.0].map(value)).unwrap();
        assert_eq!(place, 0.8);
        assert_eq!(vertex(z, z.map(|x| x * x)), None);
        assert_eq!(vertex([-1.0, 0.0, 1.0], [f64::NEG_INFINITY, 1.0, f64::NEG_INFINITY]), None);
    }
}
