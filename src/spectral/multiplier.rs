//! What a convolution multiplies with: an even, positive K, and the odd T of a skew part K(1 − iT).

use crate::numeric::fourier::line;
use crate::numeric::lanes::{LANES, Real, vectorised};
use fearless_simd::{f64x8, prelude::*};

/// A positive, even multiplier K(k₁, k₂), k₂ ≤ N₂/2, in the order of the column pass.
#[derive(Debug, Clone)]
pub struct Multiplier {
    /// K/(N₁N₂), eight columns at a time, padded with ones.
    table: Vec<f64>,
    /// N₁.
    rows: usize,
    /// 1/(N₁N₂).
    normalisation: f64,
}

impl Multiplier {
    /// With the values K/(N₁N₂) of `table`, N₁ `rows`.
    pub(super) fn new(table: Vec<f64>, rows: usize, normalisation: f64) -> Self {
        Self { table, rows, normalisation }
    }

    pub(super) fn len(&self) -> usize {
        self.table.len()
    }
}

/// An odd multiplier T(k₁, k₂), k₂ ≤ N₂/2, in the order of the column pass.
#[derive(Debug, Clone)]
pub struct Turns {
    /// Eight columns at a time, padded with zeros.
    table: Vec<f64>,
}

impl Turns {
    pub(super) fn new(table: Vec<f64>) -> Self {
        Self { table }
    }

    /// The largest |T|.
    pub fn largest(&self) -> f64 {
        self.table.iter().fold(0.0, |largest, turn| turn.abs().max(largest))
    }
}

/// What a convolution does with its multiplier K.
#[derive(Debug, Clone, Copy)]
pub enum Action<'a> {
    /// u = F⁻¹[cK · F p] with a factor c, of zero mean: the component (0, 0) is dropped.
    Times(f64),
    /// u = F⁻¹[c F p / K].
    Over(f64),
    /// u = F⁻¹[cK(1 − iT) · F p], of zero mean.
    TimesTurned(f64, &'a Turns),
    /// u = F⁻¹[c F p / K(1 − iT)].
    OverTurned(f64, &'a Turns),
}

impl Action<'_> {
    /// Multiplies lines of a tile of columns, from its line `first` on.
    pub(super) fn multiply<T: Real>(self, multiplier: &Multiplier, tile: usize, first: usize, lines: &mut [T]) {
        let rows = lines.len() / line::<T>();
        for (number, lane) in (0..T::WIDTH).step_by(LANES).enumerate() {
            // Factors of eight columns.
            let whole = (tile * T::WIDTH / LANES + number) * multiplier.rows;
            let own = (whole + first) * LANES..(whole + first + rows) * LANES;
            let (table, normalisation) = (&multiplier.table[own.clone()], multiplier.normalisation);
            match self {
                Self::Times(factor) | Self::TimesTurned(factor, _) => {
                    vectorised!(simd => times(simd, factor, table, lines, lane));
                }
                Self::Over(factor) | Self::OverTurned(factor, _) => {
                    // The table holds the normalisation already.
                    let (numerator, common) = (normalisation, 1.0 / (factor * normalisation));
                    vectorised!(simd => over(simd, numerator, common, table, lines, lane));
                }
            }
            match self {
                Self::Times(_) | Self::Over(_) => {}
                Self::TimesTurned(_, turns) => vectorised!(simd => turn(simd, &turns.table[own], lines, lane)),
                Self::OverTurned(_, turns) => vectorised!(simd => turn_back(simd, &turns.table[own], lines, lane)),
            }
        }
        if let (Self::Times(_) | Self::TimesTurned(..), 0, 0) = (self, tile, first) {
            (lines[0], lines[T::WIDTH]) = (T::zero(), T::zero());
        }
    }
}

/// Eight real and eight imaginary parts of a line, from the column `lane` on.
#[inline(always)]
fn parts<T: Real>(line: &mut [T], lane: usize) -> [&mut [T]; 2] {
    let (re, im) = line.split_at_mut(T::WIDTH);
    [&mut re[lane..lane + LANES], &mut im[lane..lane + LANES]]
}

/// Each component times its factor and a common one.
#[inline(always)]
fn times<S: Simd, T: Real>(simd: S, common: f64, table: &[f64], lines: &mut [T], lane: usize) {
    for (line, factors) in lines.chunks_exact_mut(line::<T>()).zip(table.chunks_exact(LANES)) {
        multiply(simd, T::lanes(f64x8::from_slice(simd, factors) * common), parts(line, lane));
    }
}

/// Each component times `numerator` over its factor and a common one.
#[inline(always)]
fn over<S: Simd, T: Real>(simd: S, numerator: f64, common: f64, table: &[f64], lines: &mut [T], lane: usize) {
    let numerator = T::Lanes::<S>::simd_from(simd, T::rounded(numerator));
    for (line, factors) in lines.chunks_exact_mut(line::<T>()).zip(table.chunks_exact(LANES)) {
        multiply(simd, numerator / T::lanes(f64x8::from_slice(simd, factors) * common), parts(line, lane));
    }
}

/// Each component times 1 − iT.
#[inline(always)]
fn turn<S: Simd, T: Real>(simd: S, table: &[f64], lines: &mut [T], lane: usize) {
    for (line, turns) in lines.chunks_exact_mut(line::<T>()).zip(table.chunks_exact(LANES)) {
        let turns = T::lanes(f64x8::from_slice(simd, turns));
        let [re, im] = parts(line, lane);
        let (x, y) = (T::Lanes::<S>::from_slice(simd, re), T::Lanes::<S>::from_slice(simd, im));
        (x + y * turns).store_slice(re);
        (y - x * turns).store_slice(im);
    }
}

/// Each component over 1 − iT.
#[inline(always)]
fn turn_back<S: Simd, T: Real>(simd: S, table: &[f64], lines: &mut [T], lane: usize) {
    let one = T::Lanes::<S>::simd_from(simd, T::rounded(1.0));
    for (line, turns) in lines.chunks_exact_mut(line::<T>()).zip(table.chunks_exact(LANES)) {
        let turns = T::lanes(f64x8::from_slice(simd, turns));
        let [re, im] = parts(line, lane);
        let (x, y) = (T::Lanes::<S>::from_slice(simd, re), T::Lanes::<S>::from_slice(simd, im));
        let scale = one / (one + turns * turns);
        ((x - y * turns) * scale).store_slice(re);
        ((y + x * turns) * scale).store_slice(im);
    }
}

#[inline(always)]
fn multiply<S: Simd, T: Real>(simd: S, factor: T::Lanes<S>, [re, im]: [&mut [T]; 2]) {
    (T::Lanes::<S>::from_slice(simd, re) * factor).store_slice(re);
    (T::Lanes::<S>::from_slice(simd, im) * factor).store_slice(im);
}
