//! Multiplication in Fourier space: by an even, positive multiplier K, or by K(1 − iT) with an odd T, the ratio of a skew part.
//!
//! The multiplier of a kernel in free space, of which a window alone is used, may be zero or negative: there H, or H − iG with
//! an odd G, the skew part itself.

use crate::numeric::fourier::line;
use crate::numeric::lanes::{LANES, Real, vectorised};
use fearless_simd::{f64x8, prelude::*};

/// A positive, even multiplier K(k₁, k₂), k₂ ≤ N₂/2, in the order of the column pass; of any sign where nothing is divided by it.
#[derive(Debug, Clone)]
pub struct Multiplier {
    /// K/(N₁N₂), eight columns at a time, padded with ones.
    table: Vec<f64>,
    /// N₁.
    rows: usize,
    /// 1/(N₁N₂).
    normalisation: f64,
    /// Whether products have zero mean: the value of the component (0, 0) is then for division alone.
    drops_mean: bool,
}

impl Multiplier {
    /// With the values K/(N₁N₂) of `table`, N₁ `rows`.
    pub(super) fn new(table: Vec<f64>, rows: usize, normalisation: f64) -> Self {
        Self { table, rows, normalisation, drops_mean: false }
    }

    /// The multiplier whose products have zero mean; its value of the component (0, 0) is for division alone.
    #[must_use]
    pub fn dropping_mean(self) -> Self {
        Self { drops_mean: true, ..self }
    }

    pub(super) fn len(&self) -> usize {
        self.table.len()
    }
}

/// Ratio T(k₁, k₂) of the skew part to K, odd, k₂ ≤ N₂/2, in the order of the column pass.
#[derive(Debug, Clone)]
pub struct SkewRatio {
    /// Eight columns at a time, padded with zeros.
    table: Vec<f64>,
}

impl SkewRatio {
    pub(super) fn new(table: Vec<f64>) -> Self {
        Self { table }
    }

    /// The largest |T|.
    pub fn largest(&self) -> f64 {
        self.table.iter().fold(0.0, |largest, ratio| ratio.abs().max(largest))
    }
}

/// Skew part G(k₁, k₂) of a multiplier H − iG, odd, k₂ ≤ N₂/2, in the order of the column pass.
#[derive(Debug, Clone)]
pub struct SkewPart {
    /// G/(N₁N₂), eight columns at a time, padded with zeros.
    table: Vec<f64>,
}

impl SkewPart {
    pub(super) fn new(table: Vec<f64>) -> Self {
        Self { table }
    }
}

/// Use of the multiplier K, or H, in a convolution.
#[derive(Debug, Clone, Copy)]
pub enum Action<'a> {
    /// u = F⁻¹[cK · F p] or F⁻¹[cH · F p] with a factor c; of zero mean where the multiplier [drops](Multiplier::dropping_mean) it.
    Multiply(f64),
    /// u = F⁻¹[c F p / K].
    Divide(f64),
    /// u = F⁻¹[cK(1 − iT) · F p]; of zero mean where the multiplier drops it.
    MultiplySkewed(f64, &'a SkewRatio),
    /// u = F⁻¹[c F p / K(1 − iT)].
    DivideSkewed(f64, &'a SkewRatio),
    /// u = F⁻¹[c(H − iG) · F p].
    MultiplyComplex(f64, &'a SkewPart),
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
                Self::Multiply(factor) | Self::MultiplySkewed(factor, _) => {
                    vectorised!(simd => times(simd, factor, table, lines, lane));
                }
                Self::Divide(factor) | Self::DivideSkewed(factor, _) => {
                    // The table holds the normalisation already.
                    let (numerator, common) = (normalisation, 1.0 / (factor * normalisation));
                    vectorised!(simd => over(simd, numerator, common, table, lines, lane));
                }
                Self::MultiplyComplex(factor, skew) => {
                    let skew = &skew.table[own.clone()];
                    vectorised!(simd => times_complex(simd, factor, [table, skew], lines, lane));
                }
            }
            match self {
                Self::Multiply(_) | Self::Divide(_) | Self::MultiplyComplex(..) => {}
                Self::MultiplySkewed(_, ratio) => {
                    vectorised!(simd => multiply_skew(simd, &ratio.table[own], lines, lane))
                }
                Self::DivideSkewed(_, ratio) => vectorised!(simd => divide_skew(simd, &ratio.table[own], lines, lane)),
            }
        }
        if let (true, Self::Multiply(_) | Self::MultiplySkewed(..), 0, 0) = (multiplier.drops_mean, self, tile, first) {
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

/// Each component times H − iG and a common factor.
#[inline(always)]
fn times_complex<S: Simd, T: Real>(simd: S, common: f64, [even, odd]: [&[f64]; 2], lines: &mut [T], lane: usize) {
    let factors = even.chunks_exact(LANES).zip(odd.chunks_exact(LANES));
    for (line, (even, odd)) in lines.chunks_exact_mut(line::<T>()).zip(factors) {
        let [even, odd] = [even, odd].map(|factors| T::lanes(f64x8::from_slice(simd, factors) * common));
        let [re, im] = parts(line, lane);
        let (x, y) = (T::Lanes::<S>::from_slice(simd, re), T::Lanes::<S>::from_slice(simd, im));
        (x * even + y * odd).store_slice(re);
        (y * even - x * odd).store_slice(im);
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
fn multiply_skew<S: Simd, T: Real>(simd: S, table: &[f64], lines: &mut [T], lane: usize) {
    for (line, ratios) in lines.chunks_exact_mut(line::<T>()).zip(table.chunks_exact(LANES)) {
        let ratios = T::lanes(f64x8::from_slice(simd, ratios));
        let [re, im] = parts(line, lane);
        let (x, y) = (T::Lanes::<S>::from_slice(simd, re), T::Lanes::<S>::from_slice(simd, im));
        (x + y * ratios).store_slice(re);
        (y - x * ratios).store_slice(im);
    }
}

/// Each component over 1 − iT.
#[inline(always)]
fn divide_skew<S: Simd, T: Real>(simd: S, table: &[f64], lines: &mut [T], lane: usize) {
    let one = T::Lanes::<S>::simd_from(simd, T::rounded(1.0));
    for (line, ratios) in lines.chunks_exact_mut(line::<T>()).zip(table.chunks_exact(LANES)) {
        let ratios = T::lanes(f64x8::from_slice(simd, ratios));
        let [re, im] = parts(line, lane);
        let (x, y) = (T::Lanes::<S>::from_slice(simd, re), T::Lanes::<S>::from_slice(simd, im));
        let scale = one / (one + ratios * ratios);
        ((x - y * ratios) * scale).store_slice(re);
        ((y + x * ratios) * scale).store_slice(im);
    }
}

#[inline(always)]
fn multiply<S: Simd, T: Real>(simd: S, factor: T::Lanes<S>, [re, im]: [&mut [T]; 2]) {
    (T::Lanes::<S>::from_slice(simd, re) * factor).store_slice(re);
    (T::Lanes::<S>::from_slice(simd, im) * factor).store_slice(im);
}
