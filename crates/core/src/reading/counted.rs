//! The area in contact counted by samples, its border, and its correction by the perimeter.
//!
//! n of N samples are in contact, and one of both in E pairs of neighbours: neighbours along the reduced basis of the
//! samples' lattice, whichever vectors describe the cell (where three directions are tied, each counts by its weight).
//! Counting takes every sample at the border for whole, and overestimates: V. A. Yastrebov, G. Anciaux & J.-F. Molinari
//! (Tribol. Int. 114 (2017) 161–171) take off (π − 1 + ln 2)/24 · S_d Δx with the perimeter S_d along the edges of the
//! samples, of which every pair has one, so that S_d Δx is E samples and
//!
//! A/A₀ = (n − (π − 1 + ln 2)/24 · E)/N.
//!
//! The factor is that of square samples, a mean over the directions of a border; on others it is taken over as it is.

use super::fraction::Fraction;
use crate::lattice::Grid;
use crate::numeric::parallel;
use std::f64::consts::{LN_2, PI};

/// Yastrebov's factor of the border pairs, (π − 1 + ln 2)/24.
const PERIMETER_FACTOR: f64 = (PI - 1.0 + LN_2) / 24.0;

/// Uncertainty of the correction by the perimeter, relative to it: the factor of a border depends on its directions.
const CORRECTION_UNCERTAINTY: f64 = 0.25;

/// The area in contact counted by samples, on one grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CountedArea {
    /// Samples in contact over all samples.
    pub fraction: f64,
    /// Length of the border along the samples' edges over the cell's area, 1/length.
    pub perimeter_density: f64,
    /// The fraction corrected by the perimeter, with its uncertainty on this grid alone.
    pub corrected: Fraction,
    /// Estimated discretisation error of the corrected fraction; `None` without a coarser grid.
    pub error: Option<f64>,
    /// Mean width of the spots in samples: four times the samples in contact over the pairs of neighbours at their border, π/2
    /// radii of a disc. 0 without contact, infinite without a border.
    pub width: f64,
}

impl CountedArea {
    /// The counted area under a `pressure` given sample by sample.
    pub fn of(grid: &Grid, pressure: &[f64]) -> Self {
        let [pairs, length] = border(grid, pressure);
        let (counted, total) = (pressure.iter().filter(|p| **p > 0.0).count() as f64, grid.len() as f64);
        let value = (counted - PERIMETER_FACTOR * pairs).max(0.0) / total;
        Self {
            fraction: counted / total,
            perimeter_density: length / grid.cell().area(),
            corrected: Fraction { value, uncertainty: CORRECTION_UNCERTAINTY * (counted / total - value) },
            error: None,
            width: if counted > 0.0 { 4.0 * counted / pairs } else { 0.0 },
        }
    }
}

/// Number of pairs of neighbours of which one is in contact, and length of the edges between them, along the other vector of
/// the basis.
fn border(grid: &Grid, pressure: &[f64]) -> [f64; 2] {
    let [n1, n2] = grid.points();
    let row = |i: usize| &pressure[i * n2..(i + 1) * n2];
    let differing = |a: &[f64], b: &[f64]| a.iter().zip(b).filter(|(a, b)| (**a > 0.0) != (**b > 0.0)).count();
    let mut sum = [0.0; 2];
    for direction in grid.directions() {
        let [down, right] = [0, 1].map(|k| direction.step[k].rem_euclid(grid.points()[k] as i32) as usize);
        let of_row = |i: usize| {
            let (upper, lower) = (row(i), row((i + down) % n1));
            differing(&upper[..n2 - right], &lower[right..]) + differing(&upper[n2 - right..], &lower[..right])
        };
        let pairs = direction.weight * parallel::map(n1, of_row).into_iter().sum::<usize>() as f64;
        sum = [sum[0] + pairs, sum[1] + pairs * direction.beside];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    /// Discs whose centres lie anywhere between samples. How well the correction does on contacts is shown in
    /// `tests/library/roughness.rs`.
    #[test]
    fn the_border_of_a_disc_has_eight_radii_of_edges() {
        let n = 64;
        let grid = Grid::new(Cell::square(1.0).unwrap(), [n, n]).unwrap();
        let radius = 0.23;
        for shift in 0..16 {
            let centre = [0.5 + 0.0041 * f64::from(shift), 0.5 - 0.0067 * f64::from(shift)];
            let inside = |index: usize| {
                let [s, t] = grid.fractions(index);
                let (x, y) = (s - centre[0], t - centre[1]);
                f64::from(u8::from(x * x + y * y < radius * radius))
            };
            let pressure: Vec<f64> = (0..grid.len()).map(inside).collect();
            let [_, found] = border(&grid, &pressure);
            // An edge more or less at each of four ends.
            assert!((found - 8.0 * radius).abs() < 4.1 / n as f64, "{found}");
        }
        assert_eq!(border(&grid, &vec![1.0; n * n]), [0.0; 2]);
    }

    #[test]
    fn one_sample_in_contact_has_four_edges() {
        let grid = Grid::new(Cell::square(2.0).unwrap(), [8, 8]).unwrap();
        let mut pressure = [0.0; 64];
        pressure[9] = 1.0;
        assert_eq!(border(&grid, &pressure), [4.0, 4.0 * 0.25]);
    }
}
