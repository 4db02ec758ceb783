//! Places without a measurement, filled as by a membrane that is held at their rim: heights above the mean plane.
//!
//! Σ_axes w (2u_k − u_{k−1} − u_{k+1}) = 0 at every hole, w = 1/d² with the distance d of samples along the axis; beyond the border of the
//! surface there is no neighbour, so that u meets it without a slope. On a rectangular cell u is harmonic. It continues the heights at the
//! rim, but not their slopes. The plane is subtracted before and added after: a hole in a plane is filled with the plane, also at the
//! border. u lies between the heights at the rim of the hole.
//!
//! Conjugate gradients, preconditioned by a cycle through coarser grids (multigrid): Jacobi's iteration takes short waves of the residual
//! away, the sums of the rest over blocks of samples belong to the next grid, and its correction to all samples of a block. A block is a hole
//! where all of its samples are. Blocks are 2 × 2, or 2 along the axis of much smaller distances.

use super::polynomial::{Polynomial, Samples};
use crate::lattice::Cell;
use crate::numeric::parallel;
use crate::numeric::sums::{self, BLOCK};
use ndarray::Array2;

/// Memory for filling, bytes a sample and bytes a hole: numbers of the holes; their neighbours, blocks and vectors on all grids.
pub const MEMORY: [u64; 2] = [6, 120];
/// Largest correction, over the range of the heights, at which the holes are settled.
const SETTLED: f64 = 1e-5;
/// Iterations at most, whatever the file holds: dots, spirals and spacings of 1 : 20 needed 41.
const MOST: usize = 500;
/// Factor of the steps of Jacobi's iteration.
const DAMPING: f64 = 0.8;
/// Quotient of weights from which on blocks are long along one axis.
const UNEQUAL: f64 = 2.0;
/// Number of a sample that is no hole.
const MEASURED: u32 = u32::MAX;
/// Number of a neighbour beyond the border.
const BEYOND: u32 = u32::MAX - 1;

/// Heights with their holes filled, lengths, and the number of these; NaN marks a hole, of which there must be fewer than samples.
pub fn filled(cell: Cell, heights: Array2<f64>) -> (Array2<f64>, usize) {
    let count = heights.iter().filter(|height| height.is_nan()).count();
    if count == 0 || count == heights.len() {
        return (heights, count);
    }
    let mut heights = if heights.is_standard_layout() { heights } else { heights.as_standard_layout().into_owned() };
    let samples = Samples::new(cell, &heights);
    // Samples on one line determine no plane.
    let plane = Polynomial::fit(&samples, 3).unwrap_or(Polynomial([0.0; 6]));
    let points: [usize; 2] = heights.dim().into();
    let spacing = cell.vectors().map(|[x, y]| x.hypot(y));
    let weights = [0, 1].map(|axis| (points[axis] as f64 / spacing[axis]).powi(2));
    let scale = weights[0].max(weights[1]);
    let above = |k: usize| samples.height(k) - plane.at(samples.place(k));
    let found = membrane(points, weights.map(|weight| weight / scale), above);
    let found: Vec<(usize, f64)> =
        found.into_iter().map(|(k, u)| (k, samples.unit * (u + plane.at(samples.place(k))))).collect();
    let values = heights.as_slice_mut().expect("in standard layout");
    found.into_iter().for_each(|(k, height)| values[k] = height);
    (heights, count)
}

/// The holes among n₁ × n₂ samples and their heights, by the heights of all samples, NaN at the holes; `weights` along both axes.
fn membrane([n1, n2]: [usize; 2], weights: [f64; 2], height: impl Fn(usize) -> f64 + Sync + Send) -> Vec<(usize, f64)> {
    let len = n1 * n2;
    let (least, most) = (sums::least(len, &height), -sums::least(len, |k| -height(k)));
    let middle = 0.5 * (least + most);
    let places: Vec<usize> = (0..len).filter(|k| height(*k).is_nan()).collect();
    let mut number = vec![MEASURED; len];
    (0..).zip(&places).for_each(|(hole, k)| number[*k] = hole);
    let holes = Holes::new([n1, n2], weights, number);
    let at_rim = |hole: usize| {
        let k = places[hole];
        let neighbours = [k.wrapping_sub(n2), k + n2, k.wrapping_sub(1), k + 1];
        let rim = (0..4).filter(|side| holes.neighbours[hole][*side] == MEASURED);
        rim.map(|side| weights[side / 2] * (height(neighbours[side]) - middle)).sum()
    };
    let u = holes.solve((0..places.len()).map(at_rim).collect(), SETTLED * (most - least));
    places.into_iter().zip(u.into_iter().map(|u| middle + u)).collect()
}

/// The holes of a grid.
struct Holes {
    /// Numbers of the neighbours before and after along a₁, then along a₂; [`MEASURED`] or [`BEYOND`].
    neighbours: Vec<[u32; 4]>,
    /// Weights along a₁ and a₂.
    weights: [f64; 2],
    /// The next coarser grid, and the number of each hole's block; none where no block is a hole.
    coarser: Option<(Box<Holes>, Vec<u32>)>,
}

