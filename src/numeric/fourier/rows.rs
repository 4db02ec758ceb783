//! Transforms of rows between real samples and components, eight rows at a time.
//!
//! The even and odd samples of a row are the real and imaginary parts of z_j = x_{2j} + i x_{2j+1}, j < M = N/2, whose
//! transform Z tells that of the row, X: with ω = e^{−2πi/N}, E = ½(Z_k + Z*_{M−k}) and O = −½i(Z_k − Z*_{M−k})
//!
//! X_k = E + ω^k O,  X_{M−k} = (E − ω^k O)*,  and back  Z_k = E + iO,  Z_{M−k} = E* + iO*.
//!
//! Eight rows stand in the lanes of vectors, as eight columns do in the other direction, and are transformed by the same
//! steps. An odd number of samples is left to the library, row by row.

use super::columns::{Columns, LINE};
use crate::numeric::lanes::{LANES, Real, vectorised};
use fearless_simd::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
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
        /// Where Z_k stands, and ω^k, k ≤ M/2.
        places: Vec<usize>,
        turns: Vec<[T; 2]>,
    },
    Library {
        forward: Arc<dyn RealToComplex<T>>,
        inverse: Arc<dyn ComplexToReal<T>>,
    },
}

/// What a group of rows takes: samples row by row, z, and components one after the other.
pub struct Buffers<T> {
    samples: Vec<T>,
    pairs: Vec<T>,
    components: Vec<T>,
    scratch: Vec<Complex<T>>,
}

impl<T: Real> Rows<T> {
    /// Plan for rows of `len` samples.
    pub fn new(len: usize) -> Self {
        if len.is_multiple_of(2) {
            let halves = Columns::new(len / 2);
            let places = halves.places(len / 2);
            let turns = (0..=len / 4).map(|k| super::butterflies::root(k, len)).collect();
            Self { len, way: Way::Paired { halves, places, turns } }
        } else {
            let mut planner = RealFftPlanner::new();
            let (forward, inverse) = (planner.plan_fft_forward(len), planner.plan_fft_inverse(len));
            Self { len, way: Way::Library { forward, inverse } }
        }
    }

    /// Samples from row to row of a group.
    fn stride(&self) -> usize {
        self.len.next_multiple_of(2 * LANES)
    }

    /// What a group of rows takes.
    pub fn buffers(&self) -> Buffers<T> {
        let (lines, half) = (self.stride() / 2, self.len / 2 + 1);
        let scratch = match &self.way {
            Way::Paired { halves, .. } => halves.scratch(self.len / 2),
            Way::Library { forward, inverse } => half + forward.get_scratch_len().max(inverse.get_scratch_len()),
        };
        Buffers {
            samples: vec![T::zero(); LANES * self.stride()],
            pairs: vec![T::zero(); lines * LINE],
            components: vec![T::zero(); half.next_multiple_of(LANES) * LINE],
            scratch: vec![Complex::new(T::zero(), T::zero()); scratch],
        }
    }

