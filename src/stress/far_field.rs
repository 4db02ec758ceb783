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
//! images leaves e^{−β′²} of it. What follows the first term is tabulated once a load step: as a polynomial over the window and,
//! material by material, over depth.

use super::depth_response::DepthResponse;
use super::far_plane::{ACROSS, FarPlane, polynomials};
use super::series::Response;
use super::tensor::StressState;
use crate::body::{Depth, HalfSpace, InteriorTable};
use crate::lattice::waves::Waves;
use crate::lattice::{Cell, Grid, LatticeError};
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// β: ½ erfc β = 2e-7 is left at both ends of a cut.
const STEEPNESS: f64 = 3.6;
/// β′: e^{−β′²} = 1e-6 of a part reaches the images.
const REMOTENESS: f64 = 3.7;
/// Number of cells, each twice as large as the one before: the last one has 2⁻²² of the least wavenumber.
const CELLS: usize = 22;
/// Nodes of the polynomials in depth.
const DOWN: usize = 8;
/// Depth over the longer side of the window down to which the field is tabulated.
const DEEPEST: f64 = 4.0;
/// Components: six stresses and three displacements.
const COMPONENTS: usize = 9;

/// Values of the components at the nodes of a plane, or coefficients of their polynomials; along x, then y.
type Nodes = [[[f64; COMPONENTS]; ACROSS]; ACROSS];

/// The smooth cut.
fn cut(ratio: f64) -> f64 {
    0.5 * libm::erfc(STEEPNESS * (ratio - 1.0))
}

/// The waves of one cell with their weights.
#[derive(Debug)]
struct Part {
    cell: Cell,
    waves: Arc<Waves>,
    /// Weight of each shell.
    weights: Vec<f64>,
    interiors: InteriorTable,
}

/// What does not depend on the pressure: the waves of all cells, and their amplitudes at the nodes in depth.
#[derive(Debug)]
pub(super) struct FarTables {
    window: Cell,
    half_space: HalfSpace,
    traction: Option<[f64; 2]>,
    parts: Vec<Part>,
    /// Ends of the intervals of depth with their materials, and of each node the response of each part.
    segments: Vec<(Interval, Vec<Vec<DepthResponse>>)>,
}

/// An interval of depth in one material, lengths.
#[derive(Debug, Clone, Copy)]
struct Interval {
    material: usize,
    ends: [f64; 2],
}

/// The difference of the free and the periodic field under one pressure.
#[derive(Debug)]
pub(super) struct FarField {
    tables: Arc<FarTables>,
    /// Corner of the cell of the series over half the window.
    corner: [f64; 2],
    /// Transform of the pressure at the waves of each part, in the order of its waves, with weights.
    coefficients: Vec<Vec<Complex64>>,
    /// Of each interval, coefficients of the polynomials by those in depth.
    segments: Vec<(Interval, Vec<Nodes>)>,
}

impl FarTables {
    /// Tables for a window on a half-space, under pressures and the `traction` per unit of them.
    pub fn new(window: Cell, half_space: &HalfSpace, traction: Option<[f64; 2]>) -> Result<Self, LatticeError> {
        let sides = [window.vectors()[0][0], window.vectors()[1][1]];
        let longer = sides[0].max(sides[1]);
        let cell = |number: usize| Cell::window(sides.map(|side| side * 2f64.powi(1 + number as i32)));
        // From the middle of an image to the far side of the window, at the shorter side.
        let shorter = sides[0].min(sides[1]);
        let limit = |number: usize| {
            let remote = 2f64.powi(1 + number as i32) * shorter - shorter;
            2.0 * STEEPNESS * REMOTENESS / remote
        };
        let mut parts = Vec::new();
        for number in 0..CELLS {
            let (own, most) = (cell(number)?, 2.0 * limit(number.saturating_sub(1)));
            let points = [0, 1].map(|axis| 2 * (most * own.vectors()[axis][axis] / TAU).ceil() as usize + 2);
            let waves = Arc::clone(Grid::new(own, points)?.waves());
            let weight = |&q: &f64| match number {
                0 => -cut(q / limit(0)),
                _ if number + 1 == CELLS => cut(q / limit(number - 1)),
                _ => cut(q / limit(number - 1)) - cut(q / limit(number)),
            };
            let weights = waves.wavenumbers().iter().map(weight).collect();
            let interiors =
                InteriorTable::new(Arc::clone(half_space.response()), waves.wavenumbers(), traction.is_some());
            parts.push(Part { cell: own, waves, weights, interiors });
        }
        let mut own = Self { window, half_space: half_space.clone(), traction, parts, segments: Vec::new() };
        let intervals = intervals(half_space, longer);
        own.segments = intervals
            .into_iter()
            .map(|interval| {
                let nodes = nodes::<DOWN>().map(|x| own.responses(interval.depth(x)));
                (interval, nodes.into_iter().collect())
            })
            .collect();
        Ok(own)
    }

