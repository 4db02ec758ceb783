//! The sphere and the cylinder that fit a surface best, by Levenberg and Marquardt's iteration.
//!
//! Parameters are the height c and the slopes g in the middle, the curvature κ and the azimuth φ of the axis. With **u** = (x, y),
//! A = **n**·**u**, B = **t**·**u** and (n_z, t_z) the third components of **n** and **t** ([`form`](super::form)), the height above c is the root
//!
//! w = C/(b + √(b² − aC)),  a = κ(1 − t_z²),  b = n_z + κ B t_z,  C = κ(|**u**|² − B²) − 2A,
//!
//! which passes into the plane w = −A/n_z for κ → 0 without cancellation. Each step solves (JᵀJ + λ diag JᵀJ) δ = Jᵀr; λ falls after a
//! step that lessens Σr² and rises otherwise.

use super::polynomial::{Polynomial, Samples};
use crate::numeric::{linear, sums};
use std::f64::consts::FRAC_PI_2;

/// Most steps; a measured surface takes about ten.
const MOST: usize = 200;
/// Step of the difference quotients for the derivatives, in units: errors of 1e-10 only slow the iteration down.
const STEP: f64 = 1e-5;
/// Relative change of Σr² at which the iteration ends.
const SETTLED: f64 = 1e-13;
/// Least (b² − aC)/b² of a fit at a sample, 0 at the equator: where samples lie beyond it, the iteration creeps to the smallest form that still
/// reaches the farthest of them.
const EQUATOR: f64 = 1e-3;
/// Σr² per sample that is round-off, relative to the squared heights.
const ROUND_OFF: f64 = 1e-29;

/// A sphere or a cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Round {
    /// c, gₓ, g_y, κ, φ, in units.
    pub parameters: [f64; 5],
    is_cylinder: bool,
}

impl Round {
    /// The best sphere or cylinder, from the polynomial of second order; `None` where the iteration finds none, or one whose equator is at a
    /// sample.
    pub fn fit(samples: &Samples<'_>, start: Polynomial, is_cylinder: bool) -> Option<Self> {
        let form = Self::iterated(samples, start, is_cylinder)?;
        let margin = |k: usize| if samples.height(k).is_nan() { 1.0 } else { form.margin(samples.place(k)) };
        (sums::least(samples.len(), margin) > EQUATOR).then_some(form)
    }

    fn iterated(samples: &Samples<'_>, start: Polynomial, is_cylinder: bool) -> Option<Self> {
        let mut form = Self::osculating(start, is_cylinder);
        let mut normal = form.normal(samples);
        // A start with curvature may not reach all samples.
        if !normal.squares.is_finite() {
            form.parameters[3] = 0.0;
            normal = form.normal(samples);
        }
        let enough = ROUND_OFF * normal.heights;
        let mut damping = 1e-3;
        for _ in 0..MOST {
            if normal.squares <= enough {
                return Some(form);
            }
            let other = Self { parameters: normal.step(form.parameters, damping, is_cylinder)?, ..form };
            let next = other.normal(samples);
            if next.squares.is_finite() && next.squares <= normal.squares {
                let has_settled = normal.squares - next.squares <= SETTLED * normal.squares;
                (form, normal, damping) = (other, next, damping / 9.0);
                if has_settled {
                    return Some(form);
                }
            } else if damping > 1e12 {
                // No step lessens the squares any more: they are least within rounding, or a sample is at the equator.
                return Some(form);
            } else {
                damping *= 7.0;
            }
        }
        None
    }

    /// The round form with height, slope and curvature of a polynomial in the middle.
    fn osculating(Polynomial([c, gx, gy, xx, xy, yy]): Polynomial, is_cylinder: bool) -> Self {
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        if !is_cylinder {
            return Self { parameters: [c, gx, gy, mean, 0.0], is_cylinder };
        }
        // The principal direction of the larger curvature is across the axis.
        let of_larger = 0.5 * xy.atan2(0.5 * (xx - yy));
        let (curvature, across) =
            if mean >= 0.0 { (mean + half, of_larger) } else { (mean - half, of_larger + FRAC_PI_2) };
        Self { parameters: [c, gx, gy, curvature, across + FRAC_PI_2], is_cylinder }
    }

