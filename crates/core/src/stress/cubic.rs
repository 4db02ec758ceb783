//! Cubic interpolation of periodic fields between their samples.

/// Cubic interpolation at a point between the samples: indices and weights of the four rows and columns around it.
#[derive(Debug)]
pub(super) struct CubicInterpolation {
    /// Index and weight of each row.
    pub rows: [(usize, f64); 4],
    /// Index and weight of each column.
    columns: [(usize, f64); 4],
}

impl CubicInterpolation {
    /// Interpolation at the fractions s, t of a₁ and a₂.
    pub fn new([n1, n2]: [usize; 2], [s, t]: [f64; 2]) -> Self {
        let around = |x: f64, n: usize| {
            let f = x - x.floor();
            let weights = [
                -f * (f - 1.0) * (f - 2.0) / 6.0,
                (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0,
                -(f + 1.0) * f * (f - 2.0) / 2.0,
                (f + 1.0) * f * (f - 1.0) / 6.0,
            ];
            let index = |k: usize| (x.floor() as i64 + k as i64 - 1).rem_euclid(n as i64) as usize;
            std::array::from_fn(|k| (index(k), weights[k]))
        };
        Self { rows: around(s * n1 as f64, n1), columns: around(t * n2 as f64, n2) }
    }

    /// Value of a row of a field at the point's place along the row.
    pub fn across(&self, row: &[f64]) -> f64 {
        self.columns.iter().map(|&(j, weight)| weight * row[j]).sum()
    }

    /// Value of a field, rows of n₂ samples, at the point.
    pub fn value(&self, field: &[f64], n2: usize) -> f64 {
        self.rows.iter().map(|&(i, weight)| weight * self.across(&field[i * n2..(i + 1) * n2])).sum()
    }
}
