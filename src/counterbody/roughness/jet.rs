//! A surface and its derivatives at any place, by the sum over its waves.

use super::Spectrum;
use rayon::prelude::*;
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Height, slope and curvature of a surface at one place, by fractions of **a**₁ and **a**₂; the height is that above what all
/// samples have in common ([`Spectrum::common`]). Lengths.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Jet {
    /// h.
    pub height: f64,
    /// ∂h/∂s and ∂h/∂t.
    pub slope: [f64; 2],
    /// ∂²h/∂s², ∂²h/∂s∂t and ∂²h/∂t².
    pub curvature: [f64; 3],
}

impl Jet {
    /// By how much its paraboloid rises along a step in fractions.
    pub fn rise(&self, [s, t]: [f64; 2]) -> f64 {
        let ([gs, gt], [ss, st, tt]) = (self.slope, self.curvature);
        gs * s + gt * t + 0.5 * (ss * s * s + 2.0 * st * s * t + tt * t * t)
    }

    fn plus(self, other: Self) -> Self {
        Self {
            height: self.height + other.height,
            slope: [0, 1].map(|k| self.slope[k] + other.slope[k]),
            curvature: [0, 1, 2].map(|k| self.curvature[k] + other.curvature[k]),
        }
    }
}

/// e^{2πiκs} of one place for all |κ| up to a largest one.
struct Phases(Vec<Complex<f64>>);

impl Phases {
    fn new(s: f64, most: i32) -> Self {
        Self((0..=most).map(|k| Complex::cis(TAU * (f64::from(k) * s).fract())).collect())
    }

    fn at(&self, k: i32) -> Complex<f64> {
        let phase = self.0[k.unsigned_abs() as usize];
        if k < 0 { phase.conj() } else { phase }
    }
}

impl Spectrum {
    /// The surface at places in fractions of **a**₁ and **a**₂.
    pub(super) fn jets(&self, places: &[[f64; 2]]) -> Vec<Jet> {
        let (grid, components) = (self.grid(), self.components());
        let [_, n2] = grid.points();
        // κᵢ = **q**·**a**ᵢ/2π.
        let most = grid.cell().vectors().map(|[x, y]| (grid.largest_wavenumber() * x.hypot(y) / TAU) as i32 + 1);
        let phases: Vec<[Phases; 2]> =
            places.iter().map(|place| [0, 1].map(|axis| Phases::new(place[axis], most[axis]))).collect();
        let of_row = |(k1, row): (usize, &[Complex<f64>])| {
            let mut jets = vec![Jet::default(); places.len()];
            for (k2, value) in row.iter().enumerate().filter(|(_, value)| value.norm_sqr() > 0.0) {
                let aliases = grid.aliases([k1, k2]);
                // Its conjugate is not among the components, but where it is its own or in the same column.
                let both = if k2 == 0 || 2 * k2 == n2 { 1.0 } else { 2.0 };
                let part = value * (both / aliases.len() as f64);
                for [m1, m2] in aliases {
                    let [q1, q2] = [m1, m2].map(|m| TAU * f64::from(m));
                    for (jet, [first, second]) in jets.iter_mut().zip(&phases) {
                        let wave = part * first.at(m1) * second.at(m2);
                        let (h, slope) = (wave.re, -wave.im);
                        jet.height += h;
                        jet.slope = [jet.slope[0] + q1 * slope, jet.slope[1] + q2 * slope];
                        let [ss, st, tt] = jet.curvature;
                        jet.curvature = [ss - q1 * q1 * h, st - q1 * q2 * h, tt - q2 * q2 * h];
                    }
                }
            }
            jets
        };
        // Rows are added in their order, whoever has summed them.
        let values = components.as_slice().expect("made row by row");
        let rows: Vec<Vec<Jet>> = values.par_chunks(n2 / 2 + 1).enumerate().map(of_row).collect();
        let add = |sum: Vec<Jet>, row: Vec<Jet>| sum.into_iter().zip(row).map(|(a, b)| a.plus(b)).collect();
        rows.into_iter().fold(vec![Jet::default(); places.len()], add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;
    use ndarray::Array2;

    /// At the samples the heights; elsewhere slope and curvature are those of differences.
    #[test]
    fn jets_have_the_heights_of_samples_and_the_derivatives_between_them() {
        for (cell, points) in [
            (Cell::square(2.0).unwrap(), [6, 8]),
            (Cell::hexagonal(1.0).unwrap(), [6, 6]),
            (Cell::new([1.0, 0.1], [1.7, 0.9]).unwrap(), [5, 8]),
        ] {
            let heights = Array2::from_shape_fn(points, |(i, j)| ((5 * i + 3 * j * j + i * j) % 7) as f64);
            let spectrum = Spectrum::of(cell, heights.view()).unwrap();
            let at = |s: f64, t: f64| spectrum.jets(&[[s, t]])[0];
            for ((i, j), height) in heights.indexed_iter() {
                let found = at(i as f64 / points[0] as f64, j as f64 / points[1] as f64);
                assert!((spectrum.common() + found.height - height).abs() < 1e-13, "{cell}");
            }
            let (s, t, d) = (0.237, -1.41, 1e-4);
            let jet = at(s, t);
            let [s1, s0, t1, t0] = [at(s + d, t), at(s - d, t), at(s, t + d), at(s, t - d)];
            let near = |a: f64, b: f64| (a - b).abs() < 1e-4 * (1.0 + b.abs());
            assert!(near((s1.height - s0.height) / (2.0 * d), jet.slope[0]), "{cell}");
            assert!(near((t1.height - t0.height) / (2.0 * d), jet.slope[1]), "{cell}");
            let second = [(s1, s0, 0, 0), (t1, t0, 0, 1), (t1, t0, 1, 2)];
            for (up, down, slope, curvature) in second {
                assert!(near((up.slope[slope] - down.slope[slope]) / (2.0 * d), jet.curvature[curvature]), "{cell}");
            }
            assert!((jet.rise([d, d]) - (at(s + d, t + d).height - jet.height)).abs() < 1e-7);
        }
    }
}
