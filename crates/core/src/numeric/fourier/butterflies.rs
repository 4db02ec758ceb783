//! Short transforms of several series of complex numbers at a time: X_k = Σ_j x_j e^{−2πi jk/R}, j, k < R.

use crate::numeric::lanes::Real;
use fearless_simd::prelude::*;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// Largest radix with a butterfly.
pub const LARGEST: usize = 13;

/// Complex numbers in two registers, one of real and one of imaginary parts.
#[derive(Debug, Clone, Copy)]
pub struct Complex<S: Simd, T: Real> {
    re: T::Register<S>,
    im: T::Register<S>,
}

/// Root of unity e^{−2πi k/n}: real and imaginary part.
pub fn root<T: Real>(k: usize, n: usize) -> [T; 2] {
    let angle = TAU * (k % n) as f64 / n as f64;
    [T::rounded(angle.cos()), T::rounded(-angle.sin())]
}

impl<S: Simd, T: Real> Complex<S, T> {
    /// The numbers of a line from index `at` on, real parts first; with `swapped` parts a transform is its own inverse times R.
    #[inline(always)]
    pub fn load(simd: S, line: &[T], at: usize, swapped: bool) -> Self {
        let part = |from: usize| T::Register::<S>::from_slice(simd, &line[from..from + T::Register::<S>::LEN]);
        let (first, second) = (part(at), part(T::WIDTH + at));
        if swapped { Self { re: second, im: first } } else { Self { re: first, im: second } }
    }

    /// Stores the numbers in a line from index `at` on, as [`load`](Self::load) reads them.
    #[inline(always)]
    pub fn store(self, line: &mut [T], at: usize, swapped: bool) {
        let (first, second) = if swapped { (self.im, self.re) } else { (self.re, self.im) };
        let len = T::Register::<S>::LEN;
        first.store_slice(&mut line[at..at + len]);
        second.store_slice(&mut line[T::WIDTH + at..T::WIDTH + at + len]);
    }

    /// Zeros.
    #[inline(always)]
    pub fn zero(simd: S) -> Self {
        let zero = T::Register::<S>::simd_from(simd, T::zero());
        Self { re: zero, im: zero }
    }

    /// self · (re + i im), one complex number for all.
    #[inline(always)]
    pub fn times(self, [re, im]: [T; 2]) -> Self {
        let simd = self.re.token();
        let (re, im) = (T::Register::<S>::simd_from(simd, re), T::Register::<S>::simd_from(simd, im));
        Self { re: self.re.mul_sub(re, self.im * im), im: self.re.mul_add(im, self.im * re) }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }

    /// self + factor · other.
    #[inline(always)]
    fn plus_times(self, factor: T, other: Self) -> Self {
        let factor = T::Register::<S>::simd_from(self.re.token(), factor);
        Self { re: other.re.mul_add(factor, self.re), im: other.im.mul_add(factor, self.im) }
    }

    /// self · (−i).
    #[inline(always)]
    fn times_minus_i(self) -> Self {
        Self { re: self.im, im: -self.re }
    }

    /// self · e^{−iπ/4}.
    #[inline(always)]
    fn times_root_of_minus_i(self) -> Self {
        let part = T::Register::<S>::simd_from(self.re.token(), T::rounded(FRAC_1_SQRT_2));
        Self { re: (self.re + self.im) * part, im: (self.im - self.re) * part }
    }
}

/// X from x, in place; `roots` are the roots of unity e^{−2πi k/R}, for radices without a form of their own.
#[inline(always)]
pub fn transform<S: Simd, T: Real, const R: usize>(x: &mut [Complex<S, T>; R], roots: &[[T; 2]]) {
    match R {
        2 => (x[0], x[1]) = (x[0].plus(x[1]), x[0].minus(x[1])),
        4 => [x[0], x[1], x[2], x[3]] = four([x[0], x[1], x[2], x[3]]),
        8 => {
            let (mut sums, mut differences) = ([x[0]; 4], [x[0]; 4]);
            for j in 0..4 {
                (sums[j], differences[j]) = (x[j].plus(x[j + 4]), x[j].minus(x[j + 4]));
            }
            let [first, second, third, fourth] = differences;
            let even = four(sums);
            let odd = four([
                first,
                second.times_root_of_minus_i(),
                third.times_minus_i(),
                fourth.times_root_of_minus_i().times_minus_i(),
            ]);
            [x[0], x[2], x[4], x[6]] = even;
            [x[1], x[3], x[5], x[7]] = odd;
        }
        _ => odd(x, roots),
    }
}

/// X for R = 4.
#[inline(always)]
fn four<S: Simd, T: Real>(x: [Complex<S, T>; 4]) -> [Complex<S, T>; 4] {
    let (even, odd) = (x[0].plus(x[2]), x[1].plus(x[3]));
    let (even_difference, odd_difference) = (x[0].minus(x[2]), x[1].minus(x[3]).times_minus_i());
    [even.plus(odd), even_difference.plus(odd_difference), even.minus(odd), even_difference.minus(odd_difference)]
}

/// X for odd R, in place: x_j and x_{R−j} enter by their sum and difference.
#[inline(always)]
fn odd<S: Simd, T: Real, const R: usize>(x: &mut [Complex<S, T>; R], roots: &[[T; 2]]) {
    let first = x[0];
    for j in 1..R.div_ceil(2) {
        (x[j], x[R - j]) = (x[j].plus(x[R - j]), x[j].minus(x[R - j]));
        x[0] = x[0].plus(x[j]);
    }
    let pairs = *x;
    for k in 1..R.div_ceil(2) {
        let (mut even, mut odd) = (first, Complex::zero(first.re.token()));
        for j in 1..R.div_ceil(2) {
            let [cosine, sine] = roots[j * k % R];
            even = even.plus_times(cosine, pairs[j]);
            odd = odd.plus_times(-sine, pairs[R - j]);
        }
        (x[k], x[R - k]) = (even.plus(odd.times_minus_i()), even.minus(odd.times_minus_i()));
    }
}
