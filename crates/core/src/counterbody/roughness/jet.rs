//! Height and derivatives of a surface at any point, by the sum over its waves.

use super::Spectrum;
use crate::lattice::Grid;
use crate::numeric::lanes::{LANES, splat, vectorised};
use crate::numeric::parallel;
use fearless_simd::{f64x8, prelude::*};
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Height, slope and curvature of a surface at one point, derivatives by the fractions s, t of **a**₁ and **a**₂; the height is
/// measured from that which all samples have in common ([`Spectrum::common`]). Lengths.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Jet {
    /// Height h.
    pub height: f64,
    /// Slopes ∂h/∂s and ∂h/∂t.
    pub slope: [f64; 2],
    /// Curvatures ∂²h/∂s², ∂²h/∂s∂t and ∂²h/∂t².
    pub curvature: [f64; 3],
}

impl Jet {
    /// Rise of the paraboloid along a step in fractions, a length.
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

/// The sum over the waves of a surface. The waves of a row (k₁, ·) of components form runs with the distance **b**₂: Σ v, Σ κ₂v and
/// Σ κ₂²v over a run, with the phases e^{2πiκ₂t}, times e^{2πiκ₁s} give height and derivatives. Eight points are summed together.
pub(super) struct WaveRows<'a> {
    spectrum: &'a Spectrum,
    rows: Vec<Vec<WaveRun>>,
}

/// Waves (κ₁, κ₂), (κ₁, κ₂ + 1), … of components (k₁, k₂), (k₁, k₂ + 1), …
struct WaveRun {
    /// k₂ of the first component.
    column: usize,
    len: usize,
    first: [i32; 2],
    /// Weight of each component, 2 where its conjugate is not among the components, over the number of tied aliases.
    part: f64,
}

/// Weight of a component without tied aliases whose conjugate is not among the components.
const WITH_CONJUGATE: f64 = 2.0;

impl<'a> WaveRows<'a> {
    pub fn of(spectrum: &'a Spectrum) -> Self {
        let [n1, _] = spectrum.grid().points();
        let rows = parallel::map(n1, |k1| runs(spectrum.grid(), k1));
        Self { spectrum, rows }
    }

    /// Jets at points in fractions of **a**₁ and **a**₂.
    pub fn jets(&self, places: &[[f64; 2]]) -> Vec<Jet> {
        let values = self.spectrum.components();
        let values = values.as_slice().expect("made row by row");
        let half = values.len() / self.rows.len();
        let groups: Vec<PointGroup> = places.chunks(LANES).map(|places| PointGroup::new(places, half)).collect();
        let of_row = |number: usize| -> Vec<Jet> {
            let (row, values) = (&self.rows[number], &values[number * half..(number + 1) * half]);
            groups.iter().flat_map(|group| vectorised!(simd => group.jets(simd, row, values))).collect()
        };
        // Rows are added in their order, whatever the threads.
        let rows = parallel::map(self.rows.len(), of_row);
        let add = |sum: Vec<Jet>, row: Vec<Jet>| sum.into_iter().zip(row).map(|(a, b)| a.plus(b)).collect();
        rows.into_iter().fold(vec![Jet::default(); places.len()], add)
    }
}

/// The waves of the components (k₁, ·).
fn runs(grid: &Grid, k1: usize) -> Vec<WaveRun> {
    let [_, n2] = grid.points();
    let [b1, b2] = grid.cell().reciprocal();
    let resolved = |m1: i32, m2: i32| grid.resolves([0, 1].map(|c| f64::from(m1) * b1[c] + f64::from(m2) * b2[c]));
    let mut runs: Vec<WaveRun> = Vec::new();
    let mut k2 = 0;
    while 2 * k2 <= n2 {
        let aliases = grid.aliases([k1, k2]);
        let both = if k2 == 0 || 2 * k2 == n2 { 1.0 } else { WITH_CONJUGATE };
        let part = both / aliases.len() as f64;
        let mut len = 1;
        if part == WITH_CONJUGATE {
            // The zone is convex: the waves leave it once.
            let [m1, m2] = aliases[0];
            let mut beyond = n2.div_ceil(2) - k2;
            while beyond - len > 0 {
                let middle = len + (beyond - len) / 2;
                if resolved(m1, m2 + middle as i32) { len = middle + 1 } else { beyond = middle }
            }
        }
        runs.extend(aliases.into_iter().map(|first| WaveRun { column: k2, len, first, part }));
        k2 += len;
    }
    runs
}

