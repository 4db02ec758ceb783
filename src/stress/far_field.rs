//! Stresses of an isolated contact: what a periodic field lacks of a free one.
//!
//! The waves of the pressure on a cell of twice the window are those of a lattice of contacts. Its images are far away: near
//! the contact they change the field smoothly. With S(**q**) the response to a wave and P(**q**) the transform of the pressure the free field is an
//! integral over all **q**, the periodic one its sum over the lattice of the cell. Their difference lies at small q, where
//! S depends on the direction of **q** and a sum with equal steps fails. So the small wavenumbers are cut off smoothly by
//! φ(q) = ½ erfc(β(q/q₀ − 1)) and summed on the lattice of a cell twice as large, of these again the smallest ones on one twice as large, and
//! so on,
//!
//! Σ₀ S P − Σ₀ φ₀ S P + Σ₁ (φ₀ − φ₁) S P + Σ₂ (φ₁ − φ₂) S P + …
//!
//! Each part has a smooth transform, so that its kernel does not reach the next image: q_j = 2ββ′/r_j with the distance r_j of the
//! images leaves e^{−β′²} of it. What follows the first term is tabulated, interval by interval of depth where it is read: as a polynomial over the
//! window and over depth.

use super::depth_response::DepthResponse;
use super::far_plane::FarPlane;
use super::far_tables::{COMPONENTS, FarTables, Interval, Part};
use super::series::Response;
use crate::body::Depth;
use crate::lattice::{Cell, Grid};
use crate::numeric::chebyshev::{analysis, inside, nodes, polynomials};
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

/// Values of the components at the nodes of a plane, or coefficients of their polynomials; along x, then y.
type Nodes = Vec<[f64; COMPONENTS]>;

/// The difference of the free and the periodic field under one pressure.
#[derive(Debug)]
pub(super) struct FarField {
    tables: Arc<FarTables>,
    /// Corner of the cell of the series over half the window.
    corner: [f64; 2],
    /// Transform of the pressure at the waves of each part, in the order of its waves, with weights.
    coefficients: Vec<Vec<Complex64>>,
    /// Of each interval that has been read, coefficients of the polynomials by those in depth.
    segments: Vec<(Interval, OnceLock<Vec<Nodes>>)>,
}

impl FarField {
    /// The difference under a `pressure` on the grid of a window, one value per sample, a₂ fastest.
    ///
    /// `series` is the cell of the periodic field, of twice the window.
    pub fn new(tables: Arc<FarTables>, grid: &Grid, pressure: &[f64], series: Cell) -> Self {
        let corner = [0, 1].map(|axis| 2.0 * series.corner()[axis] / grid.cell().vectors()[axis][axis]);
        let coefficients: Vec<Vec<Complex64>> =
            tables.parts.par_iter().map(|part| part.coefficients(grid, pressure)).collect();
        let segments = tables.segments.iter().map(|(interval, _)| (*interval, OnceLock::new())).collect();
        Self { tables, corner, coefficients, segments }
    }

    /// All components at a depth.
    pub fn plane(&self, depth: Depth) -> FarPlane<COMPONENTS> {
        let coefficients = match self.segment(depth) {
            Some(number) => {
                combined(polynomials(inside(self.segments[number].0.ends, depth.z)), self.in_segment(number))
            }
            None => self.tables.plane(&self.coefficients, &self.tables.responses(depth)),
        };
        FarPlane { counts: self.tables.counts, coefficients, corner: self.corner }
    }

    /// Reads the intervals of some depths, all threads at once.
    pub fn read_ahead(&self, depths: impl Iterator<Item = Depth>) {
        let mut numbers: Vec<usize> = depths.filter_map(|depth| self.segment(depth)).collect();
        numbers.dedup();
        numbers.into_par_iter().for_each(|number| {
            self.in_segment(number);
        });
    }

