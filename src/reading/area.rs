//! Area of contact of any shape, between the samples.
//!
//! Along every line of nearest samples contact is a set of intervals. At a distance d inside an end p² falls nearly as d, at a
//! distance d outside g^{2/3} rises nearly as d: the end is the mean of the roots of two parabolas, one fitted to p² on
//! the one side, one to g^{2/3} on the other, each without the outermost sample. The lengths, averaged over the lines
//! of all directions, give the fraction of the cell. What the two roots differ measures their error. Between intervals
//! of few samples the end is halfway.

use crate::lattice::Grid;
use crate::numeric::least_squares;
use rayon::prelude::*;

/// Fewest samples of an interval for a parabola, and most samples it uses beyond the square root of their number.
const FEWEST: usize = 6;
const MOST: usize = 3;

/// Fraction of the cell in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    /// The fraction.
    pub fraction: f64,
    /// Its estimated error: half of what the two readings of each end differ.
    pub error: f64,
}

/// Fraction of the cell in contact, from pressure and gap (one value per sample each), without the intervals whose
/// samples are `known`.
pub fn contact_fraction(grid: &Grid, pressure: &[f64], gap: &[f64], known: impl Fn(usize) -> bool + Sync) -> Area {
    let sample = |index: usize| (pressure[index], gap[index], known(index));
    let mut mean = [0.0; 2];
    for direction in grid.directions() {
        let lines = direction.lines(grid.points());
        let read = |&start: &usize| {
            let line: Vec<usize> = direction.line(grid.points(), start).collect();
            line_fraction(line.len(), |k| sample(line[k]))
        };
        // Lines are added in their order, whoever has read them.
        let all: Vec<[f64; 2]> = lines.par_iter().map(read).collect();
        let sum = all.iter().fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        mean = [0, 1].map(|k| mean[k] + 0.5 * direction.weight * (sum[k] / lines.len() as f64));
    }
    Area { fraction: mean[0], error: mean[1] }
}

/// Fraction in contact of a closed line of `n` samples, of each pressure, gap and whether it is known, and its estimated
/// error.
fn line_fraction(n: usize, sample: impl Fn(usize) -> (f64, f64, bool)) -> [f64; 2] {
    let touches = |i: usize| sample(i % n).0 > 0.0;
    let known = |i: usize| sample(i).2;
    let height = |i: usize| match sample(i) {
        (p, ..) if p > 0.0 => p * p,
        (_, gap, _) => -gap.max(0.0).powf(2.0 / 3.0),
    };
    let Some(start) = (0..n).find(|&i| !touches(i) && touches(i + 1)) else {
        // No end: all or nothing.
        return [f64::from(u8::from(touches(0) && !known(0))), 0.0];
    };
    // Intervals in turn, from the first sample in contact: contact, open, contact, …
    let mut ends = vec![start + 1];
    for i in start + 1..start + n {
        if touches(i) != touches(i + 1) {
            ends.push(i + 1);
        }
    }
    ends.push(start + 1 + n);
    let mut total = [0.0; 2];
    for (index, interval) in ends.windows(2).enumerate().step_by(2).filter(|(_, interval)| !known(interval[0] % n)) {
        let [first, last] = [interval[0], interval[1]];
        total[0] += (last - first) as f64 - 1.0;
        // How far contact reaches beyond its outermost samples.
        let (before, after) = (open_length(&ends, index, n), open_length(&ends, index + 1, n));
        let count = last - first;
        for [length, error] in [
            overhang(|k| height((first + k) % n), count, |k| -height((first + n - 1 - k) % n), before),
            overhang(|k| height((last - 1 - k) % n), count, |k| -height((last + k) % n), after),
        ] {
            total[0] += length;
            total[1] += error;
        }
    }
    total.map(|samples| samples / n as f64)
}

/// Length of the open interval that ends or begins at the border of this index.
fn open_length(ends: &[usize], index: usize, n: usize) -> usize {
    // Borders alternate; the first and the last one are the same border of the closed line.
    let (end, borders) = (ends[index], ends.len() - 1);
    if index % 2 == 1 { ends[index + 1] - end } else { (end + n - ends[(index + borders - 1) % borders]) % n }
}

/// How far contact reaches beyond its outermost sample, in samples, between 0 and 1, and how uncertain that is:
/// `inside(k)` and `outside(k)` are the heights k samples from the end on either side. Where one side alone can be read,
/// a quarter of a sample is uncertain, where none can, half.
fn overhang(inside: impl Fn(usize) -> f64, count: usize, outside: impl Fn(usize) -> f64, open: usize) -> [f64; 2] {
    let from_inside = beyond(inside, count);
    let from_outside = beyond(outside, open).map(|x| 1.0 - x);
    match (from_inside, from_outside) {
        (Some(a), Some(b)) => [0.5 * (a + b), 0.5 * (a - b).abs()],
        (Some(x), None) | (None, Some(x)) => [x, 0.25],
        (None, None) => [0.5; 2],
    }
}

/// How far beyond the outermost of `count` samples their heights vanish, if there are enough of them.
fn beyond(height: impl Fn(usize) -> f64, count: usize) -> Option<f64> {
    if count < FEWEST {
        return None;
    }
    let used = (count / 2 - 1).min(MOST + (count as f64).sqrt() as usize).max(3);
    let scale = height(used);
    let rows = (1..=used).map(|k| {
        let x = k as f64 / used as f64;
        (vec![1.0, x, x * x], height(k) / scale)
    });
    let c = least_squares::fit(3, rows)?;
    let discriminant = c[1] * c[1] - 4.0 * c[0] * c[2];
    let root = 2.0 * c[0] / (c[1] + discriminant.max(0.0).sqrt()) * used as f64;
    (c[1] > 0.0 && discriminant >= 0.0).then(|| root.clamp(0.0, 1.0))
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
        let exact = PI * radius * radius / grid.cell().area();
        for (inside, expected) in [(1.0, exact), (-1.0, 1.0 - exact)] {
            let depth: Vec<f64> = (0..grid.len())
                .map(|index| {
                    let [s, t] = grid.fractions(index);
                    let [x, y] = grid.cell().point([s - 0.5, t - 0.5]);
                    inside * (1.0 - (x * x + y * y) / (radius * radius))
                })
                .collect();
            let pressure: Vec<f64> = depth.iter().map(|d| d.max(0.0).sqrt()).collect();
            let gap: Vec<f64> = depth.iter().map(|d| (-d).max(0.0).powf(1.5)).collect();
            let Area { fraction, .. } = contact_fraction(&grid, &pressure, &gap, |_| false);
            assert!((fraction - expected).abs() < 2e-4, "{fraction} {expected}");
        }
    }

    #[test]
    fn full_contact_and_none_are_exact() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 12]).unwrap();
        let exact = |fraction| Area { fraction, error: 0.0 };
        assert_eq!(contact_fraction(&grid, &[1.0; 96], &[0.0; 96], |_| false), exact(1.0));
        assert_eq!(contact_fraction(&grid, &[0.0; 96], &[1.0; 96], |_| false), exact(0.0));
    }

    #[test]
    fn one_sample_in_contact_is_one_sample_of_area() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        let mut pressure = [0.0; 64];
        pressure[27] = 1.0;
        // One line of eight in each direction, with one sample: half a sample beyond it on either side.
        let found = contact_fraction(&grid, &pressure, &[0.0; 64], |_| false);
        assert!((found.fraction - 1.0 / 64.0).abs() < 1e-12 && found.error > 0.0);
        assert_eq!(contact_fraction(&grid, &pressure, &[0.0; 64], |index| index == 27).fraction, 0.0);
    }
}
