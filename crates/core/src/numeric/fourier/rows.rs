//! Transforms of real rows and back, a group of rows at a time.
//!
//! The even and odd samples of a row are the real and imaginary parts of z_j = x_{2j} + i x_{2j+1}, j < M = N/2, from whose
//! transform Z follows that of the row, X: with ω = e^{−2πi/N}, E = ½(Z_k + Z*_{M−k}) and O = −½i(Z_k − Z*_{M−k})
//!
//! X_k = E + ω^k O,  X_{M−k} = (E − ω^k O)*,  and back  Z_k = E + iO,  Z_{M−k} = E* + iO*.
//!
//! The rows of a group stand in the lanes of vectors, as the columns of a block do in the other direction, and are transformed by
//! the same stages. Rows of an odd number of samples are transformed by rustfft, row by row, in double precision.

use super::columns::{Columns, line};
use crate::numeric::aligned::Aligned;
use crate::numeric::lanes::{Real, all_zero, vectorised};
use fearless_simd::prelude::*;
use percoat_fft::{Complex64, ComplexToReal, RealToComplex};
use std::sync::Arc;

/// Plan for rows of `len` samples.
#[derive(Clone)]
pub struct Rows<T: Real> {
    len: usize,
    algorithm: Algorithm<T>,
}

/// How rows are transformed.
#[derive(Clone)]
enum Algorithm<T: Real> {
    /// Transforms of pairs of samples, for even numbers of samples.
    Paired {
        /// Plan for the transform of z.
        halves: Columns<T>,
        /// Place of Z_k, k < M.
        places: Vec<usize>,
        /// Twiddle factors ω^k, k ≤ M.
        twiddles: Vec<[T; 2]>,
    },
    /// Transforms by rustfft in double precision, whatever the precision of the rows.
    Library { forward: Arc<dyn RealToComplex<f64>>, inverse: Arc<dyn ComplexToReal<f64>> },
}

/// Working memory of a group of rows.
pub struct Buffers<T> {
    /// Samples, row by row.
    samples: Aligned<T>,
    /// z, a line for each j.
    pairs: Aligned<T>,
    /// Components X, a line for each k.
    components: Aligned<T>,
    scratch: Vec<Complex64>,
    /// One row for rustfft.
    for_library: Vec<f64>,
}

impl<T: Real> Rows<T> {
    /// Plan for rows of `len` samples.
    pub fn new(len: usize) -> Self {
        if len.is_multiple_of(2) {
            let halves = Columns::new(len / 2);
            let places = halves.places(len / 2);
            let twiddles = (0..=len / 2).map(|k| super::butterflies::root(k, len)).collect();
            Self { len, algorithm: Algorithm::Paired { halves, places, twiddles } }
        } else {
            let (forward, inverse) = (percoat_fft::of_real(len), percoat_fft::to_real(len));
            Self { len, algorithm: Algorithm::Library { forward, inverse } }
        }
    }

    /// Samples from one row of a group to the next: two cache lines more than a row has, so that rows of a power of two do not all
    /// take the same cache sets.
    fn stride(&self) -> usize {
        self.len.next_multiple_of(2 * T::WIDTH) + 2 * T::WIDTH
    }

    /// Working memory for a group of rows.
    pub fn buffers(&self) -> Buffers<T> {
        let (lines, half) = (self.len.next_multiple_of(2 * T::WIDTH) / 2, self.len / 2 + 1);
        let (scratch, for_library) = match &self.algorithm {
            Algorithm::Paired { halves, .. } => (halves.scratch(self.len / 2), 0),
            Algorithm::Library { forward, inverse } => {
                (half + forward.get_scratch_len().max(inverse.get_scratch_len()), self.len)
            }
        };
        Buffers {
            samples: Aligned::new(T::WIDTH * self.stride()),
            pairs: Aligned::new(lines * line::<T>()),
            components: Aligned::new(half.next_multiple_of(T::WIDTH) * line::<T>()),
            scratch: vec![Complex64::ZERO; scratch],
            for_library: vec![0.0; for_library],
        }
    }

