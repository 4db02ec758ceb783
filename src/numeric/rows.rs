//! Sweeps over fields row by row, on all threads, with sums that do not depend on how many there are.
//!
//! Each row gives its own sums and minima; those of the rows are added in order.

use rayon::prelude::*;

/// Samples that are worth a task of their own.
const TASK: usize = 8192;

/// Σ and least value over all rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Totals<const K: usize, const L: usize> {
    pub sums: [f64; K],
    pub least: [f64; L],
}

impl<const K: usize, const L: usize> Totals<K, L> {
    /// Those of nothing.
    pub const NONE: Self = Self { sums: [0.0; K], least: [f64::INFINITY; L] };

    /// Takes in those of further samples.
    pub fn add(&mut self, more: Self) {
        self.sums.iter_mut().zip(more.sums).for_each(|(sum, term)| *sum += term);
        self.least.iter_mut().zip(more.least).for_each(|(least, value)| *least = least.min(value));
    }

    /// Those of all parts, in their order.
    pub fn of(parts: Vec<Self>) -> Self {
        parts.into_iter().fold(Self::NONE, |mut totals, part| {
            totals.add(part);
            totals
        })
    }
}

/// Calls `row(i, rows of the fields)` for each row of fields with so many `columns`.
pub fn sweep<const K: usize, const L: usize, R>(
    columns: usize,
    rows: R,
    row: impl Fn(usize, R::Item) -> Totals<K, L> + Sync + Send,
) -> Totals<K, L>
where
    R: IntoParallelIterator<Iter: IndexedParallelIterator>,
{
    let rows = rows.into_par_iter().with_min_len(TASK.div_ceil(columns)).enumerate();
    Totals::of(rows.map(|(i, fields)| row(i, fields)).collect())
}

/// The same without sums.
pub fn each<R>(columns: usize, rows: R, row: impl Fn(usize, R::Item) + Sync + Send)
where
    R: IntoParallelIterator<Iter: IndexedParallelIterator>,
{
    rows.into_par_iter().with_min_len(TASK.div_ceil(columns)).enumerate().for_each(|(i, fields)| row(i, fields));
}
