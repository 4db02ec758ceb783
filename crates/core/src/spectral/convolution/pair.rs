//! Convolution of a pair of fields at once: a vector in the plane on every sample, multiplied by a 2 × 2 matrix wave by wave.
//!
//! Both components pass the rows one after the other; in the pass over columns a tile of each is transformed, multiplied and transformed back
//! together. The work is divided as for one field, so that no bit depends on the number of threads.

use super::{Convolution, Convolved};
use crate::numeric::aligned::Aligned;
use crate::numeric::fourier::LINE;
use crate::numeric::lanes::LANES;
use crate::numeric::parallel;
use crate::numeric::rows::next;
use crate::spectral::by_rows::ResultRows;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// A symmetric 2 × 2 matrix Â(k₁, k₂), even, k₂ ≤ N₂/2: u = Â q.
#[derive(Debug, Clone)]
pub struct ShearMultiplier {
    /// Â_xx, Â_yy, Â_xy over N₁N₂, in the order of the column pass.
    tables: [Vec<f64>; 3],
    /// 1/(N₁N₂).
    normalisation: f64,
}

/// A vector **G**(k₁, k₂), odd, k₂ ≤ N₂/2, that couples the plane with its normal by ±i**G**.
#[derive(Debug, Clone)]
pub struct VectorMultiplier {
    /// G_x, G_y over N₁N₂, in the order of the column pass.
    tables: [Vec<f64>; 2],
}

