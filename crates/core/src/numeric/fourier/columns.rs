//! Transforms of a block of columns at a time, forward, times a factor, and inverse.
//!
//! Forward by decimation in frequency: a column of N = R M numbers becomes R columns of M, x_{j+qM} → Σ_q x_{j+qM}
//! e^{−2πi qk/R} e^{−2πi jk/N}, and so on; the components end in the order of their digits reversed, where they are
//! multiplied. Inverse by decimation in time, the stages in reverse order, so that nothing is ever reordered. Columns whose
//! number of points has a prime factor beyond the largest butterfly are transformed by rustfft, column by column, in double
//! precision.

use super::butterflies::{Complex, LARGEST, root, transform};
use crate::numeric::lanes::{Real, vectorised};
use fearless_simd::prelude::*;
use percoat_fft::{Complex64, Fft, FftDirection};
use std::sync::Arc;

/// Length of a line of a block in double precision: the real, then the imaginary parts of one row in eight columns.
pub const LINE: usize = line::<f64>();

/// Length of a line of a block: the real, then the imaginary parts of one row in as many columns as take 64 bytes, two cache lines.
pub const fn line<T: Real>() -> usize {
    2 * T::WIDTH
}

/// Plan for columns of a number of points.
#[derive(Clone)]
pub enum Columns<T: Real> {
    /// Stages of butterflies, in the order of the forward transform.
    Butterflies(Vec<Stage<T>>),
    /// Transforms by rustfft in double precision, whatever the precision of the columns.
    Library {
        /// Plan of the forward transform.
        forward: Arc<dyn Fft<f64>>,
        /// Plan of the inverse transform.
        inverse: Arc<dyn Fft<f64>>,
    },
}

/// A stage of a transform: columns of `radix` · `part` numbers are split into `radix` columns.
#[derive(Clone)]
pub(crate) struct Stage<T> {
    radix: usize,
    part: usize,
    /// Twiddle factors e^{−2πi jk/N}, j < part, 0 < k < radix.
    twiddles: Vec<[T; 2]>,
    /// Roots of unity e^{−2πi k/radix}.
    roots: Vec<[T; 2]>,
}

impl<T: Real> Columns<T> {
    /// Plan for columns of `len` numbers.
    pub fn new(len: usize) -> Self {
        match radices(len, whole_registers::<T>()) {
            Some(radices) => Self::by(len, radices),
            None => {
                let plan = |direction| percoat_fft::complex(len, direction);
                Self::Library { forward: plan(FftDirection::Forward), inverse: plan(FftDirection::Inverse) }
            }
        }
    }

    /// Plan for columns of `len` numbers, the product of the radices.
    fn by(len: usize, radices: Vec<usize>) -> Self {
        let stages = radices.into_iter().scan(len, |len, radix| {
            let (whole, part) = (*len, *len / radix);
            *len = part;
            let twiddle = |j: usize| (1..radix).map(move |k| root(j * k, whole));
            let twiddles = (0..part).flat_map(twiddle).collect();
            Some(Stage { radix, part, twiddles, roots: (0..radix).map(|k| root(k, radix)).collect() })
        });
        Self::Butterflies(stages.collect())
    }

    /// Index of the component at each place after the forward transform.
    pub fn order(&self, len: usize) -> Vec<usize> {
        let Self::Butterflies(stages) = self else { return (0..len).collect() };
        stages.iter().rev().fold(vec![0], |order, stage| {
            (0..stage.radix).flat_map(|k| order.iter().map(move |rest| stage.radix * rest + k)).collect()
        })
    }

    /// Place of each component after the forward transform.
    pub fn places(&self, len: usize) -> Vec<usize> {
        let mut places = vec![0; len];
        self.order(len).into_iter().enumerate().for_each(|(place, component)| places[component] = place);
        places
    }

    /// Length of the working memory of a transform, in complex numbers.
    pub fn scratch(&self, len: usize) -> usize {
        match self {
            Self::Butterflies(_) => 0,
            Self::Library { forward, inverse } => {
                len + forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len())
            }
        }
    }

    /// Transforms a block of columns, in place.
    pub fn forward(&self, lines: &mut [T], scratch: &mut [Complex64]) {
        match self {
            Self::Butterflies(stages) => {
                vectorised!(simd => convolve::<_, T, true, false>(simd, stages, 0, lines, &|_, _| ()));
            }
            Self::Library { forward, .. } => by_column(&**forward, lines, scratch),
        }
    }

    /// Transforms a block of columns back, in place, times the number of their points.
    pub fn inverse(&self, lines: &mut [T], scratch: &mut [Complex64]) {
        match self {
            Self::Butterflies(stages) => {
                vectorised!(simd => convolve::<_, T, false, true>(simd, stages, 0, lines, &|_, _| ()));
            }
            Self::Library { inverse, .. } => by_column(&**inverse, lines, scratch),
        }
    }

    /// Transforms a block of columns, calls `between` with some of its lines at a time and the number of the first one, and
    /// transforms it back.
    pub fn there_and_back(&self, lines: &mut [T], scratch: &mut [Complex64], between: &impl Fn(usize, &mut [T])) {
        match self {
            Self::Butterflies(stages) => {
                vectorised!(simd => convolve::<_, T, true, true>(simd, stages, 0, lines, between));
            }
            Self::Library { forward, inverse } => {
                by_column(&**forward, lines, scratch);
                between(0, lines);
                by_column(&**inverse, lines, scratch);
            }
        }
    }
}

