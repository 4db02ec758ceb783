//! Linear least squares of a few unknowns by normal equations.

/// Coefficients c that minimise Σ (Σₖ cₖ `row[k]` − value)²; `None` when the rows do not determine c.
///
/// Meant for a few tens of unknowns with basis functions of order one.
pub fn fit(unknowns: usize, rows: impl Iterator<Item = (Vec<f64>, f64)>) -> Option<Vec<f64>> {
    let mut matrix = vec![vec![0.0; unknowns]; unknowns];
    let mut right = vec![0.0; unknowns];
    for (row, value) in rows {
        for ((line, right), factor) in matrix.iter_mut().zip(&mut right).zip(&row) {
            *right += factor * value;
            // The lower triangle alone is needed, but whole rows are summed faster.
            line.iter_mut().zip(&row).for_each(|(sum, other)| *sum += factor * other);
        }
    }
    solved(matrix, right)
}

/// Solution of normal equations, whose matrix is given by its lower triangle; `None` when they do not determine c.
pub(super) fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let unknowns = right.len();
    // Cholesky: matrix = L Lᵀ, in place.
    for i in 0..unknowns {
        for j in 0..=i {
            let rest = matrix[i][j] - product(&matrix[i][..j], &matrix[j][..j]);
            if i > j {
                matrix[i][j] = rest / matrix[j][j];
            } else if rest > 1e-13 * matrix[i][i] {
                matrix[i][i] = rest.sqrt();
            } else {
                return None;
            }
        }
    }
    for i in 0..unknowns {
        right[i] = (right[i] - product(&matrix[i][..i], &right[..i])) / matrix[i][i];
    }
    for i in (0..unknowns).rev() {
        let known: f64 = (i + 1..unknowns).map(|k| matrix[k][i] * right[k]).sum();
        right[i] = (right[i] - known) / matrix[i][i];
    }
    Some(right)
}

/// Scalar product Σ aᵢbᵢ, by eight independent sums.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let ((groups, rest), (others, others_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    for (a, b) in groups.iter().zip(others) {
        (0..8).for_each(|k| sums[k] += a[k] * b[k]);
    }
    sums.iter().sum::<f64>() + rest.iter().zip(others_rest).map(|(a, b)| a * b).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_recovered_and_too_few_rows_are_refused() {
        let row = |x: f64| (vec![1.0, x, x * x], 2.0 - x + 0.5 * x * x);
        let c = fit(3, (0..9).map(|i| row(f64::from(i) / 8.0))).unwrap();
        for (found, expected) in c.iter().zip([2.0, -1.0, 0.5]) {
            assert!((found - expected).abs() < 1e-11);
        }
        assert!(fit(3, (0..2).map(|i| row(f64::from(i)))).is_none());
    }
}
