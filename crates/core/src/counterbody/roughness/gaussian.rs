//! The Gaussian filter of short waves, with the cut-off λ_s (ISO 16610-21, -61).
//!
//! h̃(**x**) = ∫ s(**x** − **x**′) h(**x**′) d²x′ with the weight s = exp(−π|**x**|²/(αλ_s)²)/(αλ_s)², α = √(ln 2/π); a wave of length λ is
//! transmitted with the factor
//!
//! ŝ(λ) = exp(−π(αλ_s/λ)²) = 2^{−(λ_s/λ)²}, one half at λ = λ_s.
//!
//! A periodic surface goes on beyond its border, and its waves are multiplied by ŝ. One that is not has nothing there: h̃ = (s ∗ h)/(s ∗ 1), both
//! sums over the samples of the surface, so that a constant height stays constant up to the border. The sums are products with the
//! transform of the sampled weight on a cell that is longer by its reach. ŝ itself ends at the shortest wave that the samples hold; for a cut-off
//! of a few samples the weight to such a ŝ would reach to the opposite border.

use crate::lattice::{Cell, Grid, LatticeError};
use crate::numeric::fourier::field;
use crate::numeric::parallel;
use ndarray::{Array2, ArrayView2};
use rustfft::num_complex::Complex;
use std::f64::consts::{LN_2, PI, TAU};

/// Memory of [`smoothed`], bytes a sample: of a period, and with borders, where the longer cell has at most four times as many samples and
/// 32 bytes for each.
pub const MEMORY: [u64; 2] = [24, 4 * 32 + 16];
/// Distance at which the weight is below 1e-16 of that in the middle, over the cut-off: α √(ln 1e16/π).
const REACH: f64 = 1.61;

/// Heights without the waves shorter than about the `cutoff`, lengths, on a cell of which they are a period if `is_periodic`.
///
/// # Errors
/// [`LatticeError`] without samples.
pub fn smoothed(
    cell: Cell,
    heights: ArrayView2<'_, f64>,
    cutoff: f64,
    is_periodic: bool,
) -> Result<Array2<f64>, LatticeError> {
    if is_periodic {
        return transmitted(cell, heights, cutoff);
    }
    let [n1, n2]: [usize; 2] = heights.dim().into();
    let [a1, a2] = cell.vectors();
    // Distances of the lines of samples, in whose direction the weight has to end.
    let [l1, l2] = [a1, a2].map(|[x, y]| x.hypot(y));
    let spacings = [cell.area() / (l2 * n1 as f64), cell.area() / (l1 * n2 as f64)];
    // No two samples are farther apart than all.
    let reach = [0, 1].map(|axis| [n1, n2][axis].min((REACH * cutoff / spacings[axis]).ceil() as usize + 1) - 1);
    let longer = [n1 + reach[0], n2 + reach[1]];
    // Number of samples from the middle of the weight, which is the first sample of the wider cell.
    let away = |k: usize, axis: usize| {
        let back = longer[axis] - k;
        if k <= reach[axis] { Some(k as f64) } else { (back <= reach[axis]).then(|| -(back as f64)) }
    };
    let weight = |(i, j): (usize, usize)| match (away(i, 0), away(j, 1)) {
        (Some(i), Some(j)) => {
            let [x, y] = cell.vector([i / n1 as f64, j / n2 as f64]);
            (-(PI * PI / LN_2) * (x * x + y * y) / (cutoff * cutoff)).exp()
        }
        _ => 0.0,
    };
    let weight = field::components(Array2::from_shape_fn(longer, weight).view());
    let mean = heights.mean().unwrap_or(0.0);
    let weighted = convolved(&weight, longer, [n1, n2], |at| heights[at] - mean);
    let weights = convolved(&weight, longer, [n1, n2], |_| 1.0);
    Ok(mean + weighted / weights)
}