    /// `count` ≤ 8 rows, filled in one after the other by `source`, to the lines of their tiles.
    pub fn forward<'a>(
        &self,
        count: usize,
        source: &mut impl FnMut(&mut [T]),
        buffers: &mut Buffers<T>,
        tiles: impl Iterator<Item = &'a mut [T]>,
    ) {
        let Buffers { samples, pairs, components, scratch } = buffers;
        let rows = samples.chunks_exact_mut(self.stride()).take(count);
        rows.for_each(|row| source(&mut row[..self.len]));
        match &self.way {
            Way::Paired { halves, places, turns } => {
                vectorised!(simd => paired(simd, samples, pairs));
                halves.forward(&mut pairs[..self.len / 2 * LINE], scratch);
                vectorised!(simd => parted(simd, places, turns, pairs, components));
            }
            Way::Library { forward, .. } => {
                let (row_components, scratch) = scratch.split_at_mut(self.len / 2 + 1);
                for (lane, row) in samples.chunks_exact_mut(self.stride()).enumerate().take(count) {
                    let done = forward.process_with_scratch(&mut row[..self.len], row_components, scratch);
                    done.expect("lengths were planned");
                    for (line, value) in components.chunks_exact_mut(LINE).zip(&*row_components) {
                        (line[lane], line[LANES + lane]) = (value.re, value.im);
                    }
                }
            }
        }
        vectorised!(simd => separate(simd, components, tiles));
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
        let Buffers { samples, pairs, components, scratch } = buffers;
        vectorised!(simd => unite(simd, tiles, components));
        components[LANES..LINE].fill(T::zero());
        match &self.way {
            Way::Paired { halves, places, turns } => {
                components[self.len / 2 * LINE + LANES..][..LANES].fill(T::zero());
                vectorised!(simd => joined(simd, places, turns, components, pairs));
                halves.inverse(&mut pairs[..self.len / 2 * LINE], scratch);
                vectorised!(simd => spread(simd, pairs, samples));
            }
            Way::Library { inverse, .. } => {
                let (row_components, scratch) = scratch.split_at_mut(self.len / 2 + 1);
                for (lane, row) in samples.chunks_exact_mut(self.stride()).enumerate().take(count) {
                    for (value, line) in row_components.iter_mut().zip(components.chunks_exact(LINE)) {
                        *value = Complex::new(line[lane], line[LANES + lane]);
                    }
                    let done = inverse.process_with_scratch(row_components, &mut row[..self.len], scratch);
                    done.expect("lengths were planned, what must be real is");
                }
            }
        }
        let rows = samples.chunks_exact_mut(self.stride()).take(count);
        rows.for_each(|row| sink(&mut row[..self.len]));
    }

    /// A row of the group that has come [back](Self::back) last.
    pub fn row<'a>(&self, number: usize, buffers: &'a Buffers<T>) -> &'a [T] {
        &buffers.samples[number * self.stride()..][..self.len]
    }
}

/// Eight vectors of eight numbers turned into those of their first, second, … numbers: the six bits of a number's place,
/// vector and lane, go round by three.
#[inline(always)]
fn transposed<S: Simd, T: Real>(mut vectors: [T::Lanes<S>; LANES]) -> [T::Lanes<S>; LANES] {
    for _ in 0..3 {
        let before = vectors;
        for pair in 0..4 {
            (vectors[2 * pair], vectors[2 * pair + 1]) = before[pair].interleave(before[pair + 4]);
        }
    }
    vectors
}

/// z of eight rows of samples.
#[inline(always)]
fn paired<S: Simd, T: Real>(simd: S, samples: &[T], pairs: &mut [T]) {
    let stride = samples.len() / LANES;
    let zero = T::Lanes::<S>::simd_from(simd, T::zero());
    for (block, lines) in pairs.chunks_exact_mut(LANES * LINE).enumerate() {
        let (mut even, mut odd) = ([zero; LANES], [zero; LANES]);
        for row in 0..LANES {
            let from = &samples[row * stride + 2 * LANES * block..][..2 * LANES];
            let (low, high) =
                (T::Lanes::<S>::from_slice(simd, &from[..LANES]), T::Lanes::<S>::from_slice(simd, &from[LANES..]));
            (even[row], odd[row]) = low.deinterleave(high);
        }
        let (even, odd) = (transposed::<S, T>(even), transposed::<S, T>(odd));
        for j in 0..LANES {
            even[j].store_slice(&mut lines[j * LINE..][..LANES]);
            odd[j].store_slice(&mut lines[j * LINE + LANES..][..LANES]);
        }
    }
}

/// Eight rows of samples from their z.
#[inline(always)]
fn spread<S: Simd, T: Real>(simd: S, pairs: &[T], samples: &mut [T]) {
    let stride = samples.len() / LANES;
    let zero = T::Lanes::<S>::simd_from(simd, T::zero());
    for (block, lines) in pairs.chunks_exact(LANES * LINE).enumerate() {
        let (mut even, mut odd) = ([zero; LANES], [zero; LANES]);
        for j in 0..LANES {
            even[j] = T::Lanes::<S>::from_slice(simd, &lines[j * LINE..][..LANES]);
            odd[j] = T::Lanes::<S>::from_slice(simd, &lines[j * LINE + LANES..][..LANES]);
        }
        let (even, odd) = (transposed::<S, T>(even), transposed::<S, T>(odd));
        for row in 0..LANES {
            let to = &mut samples[row * stride + 2 * LANES * block..][..2 * LANES];
            let (low, high) = even[row].interleave(odd[row]);
            low.store_slice(&mut to[..LANES]);
            high.store_slice(&mut to[LANES..]);
        }
    }
}

