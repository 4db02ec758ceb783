//! The power spectrum of a periodic surface, and the surface on other grids.
//!
//! h(**x**) = h̄ + Σ ĥ_**q** e^{i**q**·**x**} over the shortest waves through the samples; a component of several shortest aliases
//! is shared by them in equal parts. C(**q**) = A/(4π²) |ĥ_**q**|² with the area A of the cell, so that
//!
//! h_rms² = Σ |ĥ_**q**|² = ∫ C d²q,  h′_rms² = ⟨|∇h|²⟩ = Σ q² |ĥ_**q**|²
//!
//! (B. N. J. Persson et al., J. Phys.: Condens. Matter 17 (2005) R1). C^{2D} = A |ĥ_**q**|² of T. D. B. Jacobs, T. Junge & L.
//! Pastewka, Surf. Topogr.: Metrol. Prop. 5 (2017) 013001, which SurfaceTopography computes, is 4π² times it: h_rms² =
//! ∫ C^{2D} d²q/4π².

use crate::lattice::{Cell, Grid, LatticeError};
use crate::numeric::fourier::field;
use crate::numeric::parallel;
use ndarray::{Array2, ArrayView2};
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Number of rings of wavevectors per decade of wavenumbers.
const RINGS_PER_DECADE: f64 = 16.0;

/// Fourier components of a surface on its grid.
#[derive(Debug, Clone)]
pub struct Spectrum {
    grid: Grid,
    /// Height that is subtracted from all samples before the transform, a length: a flat surface has no waves, not even of rounding.
    common: f64,
    /// Components ĥ(k₁, k₂), k₂ ≤ N₂/2, lengths.
    components: Array2<Complex<f64>>,
}

/// Radial average of the power spectrum over a ring of wavevectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Radial {
    /// Mean wavenumber q, 1/length.
    pub wavenumber: f64,
    /// Mean of C over the ring, length⁴; h_rms² = ∫ C d²q.
    pub density: f64,
    /// Number of waves in the ring.
    pub waves: f64,
}

impl Spectrum {
    /// Spectrum of heights on a cell, lengths, axis 0 along a₁, axis 1 along a₂.
    ///
    /// # Errors
    /// [`LatticeError`] when there are none.
    pub fn of(cell: Cell, heights: ArrayView2<'_, f64>) -> Result<Self, LatticeError> {
        let grid = Grid::new(cell, heights.dim().into())?;
        let common = heights.first().copied().unwrap_or(0.0);
        let components = field::components_above(heights, common);
        Ok(Self { grid, common, components })
    }

    /// Spectrum with these components (k₁, k₂), k₂ ≤ N₂/2, lengths, on a grid.
    pub(super) fn new(grid: Grid, components: Array2<Complex<f64>>) -> Self {
        Self { grid, common: 0.0, components }
    }

    /// The grid of the samples.
    pub(crate) fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Height that all samples have in common, a length, not contained in the components.
    pub(super) fn common(&self) -> f64 {
        self.common
    }

