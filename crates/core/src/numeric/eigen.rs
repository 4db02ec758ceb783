//! Eigenvalues and eigenvectors of small symmetric matrices by Jacobi's rotations.
//!
//! A rotation in the plane of i and j takes aᵢⱼ away; cycles over all pairs end where every |aᵢⱼ| ≤ ε √(aᵢᵢ aⱼⱼ). By this criterion
//! small eigenvalues of a positive definite matrix keep their relative accuracy where its rows differ in scale: J. Demmel and
//! K. Veselić, SIAM J. Matrix Anal. Appl. 13, 1204 (1992).

/// Off-diagonal part, over the geometric mean of its diagonal elements, that counts as zero.
const TOLERANCE: f64 = 1e-16;
/// Most cycles over all pairs; six or seven are usual.
const MOST_CYCLES: usize = 40;

/// Eigenvalues λⱼ of a symmetric matrix, given by its rows, each with its eigenvector of length one.
pub fn eigen(mut rows: Vec<Vec<f64>>) -> Vec<(f64, Vec<f64>)> {
    let n = rows.len();
    let mut vectors: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|k| f64::from(u8::from(i == k))).collect()).collect();
    for _ in 0..MOST_CYCLES {
        let mut rotated = false;
        for (i, j) in (0..n).flat_map(|j| (0..j).map(move |i| (i, j))) {
            let [aii, ajj, aij] = [rows[i][i], rows[j][j], rows[i][j]];
            if aij.abs() > TOLERANCE * (aii * ajj).abs().sqrt() {
                rotate(&mut rows, &mut vectors, i, j);
                rotated = true;
            }
        }
        if !rotated {
            break;
        }
    }
    vectors.into_iter().enumerate().map(|(k, vector)| (rows[k][k], vector)).collect()
}

/// Rotates rows, columns and vectors i < j so that aᵢⱼ becomes zero.
fn rotate(rows: &mut [Vec<f64>], vectors: &mut [Vec<f64>], i: usize, j: usize) {
    let off = rows[i][j];
    // tan of the lesser of both angles: t² + 2t cot 2φ = 1.
    let cotangent = (rows[j][j] - rows[i][i]) / (2.0 * off);
    let tangent = cotangent.signum() / (cotangent.abs() + cotangent.hypot(1.0));
    let cosine = tangent.hypot(1.0).recip();
    let sine = tangent * cosine;
    for k in (0..rows.len()).filter(|&k| k != i && k != j) {
        let [x, y] = [rows[k][i], rows[k][j]];
        let [x, y] = [cosine * x - sine * y, sine * x + cosine * y];
        (rows[k][i], rows[i][k], rows[k][j], rows[j][k]) = (x, x, y, y);
    }
    rows[i][i] -= tangent * off;
    rows[j][j] += tangent * off;
    (rows[i][j], rows[j][i]) = (0.0, 0.0);
    let (head, tail) = vectors.split_at_mut(j);
    for (x, y) in head[i].iter_mut().zip(&mut tail[0]) {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between −1 and 1 without a pattern.
    fn noise(seed: usize) -> f64 {
        let x = (seed as f64 * 12.9898).sin() * 43758.5453;
        2.0 * (x - x.floor()) - 1.0
    }

    #[test]
    fn eigenvectors_are_orthonormal_and_make_the_matrix_again() {
        for n in [1, 2, 5, 12, 20] {
            let entry = |i: usize, k: usize| noise(31 * i.min(k) + i.max(k) + 7);
            let matrix: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|k| entry(i, k)).collect()).collect();
            let pairs = eigen(matrix.clone());
            for (i, k) in (0..n).flat_map(|i| (0..n).map(move |k| (i, k))) {
                let sum: f64 = pairs.iter().map(|(value, vector)| value * vector[i] * vector[k]).sum();
                let product: f64 = pairs[i].1.iter().zip(&pairs[k].1).map(|(x, y)| x * y).sum();
                assert!((sum - matrix[i][k]).abs() < 1e-14 * n as f64, "{n}: {i}, {k}");
                assert!((product - f64::from(u8::from(i == k))).abs() < 1e-14 * n as f64);
            }
        }
    }

    /// D A D with A near to the unit matrix and D over twelve decades: the determinant to rounding, and every eigenvalue near d².
    #[test]
    fn graded_matrices_have_their_small_eigenvalues_to_rounding() {
        let scale = |i: usize| 10f64.powi(2 * i as i32 - 6);
        let entry = |i: usize, k: usize| scale(i) * scale(k) * if i == k { 1.0 } else { 0.1 };
        let pairs = eigen((0..7).map(|i| (0..7).map(|k| entry(i, k)).collect()).collect());
        // det(0.9 + 0.1 𝟏𝟏ᵀ) = 0.9⁶ · 1.6, and the scales multiply to one.
        let determinant: f64 = pairs.iter().map(|(value, _)| value).product();
        assert!((determinant / (0.9f64.powi(6) * 1.6) - 1.0).abs() < 1e-14, "{determinant}");
        assert!((0..7).all(|i| (pairs[i].0 / scale(i).powi(2) - 1.0).abs() < 0.2), "{pairs:?}");
    }
}
