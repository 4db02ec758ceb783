//! Sweeps over fields row by row, on all threads, with sums that do not depend on how many there are.
//!
//! Each row, or each part of the rows, gives its own sums and minima; they are added in order.

use rayon::prelude::*;
use std::slice::{ChunksExact, ChunksExactMut};

/// Most parts the rows are divided into, and the least rows of one.
const PARTS: usize = 64;
const LEAST: usize = 64;

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

/// The rows of fields in parts, whatever the number of threads: each is the work of one of them, row after row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parts {
    points: [usize; 2],
}

impl Parts {
    /// Of fields of `points` = [rows, columns].
    pub fn new(points: [usize; 2]) -> Self {
        Self { points }
    }

    /// [rows, columns] of the fields.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// Rows of a part; the last one may have fewer.
    pub fn rows(&self) -> usize {
        self.points[0].div_ceil(PARTS).max(LEAST)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.points[0].div_ceil(self.rows())
    }

    /// Totals of each, of nothing yet.
    pub fn totals<const K: usize, const L: usize>(&self) -> Vec<Totals<K, L>> {
        vec![Totals::NONE; self.count()]
    }

    /// The rows of a field, by parts.
    pub fn of<'a, T: Sync>(
        &self,
        field: &'a [T],
    ) -> impl IndexedParallelIterator<Item = ChunksExact<'a, T>> + use<'a, T> {
        let columns = self.points[1];
        field.par_chunks(self.rows() * columns).map(move |part| part.chunks_exact(columns))
    }

    /// The same, to be written.
    pub fn of_mut<'a, T: Send>(
        &self,
        field: &'a mut [T],
    ) -> impl IndexedParallelIterator<Item = ChunksExactMut<'a, T>> + use<'a, T> {
        let columns = self.points[1];
        field.par_chunks_mut(self.rows() * columns).map(move |part| part.chunks_exact_mut(columns))
    }
}

/// The next row of a part.
///
/// # Panics
/// When there is none.
pub fn next<I: Iterator>(rows: &mut I) -> I::Item {
    rows.next().expect("a part has its rows")
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
