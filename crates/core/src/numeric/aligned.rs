//! Arrays aligned to cache lines.

use std::fmt;
use std::ops::{Deref, DerefMut};

/// Bytes of a cache line, the largest register of any processor.
const LINE: usize = 64;

/// An array whose first number starts a cache line: a register that is loaded from a multiple of 64 bytes on never spans two lines.
pub struct Aligned<T> {
    numbers: Vec<T>,
    first: usize,
}

impl<T: Copy + Default> Aligned<T> {
    /// An array of `len` zeros.
    pub fn new(len: usize) -> Self {
        let spare = LINE / size_of::<T>();
        let mut numbers = vec![T::default(); len + spare];
        let first = numbers.as_ptr().align_offset(LINE).min(spare);
        numbers.truncate(first + len);
        Self { numbers, first }
    }
}

impl<T> Deref for Aligned<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.numbers[self.first..]
    }
}

impl<T> DerefMut for Aligned<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.numbers[self.first..]
    }
}

impl<T: Copy + Default> Default for Aligned<T> {
    fn default() -> Self {
        Self::new(0)
    }
}

impl<T> fmt::Debug for Aligned<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} numbers", self.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_number_starts_a_cache_line() {
        for len in [0, 1, 7, 1000] {
            let (double, single) = (Aligned::<f64>::new(len), Aligned::<f32>::new(len));
            assert_eq!((double.len(), single.len()), (len, len));
            assert_eq!(double.as_ptr().align_offset(LINE), 0);
            assert_eq!(single.as_ptr().align_offset(LINE), 0);
        }
    }
}
