//! Transforms of eight columns at a time, forth, times a factor, and back.
//!
//! Forth by decimation in frequency: a column of N = R M numbers becomes R columns of M, x_{j+qM} → Σ_q x_{j+qM}
//! e^{−2πi qk/R} e^{−2πi jk/N}, and so on; the components end in the order of their digits reversed, where they are
//! multiplied. Back by decimation in time, the same steps the other way round, so that nothing is ever reordered. A
//! number of points with a prime factor beyond the largest butterfly is left to the library, column by column.

use super::butterflies::{Complex, LARGEST, root, transform};
use crate::numeric::lanes::{LANES, Real, vectorised};
use fearless_simd::prelude::*;
use rustfft::{Fft, FftPlanner, num_complex};
use std::sync::Arc;

/// Numbers of a line: the real, then the imaginary parts of one row in eight columns.
pub const LINE: usize = 2 * LANES;

/// Plan for columns of so many numbers.
#[derive(Clone)]
pub enum Columns<T: Real> {
    Butterflies(Vec<Stage<T>>),
    Library { forward: Arc<dyn Fft<T>>, inverse: Arc<dyn Fft<T>> },
}

/// One splitting of columns of `radix` · `part` numbers into `radix` columns.
#[derive(Clone)]
pub struct Stage<T> {
    radix: usize,
    part: usize,
    /// e^{−2πi jk/N}, j < part, 0 < k < radix.
    twiddles: Vec<[T; 2]>,
    /// e^{−2πi k/radix}.
    roots: Vec<[T; 2]>,
}

impl<T: Real> Columns<T> {
    /// Plan for columns of `len` numbers.
    pub fn new(len: usize) -> Self {
        match radices(len) {
            Some(radices) => {
                let stages = radices.into_iter().scan(len, |len, radix| {
                    let (whole, part) = (*len, *len / radix);
                    *len = part;
                    let twiddle = |j: usize| (1..radix).map(move |k| root(j * k, whole));
                    let twiddles = (0..part).flat_map(twiddle).collect();
                    Some(Stage { radix, part, twiddles, roots: (0..radix).map(|k| root(k, radix)).collect() })
                });
                Self::Butterflies(stages.collect())
            }
            None => {
                let mut planner = FftPlanner::new();
                Self::Library { forward: planner.plan_fft_forward(len), inverse: planner.plan_fft_inverse(len) }
            }
        }
    }

    /// The component that stands at each place between forth and back.
    pub fn order(&self, len: usize) -> Vec<usize> {
        let Self::Butterflies(stages) = self else { return (0..len).collect() };
        stages.iter().rev().fold(vec![0], |order, stage| {
            (0..stage.radix).flat_map(|k| order.iter().map(move |rest| stage.radix * rest + k)).collect()
        })
    }

    /// The place of each component between forth and back.
    pub fn places(&self, len: usize) -> Vec<usize> {
        let mut places = vec![0; len];
        self.order(len).into_iter().enumerate().for_each(|(place, component)| places[component] = place);
        places
    }

    /// Complex numbers that a transform needs besides the lines.
    pub fn scratch(&self, len: usize) -> usize {
        match self {
            Self::Butterflies(_) => 0,
            Self::Library { forward, inverse } => {
                len + forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len())
            }
        }
    }

    /// Eight columns forth, in place.
    pub fn forward(&self, lines: &mut [T], scratch: &mut [num_complex::Complex<T>]) {
        match self {
            Self::Butterflies(stages) => vectorised!(simd => forward(simd, stages, lines)),
            Self::Library { forward, .. } => by_column(&**forward, lines, scratch),
        }
    }

    /// Eight columns back, in place, times the number of their points.
    pub fn inverse(&self, lines: &mut [T], scratch: &mut [num_complex::Complex<T>]) {
        match self {
            Self::Butterflies(stages) => vectorised!(simd => inverse(simd, stages, lines)),
            Self::Library { inverse, .. } => by_column(&**inverse, lines, scratch),
        }
    }
}