    /// Components ĥ(k₁, k₂), k₂ ≤ N₂/2, lengths.
    pub(super) fn components(&self) -> ArrayView2<'_, Complex<f64>> {
        self.components.view()
    }

    /// Heights at the samples of the grid, lengths, axis 0 along a₁, axis 1 along a₂.
    pub fn into_heights(self) -> Array2<f64> {
        let [_, n2] = self.grid.points();
        let common = self.common;
        field::field(self.components, n2).mapv_into(|height| height + common)
    }

    /// Rms slope √⟨|∇h|²⟩, dimensionless.
    pub fn rms_slope(&self) -> f64 {
        let [slopes] = self.sums(|[sum], (q, square, _)| *sum += q * q * square);
        slopes.sqrt()
    }

    /// C averaged over rings of wavevectors, sixteen per decade, up to the least aliased wavenumber.
    pub fn radial(&self) -> Vec<Radial> {
        let (least, most) = (self.grid.least_wavenumber(), self.grid.least_aliased());
        let ring = |q: f64| (RINGS_PER_DECADE * (q / least).log10() + 0.5).floor().max(0.0) as usize;
        let mut sums = vec![[0.0; 3]; ring(most) + 1];
        for (q, square, waves) in self.squares().filter(|(q, ..)| *q <= most * (1.0 + 1e-9)) {
            let sum = &mut sums[ring(q).min(ring(most))];
            *sum = [sum[0] + waves * q, sum[1] + square, sum[2] + waves];
        }
        let scale = self.grid.cell().area() / (TAU * TAU);
        let found = sums.into_iter().filter(|[_, _, waves]| *waves > 0.0);
        found
            .map(|[q, square, waves]| Radial { wavenumber: q / waves, density: scale * square / waves, waves })
            .collect()
    }

    /// Heights on another grid of the cell, lengths, axis 0 along a₁, axis 1 along a₂: the sum of the waves, without those that a
    /// coarser grid cannot hold.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn resampled(&self, points: [usize; 2]) -> Result<Array2<f64>, LatticeError> {
        let to = Grid::new(self.grid.cell(), points)?;
        let [b1, b2] = to.cell().reciprocal();
        let [_, n2] = self.grid.points();
        let mut sum = WaveSum::new(points);
        for ((k1, k2), value) in self.components.indexed_iter() {
            let aliases = self.grid.aliases([k1, k2]);
            let part = value / aliases.len() as f64;
            let alone = k2 == 0 || 2 * k2 == n2;
            for wave in aliases {
                let q = [0, 1].map(|c| f64::from(wave[0]) * b1[c] + f64::from(wave[1]) * b2[c]);
                if to.holds(q) {
                    sum.add(wave, part);
                    // The conjugate is not among the components.
                    if !alone {
                        sum.add(wave.map(|k| -k), part.conj());
                    }
                }
            }
        }
        Ok(sum.field().mapv_into(|height| height + self.common))
    }

    /// Wavenumber, Σ |ĥ|² over the waves of the component and its conjugate, and their number, for every component but the mean.
    pub(super) fn squares(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        (0..self.components.nrows()).flat_map(|k1| self.squares_of_row(k1))
    }

    /// Sums of N terms over all [components but the mean](Self::squares), in their order whatever the threads: `add` adds those of one.
    pub(super) fn sums<const N: usize>(&self, add: impl Fn(&mut [f64; N], (f64, f64, f64)) + Sync) -> [f64; N] {
        let of_row = |k1: usize| {
            let mut sums = [0.0; N];
            self.squares_of_row(k1).for_each(|component| add(&mut sums, component));
            sums
        };
        let rows = parallel::map(self.components.nrows(), of_row);
        rows.into_iter().fold([0.0; N], |sums, row| std::array::from_fn(|k| sums[k] + row[k]))
    }

    /// The components of one k₁ of [`Self::squares`].
    fn squares_of_row(&self, k1: usize) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let [_, n2] = self.grid.points();
        let all_but_mean = self.components.row(k1).into_iter().enumerate().skip(usize::from(k1 == 0));
        all_but_mean.map(move |(k2, value)| {
            let count = if k2 == 0 || 2 * k2 == n2 { 1.0 } else { 2.0 };
            // Shared in equal parts, the squares of the parts add to the component's square over their number.
            let ([x, y], tied) = self.grid.wavevector_and_ties([k1, k2]);
            ((x * x + y * y).sqrt(), count * value.norm_sqr() / tied as f64, count * tied as f64)
        })
    }
}

/// A sum of waves on a grid.
#[derive(Debug)]
pub(super) struct WaveSum {
    points: [usize; 2],
    components: Array2<Complex<f64>>,
}

impl WaveSum {
    /// The empty sum on N₁ × N₂ samples.
    pub fn new(points: [usize; 2]) -> Self {
        Self { points, components: Array2::default((points[0], points[1] / 2 + 1)) }
    }

    /// Adds value·e^{i**q**·**x**}, **q** = κ₁b₁ + κ₂b₂; its conjugate has to be added too.
    pub fn add(&mut self, wave: [i32; 2], value: Complex<f64>) {
        let [k1, k2] = [0, 1].map(|axis| i64::from(wave[axis]).rem_euclid(self.points[axis] as i64) as usize);
        if let Some(component) = self.components.get_mut([k1, k2]) {
            *component += value;
        }
    }

    /// Values of the sum at the samples, lengths.
    pub fn field(self) -> Array2<f64> {
        field::field(self.components, self.points[1])
    }

