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
use super::far_plane::{FarPlane, weighted};
use super::far_tables::{COMPONENTS, FarTables, Interval, Part};
use super::series::Response;
use super::traction::Traction;
use super::traction_waves::{TractionWave, TractionWaves, Wave};
use super::window_waves::window_waves;
use crate::body::Depth;
use crate::lattice::Cell;
use crate::lattice::waves::WaveRow;
use crate::numeric::chebyshev::{analysis, inside, polynomials};
use crate::numeric::lanes::vectorised;
use crate::numeric::parallel;
use rustfft::num_complex::Complex64;
use std::sync::{Arc, OnceLock};

/// Values of the components at the nodes of a plane, or coefficients of their polynomials; along x, then y.
type Nodes = Vec<[f64; COMPONENTS]>;

/// The difference of the free and the periodic field under one traction.
#[derive(Debug)]
pub(super) struct FarField {
    tables: Arc<FarTables>,
    /// Corner of the cell of the series over half the window.
    corner: [f64; 2],
    /// Transform of the traction at the waves of each part, with weights.
    coefficients: Vec<TractionWaves>,
    /// Coefficients of the polynomials of each interval, by those in depth; set once the interval is read.
    segments: Vec<(Interval, OnceLock<Vec<Nodes>>)>,
}

impl FarField {
    /// The difference in the window of the tables under a traction on a grid in it. `series` is the cell of the periodic field, of twice
    /// the window.
    pub fn new(tables: Arc<FarTables>, traction: &Traction<'_>, series: Cell) -> Self {
        let corner = [0, 1].map(|axis| 2.0 * series.corner()[axis] / tables.window.vectors()[axis][axis]);
        let coefficients = parallel::map_items(&tables.parts, |part| part.coefficients(traction));
        let segments = tables.segments.iter().map(|(interval, _)| (*interval, OnceLock::new())).collect();
        Self { tables, corner, coefficients, segments }
    }

    /// All components at a depth.
    pub fn plane(&self, depth: Depth) -> FarPlane<COMPONENTS> {
        let coefficients = match self.segment(depth) {
            Some(number) => {
                combined(polynomials(inside(self.segments[number].0.ends, depth.z)), self.in_segment(number))
            }
            None => self.below(depth),
        };
        FarPlane { counts: self.tables.counts, coefficients, corner: self.corner }
    }