/// Product in Fourier space of a pair of fields.
#[derive(Debug, Clone, Copy)]
pub enum PairAction<'a> {
    /// (x, y) → Â (x, y).
    Shear(&'a ShearMultiplier),
    /// x → i**G** x, of a pair of which the first field alone counts.
    Gradient(&'a VectorMultiplier),
    /// (x, y) → −i**G**·(x, y), the first field of the result; the second is zero.
    Divergence(&'a VectorMultiplier),
}

impl ShearMultiplier {
    /// The matrix of the values Â_xx, Â_yy, Â_xy that `of` gives the components (k₁, k₂), 0 ≤ k₁ < N₁, 0 ≤ k₂ ≤ N₂/2.
    pub fn new(convolution: &Convolution<f64>, of: impl Fn([usize; 2]) -> [f64; 3] + Sync) -> Self {
        let normalisation = convolution.normalisation();
        Self {
            tables: tables(convolution, |component| of(component).map(|value| value * normalisation)),
            normalisation,
        }
    }

    /// The matrix (Â + λ)⁻¹.
    #[must_use]
    pub fn inverse(&self, lambda: f64) -> Self {
        let [xx, yy, xy] = &self.tables;
        let (shift, square) = (lambda * self.normalisation, self.normalisation * self.normalisation);
        let inverses = parallel::map_by(LANES * LANES, xx.len(), |i| {
            let [a, b, c] = [xx[i] + shift, yy[i] + shift, xy[i]];
            let determinant = a * b - c * c;
            // Places beyond the last column are empty.
            if determinant > 0.0 { [b, a, -c].map(|x| square * x / determinant) } else { [0.0; 3] }
        });
        let tables = [0, 1, 2].map(|k| inverses.iter().map(|values| values[k]).collect());
        Self { tables, normalisation: self.normalisation }
    }

    /// The matrix with these values of the component (0, 0).
    #[must_use]
    pub fn with_mean(mut self, values: [f64; 3]) -> Self {
        for (table, value) in self.tables.iter_mut().zip(values) {
            table[0] = value * self.normalisation;
        }
        self
    }
}

impl VectorMultiplier {
    /// The vector of the values G_x, G_y that `of` gives the components (k₁, k₂), 0 ≤ k₁ < N₁, 0 ≤ k₂ ≤ N₂/2; zero for those that are their
    /// own conjugates.
    pub fn new(convolution: &Convolution<f64>, of: impl Fn([usize; 2]) -> [f64; 2] + Sync) -> Self {
        let normalisation = convolution.normalisation();
        Self { tables: tables(convolution, |component| of(component).map(|value| value * normalisation)) }
    }

    /// Whether the vector is zero for all waves.
    pub fn is_zero(&self) -> bool {
        self.tables.iter().flatten().all(|value| *value == 0.0)
    }
}

/// Tables of several values of each component, in the order of the column pass.
fn tables<const K: usize>(convolution: &Convolution<f64>, of: impl Fn([usize; 2]) -> [f64; K] + Sync) -> [Vec<f64>; K] {
    let ([n1, _], half) = (convolution.points, convolution.half());
    let values = parallel::map_by(half, n1 * half, |i| of([i / half, i % half]));
    std::array::from_fn(|kind| {
        convolution.table(0.0, false, |[k1, k2], to| {
            to.iter_mut().zip(k2..).for_each(|(to, k2)| *to = values[k1 * half + k2][kind]);
        })
    })
}

impl PairAction<'_> {
    /// Multiplies the lines of a tile of both fields.
    fn multiply(self, tile: usize, [first, second]: [&mut [f64]; 2]) {
        let lines = first.chunks_exact_mut(LINE).zip(second.chunks_exact_mut(LINE));
        let factors = |table: &[f64], line: usize, rows: usize, lane: usize| table[(tile * rows + line) * LANES + lane];
        match self {
            Self::Shear(ShearMultiplier { tables: [xx, yy, xy], .. }) => {
                let rows = lines.len();
                for (line, (x, y)) in lines.enumerate() {
                    for k in 0..LINE {
                        let [a, b, c] = [xx, yy, xy].map(|table| factors(table, line, rows, k % LANES));
                        (x[k], y[k]) = (a * x[k] + c * y[k], c * x[k] + b * y[k]);
                    }
                }
            }
            Self::Gradient(VectorMultiplier { tables }) => {
                let rows = lines.len();
                for (line, (x, y)) in lines.enumerate() {
                    for lane in 0..LANES {
                        let [gx, gy] = tables.each_ref().map(|table| factors(table, line, rows, lane));
                        let (re, im) = (x[lane], x[LANES + lane]);
                        (x[lane], x[LANES + lane]) = (-gx * im, gx * re);
                        (y[lane], y[LANES + lane]) = (-gy * im, gy * re);
                    }
                }
            }
            Self::Divergence(VectorMultiplier { tables }) => {
                let rows = lines.len();
                for (line, (x, y)) in lines.enumerate() {
                    for lane in 0..LANES {
                        let [gx, gy] = tables.each_ref().map(|table| factors(table, line, rows, lane));
                        let sum = |part: usize| gx * x[part + lane] + gy * y[part + lane];
                        (x[lane], x[LANES + lane]) = (sum(LANES), -sum(0));
                    }
                    y.fill(0.0);
                }
            }
        }
    }
}

impl Convolution<f64> {
    /// Numbers that a convolution of a pair has for its memory.
    pub fn pair_memory(&self) -> usize {
        2 * self.size()
    }

    /// F⁻¹[action · F v] of a field v of vectors, in place; rows that are not `needed` possibly as zeros. The `memory` holds
    /// [`Self::pair_memory`] numbers.
    ///
    /// # Panics
    /// When the multiplier belongs to other `points`, or the memory is too small.
    pub fn convolve_pair(
        &self,
        action: PairAction<'_>,
        memory: &mut [f64],
        field: &mut [[f64; 2]],
        needed: impl Fn(usize) -> bool + Sync,
    ) {
        let (first, second) = memory[..self.pair_memory()].split_at_mut(self.size());
        for (component, spectrum) in [&mut *first, &mut *second].into_iter().enumerate() {
            let sources = self.blocks.of(&*field).map(|mut rows| {
                move |to: &mut [f64]| to.iter_mut().zip(next(&mut rows)).for_each(|(to, v)| *to = v[component])
            });
            self.rows_forward(sources, spectrum);
        }
        self.pair_column_pass(action, first, second);
        for (component, spectrum) in [&*first, &*second].into_iter().enumerate() {
            let sinks = self.blocks.of_mut(&mut *field).map(|mut rows| {
                move |from: &mut [f64]| next(&mut rows).iter_mut().zip(from).for_each(|(v, x)| v[component] = *x)
            });
            Convolved { convolution: self, spectrum }.some_rows(&needed, sinks);
        }
    }

    fn pair_column_pass(&self, action: PairAction<'_>, first: &mut [f64], second: &mut [f64]) {
        let (size, whole) = (self.tile(), self.points[0] * LINE);
        let padding = if size < whole { whole } else { 0 };
        let memory = || {
            (
                vec![Complex64::ZERO; self.columns.scratch(self.points[0])],
                [(); 2].map(|()| Aligned::<f64>::new(padding)),
            )
        };
        let tiles = first.par_chunks_exact_mut(size).zip(second.par_chunks_exact_mut(size)).enumerate();
        tiles.for_each_init(memory, |(scratch, padded), (tile, (x, y))| {
            let mut pass = |x: &mut [f64], y: &mut [f64]| {
                self.columns.forward(x, scratch);
                self.columns.forward(y, scratch);
                action.multiply(tile, [&mut *x, &mut *y]);
                self.columns.inverse(x, scratch);
                self.columns.inverse(y, scratch);
            };
            if padding == 0 {
                return pass(x, y);
            }
            let [first, second] = padded;
            for (padded, lines) in [(&mut *first, &*x), (&mut *second, &*y)] {
                padded[..size].copy_from_slice(lines);
                padded[size..].fill(0.0);
            }
            pass(first, second);
            x.copy_from_slice(&first[..size]);
            y.copy_from_slice(&second[..size]);
        });
    }
}
