//! Self-affine surfaces with a roll-off, generated from a seed.
//!
//! C(q) is constant from 2π/λ_l to 2π/λ_r, falls as q^{−2(1+H)} from there to 2π/λ_s, and is 0 elsewhere, with the Hurst
//! exponent H and the longest, roll-off and shortest wavelength λ_l ≥ λ_r ≥ λ_s (e.g. V. A. Yastrebov, G. Anciaux &
//! J.-F. Molinari, J. Mech. Phys. Solids 107 (2017) 469–493).
//!
//! Every wave of the cell in the band has the amplitude of C and a phase of its own, drawn from the seed and the
//! wave's multiples (κ₁, κ₂) of **b**₁ and **b**₂ alone. So the surface does not depend on the grid, the spectrum of every seed
//! is the same, and the prescribed rms value is exactly that of the surface, all its waves included.

use super::band::{CUTOFF_TOLERANCE, WaveBand};
use super::spectrum::{Spectrum, WaveSum};
use crate::lattice::{Cell, Grid, LatticeError};
use crate::numeric::fourier::fast_points;
use crate::numeric::parallel;
use ndarray::Array2;
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Largest |κ| along a cell vector: a grid of 32768 points holds these waves.
const MAX_WAVES_ALONG: f64 = 16_383.0;
/// Largest number of waves that are summed.
const MAX_WAVES: f64 = 1.5e8;

/// Rms value that fixes the amplitude of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rms {
    /// Rms slope √⟨|∇h|²⟩, dimensionless.
    Slope(f64),
    /// Rms height √⟨(h − h̄)²⟩, a length.
    Height(f64),
}

/// Parameters of a self-affine surface, independent of the cell. All values are positive and finite, H lies between 0 and 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfAffine {
    /// Hurst exponent H.
    pub hurst: f64,
    /// Longest wavelength λ_l, a length.
    pub longest: f64,
    /// Wavelength λ_r above which the spectrum is constant, a length.
    pub rolloff: f64,
    /// Shortest wavelength λ_s, a length.
    pub shortest: f64,
    /// Rms value that fixes the amplitude.
    pub rms: Rms,
    /// Seed of the phases.
    pub seed: u64,
}