/// A line's real and imaginary parts.
#[inline(always)]
fn line<S: Simd, T: Real>(simd: S, lines: &[T], number: usize) -> [T::Lanes<S>; 2] {
    let line = &lines[number * LINE..][..LINE];
    [T::Lanes::<S>::from_slice(simd, &line[..LANES]), T::Lanes::<S>::from_slice(simd, &line[LANES..])]
}

#[inline(always)]
fn put<S: Simd, T: Real>([re, im]: [T::Lanes<S>; 2], lines: &mut [T], number: usize) {
    let line = &mut lines[number * LINE..][..LINE];
    re.store_slice(&mut line[..LANES]);
    im.store_slice(&mut line[LANES..]);
}

/// X from Z.
#[inline(always)]
fn parted<S: Simd, T: Real>(simd: S, places: &[usize], turns: &[[T; 2]], pairs: &[T], components: &mut [T]) {
    let (half, number) = (T::Lanes::<S>::simd_from(simd, T::rounded(0.5)), places.len());
    for (k, turn) in turns.iter().enumerate() {
        let [a_re, a_im] = line(simd, pairs, places[k]);
        let [b_re, b_im] = line(simd, pairs, places[(number - k) % number]);
        let (e_re, e_im) = ((a_re + b_re) * half, (a_im - b_im) * half);
        let (o_re, o_im) = ((a_im + b_im) * half, (b_re - a_re) * half);
        let (re, im) = (T::Lanes::<S>::simd_from(simd, turn[0]), T::Lanes::<S>::simd_from(simd, turn[1]));
        let (t_re, t_im) = (o_re.mul_sub(re, o_im * im), o_re.mul_add(im, o_im * re));
        put::<S, T>([e_re + t_re, e_im + t_im], components, k);
        put::<S, T>([e_re - t_re, t_im - e_im], components, number - k);
    }
}

/// 2Z from X.
#[inline(always)]
fn joined<S: Simd, T: Real>(simd: S, places: &[usize], turns: &[[T; 2]], components: &[T], pairs: &mut [T]) {
    let number = places.len();
    for (k, turn) in turns.iter().enumerate() {
        let [a_re, a_im] = line(simd, components, k);
        let [b_re, b_im] = line(simd, components, number - k);
        let (e_re, e_im) = (a_re + b_re, a_im - b_im);
        let (t_re, t_im) = (a_re - b_re, a_im + b_im);
        // O = ω^{−k}(X_k − X*_{M−k}).
        let (re, im) = (T::Lanes::<S>::simd_from(simd, turn[0]), T::Lanes::<S>::simd_from(simd, turn[1]));
        let (o_re, o_im) = (t_re.mul_add(re, t_im * im), t_im.mul_sub(re, t_re * im));
        put::<S, T>([e_re - o_im, e_im + o_re], pairs, places[k]);
        put::<S, T>([e_re + o_im, o_re - e_im], pairs, places[(number - k) % number]);
    }
}

/// The components of eight rows, one after the other, to the lines of their tiles.
#[inline(always)]
fn separate<'a, S: Simd, T: Real>(simd: S, components: &[T], tiles: impl Iterator<Item = &'a mut [T]>) {
    let zero = T::Lanes::<S>::simd_from(simd, T::zero());
    for (from, tile) in components.chunks_exact(LANES * LINE).zip(tiles) {
        let (mut re, mut im) = ([zero; LANES], [zero; LANES]);
        for c in 0..LANES {
            [re[c], im[c]] = line(simd, from, c);
        }
        let (re, im) = (transposed::<S, T>(re), transposed::<S, T>(im));
        for row in 0..tile.len() / LINE {
            put::<S, T>([re[row], im[row]], tile, row);
        }
    }
}

/// The other way round.
#[inline(always)]
fn unite<'a, S: Simd, T: Real>(simd: S, tiles: impl Iterator<Item = &'a [T]>, components: &mut [T]) {
    let zero = T::Lanes::<S>::simd_from(simd, T::zero());
    for (to, tile) in components.chunks_exact_mut(LANES * LINE).zip(tiles) {
        let (mut re, mut im) = ([zero; LANES], [zero; LANES]);
        for row in 0..tile.len() / LINE {
            [re[row], im[row]] = line(simd, tile, row);
        }
        let (re, im) = (transposed::<S, T>(re), transposed::<S, T>(im));
        for c in 0..LANES {
            put::<S, T>([re[c], im[c]], to, c);
        }
    }
}