    /// Number of the interval in which a depth is; `None` below all.
    fn segment(&self, depth: Depth) -> Option<usize> {
        let in_material =
            || self.segments.iter().enumerate().filter(|(_, (interval, _))| interval.material == depth.material);
        let above = in_material().find(|(_, (interval, _))| depth.z <= interval.ends[1]);
        // An expansion around the lower face of a layer looks a little beyond it. Intervals end above the face of a layer that is
        // thicker than several windows.
        let face = self.tables.half_space.faces(depth.material).1;
        let at_face = || in_material().next_back().filter(|(_, (interval, _))| interval.ends[1] == face);
        above.or_else(at_face).map(|(number, _)| number)
    }

    /// Coefficients of the polynomials of an interval, by those in depth. By one thread: others may wait for it.
    fn in_segment(&self, number: usize) -> &[Nodes] {
        self.segments[number].1.get_or_init(|| {
            let responses = self.tables.segments[number].1.iter();
            let values: Vec<Nodes> = responses.map(|own| self.tables.plane(&self.coefficients, own)).collect();
            in_depth(&values)
        })
    }
}

impl Part {
    /// Coefficients c of the waves of a pressure, with their weights: p = Re Σ c e^{2πi(κ₁s + κ₂t)} by the fractions s, t of the cell.
    fn coefficients(&self, grid: &Grid, pressure: &[f64]) -> Vec<Complex64> {
        let [n1, n2] = grid.points();
        let fractions = |axis: usize, n: usize| -> Vec<f64> {
            let (corner, step) = (grid.cell().corner()[axis], grid.steps()[axis][axis]);
            let side = self.cell.vectors()[axis][axis];
            (0..n).map(|i| (corner + i as f64 * step) / side + 0.5).collect()
        };
        let (along, across) = (fractions(0, n1), fractions(1, n2));
        let rows = self.waves.rows_within(self.waves.wavenumbers().len());
        let most = rows.iter().map(|row| row.across).max().unwrap_or(0);
        let first = rows.iter().map(|row| row.first).min().unwrap_or(0);
        let last = rows.iter().map(|row| row.first + row.len as i32).max().unwrap_or(0);
        let phase = |k: i32, s: f64| Complex64::cis(-TAU * (f64::from(k) * s).fract());
        // Along y first: of each row of samples the sums for all κ₂.
        let by_rows: Vec<(usize, Vec<Complex64>)> = (0..n1)
            .filter(|i| pressure[i * n2..][..n2].iter().any(|&p| p > 0.0))
            .map(|i| {
                let mut sums = vec![Complex64::default(); most as usize + 1];
                for (&p, &t) in pressure[i * n2..][..n2].iter().zip(&across).filter(|(p, _)| **p > 0.0) {
                    let (step, mut own) = (phase(1, t), Complex64::from(p));
                    for sum in &mut sums {
                        (sum.re, sum.im) = (sum.re + own.re, sum.im + own.im);
                        own = Complex64::new(own.re * step.re - own.im * step.im, own.re * step.im + own.im * step.re);
                    }
                }
                (i, sums)
            })
            .collect();
        let phases: Vec<Vec<Complex64>> =
            by_rows.iter().map(|&(i, _)| (first..last).map(|k| phase(k, along[i])).collect()).collect();
        // A wave and its conjugate share one coefficient.
        let scale = 2.0 * grid.sample_area() / self.cell.area();
        let component = |[k1, k2]: [i32; 2]| {
            let terms = by_rows.iter().zip(&phases);
            scale
                * terms.map(|((_, sums), phases)| sums[k2 as usize] * phases[(k1 - first) as usize]).sum::<Complex64>()
        };
        let mut all = self.waves.coefficients(component);
        for (c, &shell) in all.iter_mut().zip(self.waves.shells()) {
            *c *= self.weights[shell as usize];
        }
        all
    }