    /// Height at a place, in units; `None` beyond the equator.
    pub fn at(&self, place: [f64; 2]) -> Option<f64> {
        let [linear, constant, root] = self.quadratic(place);
        (root >= 0.0 && linear > 0.0).then(|| self.parameters[0] + constant / (linear + root.sqrt()))
    }

    /// (b² − aC)/b² at a place: 1 in the middle, 0 at the equator.
    fn margin(&self, place: [f64; 2]) -> f64 {
        let [linear, _, root] = self.quadratic(place);
        root / (linear * linear)
    }

    /// b, C and b² − aC at a place, in units.
    fn quadratic(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let [_, gx, gy, curvature, azimuth] = self.parameters;
        let (sine, cosine) = azimuth.sin_cos();
        let size = (1.0 + gx * gx + gy * gy).sqrt();
        let (a, n_z) = (-(gx * x + gy * y) / size, 1.0 / size);
        let rise = gx * cosine + gy * sine;
        let length = if self.is_cylinder { (1.0 + rise * rise).sqrt() } else { f64::INFINITY };
        let (b, t_z) = ((cosine * x + sine * y) / length, rise / length);
        let quadratic = curvature * (1.0 - t_z * t_z);
        let linear = n_z + curvature * b * t_z;
        let constant = curvature * (x * x + y * y - b * b) - 2.0 * a;
        [linear, constant, linear * linear - quadratic * constant]
    }

    /// Radius, in units; `None` of a plane.
    pub fn radius(&self) -> Option<f64> {
        Some(self.parameters[3].abs().recip()).filter(|radius| radius.is_finite())
    }

    /// JᵀJ, Jᵀr, Σr² and Σh².
    fn normal(&self, samples: &Samples<'_>) -> Normal {
        let changed = |k: usize, change: f64| {
            let mut moved = *self;
            moved.parameters[k] += change;
            moved
        };
        let others: [[Self; 2]; 5] = std::array::from_fn(|k| [changed(k, STEP), changed(k, -STEP)]);
        let summed = sums::of::<22>(samples.len(), |k| {
            let (height, place) = (samples.height(k), samples.place(k));
            let mut products = [0.0; 22];
            if height.is_nan() {
                return products;
            }
            let Some(residual) = self.at(place).map(|form| height - form) else {
                products[20] = f64::INFINITY;
                return products;
            };
            let slope = |[more, less]: &[Self; 2]| match (more.at(place), less.at(place)) {
                (Some(more), Some(less)) => (more - less) / (2.0 * STEP),
                _ => 0.0,
            };
            let slopes = others.each_ref().map(slope);
            for row in 0..5 {
                (0..=row).for_each(|column| products[row * (row + 1) / 2 + column] = slopes[row] * slopes[column]);
                products[15 + row] = slopes[row] * residual;
            }
            (products[20], products[21]) = (residual * residual, height * height);
            products
        });
        let at = |row: usize, column: usize| summed[row.max(column) * (row.max(column) + 1) / 2 + row.min(column)];
        Normal {
            matrix: std::array::from_fn(|row| std::array::from_fn(|column| at(row, column))),
            right: std::array::from_fn(|row| summed[15 + row]),
            squares: summed[20],
            heights: summed[21],
        }
    }
}

/// Normal equations of a step.
#[derive(Debug, Clone, Copy)]
struct Normal {
    matrix: [[f64; 5]; 5],
    right: [f64; 5],
    /// Σr², infinite where a sample has no height.
    squares: f64,
    /// Σh².
    heights: f64,
}

impl Normal {
    /// Parameters after a damped step; a sphere has no azimuth.
    fn step(&self, mut parameters: [f64; 5], damping: f64, is_cylinder: bool) -> Option<[f64; 5]> {
        let count = if is_cylinder { 5 } else { 4 };
        let trace: f64 = (0..count).map(|k| self.matrix[k][k]).sum();
        // A plane has no axis: the azimuth stays where nothing depends on it.
        let damped = |row: usize, column: usize| {
            let entry = self.matrix[row][column];
            if row == column { entry + damping * entry.max(1e-15 * trace) } else { entry }
        };
        let rows = (0..count).map(|row| (0..count).map(|column| damped(row, column)).collect()).collect();
        let change = linear::solve(rows, self.right[..count].to_vec())?;
        parameters.iter_mut().zip(change).for_each(|(parameter, change)| *parameter += change);
        Some(parameters)
    }
}