/// Why a surface cannot be generated on a cell.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SelfAffineError {
    /// No wave of the cell is in the band.
    #[error(
        "no wave that the cell holds is between the wavelengths {shortest} and {longest}: its longest one is {cell}; make \
         the cell larger or the band wider"
    )]
    NoWaves {
        /// Shortest wavelength λ_s, a length.
        shortest: f64,
        /// Longest wavelength λ_l, a length.
        longest: f64,
        /// The longest wavelength of the cell, a length.
        cell: f64,
    },
    /// More waves than any grid holds.
    #[error(
        "the cell is {0:.0} times as long as the shortest wavelength: no grid of at most 32768 points along a side holds it"
    )]
    TooFine(f64),
    /// More waves than can be summed.
    #[error(
        "the cell has {0:.0} × {1:.0} waves down to the shortest wavelength, too many: make the band narrower or the cell smaller"
    )]
    TooMany(f64, f64),
    /// A parameter out of its range.
    #[error(
        "{name} = {value}: the Hurst exponent must lie between 0 and 1, the rms value and the wavelengths must be positive and finite"
    )]
    Value {
        /// Name of the parameter.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A grid that cannot be built.
    #[error(transparent)]
    Grid(#[from] LatticeError),
}

impl SelfAffine {
    /// Shape of the power spectrum: C(q) over its value at the roll-off.
    pub fn shape(&self, q: f64) -> f64 {
        let [low, roll, high] = [self.longest, self.rolloff, self.shortest].map(|length| TAU / length);
        match q {
            q if q < low * (1.0 - CUTOFF_TOLERANCE) || q > high * (1.0 + CUTOFF_TOLERANCE) => 0.0,
            q if q <= roll => 1.0,
            q => libm::pow(q / roll, -2.0 * (1.0 + self.hurst)),
        }
    }

    /// Spectrum of the surface on a grid of `points` = [N₁, N₂] of a cell, without the waves that the grid aliases.
    ///
    /// # Errors
    /// [`SelfAffineError`].
    pub fn spectrum(&self, cell: Cell, points: [usize; 2]) -> Result<Spectrum, SelfAffineError> {
        let power = self.power(cell)?;
        let grid = Grid::new(cell, points)?;
        let band = WaveBand::new(cell, (TAU / self.shortest).min(grid.largest_wavenumber()));
        let mut sum = WaveSum::new(points);
        for (wave, q) in band.rows().flat_map(|row| band.waves(row)) {
            let shape = self.shape(q[0].hypot(q[1]));
            if shape > 0.0 && grid.resolves(q) {
                let (sine, cosine) = libm::sincos(TAU * part(self.seed, wave));
                let value = Complex::new(cosine, sine) * (shape * power).sqrt();
                sum.add(wave, value);
                sum.add(wave.map(|k| -k), value.conj());
            }
        }
        Ok(Spectrum::new(grid, sum.components()))
    }

    /// Heights at the samples of a grid, lengths, axis 0 along a₁, axis 1 along a₂; mean 0.
    ///
    /// # Errors
    /// [`SelfAffineError`].
    pub fn heights(&self, cell: Cell, points: [usize; 2]) -> Result<Array2<f64>, SelfAffineError> {
        Ok(self.spectrum(cell, points)?.into_heights())
    }

    /// Number of points along a₁ and a₂ of a grid that holds all waves, with fast transforms.
    ///
    /// # Errors
    /// [`SelfAffineError::TooFine`] when none does.
    pub fn resolving_points(&self, cell: Cell) -> Result<[usize; 2], SelfAffineError> {
        let high = TAU / self.shortest * (1.0 + CUTOFF_TOLERANCE);
        let WaveBand { most, .. } = self.band(cell)?;
        let mut points = most.map(|k| fast_points(2 * k as usize + 2));
        // In a skewed cell the zone of these samples may not contain the circle of waves.
        while Grid::new(cell, points)?.least_aliased() <= high {
            points = points.map(|n| fast_points(n + n / 8 + 1));
        }
        Ok(points)
    }

    /// Checks the ranges of the parameters.
    fn check(&self) -> Result<(), SelfAffineError> {
        let rms = match self.rms {
            Rms::Slope(rms) | Rms::Height(rms) => rms,
        };
        let sizes = [("longest", self.longest), ("rolloff", self.rolloff), ("shortest", self.shortest), ("rms", rms)];
        let is_wrong = |value: f64| !(value > 0.0 && value.is_finite());
        let wrong = sizes.into_iter().find(|(_, value)| is_wrong(*value));
        let hurst = (!(0.0..=1.0).contains(&self.hurst)).then_some(("hurst", self.hurst));
        wrong.or(hurst).map_or(Ok(()), |(name, value)| Err(SelfAffineError::Value { name, value }))
    }

    /// Waves up to the shortest wavelength.
    fn band(&self, cell: Cell) -> Result<WaveBand, SelfAffineError> {
        self.check()?;
        let band = WaveBand::new(cell, TAU / self.shortest * (1.0 + CUTOFF_TOLERANCE));
        let [k1, k2] = band.most.map(f64::from);
        if k1.max(k2) > MAX_WAVES_ALONG {
            return Err(SelfAffineError::TooFine(k1.max(k2)));
        }
        if (2.0 * k1 + 1.0) * (k2 + 1.0) > MAX_WAVES {
            return Err(SelfAffineError::TooMany(2.0 * k1 + 1.0, 2.0 * k2 + 1.0));
        }
        Ok(band)
    }

    /// Power spectral density C as a function of the wavenumber on a cell, length⁴.
    ///
    /// # Errors
    /// [`SelfAffineError`].
    pub fn density(&self, cell: Cell) -> Result<impl Fn(f64) -> f64, SelfAffineError> {
        let (surface, scale) = (*self, self.power(cell)? * cell.area() / (TAU * TAU));
        Ok(move |q| scale * surface.shape(q))
    }

    /// Rms slope √⟨|∇h|²⟩ of the surface on a cell, all waves included, dimensionless.
    ///
    /// # Errors
    /// [`SelfAffineError`].
    pub fn rms_slope(&self, cell: Cell) -> Result<f64, SelfAffineError> {
        let [_, slopes] = self.sums(cell)?;
        Ok((self.power(cell)? * slopes).sqrt())
    }

    /// Squared amplitude |ĥ|² of a wave where the shape of the spectrum is 1, a length squared.
    fn power(&self, cell: Cell) -> Result<f64, SelfAffineError> {
        let [heights, slopes] = self.sums(cell)?;
        Ok(match self.rms {
            Rms::Slope(slope) => slope * slope / slopes,
            Rms::Height(height) => height * height / heights,
        })
    }

    /// Σ S and Σ q²S over all waves, S the shape of the spectrum.
    fn sums(&self, cell: Cell) -> Result<[f64; 2], SelfAffineError> {
        let band = self.band(cell)?;
        let add = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a + c, b + d];
        let row = |row: i32| {
            let terms = band.waves(row).map(|(_, q)| {
                let q = q[0].hypot(q[1]);
                // The wave and its conjugate.
                [2.0 * self.shape(q), 2.0 * q * q * self.shape(q)]
            });
            terms.fold([0.0; 2], add)
        };
        let numbers: Vec<i32> = band.rows().collect();
        let sums = parallel::map_items(&numbers, |&number| row(number)).into_iter().fold([0.0; 2], add);
        if sums[0] > 0.0 {
            return Ok(sums);
        }
        let cell = TAU / Grid::new(cell, [1, 1])?.least_wavenumber();
        Err(SelfAffineError::NoWaves { shortest: self.shortest, longest: self.longest, cell })
    }
}

