//! Transforms of whole fields of any size, used once, outside of iterations.
//!
//! X_{k₁k₂} = (1/N₁N₂) Σ x_{j₁j₂} e^{−2πi(k₁j₁/N₁ + k₂j₂/N₂)} for 0 ≤ k₁ < N₁ and 0 ≤ k₂ ≤ N₂/2: of a real field the others
//! are conjugates of these.

use ndarray::{Array2, ArrayView2};
use percoat_fft::{Complex, FftDirection};
use rayon::prelude::*;

const ZERO: Complex<f64> = Complex::new(0.0, 0.0);

/// Components of a field, shape (N₁, N₂/2 + 1).
pub fn components(field: ArrayView2<'_, f64>) -> Array2<Complex<f64>> {
    components_above(field, 0.0)
}

/// Components of a field less a value that all samples have in common, shape (N₁, N₂/2 + 1).
pub fn components_above(field: ArrayView2<'_, f64>, common: f64) -> Array2<Complex<f64>> {
    let (n1, n2) = field.dim();
    let plan = percoat_fft::of_real(n2);
    let half = n2 / 2 + 1;
    let mut values = Array2::from_elem((n1, half), ZERO);
    let rows = values.as_slice_mut().expect("made row by row").par_chunks_mut(half);
    let samples = field.as_standard_layout();
    let samples = samples.as_slice().expect("in standard layout").par_chunks(n2);
    rows.zip(samples).for_each_init(
        || (plan.make_input_vec(), plan.make_scratch_vec()),
        |(input, scratch), (row, samples)| {
            input.iter_mut().zip(samples).for_each(|(input, sample)| *input = sample - common);
            plan.process_with_scratch(input, row, scratch).expect("lengths were planned");
        },
    );
    let scale = 1.0 / (n1 * n2) as f64;
    let mut values = columns(values, FftDirection::Forward);
    values.as_slice_mut().expect("in standard layout").par_iter_mut().for_each(|x| *x *= scale);
    values
}

/// The field of `n2` samples along a₂ with some components; of components that are their own conjugates the real part counts.
pub fn field(components: Array2<Complex<f64>>, n2: usize) -> Array2<f64> {
    let plan = percoat_fft::to_real(n2);
    let mut values = columns(components, FftDirection::Inverse);
    let (n1, half) = values.dim();
    let mut field = Array2::zeros((n1, n2));
    let rows = values.as_slice_mut().expect("made row by row").par_chunks_mut(half);
    let samples = field.as_slice_mut().expect("made row by row").par_chunks_mut(n2);
    rows.zip(samples).for_each_init(
        || plan.make_scratch_vec(),
        |scratch, (row, samples)| {
            row[0].im = 0.0;
            if n2.is_multiple_of(2) {
                row[half - 1].im = 0.0;
            }
            plan.process_with_scratch(row, samples, scratch).expect("lengths were planned");
        },
    );
    field
}

/// Transforms every column; in standard layout.
fn columns(values: Array2<Complex<f64>>, direction: FftDirection) -> Array2<Complex<f64>> {
    let plan = percoat_fft::complex(values.nrows(), direction);
    let mut columns = transposed(values);
    columns.as_slice_mut().expect("in standard layout").par_chunks_mut(plan.len()).for_each_init(
        || vec![ZERO; plan.get_inplace_scratch_len()],
        |scratch, column| plan.process_with_scratch(column, scratch),
    );
    transposed(columns)
}

/// Rows and columns exchanged, in standard layout: by bands of rows of the result.
fn transposed(values: Array2<Complex<f64>>) -> Array2<Complex<f64>> {
    /// Rows of a band: a line of the cache of each row that is read serves half of them.
    const BAND: usize = 8;
    let (rows, columns) = values.dim();
    let values = values.as_standard_layout();
    let from = values.as_slice().expect("in standard layout");
    let mut result = Array2::from_elem((columns, rows), ZERO);
    let bands = result.as_slice_mut().expect("made row by row").par_chunks_mut(BAND * rows).enumerate();
    bands.for_each(|(band, to)| {
        let (first, count) = (band * BAND, to.len() / rows);
        for (row, values) in from.chunks_exact(columns).enumerate() {
            for (k, value) in values[first..first + count].iter().enumerate() {
                to[k * rows + row] = *value;
            }
        }
    });
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn components_are_the_direct_sums_and_lead_back() {
        for (n1, n2) in [(6, 8), (5, 7), (11, 4), (1, 3)] {
            let x = Array2::from_shape_fn((n1, n2), |(i, j)| ((7 * i + 3 * j * j) % 11) as f64 - 4.0);
            let found = components(x.view());
            for ((k1, k2), value) in found.indexed_iter() {
                let mut sum = ZERO;
                for ((i, j), &x) in x.indexed_iter() {
                    let turns = (k1 * i) as f64 / n1 as f64 + (k2 * j) as f64 / n2 as f64;
                    sum += Complex::from_polar(x / (n1 * n2) as f64, -TAU * turns);
                }
                assert!((sum - value).norm() < 1e-14, "{n1} × {n2}, ({k1}, {k2})");
            }
            let back = field(found, n2);
            assert!((&back - &x).iter().all(|d| d.abs() < 1e-13));
        }
    }
}
