//! Discrete Fourier transforms, several series of numbers at a time: as many as take 64 bytes, eight in double and sixteen in
//! single precision.
//!
//! - `butterflies`: short transforms of series in the lanes of vectors;
//! - `columns`: complex columns, forward and inverse, without reordering between;
//! - `rows`: real rows, by the same stages;
//! - `nonuniform`: sums of waves of any frequency at equally spaced points;
//! - `field`: whole fields of any size by rustfft, outside of iterations.
//!
//! A field is transformed by groups of as many rows, then by blocks of as many columns. A block consists of lines, one for each
//! row, with the real and the imaginary parts of its columns.

mod butterflies;
mod columns;
pub(crate) mod field;
mod nonuniform;
mod rows;

pub(crate) use columns::{Columns, LINE, line};
pub(crate) use nonuniform::Nonuniform;
pub(crate) use rows::{Buffers, Rows};

/// Least number ≥ `n` whose prime factors are 2, 3, 5 and 7, for which transforms are fast.
pub fn fast_points(n: usize) -> usize {
    (n.max(1)..).find(|&m| has_fast_factors(m)).unwrap_or(n)
}

/// Whether the prime factors of `n` are 2, 3, 5 and 7 only.
pub fn has_fast_factors(n: usize) -> bool {
    let mut rest = n;
    for factor in [2, 3, 5, 7] {
        while rest > 0 && rest.is_multiple_of(factor) {
            rest /= factor;
        }
    }
    rest == 1
}
