//! Passes over fields row by row, on all threads, with sums that do not depend on the number of threads.
//!
//! Each row, or each block of rows, gives its own sums and minima, which are added in order.

use rayon::prelude::*;
use std::slice::{ChunksExact, ChunksExactMut};

/// Largest number of blocks that rows are divided into.
const MOST_BLOCKS: usize = 64;
/// Least number of rows of a block.
const LEAST_ROWS: usize = 64;

/// Least number of samples of a task.
const TASK: usize = 8192;

/// Sums and least values over rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Totals<const K: usize, const L: usize> {
    pub sums: [f64; K],
    pub least: [f64; L],
}

impl<const K: usize, const L: usize> Totals<K, L> {
    /// Totals of no samples.
    pub const NONE: Self = Self { sums: [0.0; K], least: [f64::INFINITY; L] };

    /// Adds the totals of further samples.
    pub fn add(&mut self, more: Self) {
        self.sums.iter_mut().zip(more.sums).for_each(|(sum, term)| *sum += term);
        self.least.iter_mut().zip(more.least).for_each(|(least, value)| *least = least.min(value));
    }

    /// Totals of all blocks, added in their order.
    pub fn of(blocks: Vec<Self>) -> Self {
        blocks.into_iter().fold(Self::NONE, |mut totals, block| {
            totals.add(block);
            totals
        })
    }
}

/// The division of the rows of fields into blocks, which does not depend on the number of threads: a block is the work of one
/// thread, row after row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RowBlocks {
    points: [usize; 2],
}

impl RowBlocks {
    /// Division of fields of `points` = [rows, columns].
    pub fn new(points: [usize; 2]) -> Self {
        Self { points }
    }

    /// [rows, columns] of the fields.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// Number of rows of a block; the last block may have fewer.
    pub fn rows(&self) -> usize {
        self.points[0].div_ceil(MOST_BLOCKS).max(LEAST_ROWS)
    }

    /// Number of blocks.
    pub fn count(&self) -> usize {
        self.points[0].div_ceil(self.rows())
    }

    /// Totals of no samples, one for each block.
    pub fn totals<const K: usize, const L: usize>(&self) -> Vec<Totals<K, L>> {
        vec![Totals::NONE; self.count()]
    }

    /// The rows of a field, block by block.
    pub fn of<'a, T: Sync>(
        &self,
        field: &'a [T],
    ) -> impl IndexedParallelIterator<Item = ChunksExact<'a, T>> + use<'a, T> {
        let columns = self.points[1];
        field.par_chunks(self.rows() * columns).map(move |block| block.chunks_exact(columns))
    }

    /// The rows of a mutable field, block by block.
    pub fn of_mut<'a, T: Send>(
        &self,
        field: &'a mut [T],
    ) -> impl IndexedParallelIterator<Item = ChunksExactMut<'a, T>> + use<'a, T> {
        let columns = self.points[1];
        field.par_chunks_mut(self.rows() * columns).map(move |block| block.chunks_exact_mut(columns))
    }
}

/// The next row of a block.
///
/// # Panics
/// When the block has no further row.
pub fn next<I: Iterator>(rows: &mut I) -> I::Item {
    rows.next().expect("a block has its rows")
}

/// Totals over fields with a number of `columns`: calls `row(i, rows of the fields)` for each row i.
pub fn row_totals<const K: usize, const L: usize, R>(
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

/// Calls `row(i, rows of the fields)` for each row i of fields with a number of `columns`.
pub fn each_row<R>(columns: usize, rows: R, row: impl Fn(usize, R::Item) + Sync + Send)
where
    R: IntoParallelIterator<Iter: IndexedParallelIterator>,
{
    rows.into_par_iter().with_min_len(TASK.div_ceil(columns)).enumerate().for_each(|(i, fields)| row(i, fields));
}
