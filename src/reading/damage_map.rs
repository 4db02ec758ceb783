//! The damage of one pass below the surface, across the path of sliding and over depth.

use super::Reading;
use super::fatigue::direction;
use super::stress::contact_radii;
use crate::body::Depth;
use crate::spectral::Step;
use crate::stress::{PathSought, RangePlane, StressField};
use ndarray::Array2;

/// Most columns of a map.
const MOST: usize = 512;

/// Range of τ₁ along the path of sliding, and the damage by it in one pass, of the materials of a body that have a law of fatigue.
#[derive(Debug, Clone, PartialEq)]
pub struct DamageMap {
    /// y across the path, lengths, ascending: along y where the counterbody slides along x. One value where all of a plane is one path.
    pub y: Vec<f64>,
    /// Depths, from the surface down; an interface has both of its sides where both materials have a law.
    pub z: Vec<Depth>,
    /// Range of τ₁, a pressure; axis 0 along `z`, axis 1 along `y`.
    pub range: Array2<f64>,
    /// Damage in one pass; axes as those of `range`.
    pub damage: Array2<f64>,
}

impl DamageMap {
    /// The map below a step that has contact and whose `reading` is known, by the stress `field` of one of its bodies; `None` where none of
    /// its materials has a law of fatigue.
    pub fn of(step: &Step, reading: &Reading, field: &StressField) -> Option<Self> {
        let (direction, radii) = (direction(step.problem()), contact_radii(step, reading));
        let sought = PathSought { fatigue: true, endurance: false };
        let found = field.path_peaks_while(direction, radii, sought, None, &|| true)?;
        let laws: Vec<_> = field.half_space().durabilities().map(|own| own.fatigue).collect();
        let widest = found.planes.iter().max_by_key(|plane| plane.lines.len())?;
        let count = widest.lines.len().min(MOST);
        let y: Vec<f64> = match (found.period, &widest.lines[..]) {
            (Some(period), _) => (0..count).map(|k| period * k as f64 / count as f64).collect(),
            (None, [[first, _], .., [last, _]]) => {
                (0..count).map(|k| first + (last - first) * k as f64 / (count - 1) as f64).collect()
            }
            (None, lines) => lines.iter().map(|[y, _]| *y).collect(),
        };
        let z: Vec<Depth> = found.planes.iter().map(|plane| plane.depth).collect();
        let range =
            Array2::from_shape_fn([z.len(), y.len()], |(row, column)| at(&found.planes[row], y[column], found.period));
        let mut damage = range.clone();
        for (mut row, depth) in damage.outer_iter_mut().zip(&z) {
            let law = laws[depth.material - 1]?;
            row.mapv_inplace(|range| law.damage(range));
        }
        Some(Self { y, z, range, damage })
    }
}

/// The range on a plane at y, linear between its lines; beyond the outermost ones theirs.
fn at(plane: &RangePlane, y: f64, period: Option<f64>) -> f64 {
    let (lines, n) = (&plane.lines, plane.lines.len());
    let next = lines.partition_point(|[own, _]| *own <= y);
    let moved = period.unwrap_or(0.0);
    let (before, after) = match (next, period) {
        (0, None) => (lines[0], lines[0]),
        (next, None) if next == n => (lines[n - 1], lines[n - 1]),
        (0, Some(_)) => ([lines[n - 1][0] - moved, lines[n - 1][1]], lines[0]),
        (next, Some(_)) if next == n => (lines[n - 1], [lines[0][0] + moved, lines[0][1]]),
        (next, _) => (lines[next - 1], lines[next]),
    };
    let part = if after[0] > before[0] { (y - before[0]) / (after[0] - before[0]) } else { 0.0 };
    (1.0 - part) * before[1] + part * after[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_lines_the_range_is_linear_also_across_the_period() {
        let plane = RangePlane { depth: Depth::SURFACE, lines: vec![[0.1, 1.0], [0.5, 3.0]] };
        // With a period of 1.1 the line at 0.1 is again at 1.2, and half-way at 0.85.
        for (y, closed, open) in
            [(0.1, 1.0, 1.0), (0.2, 1.5, 1.5), (0.85, 2.0, 3.0), (0.05, 1.0 + 2.0 * 0.05 / 0.7, 1.0)]
        {
            assert!((at(&plane, y, Some(1.1)) - closed).abs() < 1e-12, "{y}");
            assert!((at(&plane, y, None) - open).abs() < 1e-12, "{y}");
        }
    }
}
