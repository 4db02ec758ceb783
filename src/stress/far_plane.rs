//! A smooth field over the window of an isolated contact at one depth, as polynomials.

use crate::numeric::chebyshev::polynomials;

/// Places are read this far beyond the window, in halves of its side: differences at its border need no more.
const BEYOND: f64 = 1.03;
/// Rows and columns farther from the middle, in halves of the window's side, are left without the field: nothing reads them.
const UNREAD: f64 = 1.5;

/// K components of a [`FarField`](super::far_field::FarField) at one depth.
#[derive(Debug, Clone)]
pub(super) struct FarPlane<const K: usize> {
    /// Numbers of polynomials along x and along y.
    pub counts: [usize; 2],
    /// Coefficients of the polynomials over the window, along x, then y.
    pub coefficients: Vec<[f64; K]>,
    /// Of the cell of the series, whose sides are twice those of the window: the place of its corner, over half the window.
    pub corner: [f64; 2],
}

impl<const K: usize> FarPlane<K> {
    /// Components picked and combined by a function of all of them, which must be linear.
    pub fn map<const L: usize>(&self, of: impl Fn([f64; K]) -> [f64; L]) -> FarPlane<L> {
        let coefficients = self.coefficients.iter().map(|&own| of(own)).collect();
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
            for (sum, own) in sums.iter_mut().flatten().zip(row.iter().flatten()) {
                *sum += weight * own;
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
        let mut sums = [0.0; K];
        for (weight, own) in self.across(t).zip(line) {
            sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += weight * own);
        }
        sums
    }

    /// Components at the fractions s, t of the cell of the series.
    pub fn at(&self, [s, t]: [f64; 2]) -> [f64; K] {
        self.on(&self.along(s), t)
    }
}