    /// Whether they are those of a window on a half-space under this traction.
    pub fn are_of(&self, window: Cell, half_space: &HalfSpace, traction: Option<[f64; 2]>) -> bool {
        self.window == window && self.traction == traction && self.half_space.response() == half_space.response()
    }

    /// The response of each part at a depth.
    fn responses(&self, depth: Depth) -> Vec<DepthResponse> {
        let of = |part: &Part| {
            let wavenumbers = part.waves.wavenumbers();
            DepthResponse::new(&part.interiors, depth, wavenumbers, self.traction, StressState::default())
        };
        self.parts.iter().map(of).collect()
    }
}

/// Intervals of depth in each material, down to a few times the window.
fn intervals(half_space: &HalfSpace, longer: f64) -> Vec<Interval> {
    let mut all = Vec::new();
    for material in 1..=half_space.material_count() {
        let (mut top, bottom) = half_space.faces(material);
        let bottom = bottom.min(DEEPEST * longer);
        while top < bottom {
            // Twice as deep from interval to interval, half the window at least.
            let next = (top + (0.5 * longer).max(top)).min(bottom);
            all.push(Interval { material, ends: [top, next] });
            top = next;
        }
    }
    all
}

impl Interval {
    /// The depth at x in [−1, 1].
    fn depth(&self, x: f64) -> Depth {
        let [top, bottom] = self.ends;
        Depth { z: top + 0.5 * (1.0 + x) * (bottom - top), material: self.material }
    }

    /// x of a depth, in [−1, 1].
    fn place(&self, z: f64) -> f64 {
        let [top, bottom] = self.ends;
        (2.0 * z - top - bottom) / (bottom - top)
    }
}

/// The N Chebyshev nodes in [−1, 1].
fn nodes<const N: usize>() -> [f64; N] {
    std::array::from_fn(|k| (PI * (k as f64 + 0.5) / N as f64).cos())
}

/// The matrix from values at the nodes to the coefficients of T₀ … T_{N−1}.
fn analysis<const N: usize>() -> [[f64; N]; N] {
    let at = nodes::<N>().map(polynomials::<N>);
    std::array::from_fn(|j| std::array::from_fn(|k| at[k][j] * if j == 0 { 1.0 } else { 2.0 } / N as f64))
}

impl FarField {
    /// The difference under a `pressure` on the grid of a window, one value per sample, a₂ fastest.
    ///
    /// `series` is the cell of the periodic field, of twice the window.
    pub fn new(tables: Arc<FarTables>, grid: &Grid, pressure: &[f64], series: Cell) -> Self {
        let corner = [0, 1].map(|axis| 2.0 * series.corner()[axis] / grid.cell().vectors()[axis][axis]);
        let coefficients: Vec<Vec<Complex64>> =
            tables.parts.par_iter().map(|part| part.coefficients(grid, pressure)).collect();
        let segment = |(interval, responses): &(Interval, Vec<Vec<DepthResponse>>)| {
            let values: Vec<Nodes> =
                responses.iter().map(|own| plane_coefficients(&tables.parts, &coefficients, own)).collect();
            (*interval, in_depth(&values))
        };
        let segments = tables.segments.par_iter().map(segment).collect();
        Self { tables, corner, coefficients, segments }
    }

    /// All components at a depth.
    pub fn plane(&self, depth: Depth) -> FarPlane<COMPONENTS> {
        let in_material = || self.segments.iter().filter(|(interval, _)| interval.material == depth.material);
        let above = in_material().find(|(interval, _)| depth.z <= interval.ends[1]);
        // An expansion around the lower face of a layer looks a little beyond it. Intervals end above the face of a layer that is
        // thicker than several windows.
        let face = self.tables.half_space.faces(depth.material).1;
        let at_face = || in_material().next_back().filter(|(interval, _)| interval.ends[1] == face);
        let Some((interval, own)) = above.or_else(at_face) else {
            let responses = self.tables.responses(depth);
            let own = plane_coefficients(&self.tables.parts, &self.coefficients, &responses);
            return FarPlane { coefficients: own.to_vec(), corner: self.corner };
        };
        let weights = polynomials::<DOWN>(interval.place(depth.z));
        let mut coefficients = vec![[[0.0; COMPONENTS]; ACROSS]; ACROSS];
        for (weight, nodes) in weights.into_iter().zip(own) {
            for (sums, own) in coefficients.iter_mut().flatten().zip(nodes.iter().flatten()) {
                sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += weight * own);
            }
        }
        FarPlane { coefficients, corner: self.corner }
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
                        *sum += own;
                        own *= step;
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