/// Up to eight points that are summed together.
struct PointGroup {
    places: Vec<[f64; 2]>,
    /// Real and imaginary parts of e^{2πik₂t} of each point, by k₂.
    phases: Vec<[[f64; LANES]; 2]>,
}

impl PointGroup {
    fn new(places: &[[f64; 2]], half: usize) -> Self {
        let phases = (0..half).map(|k2| {
            let mut parts = [[0.0; LANES]; 2];
            for (lane, [_, t]) in places.iter().enumerate() {
                let phase = phase(k2 as f64, *t);
                (parts[0][lane], parts[1][lane]) = (phase.re, phase.im);
            }
            parts
        });
        Self { phases: phases.collect(), places: places.to_vec() }
    }

    /// Contribution of the waves of a row at each point.
    #[inline(always)]
    fn jets<S: Simd>(&self, simd: S, row: &[WaveRun], values: &[Complex<f64>]) -> Vec<Jet> {
        let mut jets = vec![Jet::default(); self.places.len()];
        for run in row {
            let moments = self.moments(simd, run.column, &values[run.column..run.column + run.len]);
            // κ₂ − k₂.
            let [m1, d2] = [run.first[0], run.first[1] - run.column as i32].map(f64::from);
            for (lane, (jet, [s, t])) in jets.iter_mut().zip(&self.places).enumerate() {
                let [v, kv, kkv] = [0, 1, 2].map(|k| Complex::new(moments[2 * k][lane], moments[2 * k + 1][lane]));
                let common = run.part * phase(m1, *s) * phase(d2, *t);
                let wave = common * v;
                let along = common * (kv + d2 * v);
                let twice = common * (kkv + 2.0 * d2 * kv + d2 * d2 * v);
                *jet = jet.plus(Jet {
                    height: wave.re,
                    slope: [-TAU * m1 * wave.im, -TAU * along.im],
                    curvature: [m1 * m1 * wave.re, m1 * along.re, twice.re].map(|x| -TAU * TAU * x),
                });
            }
        }
        jets
    }

    /// Σ v, Σ k₂v and Σ k₂²v over components from a column on, real and imaginary parts, with the phases of each point.
    #[inline(always)]
    fn moments<S: Simd>(&self, simd: S, column: usize, values: &[Complex<f64>]) -> [[f64; LANES]; 6] {
        let mut sums = [splat(simd, 0.0); 6];
        for (k2, (value, [cos, sin])) in (column..).zip(values.iter().zip(&self.phases[column..])) {
            let (cos, sin) = (f64x8::from_slice(simd, cos), f64x8::from_slice(simd, sin));
            let (re, im, k) = (splat(simd, value.re), splat(simd, value.im), splat(simd, k2 as f64));
            let v = [cos * re - sin * im, sin.mul_add(re, cos * im)];
            let kv = [v[0] * k, v[1] * k];
            for part in 0..2 {
                sums[part] += v[part];
                sums[2 + part] += kv[part];
                sums[4 + part] = kv[part].mul_add(k, sums[4 + part]);
            }
        }
        sums.map(|sum| {
            let mut lanes = [0.0; LANES];
            sum.store_slice(&mut lanes);
            lanes
        })
    }
}

/// Phase e^{2πiκs}.
fn phase(k: f64, s: f64) -> Complex<f64> {
    Complex::cis(TAU * (k * s).fract())
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
            let waves = WaveRows::of(&spectrum);
            let at = |s: f64, t: f64| waves.jets(&[[s, t]])[0];
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