/// Radices whose product is `len`; `None` when a prime factor has no butterfly.
///
/// The butterfly for eight needs 16 registers and more. Processors whose registers hold a `WIDTH` of numbers (`whole`)
/// have 32 of them; the others mostly 16: there fours come first, and the eight of an odd power of two last, where no twiddle
/// factors are needed.
fn radices(len: usize, whole: bool) -> Option<Vec<usize>> {
    assert!(len > 0, "a transform has points");
    let (mut rest, mut radices, mut last) = (len, Vec::new(), None);
    if !whole && len.trailing_zeros() > 1 && len.trailing_zeros() % 2 == 1 {
        (rest, last) = (rest / 8, Some(8));
    }
    let radices_of_two: &[usize] = if whole { &[8, 4, 2] } else { &[4, 2] };
    for &radix in radices_of_two.iter().chain(&[3, 5, 7, 11, LARGEST]) {
        while rest.is_multiple_of(radix) {
            rest /= radix;
            radices.push(radix);
        }
    }
    radices.extend(last);
    (rest == 1).then_some(radices)
}

/// Whether a register of this processor holds the `WIDTH` real parts of a line.
fn whole_registers<T: Real>() -> bool {
    #[inline(always)]
    fn of<S: Simd, T: Real>(_: S) -> bool {
        T::Register::<S>::LEN == T::WIDTH
    }
    vectorised!(simd => of::<_, T>(simd))
}

/// Bytes of a block that fit into the first-level cache beside other data.
const FIRST_LEVEL_CACHE: usize = 32 * 1024;

/// Transforms columns forward, calls `between`, and transforms them back. Columns too large for the first-level cache are split
/// once, and each part is finished before the next.
#[inline(always)]
fn convolve<S: Simd, T: Real, const FORWARD: bool, const BACK: bool>(
    simd: S,
    stages: &[Stage<T>],
    first: usize,
    lines: &mut [T],
    between: &impl Fn(usize, &mut [T]),
) {
    match stages.split_first() {
        Some((stage, rest)) if size_of_val(lines) > FIRST_LEVEL_CACHE => {
            if FORWARD {
                apply::<S, T, false>(simd, stage, lines);
            }
            for (number, part) in lines.chunks_exact_mut(stage.part * line::<T>()).enumerate() {
                convolve_part::<S, T, FORWARD, BACK>(simd, rest, first + number * stage.part, part, between);
            }
            if BACK {
                apply::<S, T, true>(simd, stage, lines);
            }
        }
        _ => {
            if FORWARD {
                for stage in stages {
                    apply::<S, T, false>(simd, stage, lines);
                }
            }
            between(first, lines);
            if BACK {
                for stage in stages.iter().rev() {
                    apply::<S, T, true>(simd, stage, lines);
                }
            }
        }
    }
}

/// [`convolve`] for a part of split columns: a function of its own, so that it can be recursive.
fn convolve_part<S: Simd, T: Real, const FORWARD: bool, const BACK: bool>(
    simd: S,
    stages: &[Stage<T>],
    first: usize,
    lines: &mut [T],
    between: &impl Fn(usize, &mut [T]),
) {
    simd.vectorize(
        #[inline(always)]
        || convolve::<S, T, FORWARD, BACK>(simd, stages, first, lines, between),
    );
}

/// A stage of every column, or (`BACK`) its inverse.
#[inline(always)]
fn apply<S: Simd, T: Real, const BACK: bool>(simd: S, stage: &Stage<T>, lines: &mut [T]) {
    match stage.radix {
        2 => apply_radix::<S, T, 2, BACK>(simd, stage, lines),
        3 => apply_radix::<S, T, 3, BACK>(simd, stage, lines),
        4 => apply_radix::<S, T, 4, BACK>(simd, stage, lines),
        5 => apply_radix::<S, T, 5, BACK>(simd, stage, lines),
        7 => apply_radix::<S, T, 7, BACK>(simd, stage, lines),
        8 => apply_radix::<S, T, 8, BACK>(simd, stage, lines),
        11 => apply_radix::<S, T, 11, BACK>(simd, stage, lines),
        _ => apply_radix::<S, T, LARGEST, BACK>(simd, stage, lines),
    }
}