    /// The components, k₂ ≤ N₂/2.
    pub fn components(self) -> Array2<Complex<f64>> {
        self.components
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Waves κ of amplitude and phase, as a direct sum.
    fn height(waves: &[([i32; 2], f64, f64)], [s, t]: [f64; 2]) -> f64 {
        let wave = |&([k1, k2], a, phase): &([i32; 2], f64, f64)| {
            a * (TAU * (f64::from(k1) * s + f64::from(k2) * t) + phase).cos()
        };
        waves.iter().map(wave).sum()
    }

    fn sampled(waves: &[([i32; 2], f64, f64)], [n1, n2]: [usize; 2]) -> Array2<f64> {
        Array2::from_shape_fn((n1, n2), |(i, j)| height(waves, [i as f64 / n1 as f64, j as f64 / n2 as f64]))
    }

    const WAVES: [([i32; 2], f64, f64); 5] =
        [([0, 0], 0.7, 0.0), ([1, 2], 1.0, 0.3), ([-2, 1], 0.5, 1.1), ([3, 0], 0.2, -0.4), ([0, 3], 0.1, 2.0)];

    fn cells() -> [Cell; 3] {
        [Cell::square(2.0), Cell::hexagonal(1.5), Cell::new([1.0, 0.1], [-0.3, 1.4])].map(Result::unwrap)
    }

    #[test]
    fn resampling_a_band_limited_surface_is_the_direct_sum() {
        for cell in cells() {
            for from in [[12, 14], [9, 11]] {
                let spectrum = Spectrum::of(cell, sampled(&WAVES, from).view()).unwrap();
                for to in [[9, 10], [12, 14], [24, 28], [17, 40]] {
                    let (found, expected) = (spectrum.resampled(to).unwrap(), sampled(&WAVES, to));
                    let error = (&found - &expected).iter().fold(0.0f64, |most, d| most.max(d.abs()));
                    assert!(error < 1e-13, "{cell}, {from:?} → {to:?}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn a_coarser_grid_loses_the_waves_it_cannot_hold() {
        let cell = Cell::square(1.0).unwrap();
        let spectrum = Spectrum::of(cell, sampled(&WAVES, [16, 16]).view()).unwrap();
        let kept: Vec<_> = WAVES.into_iter().filter(|(k, ..)| k.iter().all(|k| k.abs() < 3)).collect();
        let found = spectrum.resampled([5, 5]).unwrap();
        assert!((&found - &sampled(&kept, [5, 5])).iter().all(|d| d.abs() < 1e-14));
    }

    /// Samples of alternating sign are the wave cos(Nx/2), half of either direction: even between the samples, and so the
    /// mean of itself and its mirror image.
    #[test]
    fn the_wave_on_the_border_is_even_and_comes_back() {
        for cell in cells() {
            let stored = Array2::from_shape_fn((6, 8), |(i, j)| ((5 * i + 3 * j * j + i * j) % 7) as f64);
            let spectrum = Spectrum::of(cell, stored.view()).unwrap();
            let finer = spectrum.resampled([18, 24]).unwrap();
            for ((i, j), value) in stored.indexed_iter() {
                assert!((finer[[3 * i, 3 * j]] - value).abs() < 1e-13, "{cell}");
            }
            let back = Spectrum::of(cell, finer.view()).unwrap().resampled([6, 8]).unwrap();
            assert!((&back - &stored).iter().all(|d| d.abs() < 1e-12), "{cell}");
        }
        let alternating = Array2::from_shape_fn((4, 2), |(i, _)| if i % 2 == 0 { 1.0 } else { -1.0 });
        let finer = Spectrum::of(Cell::square(1.0).unwrap(), alternating.view()).unwrap().resampled([8, 2]).unwrap();
        let expected = Array2::from_shape_fn((8, 2), |(i, _)| (TAU * i as f64 / 4.0).cos());
        assert!((&finer - &expected).iter().all(|d| d.abs() < 1e-15));
    }

    /// Σ a²/2 and Σ q²a²/2, and the density as the mean over the waves of a ring.
    #[test]
    fn rms_values_and_density_are_those_of_the_waves() {
        for cell in cells() {
            let spectrum = Spectrum::of(cell, sampled(&WAVES, [12, 14]).view()).unwrap();
            let [b1, b2] = cell.reciprocal();
            let wavenumber = |k: [i32; 2]| {
                let [x, y] = [0, 1].map(|c| f64::from(k[0]) * b1[c] + f64::from(k[1]) * b2[c]);
                x.hypot(y)
            };
            let sum = |of: &dyn Fn([i32; 2]) -> f64| -> f64 {
                WAVES[1..].iter().map(|(k, a, _)| 0.5 * a * a * of(*k)).sum::<f64>().sqrt()
            };
            let rms_height = spectrum.squares().map(|(_, square, _)| square).sum::<f64>().sqrt();
            assert!((rms_height / sum(&|_| 1.0) - 1.0).abs() < 1e-13);
            assert!((spectrum.rms_slope() / sum(&|k| wavenumber(k).powi(2)) - 1.0).abs() < 1e-13);
            let rings = spectrum.radial();
            let power: f64 = rings.iter().map(|ring| ring.density * ring.waves).sum();
            let held = |k: &[i32; 2]| wavenumber(*k) <= Grid::new(cell, [12, 14]).unwrap().least_aliased();
            let expected: f64 = WAVES[1..].iter().filter(|(k, ..)| held(k)).map(|(_, a, _)| 0.5 * a * a).sum();
            assert!((power * TAU * TAU / cell.area() / expected - 1.0).abs() < 1e-12);
        }
    }
}