impl Holes {
    /// The holes by the number of each sample, counted from 0, or [`MEASURED`].
    fn new([n1, n2]: [usize; 2], weights: [f64; 2], number: Vec<u32>) -> Self {
        let holes = || (0..number.len()).filter(|k| number[*k] != MEASURED);
        let of = |k: usize| {
            let (i, j) = (k / n2, k % n2);
            let sides =
                [(i > 0, k.wrapping_sub(n2)), (i + 1 < n1, k + n2), (j > 0, k.wrapping_sub(1)), (j + 1 < n2, k + 1)];
            sides.map(|(is_inside, at)| if is_inside { number[at] } else { BEYOND })
        };
        let neighbours = holes().map(of).collect();
        let is_long = |axis: usize| {
            let other = 1 - axis;
            [n1, n2][axis] > 1 && ([n1, n2][other] == 1 || UNEQUAL * weights[axis] >= weights[other])
        };
        let [d1, d2] = [0, 1].map(|axis| if is_long(axis) { 2 } else { 1 });
        let [m1, m2] = [n1.div_ceil(d1), n2.div_ceil(d2)];
        let block = |k: usize| k / n2 / d1 * m2 + k % n2 / d2;
        let mut blocks = vec![0; m1 * m2];
        (0..number.len()).filter(|k| number[*k] == MEASURED).for_each(|k| blocks[block(k)] = MEASURED);
        let mut count = 0;
        for index in blocks.iter_mut().filter(|index| **index != MEASURED) {
            *index = count;
            count += 1;
        }
        let coarser = (count > 0).then(|| {
            let of_holes = holes().map(|k| blocks[block(k)]).collect();
            // The sum of d₁d₂ equations with d times the distance.
            let sizes = [d1, d2].map(|d| d as f64);
            let weights = [0, 1].map(|axis| weights[axis] * sizes[0] * sizes[1] / sizes[axis].powi(2));
            (Box::new(Self::new([m1, m2], weights, blocks)), of_holes)
        });
        Self { neighbours, weights, coarser }
    }

    /// Sum of the weights of a hole's neighbours.
    fn diagonal(&self, hole: usize) -> f64 {
        (0..4).map(|side| if self.neighbours[hole][side] == BEYOND { 0.0 } else { self.weights[side / 2] }).sum()
    }

    /// Σ w (u − u of the neighbour) at a hole, u = 0 at the rim.
    fn applied(&self, u: &[f64], hole: usize) -> f64 {
        let difference = |side: usize| match self.neighbours[hole][side] {
            BEYOND => 0.0,
            MEASURED => self.weights[side / 2] * u[hole],
            number => self.weights[side / 2] * (u[hole] - u[number as usize]),
        };
        difference(0) + difference(1) + difference(2) + difference(3)
    }

    /// A value for each hole.
    fn each(&self, value: impl Fn(usize) -> f64 + Sync + Send) -> Vec<f64> {
        parallel::map_by(BLOCK, self.neighbours.len(), value)
    }

    /// Approximate solution of a residual: a cycle to the coarsest grid and back.
    fn cycle(&self, residual: &[f64]) -> Vec<f64> {
        let mut u = self.each(|hole| DAMPING * residual[hole] / self.diagonal(hole));
        if let Some((coarser, blocks)) = &self.coarser {
            let rest = self.each(|hole| residual[hole] - self.applied(&u, hole));
            let mut sums = vec![0.0; coarser.neighbours.len()];
            let within = |(_, block): &(usize, u32)| *block != MEASURED;
            let all = || blocks.iter().copied().enumerate().filter(within);
            all().for_each(|(hole, block)| sums[block as usize] += rest[hole]);
            let correction = coarser.cycle(&sums);
            all().for_each(|(hole, block)| u[hole] += correction[block as usize]);
        }
        self.each(|hole| u[hole] + DAMPING * (residual[hole] - self.applied(&u, hole)) / self.diagonal(hole))
    }

