//! Work on all threads.
//!
//! A scheduler that is generic in its work is some forty functions for each closure. Here the work is passed as `&dyn`, so that one is
//! compiled for calls by number, and one for each type of working memory and of the chunks of a field. Loops that pass over whole fields in
//! every iteration are generic instead ([`rows`](super::rows)).

use rayon::prelude::*;
use std::sync::OnceLock;

/// Most tasks that a list of values is divided into.
const TASKS: usize = 256;
const CALLED: &str = "each number is called";

/// Calls `work(i)` for 0 ≤ i < `count`.
pub fn each(count: usize, work: impl Fn(usize) + Sync) {
    numbers(count, &work);
}

/// Values of `of(i)` for 0 ≤ i < `count`, in this order.
pub fn map<T: Send + Sync>(count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    map_by(1, count, of)
}

/// Values of `of(i)` for 0 ≤ i < `count`, in this order, `least` or more in a task.
pub fn map_by<T: Send + Sync>(least: usize, count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let length = least.max(count.div_ceil(TASKS)).max(1);
    let parts: Vec<OnceLock<Vec<T>>> = (0..count.div_ceil(length)).map(|_| OnceLock::new()).collect();
    each(parts.len(), |part| {
        let numbers = part * length..count.min((part + 1) * length);
        drop(parts[part].set(numbers.map(&of).collect()));
    });
    let mut values = Vec::with_capacity(count);
    parts.into_iter().for_each(|part| values.extend(part.into_inner().expect(CALLED)));
    values
}

/// Values of `of(memory, i)` for 0 ≤ i < `count`, in this order; tasks have working memory made by `memory`.
pub fn map_with<S, T: Send + Sync>(
    count: usize,
    memory: impl Fn() -> S + Sync,
    of: impl Fn(&mut S, usize) -> T + Sync,
) -> Vec<T> {
    let places: Vec<OnceLock<T>> = (0..count).map(|_| OnceLock::new()).collect();
    each_with(count, &memory, &|memory, i| drop(places[i].set(of(memory, i))));
    places.into_iter().map(|place| place.into_inner().expect(CALLED)).collect()
}

/// Values of `of` for each item, in their order.
pub fn map_items<S: Sync, T: Send + Sync>(items: &[S], of: impl Fn(&S) -> T + Sync) -> Vec<T> {
    map(items.len(), |i| of(&items[i]))
}

/// Values of `of` for the chunks of a list of this length, in their order; the last one may be shorter.
pub fn map_chunks<S: Sync, T: Send + Sync>(items: &[S], length: usize, of: impl Fn(&[S]) -> T + Sync) -> Vec<T> {
    map(items.len().div_ceil(length), |number| of(&items[number * length..items.len().min((number + 1) * length)]))
}

/// Calls `work(k, chunk k)` for the chunks of a field of this length; the last one may be shorter.
pub fn each_chunk<T: Send>(field: &mut [T], length: usize, work: impl Fn(usize, &mut [T]) + Sync) {
    chunks(field, length, &work);
}

/// Calls `work(memory, k, chunk k)` for the chunks of a field of this length; tasks have working memory made by `memory`.
pub fn each_chunk_with<T: Send, S>(
    field: &mut [T],
    length: usize,
    memory: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut [T]) + Sync,
) {
    chunks_with(field, length, &memory, &work);
}

fn numbers(count: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(work);
}

fn each_with<S>(count: usize, memory: &(dyn Fn() -> S + Sync), work: &(dyn Fn(&mut S, usize) + Sync)) {
    (0..count).into_par_iter().for_each_init(memory, |memory, i| work(memory, i));
}

fn chunks<T: Send>(field: &mut [T], length: usize, work: &(dyn Fn(usize, &mut [T]) + Sync)) {
    field.par_chunks_mut(length).enumerate().for_each(|(number, chunk)| work(number, chunk));
}

fn chunks_with<T: Send, S>(
    field: &mut [T],
    length: usize,
    memory: &(dyn Fn() -> S + Sync),
    work: &(dyn Fn(&mut S, usize, &mut [T]) + Sync),
) {
    let chunks = field.par_chunks_mut(length).enumerate();
    chunks.for_each_init(memory, |memory, (number, chunk)| work(memory, number, chunk));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_in_order_whatever_the_tasks() {
        for (least, count) in [(0, 0), (1, 0), (1, 1), (0, 1000), (1, 1000), (64, 1000), (5000, 1000)] {
            assert_eq!(map_by(least, count, |i| vec![i; 2]), (0..count).map(|i| vec![i; 2]).collect::<Vec<_>>());
        }
        assert_eq!(map_with(1000, || 7, |seven, i| i + *seven), (7..1007).collect::<Vec<_>>());
        let mut field = vec![0; 1003];
        each_chunk(&mut field, 100, |k, chunk| chunk.iter_mut().enumerate().for_each(|(i, x)| *x = 100 * k + i));
        assert_eq!(field, (0..1003).collect::<Vec<_>>());
    }
}
