//! Area of contact of any shape, between the samples.
//!
//! Along every line of samples contact is a set of intervals. Where an interval ends, p² vanishes nearly like a parabola of the
//! distance; the end is the root of the parabola fitted to the samples behind the outermost one. The lengths, averaged over the lines of both
//! directions (and of the third natural one on a rhombus), give the fraction of the cell. Intervals of few samples are counted.

use crate::grid::Grid;
use crate::least_squares;

/// Fewest samples of an interval whose ends are fitted.
const FEWEST: usize = 8;

/// Fraction of the cell in contact: p > 0, from pressure (one value per sample).
pub fn contact_fraction(grid: &Grid, pressure: &[f64]) -> f64 {
    let [n1, n2] = grid.points();
    let (mut length, mut lines) = (0.0, 0.0);
    for i in 0..n1 {
        length += line_fraction(n2, |j| pressure[i * n2 + j]);
        lines += 1.0;
    }
    for j in 0..n2 {
        length += line_fraction(n1, |i| pressure[i * n2 + j]) * n1 as f64 / n2 as f64;
        lines += n1 as f64 / n2 as f64;
    }
    length / lines
}

/// Fraction of a closed line of `n` samples with p > 0.
fn line_fraction(n: usize, p: impl Fn(usize) -> f64) -> f64 {
    // Start behind a sample without contact, so that no interval is cut.
    let Some(start) = (0..n).find(|&i| p(i) <= 0.0) else { return 1.0 };
    let at = |i: usize| p((start + i) % n);
    let (mut total, mut i) = (0.0, 0);
    while i < n {
        if at(i) <= 0.0 {
            i += 1;
            continue;
        }
        let first = i;
        while i < n && at(i) > 0.0 {
            i += 1;
        }
        total += interval_length(i - first, |k| at(first + k));
    }
    total / n as f64
}

/// Length, in samples, of an interval of `count` samples in contact.
fn interval_length(count: usize, p: impl Fn(usize) -> f64) -> f64 {
    let counted = count as f64;
    if count < FEWEST {
        return counted;
    }
    // Samples used at each end: the outermost is skipped, the window grows with the root of the length.
    let used = (count / 2 - 1).min(3 + (counted.sqrt()) as usize);
    let end = |p: &dyn Fn(usize) -> f64| -> f64 {
        let scale = p(used).powi(2);
        let fitted = least_squares::fit(
            3,
            (1..=used).map(|k| {
                let x = k as f64 / used as f64;
                (vec![1.0, x, x * x], p(k).powi(2) / scale)
            }),
        );
        // Root nearest to the outermost sample, in samples beyond it.
        let beyond = fitted.and_then(|c| {
            let discriminant = c[1] * c[1] - 4.0 * c[0] * c[2];
            (c[1] > 0.0 && discriminant >= 0.0).then(|| 2.0 * c[0] / (c[1] + discriminant.sqrt()) * used as f64)
        });
        beyond.filter(|x| (-1.0..=1.0).contains(x)).unwrap_or(0.5)
    };
    counted - 1.0 + end(&p) + end(&|k| p(count - 1 - k))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;
    use std::f64::consts::PI;

    #[test]
    fn a_disc_and_its_complement_have_their_areas() {
        let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [120, 120]).unwrap();
        let radius = 0.3;
        let field = |inside: bool| -> Vec<f64> {
            (0..grid.len())
                .map(|index| {
                    let [s, t] = grid.fractions(index);
                    let [x, y] = grid.cell().point([s - 0.5, t - 0.5]);
                    let depth = 1.0 - (x * x + y * y) / (radius * radius);
                    (if inside { depth } else { -depth }).max(0.0).sqrt()
                })
                .collect()
        };
        let exact = PI * radius * radius / grid.cell().area();
        assert!((contact_fraction(&grid, &field(true)) / exact - 1.0).abs() < 5e-4);
        assert!((contact_fraction(&grid, &field(false)) - (1.0 - exact)).abs() < 5e-4);
    }

    #[test]
    fn full_contact_and_none_are_exact() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 12]).unwrap();
        assert_eq!(contact_fraction(&grid, &[1.0; 96]), 1.0);
        assert_eq!(contact_fraction(&grid, &[0.0; 96]), 0.0);
    }
}
