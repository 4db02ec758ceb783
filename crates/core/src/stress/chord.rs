//! The longest chord of a set of points: the largest change of a vector between any two places of a path.

use crate::numeric::search::first_largest;

/// A chord between two of some points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Chord {
    /// Numbers of the points at its ends.
    pub ends: [usize; 2],
    pub length: f64,
}

/// Distance of two points.
pub(super) fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The longest chord of at least one point; its length is not a number where a coordinate is none.
///
/// A chord is at most dᵢ + dⱼ long, dᵢ the distance of a point from any centre: pairs are compared in descending order
/// of d until none can be longer.
pub(super) fn longest_chord<const D: usize>(points: &[[f64; D]]) -> Chord {
    let middle: [f64; D] = std::array::from_fn(|k| {
        let ends = points
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| [low.min(point[k]), high.max(point[k])]);
        0.5 * (ends[0] + ends[1])
    });
    let mut ordered: Vec<(f64, usize)> = points.iter().map(|point| distance(point, &middle)).zip(0..).collect();
    if ordered.iter().any(|(d, _)| !d.is_finite()) {
        return Chord { ends: [0; 2], length: f64::NAN };
    }
    ordered.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut best = Chord { ends: [ordered[0].1; 2], length: 0.0 };
    let mut compare = |i: usize, j: usize| {
        let length = distance(&points[i], &points[j]);
        if length > best.length {
            best = Chord { ends: [i, j], length };
        }
        best.length
    };
    // A first guess leaves few pairs.
    let first = ordered[0].1;
    if let Some((other, _)) = first_largest(points.iter().map(|point| distance(point, &points[first]))) {
        compare(first, other);
    }
    for (k, &(d, i)) in ordered.iter().enumerate() {
        let mut length = compare(i, i);
        if 2.0 * d <= length {
            break;
        }
        for &(other, j) in &ordered[k + 1..] {
            if d + other <= length {
                break;
            }
            length = compare(i, j);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against all pairs, on points that a rule scatters, on a circle, and on a line.
    #[test]
    fn no_pair_is_farther_apart() {
        let scattered = |k: usize| std::array::from_fn::<f64, 5, _>(|c| ((k * k * 37 + 11 * c * k + c) % 101) as f64);
        let circle = |k: usize| {
            let (sine, cosine) = (0.1 + 0.31 * k as f64).sin_cos();
            [cosine, 0.0, 2.0, sine, 0.0]
        };
        let line = |k: usize| [k as f64, 2.0 * k as f64, 0.0, -(k as f64), 1.0];
        let single = |_: usize| [3.0; 5];
        let sets: [&dyn Fn(usize) -> [f64; 5]; 4] = [&scattered, &circle, &line, &single];
        for (number, set) in sets.into_iter().enumerate() {
            let points: Vec<[f64; 5]> = (0..83).map(set).collect();
            let pairs = points.iter().flat_map(|a| points.iter().map(move |b| distance(a, b)));
            let known = pairs.fold(0.0, f64::max);
            let Chord { ends: [i, j], length } = longest_chord(&points);
            assert_eq!((length, distance(&points[i], &points[j])), (known, known), "set {number}");
        }
        assert!(longest_chord(&[[0.0], [f64::NAN]]).length.is_nan());
    }
}
