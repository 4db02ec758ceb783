//! A smooth field over the window of an isolated contact at one depth, as polynomials.

use crate::numeric::chebyshev::{analysis, inside, nodes, place, polynomials};

/// Places are read this far beyond the window, in halves of its side: differences at its border need no more.
const BEYOND: f64 = 1.03;
/// The border of the window with what rounding adds to it: lines end there, as polynomials grow fast beyond it.
const BORDER: f64 = 1.0 + 1e-8;
/// Rows and columns farther from the middle, in halves of the window's side, are left without the field: nothing reads them.
const UNREAD: f64 = 1.5;

/// K components of a [`FarField`](super::far_field::FarField) at one depth.
#[derive(Debug, Clone)]
pub(super) struct FarPlane<const K: usize> {
    /// Numbers of polynomials along x and along y.
    pub counts: [usize; 2],
    /// Coefficients of the polynomials over the window, along x, then y.
    pub coefficients: Vec<[f64; K]>,
    /// Corner of the cell of the series, whose sides are twice those of the window, over half the window.
    pub corner: [f64; 2],
}

impl<const K: usize> FarPlane<K> {
    /// Components picked and combined by a function of all of them, which must be linear.
    pub fn map<const L: usize>(&self, of: impl Fn([f64; K]) -> [f64; L]) -> FarPlane<L> {
        let coefficients = self.coefficients.iter().map(|&components| of(components)).collect();
        FarPlane { counts: self.counts, coefficients, corner: self.corner }
    }

    /// The field with x and y exchanged.
    pub fn exchanged(&self) -> Self {
        let [n1, n2] = self.counts;
        let coefficients = (0..n1 * n2).map(|k| self.coefficients[k % n1 * n2 + k / n1]).collect();
        Self { counts: [n2, n1], coefficients, corner: [self.corner[1], self.corner[0]] }
    }

    /// Place in the window, −1 to 1, of a fraction of the cell of the series; [`BEYOND`] its border at most.
    fn inside(&self, axis: usize, fraction: f64) -> f64 {
        (self.corner[axis] + 4.0 * fraction).clamp(-BEYOND, BEYOND)
    }

    /// Coefficients of the polynomials of y along the line of one x, by its fraction s of the cell of the series.
    pub fn along(&self, s: f64) -> Vec<[f64; K]> {
        let mut sums = vec![[0.0; K]; self.counts[1]];
        let rows = self.coefficients.chunks_exact(self.counts[1]);
        for (weight, row) in polynomials(self.inside(0, s)).zip(rows) {
            for (sum, coefficient) in sums.iter_mut().flatten().zip(row.iter().flatten()) {
                *sum += weight * coefficient;
            }
        }
        sums
    }

    /// The polynomials of y at the fraction t.
    pub fn across(&self, t: f64) -> impl Iterator<Item = f64> {
        polynomials(self.inside(1, t)).take(self.counts[1])
    }

    /// Whether fields are read at a fraction of the cell of the series along an axis.
    pub fn is_read(&self, axis: usize, fraction: f64) -> bool {
        (self.corner[axis] + 4.0 * fraction).abs() < UNREAD
    }

    /// Components on the line of [`Self::along`], by the fraction t.
    pub fn on(&self, line: &[[f64; K]], t: f64) -> [f64; K] {
        weighted(self.across(t), line)
    }

    /// The field on the line through the fractions `origin` with the fractions of its `unit` vector, between two distances s from it.
    ///
    /// On a line a product of polynomials of x and y is one of s, of the sum of their degrees: so many nodes give it exactly.
    pub fn on_line(&self, origin: [f64; 2], unit: [f64; 2], ends: [f64; 2]) -> FarLine<K> {
        let ends = self.part_inside(origin, unit, ends);
        let degree = |axis: usize| if unit[axis] == 0.0 { 0 } else { self.counts[axis] - 1 };
        let count = 1 + degree(0) + degree(1);
        let at = |x: f64| {
            let s = place(ends, x);
            self.at([0, 1].map(|axis| origin[axis] + s * unit[axis]))
        };
        let values: Vec<[f64; K]> = nodes(count).into_iter().map(at).collect();
        let coefficients = analysis(count).into_iter().map(|weights| weighted(weights.into_iter(), &values)).collect();
        FarLine { ends, coefficients }
    }