    /// Adds the components at nodes of the window, by the fractions of those along x and along y, at the depth of a response.
    fn add(
        &self,
        coefficients: &[Complex64],
        response: &DepthResponse,
        [along, across]: &[Vec<f64>; 2],
        values: &mut Nodes,
    ) {
        let step = self.waves.step();
        let steps: Vec<Complex64> = along.iter().map(|s| Complex64::cis(TAU * s)).collect();
        // Real and imaginary parts apart, in lanes.
        let mut sums = vec![[[0.0; COMPONENTS]; 2]; along.len()];
        let mut phases = vec![Complex64::default(); along.len()];
        for row in self.waves.rows_within(response.shells()) {
            sums.fill([[0.0; COMPONENTS]; 2]);
            for (phase, s) in phases.iter_mut().zip(along) {
                *phase = Complex64::cis(TAU * (f64::from(row.first) * s).fract());
            }
            for k in 0..row.len {
                let number = row.start + k;
                let shell = self.waves.shells()[number] as usize;
                let terms: [Complex64; COMPONENTS] = response.times(row.at(k, step), shell, coefficients[number]);
                let (re, im) = (terms.map(|term| term.re), terms.map(|term| term.im));
                for ([sum_re, sum_im], (phase, step)) in sums.iter_mut().zip(phases.iter_mut().zip(&steps)) {
                    let Complex64 { re: c, im: s } = *phase;
                    for k in 0..COMPONENTS {
                        sum_re[k] += re[k] * c - im[k] * s;
                        sum_im[k] += re[k] * s + im[k] * c;
                    }
                    *phase = Complex64::new(c * step.re - s * step.im, c * step.im + s * step.re);
                }
            }
            for (j, &t) in across.iter().enumerate() {
                let Complex64 { re: c, im: s } = Complex64::cis(TAU * (f64::from(row.across) * t).fract());
                for (i, [re, im]) in sums.iter().enumerate() {
                    let value = &mut values[i * across.len() + j];
                    for k in 0..COMPONENTS {
                        value[k] += c * re[k] - s * im[k];
                    }
                }
            }
        }
    }
}

impl FarTables {
    /// Coefficients of the polynomials over the window at one depth, by the response of each part there.
    fn plane(&self, coefficients: &[Vec<Complex64>], responses: &[DepthResponse]) -> Nodes {
        let [n1, n2] = self.counts;
        let mut values: Nodes = vec![[0.0; COMPONENTS]; n1 * n2];
        let places = self.counts.map(nodes);
        for ((part, coefficients), response) in self.parts.iter().zip(coefficients).zip(responses) {
            let fractions = [0, 1].map(|axis| {
                let part_of_cell = self.window.vectors()[axis][axis] / part.cell.vectors()[axis][axis];
                places[axis].iter().map(|x| 0.5 * x * part_of_cell + 0.5).collect()
            });
            part.add(coefficients, response, &fractions, &mut values);
        }
        // Along y, row by row, then along x.
        let matrix = analysis(n2);
        let rows = values.chunks_exact(n2).map(|row| {
            let of = |weights: &Vec<f64>| {
                let mut sum = [0.0; COMPONENTS];
                for (weight, own) in weights.iter().zip(row) {
                    sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += weight * own);
                }
                sum
            };
            matrix.iter().map(of).collect()
        });
        let rows: Vec<Nodes> = rows.collect();
        analysis(n1).into_iter().flat_map(|weights| combined(weights.into_iter(), &rows)).collect()
    }
}

/// The sum of all components of several `parts`, with weights.
fn combined(weights: impl Iterator<Item = f64>, parts: &[Nodes]) -> Nodes {
    let mut sums = vec![[0.0; COMPONENTS]; parts.first().map_or(0, Vec::len)];
    for (weight, own) in weights.zip(parts) {
        for (sum, own) in sums.iter_mut().flatten().zip(own.iter().flatten()) {
            *sum += weight * own;
        }
    }
    sums
}

/// Coefficients of the polynomials in depth, from those over the window at the nodes in depth.
fn in_depth(values: &[Nodes]) -> Vec<Nodes> {
    analysis(values.len()).into_iter().map(|weights| combined(weights.into_iter(), values)).collect()
}
