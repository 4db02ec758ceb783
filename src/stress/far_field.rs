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
use super::far_plane::{FarPlane, polynomials};
use super::series::Response;
use super::tensor::StressState;
#[cfg(any(feature = "cli", test))]
use crate::body::{Amplitudes, Antiplane};
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
/// Nodes of the polynomials along a side as long as the shorter one; by the distance of the images they leave 10⁻⁷ of the difference.
const ACROSS: usize = 10;
/// Nodes more along the longer side for each shorter side that it is longer: the images are as close beside all of it.
const MORE_ACROSS: f64 = 8.0;
/// Largest number of nodes of the polynomials in depth.
const DOWN: usize = 8;
/// Depth over the longer side of the window down to which the field is tabulated.
const DEEPEST: f64 = 4.0;
/// What the polynomials over an interval of depth leave of the difference, by the distance of the images.
const LEFT_IN_DEPTH: f64 = 1e-7;
/// Components: six stresses and three displacements.
const COMPONENTS: usize = 9;

/// Values of the components at the nodes of a plane, or coefficients of their polynomials; along x, then y.
type Nodes = Vec<[f64; COMPONENTS]>;

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
pub(crate) struct FarTables {
    window: Cell,
    half_space: HalfSpace,
    traction: Option<[f64; 2]>,
    /// Numbers of nodes along x and y.
    counts: [usize; 2],
    parts: Vec<Part>,
    /// Ends of the intervals of depth with their materials, and of each node the response of each part.
    segments: Vec<(Interval, Vec<Vec<DepthResponse>>)>,
}

/// An interval of depth in one material, lengths.
#[derive(Debug, Clone, Copy)]
struct Interval {
    material: usize,
    ends: [f64; 2],
    /// Number of nodes.
    nodes: usize,
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
        let sides = sides(window);
        let shorter = sides[0].min(sides[1]);
        let limit = |number: usize| limit(shorter, number);
        let mut parts = Vec::new();
        for number in 0..CELLS {
            let (own, points) = part(sides, number);
            let own = Cell::window(own)?;
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
        let (half_space, counts) = (half_space.clone(), counts(sides));
        let mut own = Self { window, half_space, traction, counts, parts, segments: Vec::new() };
        let tabulated = |interval: Interval| {
            let depths = nodes(interval.nodes).into_iter().map(|x| interval.depth(x));
            (interval, depths.map(|depth| own.responses(depth)).collect())
        };
        own.segments = intervals(&own.half_space, sides).into_iter().map(tabulated).collect();
        Ok(own)
    }