    /// Transforms a group of `count` rows, at most as many as a block has columns, filled in one after the other by `source`, to
    /// lines of the `blocks` of columns. Rows of zeros give zeros without a transform.
    pub fn forward<'a>(
        &self,
        count: usize,
        source: &mut impl FnMut(&mut [T]),
        buffers: &mut Buffers<T>,
        blocks: impl Iterator<Item = &'a mut [T]>,
    ) {
        let Buffers { samples, pairs, components, scratch, for_library } = buffers;
        let rows = samples.chunks_exact_mut(self.stride()).take(count);
        rows.for_each(|row| source(&mut row[..self.len]));
        if vectorised!(simd => all_zero(simd, &samples[..count * self.stride()])) {
            blocks.for_each(|lines| lines.fill(T::zero()));
            return;
        }
        match &self.algorithm {
            Algorithm::Paired { halves, places, twiddles } => {
                vectorised!(simd => samples_to_pairs(simd, samples, pairs));
                halves.forward(&mut pairs[..self.len / 2 * line::<T>()], scratch);
                vectorised!(simd => pairs_to_components(simd, places, twiddles, pairs, components, blocks));
            }
            Algorithm::Library { forward, .. } => {
                let (row_components, scratch) = scratch.split_at_mut(self.len / 2 + 1);
                for (lane, samples) in samples.chunks_exact(self.stride()).enumerate().take(count) {
                    for_library.iter_mut().zip(samples).for_each(|(to, from)| *to = from.double());
                    let done = forward.process_with_scratch(for_library, row_components, scratch);
                    done.expect("lengths were planned");
                    for (line, value) in components.chunks_exact_mut(line::<T>()).zip(&*row_components) {
                        (line[lane], line[T::WIDTH + lane]) = (T::rounded(value.re), T::rounded(value.im));
                    }
                }
                vectorised!(simd => components_to_blocks(simd, components, blocks));
            }
        }
    }

    /// Transforms a group of `count` rows back, times the number of samples; `sink` takes one row after the other. Components that
    /// are their own conjugates are real: their imaginary parts, rounding errors, are dropped.
    pub fn back<'a>(
        &self,
        count: usize,
        blocks: impl Iterator<Item = &'a [T]>,
        buffers: &mut Buffers<T>,
        sink: &mut impl FnMut(&mut [T]),
    ) {
        let Buffers { samples, pairs, components, scratch, for_library } = buffers;
        vectorised!(simd => blocks_to_components(simd, blocks, components));
        components[T::WIDTH..line::<T>()].fill(T::zero());
        match &self.algorithm {
            Algorithm::Paired { halves, places, twiddles } => {
                components[self.len / 2 * line::<T>() + T::WIDTH..][..T::WIDTH].fill(T::zero());
                vectorised!(simd => components_to_pairs(simd, places, twiddles, components, pairs));
                halves.inverse(&mut pairs[..self.len / 2 * line::<T>()], scratch);
                vectorised!(simd => pairs_to_samples(simd, pairs, samples));
            }
            Algorithm::Library { inverse, .. } => {
                let (row_components, scratch) = scratch.split_at_mut(self.len / 2 + 1);
                for (lane, samples) in samples.chunks_exact_mut(self.stride()).enumerate().take(count) {
                    for (value, line) in row_components.iter_mut().zip(components.chunks_exact(line::<T>())) {
                        *value = Complex64::new(line[lane].double(), line[T::WIDTH + lane].double());
                    }
                    let done = inverse.process_with_scratch(row_components, for_library, scratch);
                    done.expect("lengths were planned, what must be real is");
                    samples.iter_mut().zip(&*for_library).for_each(|(to, from)| *to = T::rounded(*from));
                }
            }
        }
        let rows = samples.chunks_exact_mut(self.stride()).take(count);
        rows.for_each(|row| sink(&mut row[..self.len]));
    }

    /// Gives rows of zeros to `sink`, in the place of a group whose values are not used.
    pub fn blank(&self, count: usize, buffers: &mut Buffers<T>, sink: &mut impl FnMut(&mut [T])) {
        for row in buffers.samples.chunks_exact_mut(self.stride()).take(count) {
            row.fill(T::zero());
            sink(&mut row[..self.len]);
        }
    }

    /// A row, by its number, of the group that was transformed [back](Self::back) last.
    pub fn row<'a>(&self, number: usize, buffers: &'a Buffers<T>) -> &'a [T] {
        &buffers.samples[number * self.stride()..][..self.len]
    }
}

/// `WIDTH` numbers from index `at` on.
#[inline(always)]
fn wide<S: Simd, T: Real>(simd: S, numbers: &[T], at: usize) -> T::Wide<S> {
    T::Wide::<S>::from_slice(simd, &numbers[at..at + T::WIDTH])
}

/// z of a group of rows of samples: sample 2j of a row is the real, sample 2j + 1 the imaginary part of z_j.
#[inline(always)]
fn samples_to_pairs<S: Simd, T: Real>(simd: S, samples: &[T], pairs: &mut [T]) {
    let stride = samples.len() / T::WIDTH;
    for (number, lines) in pairs.chunks_exact_mut(T::WIDTH * T::WIDTH).enumerate() {
        T::transpose(simd, &samples[number * T::WIDTH..], stride, lines, T::WIDTH);
    }
}

/// The samples of a group of rows from their z.
#[inline(always)]
fn pairs_to_samples<S: Simd, T: Real>(simd: S, pairs: &[T], samples: &mut [T]) {
    let stride = samples.len() / T::WIDTH;
    for (number, lines) in pairs.chunks_exact(T::WIDTH * T::WIDTH).enumerate() {
        T::transpose(simd, lines, T::WIDTH, &mut samples[number * T::WIDTH..], stride);
    }
}

