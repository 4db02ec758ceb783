//! Fields as arrays with their shape, and as slices of their samples.

use ndarray::{Array, Array2, ArrayView2, Dimension};

/// Field of [n₁, n₂] samples, given row by row.
///
/// # Panics
/// When the number of samples is not n₁n₂.
pub fn field<T>(points: [usize; 2], samples: Vec<T>) -> Array2<T> {
    Array2::from_shape_vec(points, samples).expect("as many samples as the field has points")
}

/// View of [n₁, n₂] samples, given row by row, as a field.
///
/// # Panics
/// When the number of samples is not n₁n₂.
pub fn view<T>(points: [usize; 2], samples: &[T]) -> ArrayView2<'_, T> {
    ArrayView2::from_shape(points, samples).expect("as many samples as the field has points")
}

/// Samples of a field, row by row, or of several fields one after the other.
///
/// # Panics
/// When the array is not in standard layout.
pub fn samples<T, D: Dimension>(field: &Array<T, D>) -> &[T] {
    field.as_slice().expect("fields are stored row by row")
}