    /// Solves for the right side `residual`, until a cycle corrects no height by more than `enough`.
    fn solve(&self, mut residual: Vec<f64>, enough: f64) -> Vec<f64> {
        let product = |a: &[f64], b: &[f64]| sums::of::<1>(a.len(), |k| [a[k] * b[k]])[0];
        let mut u = vec![0.0; residual.len()];
        let mut correction = self.cycle(&residual);
        let mut direction = correction.clone();
        let mut rz = product(&residual, &correction);
        for _ in 0..MOST {
            if rz <= 0.0 || correction.iter().all(|z| z.abs() <= enough) {
                break;
            }
            let image = self.each(|hole| self.applied(&direction, hole));
            let step = rz / product(&direction, &image);
            sums::update(&mut u, |k, u| u + step * direction[k]);
            sums::update(&mut residual, |k, r| r - step * image[k]);
            correction = self.cycle(&residual);
            let next = product(&residual, &correction);
            sums::update(&mut direction, |k, d| correction[k] + next / rz * d);
            rz = next;
        }
        u
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rectangular holes [i, j, length, width] in a field.
    fn with_holes(field: &Array2<f64>, holes: &[[usize; 4]]) -> Array2<f64> {
        let is_hole =
            |i: usize, j: usize| holes.iter().any(|[a, b, l, w]| (*a..a + l).contains(&i) && (*b..b + w).contains(&j));
        Array2::from_shape_fn(field.dim(), |(i, j)| if is_hole(i, j) { f64::NAN } else { field[[i, j]] })
    }

    fn error(cell: Cell, field: &Array2<f64>, holes: &[[usize; 4]]) -> f64 {
        let (found, count) = filled(cell, with_holes(field, holes));
        assert_eq!(count, holes.iter().map(|[_, _, l, w]| l * w).sum::<usize>());
        found.iter().zip(field).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()))
    }

    /// x² − y² and xy have no second difference either, whatever the size of the hole; a plane is kept at the border too.
    #[test]
    fn harmonic_surfaces_and_planes_are_filled_as_they_were() {
        let cell = Cell::new([36.0, 0.0], [0.0, 60.0]).unwrap();
        let place = |i: usize, j: usize| (0.5 * i as f64, 1.5 * j as f64);
        let surface = |height: &dyn Fn(f64, f64) -> f64| {
            Array2::from_shape_fn((72, 40), |(i, j)| {
                let (x, y) = place(i, j);
                height(x, y)
            })
        };
        let inside = [[3, 4, 1, 1], [10, 5, 40, 30], [60, 20, 7, 2]];
        let saddle = surface(&|x, y| 0.1 * (x * x - y * y) + 0.3 * x * y - 2.0 * x + 5.0);
        // Some 1e-5 of the range, about 800.
        assert!(error(cell, &saddle, &inside) < 2e-2, "{}", error(cell, &saddle, &inside));
        let plane = surface(&|x, y| 1e3 + 0.7 * x - 0.2 * y);
        assert!(error(cell, &plane, &[[0, 0, 5, 9], [70, 10, 2, 30], [20, 20, 3, 3]]) < 1e-10);
    }

    /// Between the lowest and the highest height at its rim, also where the cascade begins with one sample.
    #[test]
    fn a_hole_lies_between_the_heights_at_its_rim() {
        let rough = Array2::from_shape_fn((33, 65), |(i, j)| ((3 * i + 7 * j * j) % 11) as f64);
        let holes = with_holes(&rough, &[[1, 1, 31, 62]]);
        let found = membrane([33, 65], [1.0, 0.3], |k| holes[[k / 65, k % 65]]);
        assert!(found.len() == 31 * 62 && found.iter().all(|(_, height)| (-1e-4..=10.0 + 1e-4).contains(height)));
        let mut alone = Array2::from_elem((8, 8), f64::NAN);
        alone[[5, 2]] = 3.0;
        let (found, count) = filled(Cell::square(1.0).unwrap(), alone);
        assert!(count == 63 && found.iter().all(|height| (height - 3.0).abs() < 1e-9), "{found}");
    }

    /// Holes of every extent, to half of the surface, are settled: the residual is small against the heights and falls with the distance
    /// over which it acts. Also of unequal distances, and where single samples stand in a hole.
    #[test]
    fn large_holes_settle() {
        let hash = |i: usize, j: usize| ((i * 7919 + j * 104_729) % 1009) as f64 / 1009.0;
        let half = |i: usize, _: usize| i < 144;
        let dots = |i: usize, j: usize| (i < 240) && !(i.is_multiple_of(40) && j.is_multiple_of(40));
        let random = |i: usize, j: usize| hash(j + 5, i) < 0.4;
        for (name, is_hole, weights) in [
            ("half", &half as &dyn Fn(usize, usize) -> bool, [1.0, 1.0]),
            ("long distances", &half, [1.0, 0.01]),
            ("dots", &dots, [1.0, 0.6]),
            ("random", &random, [0.3, 1.0]),
        ] {
            let n = 300;
            let mut field =
                Array2::from_shape_fn(
                    (n, n),
                    |(i, j)| if is_hole(i, j) { f64::NAN } else { hash(i, j) + 0.01 * j as f64 },
                );
            let found = membrane([n, n], weights, |k| field[[k / n, k % n]]);
            found.iter().for_each(|(k, height)| field[[k / n, k % n]] = *height);
            for (k, height) in &found {
                let (i, j) = (k / n, k % n);
                let along = [i.checked_sub(1), (i + 1 < n).then_some(i + 1)].map(|i| i.map(|i| (weights[0], [i, j])));
                let across = [j.checked_sub(1), (j + 1 < n).then_some(j + 1)].map(|j| j.map(|j| (weights[1], [i, j])));
                let all = along.into_iter().chain(across).flatten();
                let residual: f64 = all.map(|(weight, at)| weight * (height - field[at])).sum();
                assert!(residual.abs() < 1e-4, "{name} {i} {j}: {residual}");
            }
        }
    }
}