/// Real and imaginary parts of the line with a `number`.
#[inline(always)]
fn get<S: Simd, T: Real>(simd: S, lines: &[T], number: usize) -> [T::Wide<S>; 2] {
    let parts = &lines[number * line::<T>()..][..line::<T>()];
    [wide(simd, parts, 0), wide(simd, parts, T::WIDTH)]
}

/// Stores the real and imaginary parts of the line with a `number`.
#[inline(always)]
fn put<S: Simd, T: Real>([re, im]: [T::Wide<S>; 2], lines: &mut [T], number: usize) {
    let parts = &mut lines[number * line::<T>()..][..line::<T>()];
    re.store_slice(&mut parts[..T::WIDTH]);
    im.store_slice(&mut parts[T::WIDTH..]);
}

/// X from Z, to lines of the blocks; `components` is working memory for those of one block.
#[inline(always)]
fn pairs_to_components<'a, S: Simd, T: Real>(
    simd: S,
    places: &[usize],
    twiddles: &[[T; 2]],
    pairs: &[T],
    components: &mut [T],
    blocks: impl Iterator<Item = &'a mut [T]>,
) {
    let (number, half) = (places.len(), T::Wide::<S>::simd_from(simd, T::rounded(0.5)));
    for (first, block) in (0..=number).step_by(T::WIDTH).zip(blocks) {
        for (k, twiddle) in (first..=number).zip(&twiddles[first..]).take(T::WIDTH) {
            let [a_re, a_im] = get(simd, pairs, places[if k < number { k } else { 0 }]);
            let [b_re, b_im] = get(simd, pairs, places[if k > 0 { number - k } else { 0 }]);
            let (e_re, e_im) = ((a_re + b_re) * half, (a_im - b_im) * half);
            let (o_re, o_im) = ((a_im + b_im) * half, (b_re - a_re) * half);
            let (c, s) = (T::Wide::<S>::simd_from(simd, twiddle[0]), T::Wide::<S>::simd_from(simd, twiddle[1]));
            let (re, im) = (o_re.mul_add(c, e_re - o_im * s), o_re.mul_add(s, o_im.mul_add(c, e_im)));
            put::<S, T>([re, im], components, k - first);
        }
        transpose_lines(simd, components, block);
    }
}

/// 2Z from X.
#[inline(always)]
fn components_to_pairs<S: Simd, T: Real>(
    simd: S,
    places: &[usize],
    twiddles: &[[T; 2]],
    components: &[T],
    pairs: &mut [T],
) {
    let number = places.len();
    for (k, twiddle) in twiddles.iter().enumerate().take(number / 2 + 1) {
        let [a_re, a_im] = get(simd, components, k);
        let [b_re, b_im] = get(simd, components, number - k);
        let (e_re, e_im) = (a_re + b_re, a_im - b_im);
        let (t_re, t_im) = (a_re - b_re, a_im + b_im);
        // O = ω^{−k}(X_k − X*_{M−k}).
        let (re, im) = (T::Wide::<S>::simd_from(simd, twiddle[0]), T::Wide::<S>::simd_from(simd, twiddle[1]));
        let (o_re, o_im) = (t_re.mul_add(re, t_im * im), t_im.mul_sub(re, t_re * im));
        put::<S, T>([e_re - o_im, e_im + o_re], pairs, places[k]);
        put::<S, T>([e_re + o_im, o_re - e_im], pairs, places[(number - k) % number]);
    }
}

/// Components of a group of rows, a line for each, to lines of the blocks.
#[inline(always)]
fn components_to_blocks<'a, S: Simd, T: Real>(simd: S, components: &[T], blocks: impl Iterator<Item = &'a mut [T]>) {
    for (from, block) in components.chunks_exact(T::WIDTH * line::<T>()).zip(blocks) {
        transpose_lines(simd, from, block);
    }
}

/// Components of a group of rows, a line for each, from lines of the blocks.
#[inline(always)]
fn blocks_to_components<'a, S: Simd, T: Real>(simd: S, blocks: impl Iterator<Item = &'a [T]>, components: &mut [T]) {
    for (to, block) in components.chunks_exact_mut(T::WIDTH * line::<T>()).zip(blocks) {
        transpose_lines(simd, block, to);
    }
}

/// Transposes `WIDTH` lines of real and imaginary parts to as many lines of their columns. Where one side has fewer lines, the other
/// lines of the other side are left as they are, and are not used.
#[inline(always)]
fn transpose_lines<S: Simd, T: Real>(simd: S, from: &[T], to: &mut [T]) {
    let (line, whole) = (line::<T>(), T::WIDTH * line::<T>());
    if from.len() >= whole && to.len() >= whole {
        T::transpose(simd, from, line, to, line);
        T::transpose(simd, &from[T::WIDTH..], line, &mut to[T::WIDTH..], line);
        return;
    }
    for (i, from) in from.chunks_exact(line).enumerate().take(T::WIDTH) {
        for (j, to) in to.chunks_exact_mut(line).enumerate().take(T::WIDTH) {
            (to[i], to[T::WIDTH + i]) = (from[j], from[T::WIDTH + j]);
        }
    }
}