    /// The part of a line between two distances s that lies in the window, in ascending order; a point where none does.
    fn part_inside(&self, origin: [f64; 2], unit: [f64; 2], [first, last]: [f64; 2]) -> [f64; 2] {
        let mut part = [first.min(last), first.max(last)];
        for axis in (0..2).filter(|&axis| unit[axis] != 0.0) {
            let border = |side: f64| (0.25 * (side * BORDER - self.corner[axis]) - origin[axis]) / unit[axis];
            let [one, other] = [border(-1.0), border(1.0)];
            part = [part[0].max(one.min(other)), part[1].min(one.max(other))];
        }
        if part[0] < part[1] { part } else { [part[0]; 2] }
    }

    /// Components at the fractions s, t of the cell of the series.
    pub fn at(&self, [s, t]: [f64; 2]) -> [f64; K] {
        self.on(&self.along(s), t)
    }
}

/// The sum of all `terms`, with weights.
#[inline(always)]
pub(super) fn weighted<const K: usize>(weights: impl Iterator<Item = f64>, terms: &[[f64; K]]) -> [f64; K] {
    let mut sums = [0.0; K];
    for (weight, term) in weights.zip(terms) {
        for k in 0..K {
            sums[k] += weight * term[k];
        }
    }
    sums
}

/// K components of a far field on a line at one depth.
#[derive(Debug, Clone)]
pub(super) struct FarLine<const K: usize> {
    /// Distances s between which it is read.
    ends: [f64; 2],
    /// Coefficients of the polynomials between them.
    coefficients: Vec<[f64; K]>,
}

impl<const K: usize> FarLine<K> {
    /// Components at a distance s; beyond the ends those at the nearer one.
    pub fn at(&self, s: f64) -> [f64; K] {
        let x = if self.ends[0] < self.ends[1] { inside(self.ends, s).clamp(-1.0, 1.0) } else { 0.0 };
        weighted(polynomials(x), &self.coefficients)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines along x, along y and aslant, in both directions, across the window and from beyond it, have the plane's
    /// values to rounding.
    #[test]
    fn a_line_has_what_the_plane_has() {
        for counts in [[5, 7], [10, 162]] {
            meets_its_lines(counts);
        }
    }

    /// Lines of a plane with these numbers of polynomials.
    fn meets_its_lines(counts: [usize; 2]) {
        let coefficients = 0..(counts[0] * counts[1]) as u32;
        let coefficients = coefficients.map(|k| [f64::from(k * 7 % 11) - 5.0, f64::from(k * k % 13) - 6.0]).collect();
        let plane = FarPlane { counts, coefficients, corner: [-2.0, -2.0] };
        // Rounding of as many terms of size 6, each with the rounding of its polynomial.
        let rounding = 1e-14 * (counts[0] * counts[1] * counts[1]) as f64;
        for unit in [[0.01, 0.0], [0.0, -0.01], [0.006, 0.008], [-0.003, 0.007]] {
            for (origin, ends) in [([0.45, 0.52], [-12.0, 15.0]), ([0.5, 0.5], [60.0, -70.0])] {
                let line = plane.on_line(origin, unit, ends);
                let mut met = 0;
                for i in 0..=100 {
                    let s = ends[0] + 0.01 * f64::from(i) * (ends[1] - ends[0]);
                    let place = [0, 1].map(|axis| origin[axis] + s * unit[axis]);
                    if place.iter().any(|fraction| (4.0 * fraction - 2.0).abs() > BORDER) {
                        continue;
                    }
                    met += 1;
                    let (found, exact) = (line.at(s), plane.at(place));
                    assert!(
                        found.iter().zip(&exact).all(|(a, b)| (a - b).abs() < rounding),
                        "{unit:?} {s}: {found:?}, {exact:?}"
                    );
                }
                assert!(met > 20, "{unit:?}");
            }
        }
    }

    #[test]
    fn a_line_beyond_the_window_is_finite() {
        let plane = FarPlane { counts: [3, 3], coefficients: vec![[1.0]; 9], corner: [-2.0, -2.0] };
        let line = plane.on_line([0.95, 0.1], [0.0, 1.0], [0.0, 0.5]);
        assert!(line.at(0.2)[0].is_finite());
        let line = plane.on_line([0.95, 0.95], [1.0, 1.0], [0.0, 0.0]);
        assert!(line.at(0.0)[0].is_finite());
    }
}
