//! The range of τ₁ along the lines of a path, on a plane of constant depth.

use crate::body::Depth;

/// Most lines of a plane beside others.
const MOST: usize = 512;

/// The range of τ₁ along the lines of a plane of constant depth.
#[derive(Debug, Clone, PartialEq)]
pub struct RangePlane {
    /// The depth, and its material.
    pub depth: Depth,
    /// y of each line across the path and the range along it, a pressure; y ascending.
    pub lines: Vec<[f64; 2]>,
    /// Distance after which lines repeat across the path, a length; `None` where they do not.
    pub period: Option<f64>,
}

impl RangePlane {
    /// y of each line, lengths.
    pub fn y(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.lines.iter().map(|[y, _]| *y)
    }

    /// The range at y, by the cubic through the four lines about it; beyond the outermost ones theirs.
    pub fn at(&self, y: f64) -> f64 {
        let n = self.lines.len();
        let (Some([first, of_first]), Some([last, of_last])) = (self.lines.first(), self.lines.last()) else {
            return 0.0;
        };
        let (y, places) = match self.period {
            _ if n == 1 => return *of_first,
            Some(period) => {
                let y = first + (y - first).rem_euclid(period);
                let before = self.lines.partition_point(|[place, _]| *place <= y) as isize - 2;
                (y, before..before + 4)
            }
            None if y <= *first => return *of_first,
            None if y >= *last => return *of_last,
            None => {
                let after = self.lines.partition_point(|[place, _]| *place <= y);
                let from = after.saturating_sub(2).min(n.saturating_sub(4));
                (y, from as isize..(from + 4).min(n) as isize)
            }
        };
        let nodes: Vec<[f64; 2]> = places.map(|place| self.line(place)).collect();
        through(&nodes, y)
    }

    /// The line of a number, which lines of other periods continue.
    fn line(&self, number: isize) -> [f64; 2] {
        let n = self.lines.len() as isize;
        let [y, range] = self.lines[number.rem_euclid(n) as usize];
        [y + number.div_euclid(n) as f64 * self.period.unwrap_or(0.0), range]
    }

    /// The plane on lines at the places `y`.
    #[must_use]
    pub fn on(&self, y: &[f64]) -> Self {
        let lines = if self.y().eq(y.iter().copied()) {
            self.lines.clone()
        } else {
            y.iter().map(|&y| [y, self.at(y)]).collect()
        };
        Self { lines, ..*self }
    }
}

/// The polynomial through some points at y, not below 0; the value of the nearest one where a range is infinite.
fn through(points: &[[f64; 2]], y: f64) -> f64 {
    if let Some([_, range]) = points.iter().find(|[place, _]| *place == y) {
        return *range;
    }
    if points.iter().any(|[_, range]| !range.is_finite()) {
        let nearest = points.iter().min_by(|a, b| (a[0] - y).abs().total_cmp(&(b[0] - y).abs()));
        return nearest.map_or(0.0, |[_, range]| *range);
    }
    let weight = |node: f64| {
        let others = points.iter().map(|[other, _]| *other).filter(|other| *other != node);
        others.map(|other| (y - other) / (node - other)).product::<f64>()
    };
    points.iter().map(|[place, range]| range * weight(*place)).sum::<f64>().max(0.0)
}

/// Planes on the lines of the one that has most of them, at most 512: waves fade with depth, so that deeper planes need fewer.
pub(super) fn on_common_lines(planes: Vec<RangePlane>) -> Vec<RangePlane> {
    // The first of equally many.
    let Some(finest) = planes.iter().rev().max_by_key(|plane| plane.lines.len()) else { return planes };
    let y: Vec<f64> = match (finest.lines.len(), &finest.lines[..]) {
        (count, [[first, _], .., [last, _]]) if count > MOST => {
            let (width, apart) = finest.period.map_or((last - first, MOST - 1), |period| (period, MOST));
            (0..MOST).map(|k| first + width * k as f64 / apart as f64).collect()
        }
        _ => finest.y().collect(),
    };
    planes.iter().map(|plane| plane.on(&y)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(lines: Vec<[f64; 2]>, period: Option<f64>) -> RangePlane {
        RangePlane { depth: Depth::SURFACE, lines, period }
    }

    #[test]
    fn between_lines_the_range_is_a_cubic_also_across_the_period() {
        let of = |period: Option<f64>, value: fn(f64) -> f64| {
            plane((0..16).map(|k| f64::from(k) / 16.0).map(|y| [y, value(y)]).collect(), period)
        };
        let wave = |y: f64| 2.0 + (std::f64::consts::TAU * y).cos();
        for k in 0..50 {
            let y = -1.3 + 0.07 * f64::from(k);
            // 3/128 h⁴ f⁗ = 5.6e-4.
            assert!((of(Some(1.0), wave).at(y) - wave(y)).abs() < 6e-4, "{y}");
        }
        let cubic = |y: f64| 1.0 + y * (1.0 - y * (0.5 - y));
        for k in 0..16 {
            let y = 0.061 * f64::from(k);
            assert!((of(None, cubic).at(y) - cubic(y)).abs() < 1e-13, "{y}");
        }
        assert_eq!([-1.0, 2.0].map(|y| of(None, cubic).at(y)), [1.0, cubic(15.0 / 16.0)]);
        assert!((plane(vec![[0.0, 1.0], [1.0, 2.0]], None).at(0.25) - 1.25).abs() < 1e-15);
        assert_eq!(plane(vec![[0.3, 1.5]], Some(1.0)).at(0.8), 1.5);
        assert_eq!(plane(vec![[0.0, f64::INFINITY], [1.0, 1.0]], None).at(0.4), f64::INFINITY);
        assert_eq!(plane(Vec::new(), None).at(0.4), 0.0);
    }

    #[test]
    fn all_planes_have_the_lines_of_the_finest_one() {
        let of = |count: usize, period: Option<f64>| {
            let y = (0..count).map(|k| k as f64 / count as f64);
            plane(y.map(|y| [y, y * (1.0 - y)]).collect(), period)
        };
        for period in [None, Some(1.0)] {
            let common = on_common_lines(vec![of(5, period), of(20, period), of(1, period)]);
            assert!(common.iter().all(|plane| plane.y().eq(of(20, period).y())));
            assert_eq!(common[1], of(20, period));
            assert_eq!(common[0].lines[8][1], common[1].lines[8][1]);
            let many = on_common_lines(vec![of(3000, period), of(7, period)]);
            assert!(many.iter().all(|plane| plane.lines.len() == MOST));
            assert!(many[0].lines.iter().all(|[y, range]| (range - y * (1.0 - y)).abs() < 1e-6));
        }
    }
}
