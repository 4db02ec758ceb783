//! Fields that pass through an operator row by row.
//!
//! A source fills row after row of a block of the grid for the first pass of a convolution, a sink receives row after row of
//! the result from its last pass: loops before and after a convolution share its way through memory.

use crate::numeric::lanes::Real;
use crate::numeric::rows::{RowBlocks, next};
use rayon::prelude::*;

/// One function for each [block](RowBlocks) of the rows, called with row after row of it: to fill them (a source) or to use them
/// (a sink).
pub trait ByRows<T>: IntoParallelIterator<Item: FnMut(&mut [T]), Iter: IndexedParallelIterator> {}

impl<T, S> ByRows<T> for S where S: IntoParallelIterator<Item: FnMut(&mut [T]), Iter: IndexedParallelIterator> {}

/// Result of an operator that is still to be taken, row by row.
pub trait ResultRows<T>: Sized {
    /// Passes all rows to the sinks, which may overwrite them.
    ///
    /// # Panics
    /// When there are not as many sinks as blocks.
    fn rows(self, sinks: impl ByRows<T>) {
        self.some_rows(|_| true, sinks);
    }

    /// Passes all rows to the sinks, those that are not `needed` possibly as zeros.
    ///
    /// # Panics
    /// When there are not as many sinks as blocks.
    fn some_rows(self, needed: impl Fn(usize) -> bool + Sync, sinks: impl ByRows<T>);
}

/// Sources that copy the rows of a field.
pub fn rows_of<T: Real>(blocks: RowBlocks, field: &[T]) -> impl IndexedParallelIterator<Item: FnMut(&mut [T])> {
    blocks.of(field).map(|mut rows| move |to: &mut [T]| to.copy_from_slice(next(&mut rows)))
}

/// Sinks that copy rows to those of a field.
pub fn rows_to<T: Real>(blocks: RowBlocks, field: &mut [T]) -> impl IndexedParallelIterator<Item: FnMut(&mut [T])> {
    blocks.of_mut(field).map(|mut rows| move |from: &mut [T]| next(&mut rows).copy_from_slice(from))
}
