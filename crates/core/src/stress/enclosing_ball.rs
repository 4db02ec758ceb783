//! The smallest ball that encloses a set of points.
//!
//! The ball is that of at most D + 1 of the points, its support, whose circumscribed ball has its centre among them.
//! From the ball of one point on the farthest point is added to the support, and the smallest ball of these few is
//! found from those of all their parts: the radius grows in every step, so that it ends at the smallest ball of all.

use super::chord::distance;
use crate::numeric::linear;
use crate::numeric::search::first_largest;

/// A ball in D dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball<const D: usize> {
    pub centre: [f64; D],
    pub radius: f64,
}

/// Largest relative distance beyond a ball at which a point counts as enclosed.
const ROUNDING: f64 = 1e-12;

impl<const D: usize> Ball<D> {
    /// The smallest ball around at least one point.
    pub fn around(points: &[[f64; D]]) -> Self {
        let mut support = vec![points[0]];
        let mut ball = Self { centre: points[0], radius: 0.0 };
        loop {
            let farthest = first_largest(points.iter().map(|point| distance(point, &ball.centre)));
            let Some((next, away)) = farthest.filter(|(_, away)| away.is_finite()) else { return ball };
            if away <= ball.radius * (1.0 + ROUNDING) || support.contains(&points[next]) {
                return ball;
            }
            let Some((larger, chosen)) = Self::of_support(&support, points[next]) else { return ball };
            // Rounding alone ends the growth otherwise.
            if larger.radius <= ball.radius {
                return ball;
            }
            (ball, support) = (larger, chosen);
        }
    }

    /// The smallest ball around a `support` and a point outside its ball, which is on the new one, and the new support.
    fn of_support(support: &[[f64; D]], point: [f64; D]) -> Option<(Self, Vec<[f64; D]>)> {
        let parts = (0..1usize << support.len()).filter_map(|part| {
            let chosen = support.iter().enumerate().filter(|(k, _)| part >> k & 1 == 1).map(|(_, member)| *member);
            let chosen: Vec<[f64; D]> = [point].into_iter().chain(chosen).collect();
            let ball = Self::through(&chosen)?;
            let encloses =
                support.iter().all(|member| distance(member, &ball.centre) <= ball.radius * (1.0 + ROUNDING));
            encloses.then_some((ball, chosen))
        });
        parts.min_by(|a, b| a.0.radius.total_cmp(&b.0.radius))
    }

    /// The smallest ball with some points on its surface; `None` where they do not determine it.
    fn through(points: &[[f64; D]]) -> Option<Self> {
        let first = points[0];
        let edges: Vec<[f64; D]> =
            points[1..].iter().map(|point| std::array::from_fn(|k| point[k] - first[k])).collect();
        let product = |a: &[f64; D], b: &[f64; D]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let rows = edges.iter().map(|a| edges.iter().map(|b| 2.0 * product(a, b)).collect()).collect();
        let weights = linear::solve(rows, edges.iter().map(|edge| product(edge, edge)).collect())?;
        let centre = std::array::from_fn(|k| {
            first[k] + edges.iter().zip(&weights).map(|(edge, weight)| weight * edge[k]).sum::<f64>()
        });
        Some(Self { centre, radius: distance(&first, &centre) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The smallest of the balls through every one, two, three and four of the points that enclose all.
    fn known(points: &[[f64; 3]]) -> Ball<3> {
        let n = points.len();
        let mut all: Vec<Vec<usize>> = vec![vec![]];
        let mut found: Option<Ball<3>> = None;
        for _ in 0..4 {
            let longer = all.iter().flat_map(|subset| {
                (subset.last().map_or(0, |last| last + 1)..n).map(move |next| [&subset[..], &[next]].concat())
            });
            all = longer.collect();
            for subset in &all {
                let chosen: Vec<[f64; 3]> = subset.iter().map(|&k| points[k]).collect();
                let Some(ball) = Ball::through(&chosen) else { continue };
                let encloses = points.iter().all(|p| distance(p, &ball.centre) <= ball.radius * (1.0 + 1e-10));
                if encloses && found.is_none_or(|found| ball.radius < found.radius) {
                    found = Some(ball);
                }
            }
        }
        found.unwrap()
    }

    #[test]
    fn no_ball_through_few_of_the_points_is_smaller() {
        for seed in 1..12usize {
            let point =
                |k: usize| std::array::from_fn(|c| ((k * k * 37 + seed * (11 * c + 3) * k + c * seed) % 101) as f64);
            let points: Vec<[f64; 3]> = (0..14).map(point).collect();
            let (found, known) = (Ball::around(&points), known(&points));
            assert!((found.radius / known.radius - 1.0).abs() < 1e-11, "{found:?}, {known:?}");
            assert!(distance(&found.centre, &known.centre) < 1e-9 * known.radius, "{found:?}, {known:?}");
        }
    }

    /// The ball of a circle in five dimensions has the radius of the circle, that of a line half its length, a single
    /// point none; of more than half a circle the ball is that of the whole.
    #[test]
    fn a_circle_is_enclosed_by_its_own_radius_and_a_line_by_half_its_length() {
        let circle = |angle: f64| [2.0 + 3.0 * angle.cos(), 1.0, 3.0 * angle.sin(), 0.0, -1.0];
        let whole: Vec<[f64; 5]> = (0..720).map(|k| circle(std::f64::consts::TAU * k as f64 / 720.0)).collect();
        let part: Vec<[f64; 5]> = whole[..500].to_vec();
        for points in [whole, part] {
            let Ball { centre, radius } = Ball::around(&points);
            assert!(
                (radius - 3.0).abs() < 1e-12 && distance(&centre, &[2.0, 1.0, 0.0, 0.0, -1.0]) < 1e-10,
                "{centre:?}"
            );
        }
        let line: Vec<[f64; 5]> = (0..=10).map(|k| [f64::from(k), 0.0, 2.0 * f64::from(k), 0.0, 0.0]).collect();
        assert!((Ball::around(&line).radius - 5.0 * 5f64.sqrt()).abs() < 1e-13);
        assert_eq!(Ball::around(&[[1.0, 2.0]]), Ball { centre: [1.0, 2.0], radius: 0.0 });
    }
}
