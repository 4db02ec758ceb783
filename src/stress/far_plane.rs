//! A smooth field over the window of an isolated contact at one depth, as polynomials.

/// Nodes of the polynomials along each side of the window.
pub(super) const ACROSS: usize = 10;

/// K components of a [`FarField`](super::far_field::FarField) at one depth.
#[derive(Debug, Clone)]
pub(super) struct FarPlane<const K: usize> {
    /// Coefficients of the polynomials over the window, along x, then y.
    pub coefficients: Vec<[[f64; K]; ACROSS]>,
    /// Of the cell of the series, whose sides are twice those of the window: the place of its corner, over half the window.
    pub corner: [f64; 2],
}

/// T₀ … T_{N−1} at x.
pub(super) fn polynomials<const N: usize>(x: f64) -> [f64; N] {
    let mut values = [1.0; N];
    if N > 1 {
        values[1] = x;
    }
    for k in 2..N {
        values[k] = 2.0 * x * values[k - 1] - values[k - 2];
    }
    values
}

impl<const K: usize> FarPlane<K> {
    /// Components picked and combined by a function of all of them, which must be linear.
    pub fn map<const L: usize>(&self, of: impl Fn([f64; K]) -> [f64; L]) -> FarPlane<L> {
        let coefficients = self.coefficients.iter().map(|row| row.map(&of)).collect();
        FarPlane { coefficients, corner: self.corner }
    }

    /// Place in [−1, 1] of a fraction of the cell of the series; beyond the window that of its border.
    fn inside(&self, axis: usize, fraction: f64) -> f64 {
        (self.corner[axis] + 4.0 * fraction).clamp(-1.0, 1.0)
    }

    /// The polynomials of y along the line of one x, by its fraction s of the cell of the series.
    pub fn along(&self, s: f64) -> [[f64; K]; ACROSS] {
        let weights = polynomials::<ACROSS>(self.inside(0, s));
        let mut sums = [[0.0; K]; ACROSS];
        for (weight, row) in weights.into_iter().zip(&self.coefficients) {
            for (sum, own) in sums.iter_mut().flatten().zip(row.iter().flatten()) {
                *sum += weight * own;
            }
        }
        sums
    }

    /// The polynomials of y at the fractions `start` + j/`count`, j = 0, 1, …
    pub fn across(&self, start: f64, count: usize) -> Vec<[f64; ACROSS]> {
        (0..count).map(|j| polynomials(self.inside(1, start + j as f64 / count as f64))).collect()
    }

    /// Components on the line of [`Self::along`], by the fraction t.
    pub fn on(&self, line: &[[f64; K]; ACROSS], t: f64) -> [f64; K] {
        let weights = polynomials::<ACROSS>(self.inside(1, t));
        let mut sums = [0.0; K];
        for (weight, own) in weights.into_iter().zip(line) {
            sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += weight * own);
        }
        sums
    }

    /// Components at the fractions s, t of the cell of the series.
    pub fn at(&self, [s, t]: [f64; 2]) -> [f64; K] {
        self.on(&self.along(s), t)
    }
}
