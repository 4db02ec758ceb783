//! Transforms of rows between real samples and components, a group of rows at a time.
//!
//! The even and odd samples of a row are the real and imaginary parts of z_j = x_{2j} + i x_{2j+1}, j < M = N/2, whose
//! transform Z tells that of the row, X: with ω = e^{−2πi/N}, E = ½(Z_k + Z*_{M−k}) and O = −½i(Z_k − Z*_{M−k})
//!
//! X_k = E + ω^k O,  X_{M−k} = (E − ω^k O)*,  and back  Z_k = E + iO,  Z_{M−k} = E* + iO*.
//!
//! The rows of a group stand in the lanes of vectors, as the columns of a tile do in the other direction, and are transformed by
//! the same steps. An odd number of samples is left to the library, row by row, in double precision.

use super::columns::{Columns, line};
use crate::numeric::aligned::Aligned;
use crate::numeric::lanes::{Real, all_zero, vectorised};
use fearless_simd::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// Plan for rows of so many samples.
#[derive(Clone)]
pub struct Rows<T: Real> {
    len: usize,
    way: Way<T>,
}

#[derive(Clone)]
enum Way<T: Real> {
    Paired {
        halves: Columns<T>,
        /// Where Z_k stands, k < M, and ω^k, k ≤ M.
        places: Vec<usize>,
        turns: Vec<[T; 2]>,
    },
    /// In double precision, whatever the rows are.
    Library { forward: Arc<dyn RealToComplex<f64>>, inverse: Arc<dyn ComplexToReal<f64>> },
}

/// What a group of rows takes: samples row by row, z, and components one after the other.
pub struct Buffers<T> {
    samples: Aligned<T>,
    pairs: Aligned<T>,
    components: Aligned<T>,
    scratch: Vec<Complex64>,
    /// A row for the library.
    for_library: Vec<f64>,
}

impl<T: Real> Rows<T> {
    /// Plan for rows of `len` samples.
    pub fn new(len: usize) -> Self {
        if len.is_multiple_of(2) {
            let halves = Columns::new(len / 2);
            let places = halves.places(len / 2);
            let turns = (0..=len / 2).map(|k| super::butterflies::root(k, len)).collect();
            Self { len, way: Way::Paired { halves, places, turns } }
        } else {
            let mut planner = RealFftPlanner::new();
            let (forward, inverse) = (planner.plan_fft_forward(len), planner.plan_fft_inverse(len));
            Self { len, way: Way::Library { forward, inverse } }
        }
    }

    /// Samples from row to row of a group: two lines of the cache more than a row has, so that rows of a power of two do not
    /// all take the same places in it.
    fn stride(&self) -> usize {
        self.len.next_multiple_of(2 * T::WIDTH) + 2 * T::WIDTH
    }