/// Radices whose product is `len`, fours first; none when a prime factor has no butterfly.
fn radices(len: usize) -> Option<Vec<usize>> {
    assert!(len > 0, "a transform has points");
    let (mut rest, mut radices) = (len, Vec::new());
    for radix in [4, 2, 3, 5, 7, 11, LARGEST] {
        while rest.is_multiple_of(radix) {
            rest /= radix;
            radices.push(radix);
        }
    }
    (rest == 1).then_some(radices)
}

/// After the first stage each part is finished before the next is begun: it fits the cache better than the whole.
#[inline(always)]
fn forward<S: Simd, T: Real>(simd: S, stages: &[Stage<T>], lines: &mut [T]) {
    let Some((first, rest)) = stages.split_first() else { return };
    split::<S, T, false>(simd, first, lines);
    for part in lines.chunks_exact_mut(first.part * LINE) {
        for stage in rest {
            for whole in part.chunks_exact_mut(stage.radix * stage.part * LINE) {
                split::<S, T, false>(simd, stage, whole);
            }
        }
    }
}

#[inline(always)]
fn inverse<S: Simd, T: Real>(simd: S, stages: &[Stage<T>], lines: &mut [T]) {
    let Some((first, rest)) = stages.split_first() else { return };
    for part in lines.chunks_exact_mut(first.part * LINE) {
        for stage in rest.iter().rev() {
            for whole in part.chunks_exact_mut(stage.radix * stage.part * LINE) {
                split::<S, T, true>(simd, stage, whole);
            }
        }
    }
    split::<S, T, true>(simd, first, lines);
}

/// One splitting of columns, or (`BACK`) what undoes it.
#[inline(always)]
fn split<S: Simd, T: Real, const BACK: bool>(simd: S, stage: &Stage<T>, lines: &mut [T]) {
    match stage.radix {
        2 => step::<S, T, 2, BACK>(simd, stage, lines),
        3 => step::<S, T, 3, BACK>(simd, stage, lines),
        4 => step::<S, T, 4, BACK>(simd, stage, lines),
        5 => step::<S, T, 5, BACK>(simd, stage, lines),
        7 => step::<S, T, 7, BACK>(simd, stage, lines),
        11 => step::<S, T, 11, BACK>(simd, stage, lines),
        _ => step::<S, T, LARGEST, BACK>(simd, stage, lines),
    }
}

/// Forth: butterfly, then twiddles. Back: twiddles, then butterfly, with real and imaginary parts exchanged, which turns
/// e^{−2πi…} into its conjugate.
#[inline(always)]
fn step<S: Simd, T: Real, const R: usize, const BACK: bool>(simd: S, stage: &Stage<T>, lines: &mut [T]) {
    let size = stage.part * LINE;
    let mut x = [Complex::zero(simd); R];
    for (j, twiddles) in stage.twiddles.chunks_exact(R - 1).enumerate() {
        let at = j * LINE;
        for q in 0..R {
            x[q] = Complex::load(simd, &lines[at + q * size..][..LINE], BACK);
            if BACK && q > 0 {
                x[q] = x[q].times(twiddles[q - 1]);
            }
        }
        transform::<S, T, R>(&mut x, &stage.roots);
        for q in 0..R {
            let result = if BACK || q == 0 { x[q] } else { x[q].times(twiddles[q - 1]) };
            result.store(&mut lines[at + q * size..][..LINE], BACK);
        }
    }
}

/// The library's transform of each of the eight columns.
fn by_column<T: Real>(fft: &dyn Fft<T>, lines: &mut [T], scratch: &mut [num_complex::Complex<T>]) {
    let (column, scratch) = scratch.split_at_mut(lines.len() / LINE);
    for lane in 0..LANES {
        for (value, line) in column.iter_mut().zip(lines.chunks_exact(LINE)) {
            *value = num_complex::Complex::new(line[lane], line[LANES + lane]);
        }
        fft.process_with_scratch(column, scratch);
        for (value, line) in column.iter().zip(lines.chunks_exact_mut(LINE)) {
            (line[lane], line[LANES + lane]) = (value.re, value.im);
        }
    }
}
