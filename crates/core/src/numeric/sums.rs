//! Sums over fields that do not depend on the number of threads.
//!
//! A field is divided into blocks of fixed length; blocks are summed on any thread, their sums added in order. Within a block
//! several independent sums run in parallel lanes.

use super::parallel;

/// Length of a block.
pub const BLOCK: usize = 4096;
/// Number of independent sums within a block.
const INDEPENDENT: usize = 8;

/// Sums Σᵢ term(i), `K` at once, over 0 ≤ i < `len`.
pub fn of<const K: usize>(len: usize, term: impl Fn(usize) -> [f64; K] + Sync + Send) -> [f64; K] {
    let add = |total: [f64; K], part: [f64; K]| std::array::from_fn(|k| total[k] + part[k]);
    let of_block = |block: usize| {
        let (start, end) = (block * BLOCK, len.min((block + 1) * BLOCK));
        let whole = start + (end - start) / INDEPENDENT * INDEPENDENT;
        let mut sums = [[0.0; K]; INDEPENDENT];
        for first in (start..whole).step_by(INDEPENDENT) {
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum = add(*sum, term(first + k));
            }
        }
        (whole..end).map(&term).fold(sums.into_iter().fold([0.0; K], add), add)
    };
    let blocks: Vec<[f64; K]> = parallel::map(len.div_ceil(BLOCK), of_block);
    blocks.into_iter().fold([0.0; K], add)
}

/// Least term(i) over 0 ≤ i < `len`, +∞ for none.
pub fn least(len: usize, term: impl Fn(usize) -> f64 + Sync + Send) -> f64 {
    let of_block =
        |block: usize| (block * BLOCK..len.min((block + 1) * BLOCK)).map(&term).fold(f64::INFINITY, f64::min);
    parallel::map(len.div_ceil(BLOCK), of_block).into_iter().fold(f64::INFINITY, f64::min)
}

/// Sets every `field[i]` to `value(i, field[i])`.
pub fn update<T: Copy + Send + Sync>(field: &mut [T], value: impl Fn(usize, T) -> T + Sync + Send) {
    parallel::each_chunk(field, BLOCK, |block, values| {
        values.iter_mut().enumerate().for_each(|(i, x)| *x = value(block * BLOCK + i, *x));
    });
}

/// Mean of a field.
pub fn mean(field: &[f64]) -> f64 {
    let [sum] = of(field.len(), |i| [field[i]]);
    sum / field.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole numbers below 2⁵³, which any order adds exactly: every term counts once, in whole blocks and in the rest of a block.
    #[test]
    fn every_term_is_added_once() {
        for len in [0, 1, 7, 8, 9, BLOCK - 1, BLOCK, BLOCK + 13, 3 * BLOCK + 8] {
            let squares = (0..len).map(|i| (i * i) as f64).sum::<f64>();
            assert_eq!(of(len, |i| [1.0, (i * i) as f64]), [len as f64, squares], "{len}");
        }
    }
}
