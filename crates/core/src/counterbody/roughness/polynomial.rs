//! The polynomial of first or second order that fits the samples of a surface best.
//!
//! p(x, y) = c₁ + c₂x + c₃y + ½c₄x² + c₅xy + ½c₆y² by the normal equations Σ tₖtₗ cₗ = Σ tₖh of its terms t over the samples with a
//! measurement, places from the middle of the cell in units of half its longer diagonal.

use crate::lattice::Cell;
use crate::numeric::{linear, sums};
use ndarray::Array2;

/// Samples of a surface with their places from the middle of the cell.
#[derive(Debug)]
pub(super) struct Samples<'a> {
    /// Lengths, NaN without a measurement.
    pub heights: &'a [f64],
    vectors: [[f64; 2]; 2],
    pub points: [usize; 2],
    /// Unit of the places and heights: half the longer diagonal of the cell, a length.
    pub unit: f64,
}

impl<'a> Samples<'a> {
    pub fn new(cell: Cell, heights: &'a Array2<f64>) -> Self {
        let [[x1, y1], [x2, y2]] = cell.vectors();
        let unit = 0.5 * (x1 + x2).hypot(y1 + y2).max((x1 - x2).hypot(y1 - y2));
        let points = heights.dim().into();
        Self { heights: heights.as_slice().expect("in standard layout"), vectors: cell.vectors(), points, unit }
    }

    pub fn len(&self) -> usize {
        self.heights.len()
    }

    /// Place of sample k, in units.
    pub fn place(&self, k: usize) -> [f64; 2] {
        let [n1, n2] = self.points;
        let part = |k: usize, n: usize| (k as f64 - 0.5 * (n as f64 - 1.0)) / (n as f64 * self.unit);
        let [s, t] = [part(k / n2, n1), part(k % n2, n2)];
        [0, 1].map(|c| s * self.vectors[0][c] + t * self.vectors[1][c])
    }

    /// Height of sample k, in units; NaN without a measurement.
    pub fn height(&self, k: usize) -> f64 {
        self.heights[k] / self.unit
    }
}

/// A polynomial of first or second order: coefficients of 1, x, y, ½x², xy, ½y², in units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Polynomial(pub [f64; 6]);

impl Polynomial {
    fn terms([x, y]: [f64; 2]) -> [f64; 6] {
        [1.0, x, y, 0.5 * x * x, x * y, 0.5 * y * y]
    }

    /// The polynomial with the first `count` terms; `None` where the samples do not determine it.
    pub fn fit(samples: &Samples<'_>, count: usize) -> Option<Self> {
        // The lower triangle of the normal equations, row by row, then their right side.
        let normal = sums::of::<27>(samples.len(), |k| {
            let height = samples.height(k);
            if height.is_nan() {
                return [0.0; 27];
            }
            let terms = Self::terms(samples.place(k));
            let mut products = [0.0; 27];
            for row in 0..6 {
                (0..=row).for_each(|column| products[row * (row + 1) / 2 + column] = terms[row] * terms[column]);
                products[21 + row] = terms[row] * height;
            }
            products
        });
        let at = |row: usize, column: usize| normal[row.max(column) * (row.max(column) + 1) / 2 + row.min(column)];
        let rows = (0..count).map(|row| (0..count).map(|column| at(row, column)).collect()).collect();
        let found = linear::solve(rows, normal[21..21 + count].to_vec())?;
        Some(Self(std::array::from_fn(|k| found.get(k).copied().unwrap_or(0.0))))
    }

    /// Height of the polynomial at a place, in units.
    pub fn at(&self, place: [f64; 2]) -> f64 {
        self.0.iter().zip(Self::terms(place)).map(|(c, term)| c * term).sum()
    }
}
