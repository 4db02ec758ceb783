//! Small dense systems of linear equations by Gauss' elimination with row exchange.

use super::number::Number;
use super::search::largest;

/// Pivot over the row's largest entry below which it is taken for a rounding error of zero.
const SINGULAR: f64 = 1e-13;

/// Solution x of Σₖ aᵢₖ xₖ = bᵢ, aᵢₖ = `rows[i][k]`, bᵢ = `right[i]`, real or complex; `None` when the real matrix is singular to working
/// precision.
pub fn solve<N: Number>(mut rows: Vec<Vec<f64>>, mut right: Vec<N>) -> Option<Vec<N>> {
    let n = right.len();
    let mut scales: Vec<f64> = rows.iter().map(|row| largest(row.iter().map(|x| x.abs()))).collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs()))?;
        rows.swap(k, pivot);
        right.swap(k, pivot);
        scales.swap(k, pivot);
        if rows[k][k].abs() <= SINGULAR * scales[k] || !rows[k][k].is_finite() {
            return None;
        }
        let (head, tail) = rows.split_at_mut(k + 1);
        let lead = &head[k];
        for (row, i) in tail.iter_mut().zip(k + 1..) {
            let factor = row[k] / lead[k];
            row[k..].iter_mut().zip(&lead[k..]).for_each(|(x, y)| *x -= factor * y);
            right[i] = right[i] - right[k] * factor;
        }
    }
    for k in (0..n).rev() {
        let known = (k + 1..n).fold(N::from(0.0), |sum, m| sum + right[m] * rows[k][m]);
        right[k] = (right[k] - known) / rows[k][k];
    }
    Some(right)
}

#[cfg(test)]
mod tests {
    use super::solve;
    use rustfft::num_complex::Complex64;

    #[test]
    fn rows_are_exchanged_and_singular_systems_refused() {
        let x =
            solve(vec![vec![0.0, 2.0, 1.0], vec![1.0, 1.0, 0.0], vec![3.0, 0.0, 1.0]], vec![7.0, 3.0, 6.0]).unwrap();
        for (found, expected) in x.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - expected).abs() < 1e-14, "{x:?}");
        }
        let right = [7.0, 3.0, 6.0].map(|x| Complex64::new(x, -2.0 * x)).to_vec();
        let complex = solve(vec![vec![0.0, 2.0, 1.0], vec![1.0, 1.0, 0.0], vec![3.0, 0.0, 1.0]], right).unwrap();
        assert!(complex.iter().zip(&x).all(|(complex, x)| (complex - Complex64::new(*x, -2.0 * x)).norm() < 1e-14));
        assert!(solve(vec![vec![1.0, 2.0], vec![2.0, 4.0]], vec![1.0, 2.0]).is_none());
        assert!(solve(vec![vec![0.1, 0.7], vec![0.3, 2.1]], vec![1.0, 2.0]).is_none(), "rounding leaves −1e-16");
        assert!(solve(vec![vec![f64::NAN]], vec![1.0]).is_none());
    }
}