    /// Adds the components at the nodes of the window (a quarter to three quarters of the first cell) at the depth of a response.
    fn add(&self, coefficients: &[Complex64], response: &DepthResponse, window: Cell, values: &mut Nodes) {
        let place = |axis: usize, x: f64| {
            let (side, whole) = (window.vectors()[axis][axis], self.cell.vectors()[axis][axis]);
            0.5 * x * side / whole + 0.5
        };
        let [along, across] = [0, 1].map(|axis| nodes::<ACROSS>().map(|x| place(axis, x)));
        let step = self.waves.step();
        for row in self.waves.rows_within(response.shells()) {
            let mut sums = [[Complex64::default(); COMPONENTS]; ACROSS];
            let steps = along.map(|s| Complex64::cis(TAU * s));
            let mut phases = along.map(|s| Complex64::cis(TAU * (f64::from(row.first) * s).fract()));
            for k in 0..row.len {
                let number = row.start + k;
                let shell = self.waves.shells()[number] as usize;
                let terms: [Complex64; COMPONENTS] = response.times(row.at(k, step), shell, coefficients[number]);
                for (sums, (phase, step)) in sums.iter_mut().zip(phases.iter_mut().zip(steps)) {
                    for (sum, term) in sums.iter_mut().zip(terms) {
                        *sum += term * *phase;
                    }
                    *phase *= step;
                }
            }
            for (j, &t) in across.iter().enumerate() {
                let turn = Complex64::cis(TAU * (f64::from(row.across) * t).fract());
                for (values, sums) in values.iter_mut().zip(&sums) {
                    for (value, sum) in values[j].iter_mut().zip(sums) {
                        *value += (turn * sum).re;
                    }
                }
            }
        }
    }
}

/// Coefficients of the polynomials over the window at one depth, by the response of each part there.
fn plane_coefficients(parts: &[Part], coefficients: &[Vec<Complex64>], responses: &[DepthResponse]) -> Nodes {
    let window = parts[0].cell;
    let [width, height] = [0, 1].map(|axis| 0.5 * window.vectors()[axis][axis]);
    // The window of a valid cell is one.
    let window = Cell::window([width, height]).unwrap_or(window);
    let mut values = [[[0.0; COMPONENTS]; ACROSS]; ACROSS];
    for ((part, coefficients), response) in parts.iter().zip(coefficients).zip(responses) {
        part.add(coefficients, response, window, &mut values);
    }
    let matrix = analysis::<ACROSS>();
    let mut half = [[[0.0; COMPONENTS]; ACROSS]; ACROSS];
    let mut whole = half;
    for (i, j, k) in triples() {
        for c in 0..COMPONENTS {
            half[i][j][c] += matrix[i][k] * values[k][j][c];
        }
    }
    for (i, j, k) in triples() {
        for c in 0..COMPONENTS {
            whole[i][j][c] += matrix[j][k] * half[i][k][c];
        }
    }
    whole
}

fn triples() -> impl Iterator<Item = (usize, usize, usize)> {
    (0..ACROSS).flat_map(|i| (0..ACROSS).flat_map(move |j| (0..ACROSS).map(move |k| (i, j, k))))
}

/// Coefficients of the polynomials in depth, from those over the window at the nodes in depth.
fn in_depth(values: &[Nodes]) -> Vec<Nodes> {
    let matrix = analysis::<DOWN>();
    let of = |order: usize| {
        let mut sum = [[[0.0; COMPONENTS]; ACROSS]; ACROSS];
        for (weight, own) in matrix[order].iter().zip(values) {
            for (to, from) in sum.iter_mut().flatten().flatten().zip(own.iter().flatten().flatten()) {
                *to += weight * from;
            }
        }
        sum
    };
    (0..DOWN).map(of).collect()
}
