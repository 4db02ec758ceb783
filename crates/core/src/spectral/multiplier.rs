//! Multiplication in Fourier space: by an even, positive multiplier K, or by K(1 − iT) with an odd T, the ratio of a skew part.
//!
//! The multiplier of a kernel in free space, of which a window alone is used, may be zero or negative: there H, or H − iG with
//! an odd G, the skew part itself.
//!
//! A further compliance may be added for a while ([`Multiplier::add`]): K + u + v with one number u for all components and v for few of
//! them, with the skew part KT as it is. It takes memory for those few alone, and the multiplier is restored bit for bit.

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
    /// K/(N₁N₂) of the component (0, 0) in products, where its value in the table is for division alone.
    mean: Option<f64>,
    added: Added,
}

/// Terms that are added to a multiplier for a while.
#[derive(Debug, Clone, Default)]
struct Added {
    /// u/(N₁N₂), added to every value of the table.
    uniform: f64,
    /// Values of the table, by their index, and of the mean before v was added.
    table: Vec<(usize, f64)>,
    mean: Option<f64>,
}

impl Multiplier {
    /// The multiplier with the values K/(N₁N₂) of `table`, N₁ `rows`.
    pub(super) fn new(table: Vec<f64>, rows: usize, normalisation: f64) -> Self {
        Self { table, rows, normalisation, mean: None, added: Added::default() }
    }

    /// The multiplier whose products have zero mean; its value of the component (0, 0) is for division alone.
    #[must_use]
    pub fn dropping_mean(self) -> Self {
        Self { mean: Some(0.0), ..self }
    }

    /// Adds `uniform` = u to the values of all components, and v to those of a few, each once with its index in the table. Where the mean is
    /// dropped so far, products have that of u and v, and division takes u and v beside the value for it alone.
    pub fn add(&mut self, uniform: f64, few: &[(usize, f64)]) {
        self.restore();
        self.added =
            Added { uniform: uniform * self.normalisation, table: Vec::with_capacity(few.len()), mean: self.mean };
        for &(index, value) in few {
            self.added.table.push((index, self.table[index]));
            self.table[index] += value * self.normalisation;
        }
        let at_zero = few.iter().find(|(index, _)| *index == 0).map_or(0.0, |&(_, value)| value * self.normalisation);
        self.mean = self.mean.map(|mean| mean + self.added.uniform + at_zero);
    }

    /// Takes off what was [added](Self::add): the multiplier is that of before, bit for bit.
    pub fn restore(&mut self) {
        let added = std::mem::take(&mut self.added);
        if added.uniform != 0.0 || !added.table.is_empty() {
            self.mean = added.mean;
        }
        added.table.iter().for_each(|&(index, value)| self.table[index] = value);
    }

    /// K without v over K with it, for each component that has v, with its index in the table.
    pub(super) fn parts(&self) -> impl Iterator<Item = (usize, f64)> {
        self.added.table.iter().map(|&(index, before)| (index, before / self.table[index]))
    }

    pub(super) fn len(&self) -> usize {
        self.table.len()
    }

    /// Whether K > 0 in all components.
    pub(super) fn is_positive(&self) -> bool {
        self.table.iter().all(|k| *k > 0.0)
    }

    /// The magnitude |K(1 − iT)| of the multiplier with a ratio T, real and positive.
    pub(super) fn magnitude(&self, SkewRatio { table }: &SkewRatio) -> Self {
        let magnitudes = self.table.iter().zip(table).map(|(k, ratio)| k * ratio.hypot(1.0));
        Self { table: magnitudes.collect(), added: Added::default(), ..*self }
    }