/// Pseudo-random number in [0, 1) of a seed and a wave: SplitMix64 of each in turn (G. Steele, D. Lea & C. Flood,
/// OOPSLA 2014).
fn part(seed: u64, [k1, k2]: [i32; 2]) -> f64 {
    let mix = |state: u64| {
        let z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let number = |k: i32| u64::from(k.cast_unsigned());
    let bits = mix(mix(mix(seed) ^ number(k1)) ^ number(k2));
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counterbody::roughness::Statistics;

    fn surface(rms: Rms) -> SelfAffine {
        SelfAffine { hurst: 0.8, longest: 1.0, rolloff: 0.25, shortest: 0.0625, rms, seed: 7 }
    }

    #[test]
    fn the_same_seed_is_the_same_surface_on_every_grid_that_holds_it() {
        for cell in [Cell::square(1.0), Cell::hexagonal(1.0), Cell::new([1.0, 0.0], [0.3, 1.7])].map(Result::unwrap) {
            let surface = surface(Rms::Slope(0.1));
            let coarse = surface.resolving_points(cell).unwrap();
            let fine = coarse.map(|n| 3 * n);
            let [one, other] = [coarse, fine].map(|points| surface.heights(cell, points).unwrap());
            let scale = Statistics::of(one.view()).rms_height;
            for ((i, j), height) in one.indexed_iter() {
                assert!((other[[3 * i, 3 * j]] - height).abs() < 1e-12 * scale, "{cell}");
            }
            let finer = Spectrum::of(cell, one.view()).unwrap().resampled(fine).unwrap();
            assert!((&finer - &other).iter().all(|d| d.abs() < 1e-12 * scale), "{cell}");
            let next = SelfAffine { seed: 8, ..surface }.heights(cell, coarse).unwrap();
            let product = (&next * &one).mean().unwrap() / (scale * scale);
            // The mean of some 200 waves' products with random phases.
            assert!(product.abs() < 0.4, "{product}");
        }
    }

    #[test]
    fn the_rms_value_prescribed_is_that_of_the_surface() {
        let cell = Cell::new([1.0, 0.0], [0.3, 1.7]).unwrap();
        let spectrum = surface(Rms::Slope(0.1)).spectrum(cell, [64, 96]).unwrap();
        assert!((spectrum.rms_slope() / 0.1 - 1.0).abs() < 1e-12);
        let heights = surface(Rms::Height(0.02)).heights(cell, [64, 96]).unwrap();
        let found = Statistics::of(heights.view());
        assert!((found.rms_height / 0.02 - 1.0).abs() < 1e-12 && found.mean.abs() < 1e-16);
        // On a grid that cannot hold all waves the others stay as they are.
        let coarse = surface(Rms::Slope(0.1)).spectrum(cell, [16, 24]).unwrap();
        assert!(coarse.rms_slope() < 0.09);
    }

    #[test]
    fn the_density_falls_as_the_hurst_exponent_says_from_the_roll_off_on() {
        let cell = Cell::square(1.0).unwrap();
        let rings = surface(Rms::Slope(0.1)).spectrum(cell, [64, 64]).unwrap().radial();
        let inside = |[long, short]: [f64; 2]| {
            let band = rings.iter().filter(move |ring| (TAU / long..TAU / short).contains(&(ring.wavenumber)));
            band.map(|ring| (ring.wavenumber.ln(), ring.density.ln())).collect::<Vec<_>>()
        };
        let plateau = inside([1.01, 0.26]);
        assert!(plateau.len() > 3 && plateau.iter().all(|(_, c)| (c - plateau[0].1).abs() < 1e-12));
        // Means over a ring of wavenumbers are off the power law by less than a per cent.
        let flank = inside([0.2, 0.07]);
        let slope = (flank[flank.len() - 1].1 - flank[0].1) / (flank[flank.len() - 1].0 - flank[0].0);
        assert!((slope + 3.6).abs() < 0.04, "{slope}");
        assert!(rings.iter().filter(|ring| ring.wavenumber > TAU / 0.06).all(|ring| ring.density == 0.0));
    }

    #[test]
    fn phases_are_those_of_the_published_generator() {
        // The first outputs of SplitMix64 from the state 0 and 1, as published.
        let mix = |state: u64| {
            let z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        };
        assert_eq!(mix(0), 0xe220_a839_7b1d_cdaf);
        let expected = (mix(mix(mix(5) ^ 3) ^ 0xffff_fffe) >> 11) as f64 / 9_007_199_254_740_992.0;
        assert_eq!(part(5, [3, -2]), expected);
    }

    #[test]
    fn a_band_without_waves_and_one_that_no_grid_holds_are_refused() {
        let cell = Cell::square(1.0).unwrap();
        let band = SelfAffine { longest: 4.0, rolloff: 4.0, shortest: 2.0, ..surface(Rms::Slope(0.1)) };
        assert!(matches!(band.heights(cell, [8, 8]), Err(SelfAffineError::NoWaves { cell, .. }) if cell == 1.0));
        let fine = SelfAffine { shortest: 1e-5, ..surface(Rms::Slope(0.1)) };
        assert!(matches!(fine.heights(cell, [8, 8]), Err(SelfAffineError::TooFine(_))));
    }
}
