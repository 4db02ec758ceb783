//! Places without a measurement, filled by the smoothest continuation: heights above the mean plane are harmonic there.
//!
//! Σ_axes (2u_k − u_{k−1} − u_{k+1})/d² = 0 at every hole, d the distance of samples along the axis; beyond the border of the surface there
//! is no neighbour, so that u meets it without a slope. The plane is subtracted before and added after: a hole in a plane is filled
//! with the plane, also at the border. A harmonic function lies between its values at the rim of the hole.
//!
//! Conjugate gradients on a cascade of grids, each of half the points of the next one: a coarse solution leaves only short waves to the
//! finer grid, which few iterations settle.

use super::polynomial::{Polynomial, Samples};
use crate::lattice::Cell;
use crate::numeric::array::field;
use crate::numeric::sums::BLOCK;
use ndarray::Array2;
use rayon::prelude::*;

/// Most iterations on a grid, enough for a hole of as many samples across.
const MOST: usize = 300;
/// Residual over that of no solution at which a grid is settled.
const SETTLED: f64 = 1e-9;
/// No number of a hole.
const MEASURED: u32 = u32::MAX;

/// Heights with their holes filled, lengths, and the number of these; NaN marks a hole, of which there must be fewer than samples.
pub fn filled(cell: Cell, heights: Array2<f64>) -> (Array2<f64>, usize) {
    let holes = heights.iter().filter(|height| height.is_nan()).count();
    if holes == 0 || holes == heights.len() {
        return (heights, holes);
    }
    let heights = if heights.is_standard_layout() { heights } else { heights.as_standard_layout().into_owned() };
    let samples = Samples::new(cell, &heights);
    // Samples on one line determine no plane.
    let plane = Polynomial::fit(&samples, 3).unwrap_or(Polynomial([0.0; 6]));
    let above = (0..samples.len()).map(|k| samples.height(k) - plane.at(samples.place(k))).collect();
    let points: [usize; 2] = heights.dim().into();
    let spacing = cell.vectors().map(|[x, y]| x.hypot(y));
    let weights = [0, 1].map(|axis| (points[axis] as f64 / spacing[axis]).powi(2));
    let scale = weights[0].max(weights[1]);
    let level = harmonic(field(points, above), weights.map(|weight| weight / scale));
    let back = |k: usize| samples.unit * (level[[k / points[1], k % points[1]]] + plane.at(samples.place(k)));
    let whole = heights.iter().enumerate().map(|(k, height)| if height.is_nan() { back(k) } else { *height }).collect();
    (field(points, whole), holes)
}

/// The field with its NaN replaced by the harmonic continuation; `weights` along both axes.
fn harmonic(mut values: Array2<f64>, weights: [f64; 2]) -> Array2<f64> {
    let holes = Holes::of(&values);
    if holes.places.is_empty() {
        return values;
    }
    let coarse = harmonic(halved(&values), weights);
    for &[i, j] in &holes.places {
        values[[i, j]] = coarse[[i / 2, j / 2]];
    }
    holes.solve(&mut values, weights);
    values
}

/// Means over blocks of 2 × 2 of what is measured there; NaN where nothing is.
fn halved(values: &Array2<f64>) -> Array2<f64> {
    let (n1, n2) = values.dim();
    Array2::from_shape_fn((n1.div_ceil(2), n2.div_ceil(2)), |(i, j)| {
        let block = (2 * i..n1.min(2 * i + 2)).flat_map(|i| (2 * j..n2.min(2 * j + 2)).map(move |j| [i, j]));
        let (sum, count) = block
            .map(|at| values[at])
            .filter(|value| !value.is_nan())
            .fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
        sum / count
    })
}

/// The holes of a field.
struct Holes {
    places: Vec<[usize; 2]>,
    /// Number of the hole at each sample, or [`MEASURED`].
    number: Array2<u32>,
}

impl Holes {
    fn of(values: &Array2<f64>) -> Self {
        let mut places = Vec::new();
        let number = values.map(|_| MEASURED);
        let mut own = Self { places: Vec::new(), number };
        for ((i, j), value) in values.indexed_iter() {
            if value.is_nan() {
                own.number[[i, j]] = places.len() as u32;
                places.push([i, j]);
            }
        }
        own.places = places;
        own
    }