    /// The sum of K(1 − iT) and its magnitude, K(1 + √(1 + T²)) with the ratio T/(1 + √(1 + T²)).
    pub(super) fn with_magnitude(&self, SkewRatio { table }: &SkewRatio) -> (Self, SkewRatio) {
        let sums = self.table.iter().zip(table).map(|(k, ratio)| k * (1.0 + ratio.hypot(1.0)));
        let ratios = table.iter().map(|ratio| ratio / (1.0 + ratio.hypot(1.0))).collect();
        (Self { table: sums.collect(), added: Added::default(), ..*self }, SkewRatio { table: ratios })
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

    /// Keeps KT as it is while K is that of a multiplier to which v was [added](Multiplier::add); returns the ratios of before, each with
    /// its index in the table.
    pub(super) fn keep_part(&mut self, multiplier: &Multiplier) -> Vec<(usize, f64)> {
        let scaled = multiplier.parts().map(|(index, part)| {
            let before = self.table[index];
            self.table[index] *= part;
            (index, before)
        });
        scaled.collect()
    }

    /// Sets the ratios of before.
    pub(super) fn restore(&mut self, before: &[(usize, f64)]) {
        before.iter().for_each(|&(index, ratio)| self.table[index] = ratio);
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
        let uniform = multiplier.added.uniform;
        let mean_line = match self {
            Self::Multiply(factor) | Self::MultiplySkewed(factor, _) if tile == 0 && first == 0 => {
                multiplier.mean.map(|mean| [lines[0], lines[T::WIDTH]].map(|x| product(x, mean * factor)))
            }
            _ => None,
        };
        for (number, lane) in (0..T::WIDTH).step_by(LANES).enumerate() {
            // Factors of eight columns.
            let whole = (tile * T::WIDTH / LANES + number) * multiplier.rows;
            let range = (whole + first) * LANES..(whole + first + rows) * LANES;
            let (table, normalisation) = (&multiplier.table[range.clone()], multiplier.normalisation);
            match self {
                Self::Multiply(factor) | Self::MultiplySkewed(factor, _) => {
                    vectorised!(simd => times(simd, factor, (table, uniform), lines, lane));
                }
                Self::Divide(factor) | Self::DivideSkewed(factor, _) => {
                    // The table holds the normalisation already.
                    let (numerator, common) = (normalisation, 1.0 / (factor * normalisation));
                    vectorised!(simd => over(simd, [numerator, common], (table, uniform), lines, lane));
                }
                Self::MultiplyComplex(factor, skew) => {
                    let skew = &skew.table[range.clone()];
                    vectorised!(simd => times_complex(simd, factor, ([table, skew], uniform), lines, lane));
                }
            }
            match self {
                Self::Multiply(_) | Self::Divide(_) | Self::MultiplyComplex(..) => {}
                Self::MultiplySkewed(_, ratio) => {
                    let ratios = (&ratio.table[range], table, uniform);
                    vectorised!(simd => multiply_skew(simd, ratios, lines, lane));
                }
                Self::DivideSkewed(_, ratio) => {
                    let ratios = (&ratio.table[range], table, uniform);
                    vectorised!(simd => divide_skew(simd, ratios, lines, lane));
                }
            }
        }
        if let Some([re, im]) = mean_line {
            (lines[0], lines[T::WIDTH]) = (re, im);
        }
    }
}

/// A number times a factor; zero for the factor zero, whatever the number.
fn product<T: Real>(x: T, factor: f64) -> T {
    if factor == 0.0 { T::zero() } else { x * T::rounded(factor) }
}

/// Ratios T of eight components to K, of which `table` holds K − u.
#[inline(always)]
fn ratios<S: Simd, T: Real>(simd: S, ratios: &[f64], table: &[f64], uniform: f64) -> T::Lanes<S> {
    let ratios = f64x8::from_slice(simd, ratios);
    if uniform == 0.0 {
        return T::lanes(ratios);
    }
    let table = f64x8::from_slice(simd, table);
    T::lanes(ratios * (table / (table + uniform)))
}

/// Ratios of all components, with K − u and u.
type Ratios<'a> = (&'a [f64], &'a [f64], f64);

/// Eight real and eight imaginary parts of a line, from the column `lane` on.
#[inline(always)]
fn parts<T: Real>(line: &mut [T], lane: usize) -> [&mut [T]; 2] {
    let (re, im) = line.split_at_mut(T::WIDTH);
    [&mut re[lane..lane + LANES], &mut im[lane..lane + LANES]]
}

/// Each component times its factor and a common one.
#[inline(always)]
fn times<S: Simd, T: Real>(simd: S, common: f64, (table, uniform): (&[f64], f64), lines: &mut [T], lane: usize) {
    for (line, factors) in lines.chunks_exact_mut(line::<T>()).zip(table.chunks_exact(LANES)) {
        multiply(simd, T::lanes((f64x8::from_slice(simd, factors) + uniform) * common), parts(line, lane));
    }
}

/// Each component times H − iG and a common factor.
#[inline(always)]
fn times_complex<S: Simd, T: Real>(
    simd: S,
    common: f64,
    ([even, odd], uniform): ([&[f64]; 2], f64),
    lines: &mut [T],
    lane: usize,
) {
    let factors = even.chunks_exact(LANES).zip(odd.chunks_exact(LANES));
    for (line, (even, odd)) in lines.chunks_exact_mut(line::<T>()).zip(factors) {
        let even = T::lanes((f64x8::from_slice(simd, even) + uniform) * common);
        let odd = T::lanes(f64x8::from_slice(simd, odd) * common);
        let [re, im] = parts(line, lane);
        let (x, y) = (T::Lanes::<S>::from_slice(simd, re), T::Lanes::<S>::from_slice(simd, im));
        (x * even + y * odd).store_slice(re);
        (y * even - x * odd).store_slice(im);
    }
}

/// Each component times `numerator` over its factor and a common one.
#[inline(always)]
fn over<S: Simd, T: Real>(
    simd: S,
    [numerator, common]: [f64; 2],
    (table, uniform): (&[f64], f64),
    lines: &mut [T],
    lane: usize,
) {
    let numerator = T::Lanes::<S>::simd_from(simd, T::rounded(numerator));
    for (line, factors) in lines.chunks_exact_mut(line::<T>()).zip(table.chunks_exact(LANES)) {
        multiply(simd, numerator / T::lanes((f64x8::from_slice(simd, factors) + uniform) * common), parts(line, lane));
    }
}

/// Each component times 1 − iT.
#[inline(always)]
fn multiply_skew<S: Simd, T: Real>(simd: S, (skew, table, uniform): Ratios<'_>, lines: &mut [T], lane: usize) {
    let factors = skew.chunks_exact(LANES).zip(table.chunks_exact(LANES));
    for (line, (skew, table)) in lines.chunks_exact_mut(line::<T>()).zip(factors) {
        let ratios = ratios::<S, T>(simd, skew, table, uniform);
        let [re, im] = parts(line, lane);
        let (x, y) = (T::Lanes::<S>::from_slice(simd, re), T::Lanes::<S>::from_slice(simd, im));
        (x + y * ratios).store_slice(re);
        (y - x * ratios).store_slice(im);
    }
}

/// Each component over 1 − iT.
#[inline(always)]
fn divide_skew<S: Simd, T: Real>(simd: S, (skew, table, uniform): Ratios<'_>, lines: &mut [T], lane: usize) {
    let one = T::Lanes::<S>::simd_from(simd, T::rounded(1.0));
    let factors = skew.chunks_exact(LANES).zip(table.chunks_exact(LANES));
    for (line, (skew, table)) in lines.chunks_exact_mut(line::<T>()).zip(factors) {
        let ratios = ratios::<S, T>(simd, skew, table, uniform);
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
