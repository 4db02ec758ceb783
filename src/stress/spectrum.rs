//! The pressure as a sum of plane waves, ordered by wavenumber.
//!
//! p(**x**) = p̄ + Re Σ c e^{i**q**·**x**}. A Fourier component whose shortest alias is not unique enters once for each
//! of them with an equal part of its coefficient: factors that depend on the direction are averaged over tied aliases,
//! and the symmetry of the lattice is kept. Waves of equal wavenumber form a **shell**; the half-space's amplitudes
//! depend on the shell and the depth alone.

use crate::lattice::Grid;
use crate::spectral::fourier::Fourier;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// One plane wave.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wave {
    /// Wavevector, 1/length.
    pub q: [f64; 2],
    /// Coefficient c; components and their conjugates are one wave.
    pub coefficient: Complex64,
    /// Index into the shells.
    pub shell: u32,
    /// Multiples of the reciprocal vectors that make up `q`.
    pub index: [i32; 2],
}

impl Wave {
    /// c e^{iq·x} at a place, lengths.
    pub fn at(&self, [x, y]: [f64; 2]) -> Complex64 {
        self.coefficient * Complex64::cis(self.q[0] * x + self.q[1] * y)
    }
}

/// Plane waves of a periodic pressure.
#[derive(Debug, Clone)]
pub(super) struct Spectrum {
    /// Mean p̄.
    pub mean: f64,
    /// By ascending wavenumber.
    pub waves: Vec<Wave>,
    /// Wavenumbers of the shells, ascending, 1/length.
    pub shells: Vec<f64>,
    /// First wave of each shell, and the number of waves.
    pub starts: Vec<usize>,
}

/// Wavenumbers closer than this, relatively, are one shell; aliases closer than this are tied.
const TIE: f64 = 1e-11;

impl Spectrum {
    /// Waves of `pressure`, one value per sample of `grid`.
    pub fn new(grid: &Grid, pressure: &[f64]) -> Self {
        let [n1, n2] = grid.points();
        let components = Fourier::new([n1, n2]).analyse(pressure);
        let waves = components.par_chunks(n1).enumerate().flat_map_iter(|(k2, column)| {
            // Of a component and its conjugate only the one with k₂ ≤ N₂/2 is stored; the others are their own
            // conjugates' columns.
            let weight = if k2 == 0 || 2 * k2 == n2 { 1.0 } else { 2.0 };
            column.iter().enumerate().filter(move |(k1, _)| (*k1, k2) != (0, 0)).flat_map(move |(k1, &value)| {
                let aliases = grid.tied_wavevectors([k1, k2], TIE);
                let part = weight / aliases.len() as f64;
                aliases.into_iter().map(move |(index, q)| Wave { q, coefficient: part * value, shell: 0, index })
            })
        });
        let mut waves: Vec<Wave> = waves.collect();
        let length = |wave: &Wave| wave.q[0].hypot(wave.q[1]);
        waves.par_sort_by(|a, b| length(a).total_cmp(&length(b)).then(a.index.cmp(&b.index)));
        let (mut shells, mut starts): (Vec<f64>, Vec<usize>) = (Vec::new(), Vec::new());
        for (number, wave) in waves.iter_mut().enumerate() {
            let q = length(wave);
            if shells.last().is_none_or(|last| q > last * (1.0 + TIE)) {
                shells.push(q);
                starts.push(number);
            }
            wave.shell = shells.len() as u32 - 1;
        }
        starts.push(waves.len());
        Self { mean: components[0].re, waves, shells, starts }
    }

    /// Number of shells with wavenumbers up to `most`.
    pub fn shells_up_to(&self, most: f64) -> usize {
        self.shells.partition_point(|&q| q <= most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    fn noise(len: usize) -> Vec<f64> {
        (0..len).map(|i| ((i * i * 7919 + 13 * i) % 1009) as f64 / 1009.0).collect()
    }

    #[test]
    fn a_hexagonal_lattice_has_few_shells() {
        let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [48, 48]).unwrap();
        let spectrum = Spectrum::new(&grid, &noise(48 * 48));
        assert!(spectrum.shells.len() < 48 * 48 / 8, "{} shells", spectrum.shells.len());
    }
}
