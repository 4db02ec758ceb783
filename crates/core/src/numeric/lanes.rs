//! Loops over eight numbers at a time, by the vector instructions of this processor.
//!
//! Loops over a row take its samples in groups of eight, in double precision whatever the precision of the row; the
//! last group is padded. A sum keeps eight lanes apart and adds them in one order at the end, so that a row has the
//! same sum on any thread. (Fused multiply-add is used where the processor has it, and transforms are split by the width of
//! its registers: results of different processors may differ in the last digits.)

use fearless_simd::{f32x4, f32x8, f32x16, f64x2, f64x8, prelude::*};
use rustfft::FftNum;

/// Length of a group.
pub const LANES: usize = 8;

/// Length of the runs that are skipped where they are [all zero](all_zero): four cache lines in single precision.
pub const RUN: usize = 64;

/// Evaluates an expression with the vector instructions of this processor.
macro_rules! vectorised {
    ($simd:ident => $operation:expr) => {
        fearless_simd::dispatch!(fearless_simd::Level::new(), $simd => $operation)
    };
}
pub(crate) use vectorised;

/// A real number, of single or double precision.
pub trait Real: FftNum + SimdFloatElement + Default + bytemuck::Pod {
    /// Number of values in 64 bytes, a cache line.
    const WIDTH: usize;

    /// Eight values.
    type Lanes<S: Simd>: SimdFloat<S, Element = Self>;

    /// Values of one register of the processor; their number divides `WIDTH`.
    type Register<S: Simd>: SimdFloat<S, Element = Self>;

    /// `WIDTH` values.
    type Wide<S: Simd>: SimdFloat<S, Element = Self>;

    /// Transposes `WIDTH` runs of `WIDTH` numbers: number j of run i, at `from[i · apart + j]`, to `to[j · spread + i]`.
    fn transpose<S: Simd>(simd: S, from: &[Self], apart: usize, to: &mut [Self], spread: usize);

    /// The value rounded to this precision.
    fn rounded(value: f64) -> Self;

    /// The value in double precision.
    fn double(self) -> f64;

    /// Group of a row from index `at` on, in double precision; padded with `beyond` at the row's end.
    fn group<S: Simd>(simd: S, row: &[Self], at: usize, beyond: Self) -> f64x8<S>;

    /// A group rounded to this precision.
    fn lanes<S: Simd>(group: f64x8<S>) -> Self::Lanes<S>;

    /// Stores a group in a row from index `at` on, rounded to this precision.
    fn put<S: Simd>(group: f64x8<S>, row: &mut [Self], at: usize);
}

impl Real for f64 {
    const WIDTH: usize = 8;
    type Lanes<S: Simd> = f64x8<S>;
    type Register<S: Simd> = S::f64s;
    type Wide<S: Simd> = f64x8<S>;

    #[inline(always)]
    fn transpose<S: Simd>(simd: S, from: &[Self], apart: usize, to: &mut [Self], spread: usize) {
        if S::f64s::LEN < Self::WIDTH {
            transpose_by_blocks::<S, f64x2<S>, 2, { Self::WIDTH }>(simd, from, apart, to, spread);
        } else {
            transpose_by_blocks::<S, f64x8<S>, 8, { Self::WIDTH }>(simd, from, apart, to, spread);
        }
    }

    #[inline(always)]
    fn rounded(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn double(self) -> f64 {
        self
    }

    #[inline(always)]
    fn group<S: Simd>(simd: S, row: &[Self], at: usize, beyond: Self) -> f64x8<S> {
        match row.get(at..at + LANES) {
            Some(whole) => f64x8::from_slice(simd, whole),
            None => f64x8::from_slice(simd, &padded(row, at, beyond)),
        }
    }

    #[inline(always)]
    fn lanes<S: Simd>(group: f64x8<S>) -> Self::Lanes<S> {
        group
    }

    #[inline(always)]
    fn put<S: Simd>(group: f64x8<S>, row: &mut [Self], at: usize) {
        match row.get_mut(at..at + LANES) {
            Some(whole) => group.store_slice(whole),
            None => row[at..].iter_mut().zip(group.as_slice()).for_each(|(to, from)| *to = *from),
        }
    }
}

impl Real for f32 {
    const WIDTH: usize = 16;
    type Lanes<S: Simd> = f32x8<S>;
    type Register<S: Simd> = S::f32s;
    type Wide<S: Simd> = f32x16<S>;

    #[inline(always)]
    fn transpose<S: Simd>(simd: S, from: &[Self], apart: usize, to: &mut [Self], spread: usize) {
        if S::f32s::LEN < Self::WIDTH {
            transpose_by_blocks::<S, f32x4<S>, 4, { Self::WIDTH }>(simd, from, apart, to, spread);
        } else {
            transpose_by_blocks::<S, f32x16<S>, 16, { Self::WIDTH }>(simd, from, apart, to, spread);
        }
    }

    #[inline(always)]
    fn rounded(value: f64) -> Self {
        value as Self
    }

