//! Fields as arrays with their shape, and as the samples they are made of.

use ndarray::{Array, Array2, ArrayView2, Dimension};

/// The field of [n₁, n₂] samples, given row by row.
///
/// # Panics
/// When there are other than n₁n₂ samples.
pub fn field<T>(points: [usize; 2], samples: Vec<T>) -> Array2<T> {
    Array2::from_shape_vec(points, samples).expect("as many samples as the field has points")
}

/// [n₁, n₂] samples, given row by row, as a field.
///
/// # Panics
/// When there are other than n₁n₂ samples.
pub fn view<T>(points: [usize; 2], samples: &[T]) -> ArrayView2<'_, T> {
    ArrayView2::from_shape(points, samples).expect("as many samples as the field has points")
}

/// The samples of a field, row by row, or of several one after the other.
///
/// # Panics
/// When the field is not stored that way.
pub fn samples<T, D: Dimension>(field: &Array<T, D>) -> &[T] {
    field.as_slice().expect("fields are stored row by row")
}