    /// Memory of the tables of a window on a half-space, and of the fields of one load, bytes at most.
    #[cfg(any(feature = "cli", test))]
    pub fn bytes(window: Cell, half_space: &HalfSpace, slides: bool) -> usize {
        let sides = sides(window);
        let depths: usize = intervals(half_space, sides).iter().map(|own| own.nodes).sum();
        // A wave and its mirror image along x have one wavenumber, in a square four waves.
        let together = if sides[0] == sides[1] { 4 } else { 2 };
        let response = size_of::<Amplitudes>() + size_of::<f64>();
        let sliding = if slides { size_of::<Amplitudes>() + size_of::<Antiplane>() } else { 0 };
        let of_part = |number: usize| {
            let (_, [n1, n2]) = part(sides, number);
            // A wave and its conjugate count once; the longest waves have fewer partners.
            let waves = n1 * n2 / 2;
            let shells = waves / together + n1 + n2;
            let interiors = InteriorTable::bytes(half_space, slides, |_| shells);
            waves * (size_of::<Complex64>() + size_of::<u32>()) + shells * depths * (response + sliding) + interiors
        };
        let [n1, n2] = counts(sides);
        (0..CELLS).map(of_part).sum::<usize>() + depths * n1 * n2 * COMPONENTS * size_of::<f64>()
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

/// Sides of a window along x and y, lengths.
fn sides(window: Cell) -> [f64; 2] {
    let [a1, a2] = window.vectors();
    [a1[0], a2[1]]
}

/// q_j of the cell of a number around a window with this `shorter` side, 1/length.
fn limit(shorter: f64, number: usize) -> f64 {
    // From the middle of an image to the far side of the window.
    let remote = 2f64.powi(1 + number as i32) * shorter - shorter;
    2.0 * STEEPNESS * REMOTENESS / remote
}

/// Sides of the cell of a number around a window of these sides, and the points of a grid that holds its waves up to twice the limit.
fn part(sides: [f64; 2], number: usize) -> ([f64; 2], [usize; 2]) {
    let own = sides.map(|side| side * 2f64.powi(1 + number as i32));
    let most = 2.0 * limit(sides[0].min(sides[1]), number.saturating_sub(1));
    (own, own.map(|side| 2 * (most * side / TAU).ceil() as usize + 2))
}

/// Numbers of nodes along the sides of a window.
fn counts(sides: [f64; 2]) -> [usize; 2] {
    let shorter = sides[0].min(sides[1]);
    sides.map(|side| ACROSS + (MORE_ACROSS * (side / shorter - 1.0)).ceil() as usize)
}

/// Intervals of depth in each material, down to a few times the window of these sides.
fn intervals(half_space: &HalfSpace, sides: [f64; 2]) -> Vec<Interval> {
    let (shorter, longer) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
    let mut all = Vec::new();
    for material in 1..=half_space.material_count() {
        let (mut top, bottom) = half_space.faces(material);
        let bottom = bottom.min(DEEPEST * longer);
        while top < bottom {
            // Twice as deep from interval to interval, half the window at least.
            let least = (0.5 * shorter).max(top);
            let next = (top + least).min(bottom);
            // The images are more than twice `least` away from the middle of the interval.
            let ratio = 0.25 * (next - top) / least;
            let nodes = ((LEFT_IN_DEPTH.ln() / ratio.ln()).ceil() as usize).clamp(2, DOWN);
            all.push(Interval { material, ends: [top, next], nodes });
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

/// Chebyshev nodes in [−1, 1].
fn nodes(count: usize) -> Vec<f64> {
    (0..count).map(|k| (PI * (k as f64 + 0.5) / count as f64).cos()).collect()
}

/// The matrix from values at the nodes to the coefficients of T₀, T₁, …: a row each.
fn analysis(count: usize) -> Vec<Vec<f64>> {
    let at: Vec<Vec<f64>> = nodes(count).into_iter().map(|x| polynomials(x).take(count).collect()).collect();
    let factor = |order: usize| if order == 0 { 1.0 } else { 2.0 } / count as f64;
    (0..count).map(|order| at.iter().map(|own| own[order] * factor(order)).collect()).collect()
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
            let values: Vec<Nodes> = responses.iter().map(|own| tables.plane(&coefficients, own)).collect();
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
            let coefficients = self.tables.plane(&self.coefficients, &responses);
            return FarPlane { counts: self.tables.counts, coefficients, corner: self.corner };
        };
        let coefficients = combined(polynomials(interval.place(depth.z)), own);
        FarPlane { counts: self.tables.counts, coefficients, corner: self.corner }
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
        for row in self.waves.rows_within(response.shells()) {
            let mut sums = vec![[Complex64::default(); COMPONENTS]; along.len()];
            let mut phases: Vec<Complex64> =
                along.iter().map(|s| Complex64::cis(TAU * (f64::from(row.first) * s).fract())).collect();
            for k in 0..row.len {
                let number = row.start + k;
                let shell = self.waves.shells()[number] as usize;
                let terms: [Complex64; COMPONENTS] = response.times(row.at(k, step), shell, coefficients[number]);
                for (sums, (phase, step)) in sums.iter_mut().zip(phases.iter_mut().zip(&steps)) {
                    for (sum, term) in sums.iter_mut().zip(terms) {
                        *sum += term * *phase;
                    }
                    *phase *= step;
                }
            }
            for (j, &t) in across.iter().enumerate() {
                let turn = Complex64::cis(TAU * (f64::from(row.across) * t).fract());
                for (i, sums) in sums.iter().enumerate() {
                    let value = &mut values[i * across.len() + j];
                    value.iter_mut().zip(sums).for_each(|(value, sum)| *value += (turn * sum).re);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, Layer, Material};

    /// Bytes of what a table holds, counted.
    fn held(tables: &FarTables) -> usize {
        let responses = tables.segments.iter().flat_map(|(_, nodes)| nodes.iter().flatten());
        let amplitudes: usize = responses.map(|own| own.normal.len()).sum();
        amplitudes * (size_of::<Amplitudes>() + size_of::<f64>())
    }

    /// Square and slender windows, one thick layer and many thin ones.
    #[test]
    fn the_memory_stated_holds_the_tables() {
        let material = |shear| Material::from_shear(shear, 0.3).unwrap();
        let layers = |count: usize, h: f64| vec![Layer::new(material(2.0), h, Interface::Bonded).unwrap(); count];
        for (sides, layers) in [([1.0; 2], layers(1, 0.3)), ([3.0, 1.0], layers(8, 0.01)), ([1.0, 6.0], layers(0, 1.0))]
        {
            let (window, half_space) = (Cell::window(sides).unwrap(), HalfSpace::new(layers, material(1.0)));
            let tables = FarTables::new(window, &half_space, None).unwrap();
            let (held, stated) = (held(&tables), FarTables::bytes(window, &half_space, false));
            assert!(held <= stated && stated < 2 * held + 20_000_000, "{sides:?}: {held}, {stated}");
        }
    }

    #[test]
    fn few_nodes_suffice_in_thin_layers() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        let layer = |h: f64| Layer::new(material, h, Interface::Bonded).unwrap();
        let half_space = HalfSpace::new(vec![layer(1e-4), layer(0.02), layer(0.4)], material);
        let nodes: Vec<usize> = intervals(&half_space, [1.0, 2.0]).iter().map(|own| own.nodes).collect();
        // The last interval is cut off where the table ends.
        assert!(nodes[..4] == [2, 4, 8, 8] && nodes.iter().all(|own| (2..=DOWN).contains(own)), "{nodes:?}");
    }
}