    /// What a group of rows takes.
    pub fn buffers(&self) -> Buffers<T> {
        let (lines, half) = (self.len.next_multiple_of(2 * T::WIDTH) / 2, self.len / 2 + 1);
        let (scratch, for_library) = match &self.way {
            Way::Paired { halves, .. } => (halves.scratch(self.len / 2), 0),
            Way::Library { forward, inverse } => {
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

    /// The rows of a group, at most a tile's width of them, filled in one after the other by `source`, to the lines of their
    /// tiles. Where all samples are zero, so are the components, without a transform.
    pub fn forward<'a>(
        &self,
        count: usize,
        source: &mut impl FnMut(&mut [T]),
        buffers: &mut Buffers<T>,
        tiles: impl Iterator<Item = &'a mut [T]>,
    ) {
        let Buffers { samples, pairs, components, scratch, for_library } = buffers;
        let rows = samples.chunks_exact_mut(self.stride()).take(count);
        rows.for_each(|row| source(&mut row[..self.len]));
        if vectorised!(simd => all_zero(simd, &samples[..count * self.stride()])) {
            tiles.for_each(|lines| lines.fill(T::zero()));
            return;
        }
        match &self.way {
            Way::Paired { halves, places, turns } => {
                vectorised!(simd => paired(simd, samples, pairs));
                halves.forward(&mut pairs[..self.len / 2 * line::<T>()], scratch);
                vectorised!(simd => parted(simd, places, turns, pairs, components, tiles));
            }
            Way::Library { forward, .. } => {
                let (row_components, scratch) = scratch.split_at_mut(self.len / 2 + 1);
                for (lane, samples) in samples.chunks_exact(self.stride()).enumerate().take(count) {
                    for_library.iter_mut().zip(samples).for_each(|(to, from)| *to = from.double());
                    let done = forward.process_with_scratch(for_library, row_components, scratch);
                    done.expect("lengths were planned");
                    for (line, value) in components.chunks_exact_mut(line::<T>()).zip(&*row_components) {
                        (line[lane], line[T::WIDTH + lane]) = (T::rounded(value.re), T::rounded(value.im));
                    }
                }
                vectorised!(simd => separate(simd, components, tiles));
            }
        }
    }

    /// The other way round, times the number of samples; `sink` takes one row after the other. Components that are their
    /// own conjugates are real: what rounding leaves of their imaginary part is dropped.
    pub fn back<'a>(
        &self,
        count: usize,
        tiles: impl Iterator<Item = &'a [T]>,
        buffers: &mut Buffers<T>,
        sink: &mut impl FnMut(&mut [T]),
    ) {
        let Buffers { samples, pairs, components, scratch, for_library } = buffers;
        vectorised!(simd => unite(simd, tiles, components));
        components[T::WIDTH..line::<T>()].fill(T::zero());
        match &self.way {
            Way::Paired { halves, places, turns } => {
                components[self.len / 2 * line::<T>() + T::WIDTH..][..T::WIDTH].fill(T::zero());
                vectorised!(simd => joined(simd, places, turns, components, pairs));
                halves.inverse(&mut pairs[..self.len / 2 * line::<T>()], scratch);
                vectorised!(simd => spread(simd, pairs, samples));
            }
            Way::Library { inverse, .. } => {
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

    /// Zeros in the place of the rows of a group whose values are not used.
    pub fn blank(&self, count: usize, buffers: &mut Buffers<T>, sink: &mut impl FnMut(&mut [T])) {
        for row in buffers.samples.chunks_exact_mut(self.stride()).take(count) {
            row.fill(T::zero());
            sink(&mut row[..self.len]);
        }
    }

    /// A row of the group that has come [back](Self::back) last.
    pub fn row<'a>(&self, number: usize, buffers: &'a Buffers<T>) -> &'a [T] {
        &buffers.samples[number * self.stride()..][..self.len]
    }
}

/// `WIDTH` numbers from the number `at` on.
#[inline(always)]
fn wide<S: Simd, T: Real>(simd: S, numbers: &[T], at: usize) -> T::Wide<S> {
    T::Wide::<S>::from_slice(simd, &numbers[at..at + T::WIDTH])
}

/// z of a group of rows of samples: number 2j of a row is the real, number 2j + 1 the imaginary part of z_j.
#[inline(always)]
fn paired<S: Simd, T: Real>(simd: S, samples: &[T], pairs: &mut [T]) {
    let stride = samples.len() / T::WIDTH;
    for (number, lines) in pairs.chunks_exact_mut(T::WIDTH * T::WIDTH).enumerate() {
        T::transpose(simd, &samples[number * T::WIDTH..], stride, lines, T::WIDTH);
    }
}

/// A group of rows of samples from their z.
#[inline(always)]
fn spread<S: Simd, T: Real>(simd: S, pairs: &[T], samples: &mut [T]) {
    let stride = samples.len() / T::WIDTH;
    for (number, lines) in pairs.chunks_exact(T::WIDTH * T::WIDTH).enumerate() {
        T::transpose(simd, lines, T::WIDTH, &mut samples[number * T::WIDTH..], stride);
    }
}

/// A line's real and imaginary parts.
#[inline(always)]
fn get<S: Simd, T: Real>(simd: S, lines: &[T], number: usize) -> [T::Wide<S>; 2] {
    let own = &lines[number * line::<T>()..][..line::<T>()];
    [wide(simd, own, 0), wide(simd, own, T::WIDTH)]
}

#[inline(always)]
fn put<S: Simd, T: Real>([re, im]: [T::Wide<S>; 2], lines: &mut [T], number: usize) {
    let own = &mut lines[number * line::<T>()..][..line::<T>()];
    re.store_slice(&mut own[..T::WIDTH]);
    im.store_slice(&mut own[T::WIDTH..]);
}

/// X from Z, to the lines of their tiles; `components` of one tile are needed between.
#[inline(always)]
fn parted<'a, S: Simd, T: Real>(
    simd: S,
    places: &[usize],
    turns: &[[T; 2]],
    pairs: &[T],
    components: &mut [T],
    tiles: impl Iterator<Item = &'a mut [T]>,
) {
    let (number, half) = (places.len(), T::Wide::<S>::simd_from(simd, T::rounded(0.5)));
    for (first, tile) in (0..=number).step_by(T::WIDTH).zip(tiles) {
        for (k, turn) in (first..=number).zip(&turns[first..]).take(T::WIDTH) {
            let [a_re, a_im] = get(simd, pairs, places[if k < number { k } else { 0 }]);
            let [b_re, b_im] = get(simd, pairs, places[if k > 0 { number - k } else { 0 }]);
            let (e_re, e_im) = ((a_re + b_re) * half, (a_im - b_im) * half);
            let (o_re, o_im) = ((a_im + b_im) * half, (b_re - a_re) * half);
            let (c, s) = (T::Wide::<S>::simd_from(simd, turn[0]), T::Wide::<S>::simd_from(simd, turn[1]));
            let (re, im) = (o_re.mul_add(c, e_re - o_im * s), o_re.mul_add(s, o_im.mul_add(c, e_im)));
            put::<S, T>([re, im], components, k - first);
        }
        transpose_lines(simd, components, tile);
    }
}

/// 2Z from X.
#[inline(always)]
fn joined<S: Simd, T: Real>(simd: S, places: &[usize], turns: &[[T; 2]], components: &[T], pairs: &mut [T]) {
    let number = places.len();
    for (k, turn) in turns.iter().enumerate().take(number / 2 + 1) {
        let [a_re, a_im] = get(simd, components, k);
        let [b_re, b_im] = get(simd, components, number - k);
        let (e_re, e_im) = (a_re + b_re, a_im - b_im);
        let (t_re, t_im) = (a_re - b_re, a_im + b_im);
        // O = ω^{−k}(X_k − X*_{M−k}).
        let (re, im) = (T::Wide::<S>::simd_from(simd, turn[0]), T::Wide::<S>::simd_from(simd, turn[1]));
        let (o_re, o_im) = (t_re.mul_add(re, t_im * im), t_im.mul_sub(re, t_re * im));
        put::<S, T>([e_re - o_im, e_im + o_re], pairs, places[k]);
        put::<S, T>([e_re + o_im, o_re - e_im], pairs, places[(number - k) % number]);
    }
}

/// The components of a group of rows, one after the other, to the lines of their tiles.
#[inline(always)]
fn separate<'a, S: Simd, T: Real>(simd: S, components: &[T], tiles: impl Iterator<Item = &'a mut [T]>) {
    for (from, tile) in components.chunks_exact(T::WIDTH * line::<T>()).zip(tiles) {
        transpose_lines(simd, from, tile);
    }
}

/// The other way round.
#[inline(always)]
fn unite<'a, S: Simd, T: Real>(simd: S, tiles: impl Iterator<Item = &'a [T]>, components: &mut [T]) {
    for (to, tile) in components.chunks_exact_mut(T::WIDTH * line::<T>()).zip(tiles) {
        transpose_lines(simd, tile, to);
    }
}

/// `WIDTH` lines of real and imaginary parts to those of their columns. Where one side has fewer lines, what the other has
/// beyond them stays as it was, and is not used.
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