    /// Neighbours of hole k with their weights.
    fn neighbours(&self, k: usize, weights: [f64; 2]) -> impl Iterator<Item = ([usize; 2], f64)> {
        let ([i, j], (n1, n2)) = (self.places[k], self.number.dim());
        let along = [(i > 0).then(|| [i - 1, j]), (i + 1 < n1).then_some([i + 1, j])];
        let across = [(j > 0).then(|| [i, j - 1]), (j + 1 < n2).then_some([i, j + 1])];
        let weigh = move |places: [Option<[usize; 2]>; 2], weight: f64| {
            places.into_iter().flatten().map(move |at| (at, weight))
        };
        weigh(along, weights[0]).chain(weigh(across, weights[1]))
    }

    /// Σ w (u − u of the neighbour) at every hole, u at measured neighbours by `rim`.
    fn applied(&self, u: &[f64], weights: [f64; 2], rim: impl Fn([usize; 2]) -> f64 + Sync) -> Vec<f64> {
        let of = |k: usize| {
            let difference = |(at, weight): ([usize; 2], f64)| {
                let other = match self.number[at] {
                    MEASURED => rim(at),
                    number => u[number as usize],
                };
                weight * (u[k] - other)
            };
            self.neighbours(k, weights).map(difference).sum()
        };
        (0..u.len()).into_par_iter().with_min_len(BLOCK).map(of).collect()
    }

    /// Solves from the values that the holes have, with the inverse of the diagonal as preconditioner.
    fn solve(&self, values: &mut Array2<f64>, weights: [f64; 2]) {
        let product = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let diagonal: Vec<f64> =
            (0..self.places.len()).map(|k| self.neighbours(k, weights).map(|(_, weight)| weight).sum()).collect();
        let mut u: Vec<f64> = self.places.iter().map(|at| values[*at]).collect();
        let of_none = self.applied(&vec![0.0; u.len()], weights, |at| values[at]);
        let enough = SETTLED * product(&of_none, &of_none).sqrt();
        let mut residual: Vec<f64> = self.applied(&u, weights, |at| values[at]).into_iter().map(|x| -x).collect();
        let mut direction: Vec<f64> = residual.iter().zip(&diagonal).map(|(r, d)| r / d).collect();
        let mut rz = product(&residual, &direction);
        for _ in 0..MOST {
            if product(&residual, &residual).sqrt() <= enough || rz <= 0.0 {
                break;
            }
            let image = self.applied(&direction, weights, |_| 0.0);
            let step = rz / product(&direction, &image);
            u.iter_mut().zip(&direction).for_each(|(u, d)| *u += step * d);
            residual.iter_mut().zip(&image).for_each(|(r, a)| *r -= step * a);
            let conditioned: Vec<f64> = residual.iter().zip(&diagonal).map(|(r, d)| r / d).collect();
            let next = product(&residual, &conditioned);
            direction.iter_mut().zip(&conditioned).for_each(|(d, z)| *d = z + next / rz * *d);
            rz = next;
        }
        self.places.iter().zip(u).for_each(|(at, u)| values[*at] = u);
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
        // The residual over the least eigenvalue, about 0.01: 1e-9 × 240/0.01 × 35 of heights to 700.
        assert!(error(cell, &saddle, &inside) < 1e-3, "{}", error(cell, &saddle, &inside));
        let plane = surface(&|x, y| 1e3 + 0.7 * x - 0.2 * y);
        assert!(error(cell, &plane, &[[0, 0, 5, 9], [70, 10, 2, 30], [20, 20, 3, 3]]) < 1e-10);
    }

    /// Between the lowest and the highest height at its rim, also where the cascade begins with one sample.
    #[test]
    fn a_hole_lies_between_the_heights_at_its_rim() {
        let rough = Array2::from_shape_fn((33, 65), |(i, j)| ((3 * i + 7 * j * j) % 11) as f64);
        let found = harmonic(with_holes(&rough, &[[1, 1, 31, 62]]), [1.0, 0.3]);
        assert!(found.iter().all(|height| (-1e-6..=10.0 + 1e-6).contains(height)));
        let mut alone = Array2::from_elem((8, 8), f64::NAN);
        alone[[5, 2]] = 3.0;
        let (found, count) = filled(Cell::square(1.0).unwrap(), alone);
        assert!(count == 63 && found.iter().all(|height| (height - 3.0).abs() < 1e-9), "{found}");
    }
}