/// A stage of radix R. Forward: butterfly, then twiddle factors. Back: twiddle factors, then butterfly, with real and imaginary
/// parts exchanged, which makes e^{−2πi…} its conjugate. The twiddle factors of columns of one number are 1.
#[inline(always)]
fn apply_radix<S: Simd, T: Real, const R: usize, const BACK: bool>(simd: S, stage: &Stage<T>, lines: &mut [T]) {
    let part = stage.part * line::<T>();
    for whole in lines.chunks_exact_mut(R * part) {
        let mut rest = whole;
        let mut parts: [&mut [T]; R] = std::array::from_fn(|_| {
            let (first, others) = std::mem::take(&mut rest).split_at_mut(part);
            rest = others;
            first
        });
        if stage.part == 1 {
            butterflies::<S, T, R, BACK, false>(simd, &stage.roots, &[], &mut parts, 0);
            continue;
        }
        for (j, twiddles) in stage.twiddles.chunks_exact(R - 1).enumerate() {
            butterflies::<S, T, R, BACK, true>(simd, &stage.roots, twiddles, &mut parts, j * line::<T>());
        }
    }
}

/// Butterflies of the lines that start at index `at` of each part, with twiddle factors where `TWIDDLED`.
#[inline(always)]
fn butterflies<S: Simd, T: Real, const R: usize, const BACK: bool, const TWIDDLED: bool>(
    simd: S,
    roots: &[[T; 2]],
    twiddles: &[[T; 2]],
    parts: &mut [&mut [T]; R],
    at: usize,
) {
    let mut x = [Complex::zero(simd); R];
    for lane in (0..T::WIDTH).step_by(T::Register::<S>::LEN) {
        for q in 0..R {
            x[q] = Complex::load(simd, &parts[q][at..at + line::<T>()], lane, BACK);
            if BACK && TWIDDLED && q > 0 {
                x[q] = x[q].times(twiddles[q - 1]);
            }
        }
        transform::<S, T, R>(&mut x, roots);
        for q in 0..R {
            let result = if BACK || !TWIDDLED || q == 0 { x[q] } else { x[q].times(twiddles[q - 1]) };
            result.store(&mut parts[q][at..at + line::<T>()], lane, BACK);
        }
    }
}

/// Transforms each column of a block by rustfft.
fn by_column<T: Real>(fft: &dyn Fft<f64>, lines: &mut [T], scratch: &mut [Complex64]) {
    let (column, scratch) = scratch.split_at_mut(lines.len() / line::<T>());
    for lane in 0..T::WIDTH {
        for (value, line) in column.iter_mut().zip(lines.chunks_exact(line::<T>())) {
            *value = Complex64::new(line[lane].double(), line[T::WIDTH + lane].double());
        }
        fft.process_with_scratch(column, scratch);
        for (value, line) in column.iter().zip(lines.chunks_exact_mut(line::<T>())) {
            (line[lane], line[T::WIDTH + lane]) = (T::rounded(value.re), T::rounded(value.im));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radices_make_up_the_points_on_registers_of_any_width() {
        for len in 1..3000 {
            let [short, whole] = [false, true].map(|whole| radices(len, whole));
            assert_eq!(short.is_some(), whole.is_some(), "{len}");
            for radices in short.iter().chain(&whole) {
                assert_eq!(radices.iter().product::<usize>(), len, "{radices:?}");
            }
            let eights = short.iter().flatten().filter(|radix| **radix == 8).count();
            assert!(eights == 0 || (eights == 1 && short.is_some_and(|radices| radices.ends_with(&[8]))), "{len}");
        }
        assert_eq!(radices(512, false), Some(vec![4, 4, 4, 8]));
        assert_eq!(radices(512, true), Some(vec![8, 8, 8]));
    }

    /// Components by the radices of either kind of processor, against direct sums.
    #[test]
    fn components_are_their_sums_by_either_radices() {
        let len = 96;
        let lines: Vec<f64> = (0..len * LINE).map(|k| ((k * 37) % 101) as f64 - 50.0).collect();
        for whole in [false, true] {
            let columns = Columns::<f64>::by(len, radices(len, whole).unwrap());
            let mut found = lines.clone();
            columns.forward(&mut found, &mut []);
            for (place, component) in columns.order(len).into_iter().enumerate() {
                let sum = (0..len).fold([0.0; 2], |[re, im], j| {
                    let ([c, s], x, y) = (root::<f64>(j * component, len), lines[j * LINE + 3], lines[j * LINE + 11]);
                    [re + x * c - y * s, im + x * s + y * c]
                });
                let found = [found[place * LINE + 3], found[place * LINE + 11]];
                assert!((0..2).all(|k| (found[k] - sum[k]).abs() < 1e-10), "{component}: {found:?} {sum:?}");
            }
            columns.inverse(&mut found, &mut []);
            let back = found.iter().zip(&lines);
            assert!(back.into_iter().all(|(found, line)| (found / len as f64 - line).abs() < 1e-11));
        }
    }
}