    /// Reads the intervals of some depths, all threads at once.
    pub fn read_ahead(&self, depths: impl Iterator<Item = Depth>) {
        let mut numbers: Vec<usize> = depths.filter_map(|depth| self.segment(depth)).collect();
        numbers.dedup();
        parallel::each(numbers.len(), |i| {
            self.in_segment(numbers[i]);
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
        let tables = &self.tables;
        let responses = tables.responses(number);
        let (interval, known) = &self.segments[number];
        known.get_or_init(|| {
            let mut sums = vec![tables.none(); interval.nodes];
            for ((part, coefficients), responses) in tables.parts.iter().zip(&self.coefficients).zip(responses) {
                let planes: Vec<Nodes> = responses.iter().map(|response| part.plane(coefficients, response)).collect();
                sums.iter_mut().zip(in_depth(&planes)).for_each(|(sums, nodes)| tables.add(part, &nodes, sums));
            }
            sums
        })
    }

    /// Coefficients of the polynomials at a depth that no interval holds.
    fn below(&self, depth: Depth) -> Nodes {
        let tables = &self.tables;
        let mut sums = tables.none();
        for (part, coefficients) in tables.parts.iter().zip(&self.coefficients) {
            tables.add(part, &part.plane(coefficients, &tables.response(part, depth)), &mut sums);
        }
        sums
    }
}

impl Part {
    /// Coefficients of the waves of a traction with their weights.
    fn coefficients(&self, traction: &Traction<'_>) -> TractionWaves {
        let shells = self.waves.shells();
        window_waves(&self.waves, self.cell, traction).scaled(|number| self.weights[shells[number] as usize])
    }

    /// Coefficients of the polynomials over the window at the depth of a response, as many as the waves of the part need.
    fn plane(&self, coefficients: &TractionWaves, response: &DepthResponse) -> Nodes {
        let values = self.values(coefficients, response);
        let [n1, n2] = self.counts;
        // Along y, row by row, then along x.
        let matrix = analysis(n2);
        let rows = values
            .chunks_exact(n2)
            .map(|row| matrix.iter().map(|weights| weighted(weights.iter().copied(), row)).collect());
        let rows: Vec<Nodes> = rows.collect();
        analysis(n1).into_iter().flat_map(|weights| combined(weights.into_iter(), &rows)).collect()
    }

    /// The components at the nodes of the window, at the depth of a response.
    fn values(&self, coefficients: &TractionWaves, response: &DepthResponse) -> Nodes {
        let mut values: Nodes = vec![[0.0; COMPONENTS]; self.counts[0] * self.counts[1]];
        let mut terms = Vec::new();
        for row in self.waves.rows_within(response.shells()) {
            match coefficients.shear {
                None => {
                    vectorised!(_simd => self.add_row::<Complex64>(&row, coefficients, response, &mut terms, &mut values))
                }
                Some(_) => self.add_row::<TractionWave>(&row, coefficients, response, &mut terms, &mut values),
            }
        }
        values
    }

    /// Adds the waves of a row at the nodes; `terms` is a buffer of their components, real parts before imaginary ones.
    #[inline(always)]
    fn add_row<W: Wave>(
        &self,
        row: &WaveRow,
        coefficients: &TractionWaves,
        response: &DepthResponse,
        terms: &mut Vec<[f64; 2 * COMPONENTS]>,
        values: &mut Nodes,
    ) {
        let [n1, n2] = self.counts;
        let [along, across] = &self.phases;
        let step = self.waves.step();
        terms.clear();
        for k in 0..row.len {
            let number = row.start + k;
            let components: [Complex64; COMPONENTS] =
                response.times(row.at(k, step), self.waves.shells()[number] as usize, coefficients.at::<W>(number));
            terms.push(std::array::from_fn(|c| {
                if c < COMPONENTS { components[c].re } else { components[c - COMPONENTS].im }
            }));
        }
        // Nodes are mirror images at the middle, where their phases are conjugate: sums by cosines and sines serve both.
        for i in 0..n1.div_ceil(2) {
            let [by_cosines, by_sines] = along.from(i, row.first).map(|phases| weighted(phases.iter().copied(), terms));
            for j in 0..n2 {
                let [c, s] = across.from(j, row.across).map(|phases| phases[0]);
                let value = &mut values[i * n2 + j];
                for k in 0..COMPONENTS {
                    let (re, im) = (by_cosines[k] - by_sines[k + COMPONENTS], by_cosines[k + COMPONENTS] + by_sines[k]);
                    value[k] += c * re - s * im;
                }
                let mirrored = n1 - 1 - i;
                if mirrored == i {
                    continue;
                }
                let value = &mut values[mirrored * n2 + j];
                for k in 0..COMPONENTS {
                    let (re, im) = (by_cosines[k] + by_sines[k + COMPONENTS], by_cosines[k + COMPONENTS] - by_sines[k]);
                    value[k] += c * re - s * im;
                }
            }
        }
    }
}

impl FarTables {
    /// Coefficients that are all zero.
    fn none(&self) -> Nodes {
        vec![[0.0; COMPONENTS]; self.counts[0] * self.counts[1]]
    }

    /// Adds coefficients of a part to those of all: of the polynomials of lower degree that it has.
    fn add(&self, part: &Part, coefficients: &Nodes, sums: &mut Nodes) {
        for (sums, row) in sums.chunks_exact_mut(self.counts[1]).zip(coefficients.chunks_exact(part.counts[1])) {
            for (sum, coefficient) in sums.iter_mut().flatten().zip(row.iter().flatten()) {
                *sum += coefficient;
            }
        }
    }
}

/// The sum of all components of several `parts`, with weights.
fn combined(weights: impl Iterator<Item = f64>, parts: &[Nodes]) -> Nodes {
    let mut sums = vec![[0.0; COMPONENTS]; parts.first().map_or(0, Vec::len)];
    for (weight, part) in weights.zip(parts) {
        for (sum, value) in sums.iter_mut().flatten().zip(part.iter().flatten()) {
            *sum += weight * value;
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
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::lattice::Grid;
    use crate::stress::traction::ShearForm;
    use ndarray::Array2;

    /// Sums of all waves of each cell one by one, between the nodes and at the corners, under a pressure and a
    /// traction. The first five cells are left out: alone they are not smooth enough over the window for their nodes,
    /// only together.
    #[test]
    fn few_nodes_give_what_the_waves_of_a_wide_cell_add_up_to() {
        let layer = Layer::new(Material::from_shear(5.0, 0.2).unwrap(), 0.05, Interface::Bonded).unwrap();
        let half_space = HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.3).unwrap());
        let window = Cell::window([1.0, 2.0]).unwrap();
        let grid = Arc::new(Grid::new(window, [8, 16]).unwrap());
        let field = |k: usize| Array2::from_shape_fn([8, 16], |(i, j)| ((16 * i + j) * (16 * i + j + k) % 7) as f64);
        let [pressure, x, y] = [0, 1, 2].map(field);
        let traction = Traction::normal(&grid, pressure.view()).unwrap().with_fields([x.view(), y.view()]).unwrap();
        let tables = FarTables::new(window, &half_space, ShearForm::Fields).unwrap();
        let mut counts = Vec::new();
        for (number, part) in tables.parts.iter().enumerate().skip(5) {
            let coefficients = part.coefficients(&traction);
            let response = tables.response(part, Depth { z: 0.3, material: 2 });
            let mut sums = tables.none();
            tables.add(part, &part.plane(&coefficients, &response), &mut sums);
            let plane = FarPlane { counts: tables.counts, coefficients: sums, corner: [-2.0; 2] };
            for [x, y] in [[0.0, 0.0], [0.37, -0.61], [1.0, 1.0], [-1.0, 0.93]] {
                let found = plane.at([x, y].map(|place| 0.25 * (place + 2.0)));
                let (mut exact, mut size) = ([0.0; COMPONENTS], [0.0; COMPONENTS]);
                for row in part.waves.rows_within(response.shells()) {
                    for k in 0..row.len {
                        let (q, wave) = (row.at(k, part.waves.step()), row.start + k);
                        let shell = part.waves.shells()[wave] as usize;
                        let terms: [Complex64; COMPONENTS] =
                            response.times(q, shell, coefficients.at::<TractionWave>(wave));
                        let phase =
                            Complex64::cis(q[0] * 0.5 * x + q[1] * y) * middle(row.first + k as i32, row.across);
                        for c in 0..COMPONENTS {
                            exact[c] += (terms[c] * phase).re;
                            size[c] += terms[c].norm();
                        }
                    }
                }
                let largest = size.iter().copied().fold(0.0, f64::max);
                let worst = (0..COMPONENTS).map(|c| (found[c] - exact[c]).abs()).fold(0.0, f64::max);
                assert!(worst <= 2e-9 * largest, "cell {number}, {x}, {y}: {worst:e} of {largest:e}");
            }
            counts.push(part.counts);
        }
        assert!(counts[0][0] == tables.counts[0] && counts[0][1] < tables.counts[1], "{counts:?}");
        assert!(counts.last().unwrap().iter().all(|&count| count <= 3), "{counts:?}");
    }

    /// Between the nodes in depth, in a thin coating and below it, what the polynomials have is what the amplitudes there give.
    #[test]
    fn few_nodes_in_depth_give_what_the_depth_itself_gives() {
        for (stack, side) in [(vec![0.05], 1.0), (vec![1.3], 1.0), (vec![0.02, 0.3, 0.1], 1.0), (vec![0.05], 6.0)] {
            let layer = |(k, h): (usize, f64)| {
                let material = Material::from_shear([5.0, 0.3, 20.0][k], 0.2).unwrap();
                Layer::new(material, h, Interface::Bonded).unwrap()
            };
            let layers = stack.into_iter().enumerate().map(layer).collect();
            agrees_in_depth(&HalfSpace::new(layers, Material::from_shear(1.0, 0.3).unwrap()), side);
        }
    }

    /// Asserts that both agree at depths under a window of the sides 1 and `side`.
    fn agrees_in_depth(half_space: &HalfSpace, side: f64) {
        let window = Cell::window([1.0, side]).unwrap();
        let grid = Arc::new(Grid::new(window, [8, 8]).unwrap());
        let pressure = Array2::from_shape_fn([8, 8], |(i, j)| ((8 * i + j) * (8 * i + j) % 7) as f64);
        let traction = Traction::normal(&grid, pressure.view()).unwrap();
        let form = ShearForm::Coulomb { ratio: [0.3, 0.1], edge_exponent: 0.0 };
        let tables = Arc::new(FarTables::new(window, half_space, form).unwrap());
        let field = FarField::new(tables, &traction, Cell::window([2.0, 2.0 * side]).unwrap());
        let depths = [0.0, 0.013, 0.05, 0.21, 0.55, 0.9, 3.1].map(|z| half_space.depths(z));
        for depth in depths.into_iter().flatten() {
            let exact = FarPlane { coefficients: field.below(depth), ..field.plane(depth) };
            let plane = field.plane(depth);
            for place in [[0.5, 0.5], [0.3, 0.61], [0.26, 0.74]] {
                let (found, exact) = (plane.at(place), exact.at(place));
                for kind in [0..6, 6..COMPONENTS] {
                    let largest = exact[kind.clone()].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                    let worst = kind.map(|c| (found[c] - exact[c]).abs()).fold(0.0, f64::max);
                    // An interval as long as it is deep: its images leave 0.25^N of the difference at N nodes, 8 at most.
                    assert!(worst <= 0.25f64.powi(8) * largest, "{depth:?}, {place:?}: {worst:e} of {largest:e}");
                }
            }
        }
    }

    /// e^{2πi(κ₁ + κ₂)/2}: fractions of a cell are counted from its corner, places from its middle.
    fn middle(k1: i32, k2: i32) -> f64 {
        if (k1 + k2).rem_euclid(2) == 0 { 1.0 } else { -1.0 }
    }
}