    #[inline(always)]
    fn double(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn group<S: Simd>(simd: S, row: &[Self], at: usize, beyond: Self) -> f64x8<S> {
        let (low, high) = match row.get(at..at + LANES) {
            Some(whole) => f32x8::from_slice(simd, whole),
            None => f32x8::from_slice(simd, &padded(row, at, beyond)),
        }
        .widen();
        low.combine(high)
    }

    #[inline(always)]
    fn lanes<S: Simd>(group: f64x8<S>) -> Self::Lanes<S> {
        let (low, high) = group.split();
        low.narrow(high)
    }

    #[inline(always)]
    fn put<S: Simd>(group: f64x8<S>, row: &mut [Self], at: usize) {
        let group = Self::lanes(group);
        match row.get_mut(at..at + LANES) {
            Some(whole) => group.store_slice(whole),
            None => row[at..].iter_mut().zip(group.as_slice()).for_each(|(to, from)| *to = *from),
        }
    }
}

/// The [transpose](Real::transpose) of W runs of W numbers, by blocks of N vectors of N numbers.
///
/// Blocks are of 128 bits where a register holds fewer than W numbers: transposing wider ones takes more instructions for each
/// number, since numbers cross the halves of a register.
#[inline(always)]
fn transpose_by_blocks<S: Simd, V: SimdFloat<S>, const N: usize, const W: usize>(
    simd: S,
    from: &[V::Element],
    apart: usize,
    to: &mut [V::Element],
    spread: usize,
) {
    for i in (0..W).step_by(N) {
        for j in (0..W).step_by(N) {
            let mut vectors = [V::from_slice(simd, &from[i * apart + j..][..N]); N];
            for k in 1..N {
                vectors[k] = V::from_slice(simd, &from[(i + k) * apart + j..][..N]);
            }
            // Each interleaving rotates the bits of a number's index, vector and lane, by one.
            for _ in 0..N.trailing_zeros() {
                let before = vectors;
                for pair in 0..N / 2 {
                    (vectors[2 * pair], vectors[2 * pair + 1]) = before[pair].interleave(before[pair + N / 2]);
                }
            }
            for k in 0..N {
                vectors[k].store_slice(&mut to[(j + k) * spread + i..][..N]);
            }
        }
    }
}

/// Group of a row from index `at` on, in the row's own precision; padded with `beyond` at the row's end.
#[inline(always)]
pub fn own_group<S: Simd, T: Real>(simd: S, row: &[T], at: usize, beyond: T) -> T::Lanes<S> {
    match row.get(at..at + LANES) {
        Some(whole) => T::Lanes::<S>::from_slice(simd, whole),
        None => T::Lanes::<S>::from_slice(simd, &padded(row, at, beyond)),
    }
}

/// The last numbers of a row from index `at` on, padded with `beyond`. A function that is not inlined, so that loops over whole
/// groups stay free of its code.
#[cold]
#[inline(never)]
fn padded<T: Real>(row: &[T], at: usize, beyond: T) -> [T; LANES] {
    let mut group = [beyond; LANES];
    group[..row.len() - at].copy_from_slice(&row[at..]);
    group
}

/// Whether all numbers are zero.
#[inline(always)]
pub fn all_zero<S: Simd, T: Real>(simd: S, numbers: &[T]) -> bool {
    let (zero, whole) = (T::Wide::<S>::simd_from(simd, T::zero()), numbers.len() / T::WIDTH * T::WIDTH);
    for wide in numbers[..whole].chunks_exact(T::WIDTH) {
        if T::Wide::<S>::from_slice(simd, wide).simd_eq(zero).any_false() {
            return false;
        }
    }
    for number in &numbers[whole..] {
        if *number != T::zero() {
            return false;
        }
    }
    true
}

/// Sum of eight lanes, in a fixed order.
#[inline(always)]
pub fn total<S: Simd>(lanes: f64x8<S>) -> f64 {
    let l = lanes.as_slice();
    ((l[0] + l[1]) + (l[2] + l[3])) + ((l[4] + l[5]) + (l[6] + l[7]))
}

/// The least of eight lanes.
#[inline(always)]
pub fn lowest<S: Simd>(lanes: f64x8<S>) -> f64 {
    lanes.as_slice().iter().fold(f64::INFINITY, |least, &x| least.min(x))
}

/// A group of eight equal numbers.
#[inline(always)]
pub fn splat<S: Simd>(simd: S, value: f64) -> f64x8<S> {
    f64x8::simd_from(simd, value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blocks of 128 bits, those of processors whose registers are short, and blocks of all W numbers.
    #[test]
    fn transposes_put_every_number_in_its_place() {
        let (apart, spread) = (19, 23);
        let from: Vec<f64> = (0..16 * apart).map(|k| k as f64).collect();
        let single: Vec<f32> = from.iter().map(|&x| x as f32).collect();
        let (mut short, mut whole) = (vec![-1.0; 16 * spread], vec![-1.0; 16 * spread]);
        let (mut short_single, mut whole_single) = (vec![-1.0f32; 16 * spread], vec![-1.0f32; 16 * spread]);
        vectorised!(simd => transpose_by_blocks::<_, f64x2<_>, 2, 8>(simd, &from, apart, &mut short, spread));
        vectorised!(simd => transpose_by_blocks::<_, f64x8<_>, 8, 8>(simd, &from, apart, &mut whole, spread));
        vectorised!(simd => transpose_by_blocks::<_, f32x4<_>, 4, 16>(simd, &single, apart, &mut short_single, spread));
        vectorised!(simd => transpose_by_blocks::<_, f32x16<_>, 16, 16>(simd, &single, apart, &mut whole_single, spread));
        let expected = |width: usize, k: usize| {
            let (j, i) = (k / spread, k % spread);
            if i < width && j < width { (i * apart + j) as f64 } else { -1.0 }
        };
        for k in 0..16 * spread {
            assert_eq!([short[k], whole[k]], [expected(8, k); 2], "{k}");
            assert_eq!([short_single[k], whole_single[k]].map(f64::from), [expected(16, k); 2], "{k}");
        }
    }
}