/// The sums of a weight times values over `points` samples, at these samples, but for a factor; `weight` are its components on the
/// `longer` samples.
fn convolved(
    weight: &Array2<Complex<f64>>,
    longer: [usize; 2],
    [n1, n2]: [usize; 2],
    value: impl Fn([usize; 2]) -> f64,
) -> Array2<f64> {
    let extended = Array2::from_shape_fn(longer, |(i, j)| if i < n1 && j < n2 { value([i, j]) } else { 0.0 });
    let mut components = field::components(extended.view());
    drop(extended);
    components.zip_mut_with(weight, |component, weight| *component *= weight);
    let sums = field::field(components, longer[1]);
    Array2::from_shape_fn([n1, n2], |at| sums[at])
}

/// A period of a surface times ŝ.
fn transmitted(cell: Cell, heights: ArrayView2<'_, f64>, cutoff: f64) -> Result<Array2<f64>, LatticeError> {
    let grid = Grid::new(cell, heights.dim().into())?;
    let [_, n2] = grid.points();
    let mut components = field::components(heights);
    let half = components.ncols();
    parallel::each_chunk(components.as_slice_mut().expect("made row by row"), half, |k1, row| {
        for (k2, value) in row.iter_mut().enumerate() {
            let ratio = cutoff * grid.wavenumber([k1, k2]) / TAU;
            *value *= f64::exp2(-ratio * ratio);
        }
    });
    Ok(field::field(components, n2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn largest(a: &Array2<f64>, b: &Array2<f64>) -> f64 {
        a.iter().zip(b).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()))
    }

    #[test]
    fn a_wave_as_long_as_the_cutoff_is_halved_in_any_direction() {
        let cell = Cell::new([2.0, 0.0], [0.6, 1.5]).unwrap();
        for wave in [[3.0, 0.0], [0.0, 2.0], [2.0, -3.0]] {
            let surface = Array2::from_shape_fn((32, 24), |(i, j)| {
                5.0 + (TAU * (wave[0] * i as f64 / 32.0 + wave[1] * j as f64 / 24.0) + 0.3).cos()
            });
            let [b1, b2] = cell.reciprocal();
            let [x, y] = [0, 1].map(|c| wave[0] * b1[c] + wave[1] * b2[c]);
            for (cutoff, factor) in [(1.0, 0.5), (2.0, 0.0625), (0.5, 0.5f64.powf(0.25))] {
                let found = smoothed(cell, surface.view(), cutoff * TAU / x.hypot(y), true).unwrap();
                let expected = surface.mapv(|height| 5.0 + factor * (height - 5.0));
                assert!(largest(&found, &expected) < 1e-13, "{wave:?} {cutoff}");
            }
        }
    }

    /// The sums of ISO 16610 over the samples that are there, one by one, from two samples a cut-off to the whole side.
    #[test]
    fn a_surface_with_borders_is_the_sum_over_its_samples() {
        let cells = [Cell::window([3.0, 2.0]).unwrap(), Cell::new([3.0, 0.0], [0.8, 2.0]).unwrap()];
        for (cell, cutoff) in cells.into_iter().flat_map(|cell| [0.2, 0.35, 0.6, 1.3, 2.0].map(|cutoff| (cell, cutoff)))
        {
            let points = [30, 25];
            let surface =
                Array2::from_shape_fn(points, |(i, j)| 7.0 + 0.1 * i as f64 + ((3 * i + 5 * j * j) % 7) as f64);
            let found = smoothed(cell, surface.view(), cutoff, false).unwrap();
            let weight = |[x, y]: [f64; 2]| (-PI * (x * x + y * y) / (LN_2 / PI * cutoff * cutoff)).exp();
            let expected = Array2::from_shape_fn(points, |(i, j)| {
                let (sum, weights) = surface.indexed_iter().fold((0.0, 0.0), |(sum, weights), ((k, l), height)| {
                    let w = weight(cell.vector([(k as f64 - i as f64) / 30.0, (l as f64 - j as f64) / 25.0]));
                    (sum + w * height, weights + w)
                });
                sum / weights
            });
            assert!(largest(&found, &expected) < 1e-12, "{cell} {cutoff}: {:e}", largest(&found, &expected));
            let flat = smoothed(cell, Array2::from_elem(points, 3.0).view(), cutoff, false).unwrap();
            assert!(flat.iter().all(|height| (height - 3.0).abs() < 1e-14));
        }
    }
}
